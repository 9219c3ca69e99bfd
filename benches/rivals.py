"""What a job of correcting a model costs by scipy.optimize.least_squares: what a user would write in Python instead of running corfem.

    python3 benches/commands.py FOLDER 1k each50       (writes the jobs)
    python3 benches/rivals.py FOLDER/1k [--corfem target/release/corfem] [--tight] [VARIANT ...]

It reads the wings of benches/commands.py, takes their elements together by itself, and lowers the objective of corfem's weighted steps
from factors of one with least_squares as it is (trf, its own tolerances). Variants:

    differences     SciPy alone (SuperLU, ARPACK), slopes by finite differences: a factor and 15 modes for every parameter
    slopes          SciPy alone with exact slopes from the factor and 20 modes at hand
    cholmod         the same with CHOLMOD (scikit-sparse) for SuperLU
    cholmod-lsmr    and tr_solver="lsmr" for "exact"

Without names all run but differences, which may take minutes. Each is a process of its own in one thread and prints a line of JSON:
processor seconds of the whole process and of least_squares alone, analyses (a factor and its modes), slopes, the objective, the most
memory, and with --corfem the largest distance of a factor's logarithm from the program's, in standard deviations. With --tight
least_squares goes on to the digits of the objective with slopes of more terms, which is to compare answers, not costs. The program's
seconds have its intervals, verdict and report in them; those of the variants end with the factors. CHOLMOD's need scikit-sparse, of
which 0.4.16 takes the SuiteSparse 5 of Debian 12 (libsuitesparse-dev), and later ones do not.
"""

# First, because it sets one thread before NumPy is loaded.
from scipy_wing import assembled, ordered, pattern  # isort: skip

import csv
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import time
import tomllib

import numpy as np
from scipy.optimize import least_squares, linear_sum_assignment
from scipy.sparse import csr_matrix, diags, vstack
from scipy.sparse.linalg import LinearOperator, eigsh

VARIANTS = ["slopes", "cholmod", "cholmod-lsmr"]
# Deviations of a frequency, of a component of a shape of unit largest component, and of a factor's logarithm: corfem's defaults.
FREQUENCY, SHAPE, PRIOR = 0.005, 0.02, 1.0
# Modes for pairing with the test's ten; more of them make the series of slopes shorter, which then has so many terms.
FEW, MODES, TERMS = 15, 20, 3


def cards(path):
    """Cards with their fields, wide or free; a line that begins with a star goes on with the last card."""
    found = []
    for line in path.read_text().splitlines():
        if "*" in line[:8]:
            fields = [line[at : at + 16].strip() for at in range(8, 72, 16)]
            if line[0] == "*":
                found[-1][1].extend(fields)
            else:
                found.append((line.split("*")[0], fields))
        else:
            name, *fields = line.split(",")
            found.append((name.strip(), fields))
    return found


def number(text):
    """1.04+7 is 1.04e+7."""
    return float(re.sub(r"(?<=[\d.])([+-])", r"e\1", text))


def lengths(vectors):
    return np.linalg.norm(vectors, axis=-1, keepdims=True)


# Deformations of elements of unit size (elements x rows x DOF): the stiffness is rows' x rows. The formulas are those of
# src/method/elements.rs, for all elements of a kind at once.
def rods(x, e, g, nu):
    along = x[:, 1] - x[:, 0]
    n = along / lengths(along)
    return (np.sqrt(e / lengths(along)) * np.hstack([-n, n]))[:, None]


def membranes(x, e, g, nu):
    """Two triangulations over each other, each of half the gage. The sum has rank six at most, and five if flat."""
    stiffness = e / (1 - nu * nu)
    elasticity = np.array([[stiffness, nu * stiffness, 0], [nu * stiffness, stiffness, 0], [0, 0, g]])
    unit = np.zeros((len(x), 12, 12))
    for nodes in ([0, 1, 3], [1, 2, 0], [2, 3, 1], [3, 0, 2]):
        a, b, c = (x[:, node] for node in nodes)
        twice = lengths(np.cross(b - a, c - a))
        k, i = np.cross(b - a, c - a) / twice, (b - a) / lengths(b - a)
        j, strain = np.cross(k, i), np.zeros((len(x), 3, 4, 3))
        for node, opposite in zip(nodes, (c - b, a - c, b - a)):
            gradient = np.cross(k, opposite) / twice
            dx, dy = ((gradient * axis).sum(1, keepdims=True) for axis in (i, j))
            strain[:, 0, node], strain[:, 1, node], strain[:, 2, node] = dx * i, dy * j, dy * i + dx * j
        strain = strain.reshape(-1, 3, 12)
        unit += 0.25 * twice[:, :, None] * (strain.transpose(0, 2, 1) @ elasticity @ strain)
    values, vectors = np.linalg.eigh(unit)
    return (vectors * np.sqrt(np.maximum(values, 0))[:, None]).transpose(0, 2, 1)[:, 6:]


