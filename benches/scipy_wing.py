"""The analysis of benches/large as a good SciPy user would write it, on the same matrices and in one thread.

    cargo bench --bench large -- --write FOLDER 1k 10k
    python3 benches/scipy_wing.py [--pardiso] FOLDER/1k

NumPy and SciPy alone, with SuperLU; with --pardiso MKL's PARDISO in its place, where pypardiso is installed. Element matrices are
given, as they are to the analysis that is compared. The lowest modes of the whole model come by ARPACK in shift-invert mode and are
not counted; then every group's share of the stiffness in these modes. Frequencies and shares are compared with those that were
written with the problem.
It prints rows of paper/costs.csv; the seconds of every stage go to standard error.
"""

import os

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import ctypes
import functools
import sys
import time

import numpy as np
import scipy
from scipy.sparse import csc_matrix, csr_matrix
from scipy.sparse.linalg import LinearOperator, eigsh, splu

BATCH = 20_000


def read(folder):
    of = {name[:-4]: np.load(os.path.join(folder, name)) for name in os.listdir(folder) if name.endswith(".npy")}
    of["count"] = 1 + max(of[kind + "_dof"].max() for kind in ("rod", "panel"))
    return of


def pattern(problem):
    """The stiffness with no values yet, and the matrix that makes its values from the elements' sizes: once for a structure."""
    count, first = problem["count"], 0
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
        owners.append((first + kept // (size * size)).astype(np.int32))
        first += len(dof)
    rows, columns, units, owners = (np.concatenate(parts) for parts in (rows, columns, units, owners))
    stiffness = csc_matrix((np.ones(len(units)), (rows, columns)), shape=(count, count))
    stiffness.sort_indices()
    of_column = np.repeat(np.arange(count, dtype=np.int64), np.diff(stiffness.indptr))
    keys = count * of_column + stiffness.indices
    place = np.searchsorted(keys, count * columns.astype(np.int64) + rows).astype(np.int32)
    return stiffness, csr_matrix((units, (place, owners)), shape=(len(keys), first))


def assembled(stiffness, incidence, sizes):
    return csc_matrix((incidence @ sizes, stiffness.indices, stiffness.indptr), shape=stiffness.shape)


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


@functools.cache
def pardiso_solver():
    """The library with its one handle, which forgets a matrix when it is given the next one."""
    from pypardiso import PyPardisoSolver

    solver = PyPardisoSolver(mtype=2)
    # METIS, and no iterative refinement, which is on by default.
    solver.iparm[:2] = 1, 2
    return solver


class Pardiso:
    """MKL's PARDISO for a symmetric definite matrix, of which it is given the upper triangle by rows."""

    def __init__(self, stiffness):
        count = stiffness.shape[0]
        of_column = np.repeat(np.arange(count), np.diff(stiffness.indptr))
        self.kept = stiffness.indices >= of_column
        begins = np.searchsorted(of_column[self.kept], np.arange(count + 1))
        self.begins, self.columns = (1 + begins).astype(np.int32), 1 + stiffness.indices[self.kept]
        self.call(11, stiffness, np.zeros((count, 1)))

    def call(self, phase, stiffness, loads):
        solver, error = pardiso_solver(), ctypes.c_int32(0)
        if phase != 33:
            self.values = stiffness.data[self.kept]
        loads = np.asfortranarray(loads)
        solution = np.empty_like(loads)
        numbers = [ctypes.byref(ctypes.c_int32(number)) for number in (1, 1, 2, phase, len(loads), loads[:1].size, 0)]
        at = lambda array: array.ctypes.data_as(ctypes.POINTER(ctypes.c_int32))
        pointer = solver.pt.ctypes.data_as(ctypes.POINTER(solver._pt_type[0]))
        matrix = [self.values.ctypes.data, at(self.begins), at(self.columns)]
        rest = [at(solver.perm), numbers[5], at(solver.iparm), numbers[6], loads.ctypes.data, solution.ctypes.data]
        solver._mkl_pardiso(pointer, *numbers[:5], *matrix, *rest, ctypes.byref(error))
        if error.value:
            sys.exit(f"PARDISO fails with error {error.value}")
        return solution

    def factorize(self, stiffness):
        self.call(22, stiffness, np.zeros((stiffness.shape[0], 1)))
        return lambda loads: self.call(33, stiffness, loads)


def by_pardiso(stiffness):
    return Pardiso(stiffness).factorize(stiffness)


def forget_most_memory():
    with open("/proc/self/clear_refs", "w") as file:
        file.write("5")


def most_memory():
    """The most that this process has held since then, MB."""
    with open("/proc/self/status") as lines:
        return 1.024e-3 * next(int(line.split()[1]) for line in lines if line.startswith("VmHWM"))


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
    """The least time of some repeats, two at least, for the first touches new memory; and what the last one made."""
    times, made = [], None
    while sum(times) < 30.0 and len(times) < 20 and (sum(times) < 0.4 or len(times) < 2):
        made = None
        start = time.perf_counter()
        made = work()
        times.append(time.perf_counter() - start)
    return min(times), made


def analyze(folder, is_pardiso):
    problem = read(folder)
    groups, count = len(problem["shares"]), problem["count"]
    spent = {}

    def stage(name, work):
        spent[name], made = least(work)
        return made

    empty, incidence = stage("pattern, once", lambda: pattern(problem))
    sizes = np.concatenate([problem["rod_size"], problem["panel_size"]])
    stiffness = stage("assembly", lambda: assembled(empty, incidence, sizes))
    del empty, incidence
    at = problem["mass_place"]
    mass = csc_matrix((problem["mass_value"], (at[:, 0], at[:, 1])), shape=stiffness.shape)
    forget_most_memory()
    factorize = Pardiso(stiffness).factorize if is_pardiso else ordered(stiffness)
    stage("factorization", lambda: factorize(stiffness))
    del factorize

    def modes():
        inverse = LinearOperator(stiffness.shape, matvec=(by_pardiso if is_pardiso else by_superlu)(stiffness), dtype=float)
        roots, shapes = eigsh(stiffness, k=len(problem["frequencies"]), M=mass, sigma=0.0, OPinv=inverse)
        order = np.argsort(roots)
        return roots[order], shapes[:, order]

    roots, shapes = stage("modes of the whole model", modes)
    found = stage("shares", lambda: shares(problem, shapes, groups))
    most = most_memory()
    spent["analysis"] = spent["assembly"] + spent["modes of the whole model"] + spent["shares"]
    apart = np.abs(np.sqrt(roots) / (2.0 * np.pi) / problem["frequencies"] - 1.0).max()
    diagonal = np.array([np.diag(share) for share in found])
    shares_apart = np.abs((diagonal - problem["shares"]) / roots).max()
    return count, spent, apart, shares_apart, most


def main(arguments):
    is_pardiso = arguments[0] == "--pardiso"
    if is_pardiso:
        pardiso_solver()
    name = "PARDISO" if is_pardiso else "SciPy"
    count, spent, apart, shares_apart, most = analyze(arguments[-1], is_pardiso)
    print(f"{name}, {count} DOF: NumPy {np.__version__}, SciPy {scipy.__version__}, one thread", file=sys.stderr)
    for stage, seconds in spent.items():
        print(f"  {seconds:.6f} s  {stage}", file=sys.stderr)
    print(f"  frequencies agree to {apart:.1e}, shares to {shares_apart:.1e} of their root", file=sys.stderr)
    if not max(apart, shares_apart) < 1e-8:
        sys.exit("frequencies or shares are not the same")
    milliseconds = {
        f"assembly and factorization by {name}": spent["assembly"] + spent["factorization"],
        f"20 modes by {name} (not counted)": spent["modes of the whole model"],
        f"analysis by {name}": spent["analysis"],
    }
    for row, seconds in milliseconds.items():
        print(f"{row},ms,{1e3 * seconds:.6g}")
    print(f"most memory of the {name} process,MB,{most:.6g}")


if __name__ == "__main__":
    main(sys.argv[1:])
