"""The analysis of benches/large as a good SciPy user would write it, on the same matrices and in one thread.

    cargo bench --bench large -- --write FOLDER 1k 10k
    python3 benches/scipy_wing.py FOLDER/1k FOLDER/10k

NumPy and SciPy alone; with scikit-sparse installed CHOLMOD is timed beside SuperLU. Element matrices are given, as they are to
the analysis that is compared. Frequencies and shares are held against those that were written with the problem.
"""

import os

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import resource
import sys
import time

import numpy as np
import scipy
from scipy.linalg import cho_factor, cho_solve, eigh
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

try:
    from sksparse.cholmod import cholesky as cholmod
except ImportError:
    cholmod = None

MODES = 10
BATCH = 20_000


def read(folder):
    of = {name[:-4]: np.load(os.path.join(folder, name)) for name in os.listdir(folder) if name.endswith(".npy")}
    of["count"] = 1 + max(of[kind + "_dof"].max() for kind in ("rod", "panel"))
    return of


def pattern(problem):
    """Rows, columns and unit entries of all elements, what is held left out: once for a structure."""
    rows, columns, units, owners = [], [], [], []
    for kind in ("rod", "panel"):
        dof, unit = problem[kind + "_dof"], problem[kind + "_unit"]
        size = dof.shape[1]
        row = np.broadcast_to(dof[:, :, None], unit.shape).reshape(-1)
        column = np.broadcast_to(dof[:, None, :], unit.shape).reshape(-1)
        kept = np.flatnonzero((row >= 0) & (column >= 0))
        rows.append(row[kept].astype(np.int32))
        columns.append(column[kept].astype(np.int32))
        units.append(unit.reshape(-1)[kept])
        owners.append(problem[kind + "_size"][kept // (size * size)])
    return [np.concatenate(parts) for parts in (rows, columns, units, owners)]


def assembled(parts, count):
    rows, columns, units, sizes = parts
    return csc_matrix((units * sizes, (rows, columns)), shape=(count, count))


def by_superlu(stiffness):
    options = dict(SymmetricMode=True, Equil=False)
    return splu(stiffness, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options).solve


def by_cholmod(stiffness):
    return cholmod(stiffness)


def shares(problem, shapes, groups):
    """V_e^t K_e V_e summed by group, elements in batches; a last row of zeros stands for what is held."""
    shapes = np.vstack([shapes, np.zeros(shapes.shape[1])])
    sums = np.zeros((groups, shapes.shape[1], shapes.shape[1]))
    for kind in ("rod", "panel"):
        dof, unit = problem[kind + "_dof"], problem[kind + "_unit"]
        size, group = problem[kind + "_size"], problem[kind + "_group"]
        for of in range(groups):
            members = np.flatnonzero(group == of)
            for start in range(0, len(members), BATCH):
                some = members[start : start + BATCH]
                moved = shapes[dof[some]]
                forces = np.matmul(unit[some], moved) * size[some, None, None]
                width = moved.shape[2]
                sums[of] += moved.reshape(-1, width).T @ forces.reshape(-1, width)
    return sums


def least(work):
    """The least time of some repeats, and what the last one made."""
    times, made = [], None
    while not times or (sum(times) < 0.4 and len(times) < 20):
        start = time.perf_counter()
        made = work()
        times.append(time.perf_counter() - start)
    return min(times), made


def analyze(folder, factorize):
    problem = read(folder)
    count, mass = problem["count"], problem["mass"]
    place, dynamic = problem["t_place"], mass.shape[0]
    loads = np.zeros((count, dynamic))
    loads[place[:, 0], place[:, 1]] = problem["t_value"]
    groups = len(problem["shares"])
    spent = {}

    def stage(name, work):
        spent[name], made = least(work)
        return made

    parts = stage("pattern, once", lambda: pattern(problem))
    stiffness = stage("assembly", lambda: assembled(parts, count))
    del parts
    solve = stage("factorization", lambda: factorize(stiffness))
    deflections = stage("solves", lambda: solve(loads))

    def condense():
        flexibility = loads.T @ deflections
        flexibility = cho_factor(0.5 * (flexibility + flexibility.T))
        return cho_solve(flexibility, np.eye(dynamic))

    dynamic_stiffness = stage("condensation", condense)
    roots, modes = stage("modes", lambda: eigh(dynamic_stiffness, mass, subset_by_index=[0, MODES - 1]))
    both = np.hstack([modes, problem["test_shapes"]])
    shapes = stage("shapes", lambda: deflections @ (dynamic_stiffness @ both))
    found = stage("shares", lambda: shares(problem, shapes, groups))
    frequencies = np.sqrt(roots) / (2.0 * np.pi)
    spent["analysis"] = sum(seconds for name, seconds in spent.items() if name != "pattern, once")
    apart = np.abs(frequencies / problem["frequencies"] - 1.0).max()
    diagonal = np.array([np.diag(share)[:MODES] for share in found])
    shares_apart = np.abs(diagonal - problem["shares"]).max() / np.abs(problem["shares"]).max()
    return count, spent, apart, shares_apart


def main(folders):
    print(f"NumPy {np.__version__}, SciPy {scipy.__version__}, one thread")
    ways = [("SuperLU", by_superlu)] + ([("CHOLMOD", by_cholmod)] if cholmod else [])
    for name, factorize in ways:
        for folder in folders:
            count, spent, apart, shares_apart = analyze(folder, factorize)
            most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
            print(f"\n{name}, {count} DOF; at most {most:.0f} MB held by the process until now\n")
            print("| stage | s |\n|---|---|")
            for stage, seconds in spent.items():
                print(f"| {stage} | {seconds:.6f} |")
            print(f"\nfrequencies agree to {apart:.1e}, shares to {shares_apart:.1e} of the largest")
            if apart > 1e-8:
                sys.exit("the frequencies are not the same")


if __name__ == "__main__":
    main(sys.argv[1:])