def shear_panels(x, e, g, nu):
    """Garvey's panel in its mean plane; sides meet in points of homogeneous coordinates, which may lie at infinity."""
    d13, d24, side = x[:, 2] - x[:, 0], x[:, 3] - x[:, 1], x[:, 1] - x[:, 0]
    k = np.cross(d13, d24) / lengths(np.cross(d13, d24))
    i = side - (side * k).sum(1, keepdims=True) * k
    i /= lengths(i)
    flat = np.einsum("pnx,apx->pna", x - x[:, :1], np.array([i, np.cross(k, i)]))
    corner = np.concatenate([flat, np.ones((len(x), 4, 1))], axis=2)
    sides = np.cross(corner, np.roll(corner, -1, axis=1))
    p, q = np.cross(sides[:, 0], sides[:, 2]), np.cross(sides[:, 1], sides[:, 3])
    line, energy = np.cross(p, q), 0
    first_two = (line * corner[:, 0]).sum(1) * (line * corner[:, 1]).sum(1)
    points, weights = np.polynomial.legendre.leggauss(12)
    for s, ws in zip(points, weights):
        for t, wt in zip(points, weights):
            at = np.array([(1 - s) * (1 - t), (1 + s) * (1 - t), (1 + s) * (1 + t), (1 - s) * (1 + t)]) / 4 @ corner
            slope = np.array([[t - 1, 1 - t, 1 + t, -1 - t], [s - 1, -1 - s, 1 + s, 1 - s]]) / 4 @ flat
            to_p, to_q = (end[:, :2] - end[:, 2:] * at[:, :2] for end in (p, q))
            cotangent = (to_p * to_q).sum(1) / (to_p[:, 0] * to_q[:, 1] - to_p[:, 1] * to_q[:, 0])
            flow = first_two / (line * at).sum(1) ** 2
            energy += ws * wt * np.linalg.det(slope) * flow**2 / (2 * g) * (1 + 2 * cotangent**2 / (1 + nu))
    (x2, _), (x3, y3), (x4, y4) = flat[:, 1].T, flat[:, 2].T, flat[:, 3].T
    tau = x4 * y3 - x3 * y4
    f1, f2 = (-0.5 * x2 * y4 / tau)[:, None] * d13, (0.5 * x2 * y3 / (tau - x2 * (y3 - y4)))[:, None] * d24
    return (np.hstack([f1, f2, -f1, -f2]) / np.sqrt(2 * energy)[:, None])[:, None]


def volumes(x):
    """What elements of unit size lump at their corners: half a rod; of a panel a third of the triangle there, in two halves."""
    if x.shape[1] == 2:
        return np.repeat(lengths(x[:, 1] - x[:, 0]) / 2, 2, axis=1)
    corner = np.cross(np.roll(x, -1, axis=1) - x, np.roll(x, 1, axis=1) - x)
    return (lengths(np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])) + lengths(corner)[:, :, 0]) / 12


