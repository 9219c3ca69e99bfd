"""The analysis of benches/large as a good SciPy user would write it, on the same matrices and in one thread.

    cargo bench --bench large -- --write FOLDER 1k 10k
    python3 benches/scipy_wing.py [--store paper/costs.csv] FOLDER/1k FOLDER/10k

NumPy and SciPy alone; with scikit-sparse installed CHOLMOD is timed beside SuperLU. Element matrices are given, as they are to
the analysis that is compared. Frequencies and shares are held against those that were written with the problem. Then the lowest
modes of the whole model by ARPACK in shift-invert mode with the same factorization, which are not counted.
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
from scipy.sparse.linalg import LinearOperator, eigsh, splu

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


def superlu(stiffness, ordering):
    options = dict(SymmetricMode=True, Equil=False)
    return splu(stiffness, permc_spec=ordering, diag_pivot_thresh=0.0, options=options)


def by_superlu(stiffness):
    return superlu(stiffness, "MMD_AT_PLUS_A").solve


def ordered(stiffness):
    """The factorization again in the order of a first one, which is found once for a structure as in the library."""
    order = np.argsort(superlu(stiffness, "MMD_AT_PLUS_A").perm_c)
    back = np.argsort(order)

    def factorize(stiffness):
        solve = superlu(stiffness[order][:, order].tocsc(), "NATURAL").solve
        return lambda loads: solve(loads[order])[back]

    return factorize


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
    again = ordered(stiffness) if factorize is by_superlu else factorize
    solve = stage("factorization", lambda: again(stiffness))
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
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    del deflections, loads, shapes, found

    def whole():
        inverse = LinearOperator(stiffness.shape, matvec=factorize(stiffness), dtype=float)
        roots, _ = eigsh(stiffness, k=len(expected), M=whole_mass, sigma=0.0, OPinv=inverse)
        return np.sqrt(np.sort(roots)) / (2.0 * np.pi)

    expected, at = problem["whole_frequencies"], problem["mass_place"]
    whole_mass = csc_matrix((problem["mass_value"], (at[:, 0], at[:, 1])), shape=stiffness.shape)
    frequencies = stage("modes of the whole model", whole)
    apart = max(apart, np.abs(frequencies / expected - 1.0).max())
    return count, spent, apart, shares_apart, most


def store(file, count, measured):
    """Writes what was measured over what stands in the file of costs."""
    with open(file) as lines:
        rows = [line.rstrip("\n").split(",") for line in lines]
    column = rows[0].index(str(count))
    for row in rows:
        if row[0] in measured:
            row[column] = f"{measured[row[0]]:.4g}"
    with open(file, "w") as lines:
        lines.writelines(",".join(row) + "\n" for row in rows)


def main(folders):
    costs = None
    if folders[:1] == ["--store"]:
        costs, folders = folders[1], folders[2:]
    print(f"NumPy {np.__version__}, SciPy {scipy.__version__}, one thread")
    ways = [("SuperLU", by_superlu)] + ([("CHOLMOD", by_cholmod)] if cholmod else [])
    for name, factorize in ways:
        for folder in folders:
            count, spent, apart, shares_apart, most = analyze(folder, factorize)
            analysis, modes = 1e3 * spent["analysis"], 1e3 * spent["modes of the whole model"]
            print(f"\n{name}, {count} DOF; at most {most:.0f} MB held by the process until the analysis was done\n")
            print("| stage | s |\n|---|---|")
            for stage, seconds in spent.items():
                print(f"| {stage} | {seconds:.6f} |")
            print(f"\nfrequencies agree to {apart:.1e}, shares to {shares_apart:.1e} of the largest")
            if apart > 1e-8:
                sys.exit("the frequencies are not the same")
            if costs and name == "SuperLU":
                # The process does not give memory back: only a run of one wing measures that.
                memory = {"most memory of the SciPy process": most} if len(folders) == 1 else {}
                store(costs, count, {"analysis by SciPy": analysis, "20 modes by SciPy (not counted)": modes, **memory})


if __name__ == "__main__":
    main(sys.argv[1:])