class Job:
    """Model, test and parameters of a written job."""

    def __init__(self, folder):
        deck = {}
        for name, fields in cards(folder / "model.bdf"):
            deck.setdefault(name, []).append(fields)
        labels = {int(grid[0]): row for row, grid in enumerate(deck["GRID"])}
        places = np.array([[number(text) for text in grid[2:5]] for grid in deck["GRID"]])
        free = np.array([[digit not in grid[6] for digit in "123"] for grid in deck["GRID"]])
        rows, count = np.where(free, np.cumsum(free).reshape(free.shape) - 1, -1), free.sum()
        e, g, nu, density = (number(text) for text in deck["MAT1"][0][1:5])
        parameter = self.parameter_of(tomllib.loads((folder / "job.toml").read_text())["parameter"])
        mass, parts, blocks = np.zeros(len(places)), [], []
        for card, corner_count, kind in [("ROD", 2, rods), ("SHEAR", 4, shear_panels), ("QDMEM", 4, membranes)]:
            sizes = {int(fields[0]): number(fields[2]) for fields in deck["P" + card]}
            members = np.array([[int(text) for text in fields[: 2 + corner_count]] for fields in deck["C" + card]])
            corners = np.vectorize(labels.get)(members[:, 2:])
            size = np.array([sizes[label] for label in members[:, 1]])
            named = ((("element", label), ("property", own)) for label, own in members[:, :2])
            of = np.array([parameter.get(one, parameter.get(other, self.count)) for one, other in named])
            np.add.at(mass, corners, density * size[:, None] * volumes(places[corners]))
            dof, unit = rows[corners].reshape(len(corners), -1), kind(places[corners], e, g, nu)
            parts.append((dof, unit.transpose(0, 2, 1) @ unit, size, of))
            # A last column of the deformations stands for what is held, and is left out.
            values = (unit * np.sqrt(size)[:, None, None]).reshape(-1)
            columns = np.repeat(np.where(dof < 0, count, dof), unit.shape[1], axis=0).reshape(-1)
            ends = np.arange(0, len(values) + 1, unit.shape[2])
            blocks.append((csr_matrix((values, columns, ends), shape=(len(ends) - 1, count + 1)), np.repeat(of, unit.shape[1])))
        for fields in deck["CONM2"]:
            mass[labels[int(fields[1])]] += number(fields[3])
        self.mass = np.repeat(mass, 3)[free.reshape(-1)]
        (rod_dof, rod_unit, *_), panels = parts[0], [np.concatenate(each) for each in zip(*parts[1:])]
        problem = {"count": count, "rod_dof": rod_dof, "rod_unit": rod_unit, "panel_dof": panels[0], "panel_unit": panels[1]}
        self.empty, self.incidence = pattern(problem)
        self.sizes, self.parameters = (np.concatenate([part[place] for part in parts]) for place in (2, 3))
        # Rows of a parameter together, those of none left out.
        owners = np.concatenate([block[1] for block in blocks])
        order = np.argsort(owners, kind="stable")
        self.begins = np.searchsorted(owners[order], np.arange(self.count + 1))
        self.deformations = vstack([block[0][:, :count] for block in blocks], format="csr")[order[: self.begins[-1]]]
        lines = list(csv.reader((folder / "test.csv").read_text().splitlines()))
        self.frequencies = np.array([float(cell) for cell in lines[0][7:]])
        self.sensors = np.array([rows[labels[int(line[0])], "xyz".index(line[2])] for line in lines[2:]])
        shapes = np.array([[float(line[3] + "1") * float(cell) for cell in line[7:]] for line in lines[2:]])
        self.shapes = shapes / np.abs(shapes).max(axis=0)

    def parameter_of(self, rules):
        """The parameter of every property or element that has one; an element is named for itself in rules with each."""
        named, self.count = {}, 0
        for rule in rules:
            for label in rule.get("properties", []):
                named["property", label] = self.count
            for text in rule.get("elements", []):
                first, last = (int(part) for part in (str(text).split("-") * 2)[:2])
                for label in range(first, last + 1):
                    named["element", label] = self.count
                    self.count += rule.get("each", False)
            self.count += not rule.get("each", False)
        return named


class Fit:
    """Residuals and their slopes; the last analysis is kept, because least_squares asks for the slopes where it was last or before."""

    def __init__(self, job, variant, is_tight=False):
        self.job, self.analyses, self.last, self.plan = job, 0, None, None
        self.terms = TERMS + 4 * is_tight
        self.is_cholmod, self.modes = variant.startswith("cholmod"), FEW if variant == "differences" else MODES
        self.mass = diags(job.mass).tocsc()

    def factorize(self, stiffness):
        """The order of unknowns is found once, for it is that of the structure."""
        if self.is_cholmod:
            from sksparse.cholmod import analyze

            self.plan = self.plan or analyze(stiffness, ordering_method="metis").cholesky
        self.plan = self.plan or ordered(stiffness)
        return self.plan(stiffness)

    def analyze(self, x):
        if self.last is None or not np.array_equal(self.last[0], x):
            factors = np.append(np.exp(x), 1)[self.job.parameters]
            stiffness = assembled(self.job.empty, self.job.incidence, self.job.sizes * factors)
            solve = self.factorize(stiffness)
            inverse = LinearOperator(stiffness.shape, matvec=solve, dtype=float)
            roots, shapes = eigsh(stiffness, self.modes, self.mass, sigma=0, OPinv=inverse, v0=np.ones(len(self.job.mass)))
            seen = shapes[self.job.sensors]
            cosines = (seen / np.linalg.norm(seen, axis=0)).T @ (self.job.shapes / np.linalg.norm(self.job.shapes, axis=0))
            pairs, tested = linear_sum_assignment(-(cosines**2))
            self.last = (x.copy(), roots, shapes, pairs[np.argsort(tested)], solve)
            self.analyses += 1
        return self.last[1:]

    def residuals(self, x):
        roots, shapes, pairs, _ = self.analyze(x)
        v, u = shapes[self.job.sensors][:, pairs], self.job.shapes
        of_frequencies = np.sqrt(roots[pairs]) / (2 * np.pi) / self.job.frequencies - 1
        apart = v * ((v * u).sum(axis=0) / (v * v).sum(axis=0)) - u
        return np.concatenate([of_frequencies / FREQUENCY, apart.T.ravel() / SHAPE, x / PRIOR])

    def slopes(self, x):
        """Of modes at hand by their couplings. What all others add at the sensors is a series in the root over theirs: its terms are the
        deflections F = K^-1 R' under unit loads at the sensors without the modes, K^-1 M F, and so on, for all parameters and modes."""
        job, (roots, shapes, pairs, solve) = self.job, self.analyze(x)
        loads = np.zeros((len(job.mass), len(job.sensors)))
        loads[job.sensors, np.arange(len(job.sensors))] = 1
        fields, seen = [shapes], shapes[job.sensors]
        for _ in range(self.terms):
            loads = solve(loads)
            loads = loads - shapes @ (shapes.T @ (job.mass[:, None] * loads))
            fields.append(loads)
            loads = job.mass[:, None] * loads
        moved = job.deformations @ np.hstack(fields)
        # Of every parameter: the work of the paired modes' forces on the modes and on the deflections.
        work = [factor * moved[a:b].T @ moved[a:b, pairs] for a, b, factor in zip(job.begins, job.begins[1:], np.exp(x))]
        work, of_frequencies, of_shapes = np.array(work), [], []
        for mode, i in enumerate(pairs):
            gaps = roots[i] - roots
            gaps[i] = np.inf
            v, u = seen[:, i], job.shapes[:, mode]
            dv = (seen / gaps) @ work[:, : len(roots), mode].T
            powers = roots[i] ** np.arange(self.terms)
            dv -= np.einsum("t,ptd->dp", powers, work[:, len(roots) :, mode].reshape(job.count, self.terms, -1))
            of_frequencies.append(np.sqrt(roots[i]) / (2 * np.pi) / job.frequencies[mode] * work[:, i, mode] / (2 * roots[i]))
            scale = v @ u / (v @ v)
            of_shapes.append(scale * (dv - np.outer(v, v @ dv) / (v @ v)) - np.outer(v, (scale * v - u) @ dv) / (v @ v))
        return np.vstack([np.array(of_frequencies) / FREQUENCY, *(rows / SHAPE for rows in of_shapes), np.eye(job.count) / PRIOR])


def alone(folder, variant, is_tight):
    """A variant in this process."""
    fit = Fit(Job(folder), variant, is_tight)
    before = time.process_time()
    jacobian = "2-point" if variant == "differences" else fit.slopes
    settings = {"tr_solver": "lsmr" if variant == "cholmod-lsmr" else "exact"}
    if is_tight:
        settings |= dict.fromkeys(["ftol", "xtol", "gtol"], 1e-13)
    found = least_squares(fit.residuals, np.zeros(fit.job.count), jacobian, **settings)
    after, deviations = time.process_time(), np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)))
    numbers = {"seconds": round(after, 2), "least_squares": round(after - before, 2), "analyses": fit.analyses, "slopes": found.njev}
    numbers |= {"objective": found.cost, "status": found.status, "MB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024}
    print(json.dumps(numbers | {"logarithms": found.x.tolist(), "deviations": deviations.tolist()}))


def main(arguments):
    tight = [argument for argument in arguments if argument == "--tight"]
    arguments = [argument for argument in arguments if argument != "--tight"]
    if arguments[0] == "--alone":
        return alone(pathlib.Path(arguments[1]), arguments[2], bool(tight))
    folder, program = pathlib.Path(arguments.pop(0)), None
    if arguments[:1] == ["--corfem"]:
        program, arguments = arguments[1], arguments[2:]
    head, logarithms = {"job": folder.name}, None
    if program:
        child = subprocess.Popen([program, "correlate", "-q", "-f", "json", str(folder / "job.toml")], stdout=subprocess.PIPE)
        found = json.load(child.stdout)
        # Of this child alone: a shell may have left others to this process.
        spent = os.wait4(child.pid, 0)[2]
        logarithms = np.log([row["factor"] for row in found["parameters"]])
        objective = 0.5 * (found["misfit"]["chi_squared"] + (logarithms**2).sum() / PRIOR**2)
        line = head | {"variant": "corfem", "seconds": round(spent.ru_utime + spent.ru_stime, 2), "analyses": found["analyses"]}
        print(json.dumps(line | {"objective": objective}), flush=True)
    for variant in arguments or VARIANTS:
        done = subprocess.run([sys.executable, __file__, "--alone", str(folder), variant, *tight], stdout=subprocess.PIPE, check=True)
        numbers = json.loads(done.stdout)
        own, deviations = np.array(numbers.pop("logarithms")), np.array(numbers.pop("deviations"))
        if program:
            numbers["apart"] = float(np.abs((own - logarithms) / deviations).max())
        print(json.dumps(head | {"variant": variant} | numbers), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
