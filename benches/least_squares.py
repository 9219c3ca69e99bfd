"""What a user of SciPy would do instead: scipy.optimize.least_squares on the paper's cases and on two jobs.

    cargo build --release
    python3 benches/least_squares.py [--corfem target/release/corfem] > golden/least_squares.json

The unknowns are logarithms of the factors, the residuals relative differences of frequencies and differences of shapes of unit length.
Derivatives are exact ones of eigenvectors, or finite differences; settings are the library's defaults, and once more with
tr_solver="lsmr", which takes the shortest step where the test leaves some combination of gages open. A mode of the test is paired with
the mode that it resembles most, and one without a shape with that of the first model which the job names. Beside it the program does
the same by the paper's rule, and the jobs by weighted steps too; those of the cases are in golden/snapshots/rules.snap. The torque box
is that of golden/reference/reference.py.
"""

import os

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib

import numpy as np
from scipy.io import mmread
from scipy.linalg import eigh
from scipy.optimize import least_squares, linear_sum_assignment

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "golden" / "reference"))
import reference  # noqa: E402

# Factors that make the model of the building right (tests/common/jobs.rs).
STORIES = [0.70, 1.0, 1.2, 0.9, 1.0, 0.8, 1.1, 1.0, 0.85, 1.0]


class Case:
    """One of the paper's cases: fifteen gages, nine modes at nine points."""

    rigid, parameters = 0, 15

    def __init__(self, number):
        data = tomllib.loads((ROOT / "paper" / "reconstruction.toml").read_text())
        self.box, self.number = reference.Box(data), number
        self.start = reference.GAGES[f"case {number} initial"]
        self.truth = reference.GVT / self.start
        self.mass, self.sensors, self.forms = np.diag(self.box.mass), slice(None), None
        self.frequencies, self.shapes = self.box.modes(self.box.dynamic(number, reference.GVT)[0])

    def matrices(self, factors):
        """Stiffness and mass, and what each of them gains by the logarithm of every factor."""
        stiffness, shares = self.box.dynamic(self.number, self.start * factors)
        return stiffness, self.mass, shares, [None] * 15


class Job:
    """A job of matrices in tests/jobs."""

    def __init__(self, folder, rigid, truth=None):
        job = tomllib.loads((folder / "job.toml").read_text())
        self.folder, self.rigid, self.truth = folder, rigid, truth
        dense = lambda name: mmread(folder / name).toarray()
        self.stiffness, self.mass = dense(job["model"]["stiffness"]), dense(job["model"]["mass"])
        self.parameters = len(job["parameter"])
        self.parts = [(dense(entry["matrix"]), entry.get("scales") == "mass") for entry in job["parameter"]]
        lines = list(csv.reader((folder / "test.csv").read_text().splitlines()))
        lines = [line for line in lines if not line[0].startswith("#")]
        self.frequencies = np.array([float(cell) for cell in lines[0] if cell and cell != "frequency_hz"])
        rows = [tuple(line[:2]) for line in csv.reader((folder / "rows.csv").read_text().splitlines())][1:]
        self.sensors = [rows.index((line[0], line[2])) for line in lines[1:] if line[0].isdigit()]
        self.shapes = np.array([[float(cell) for cell in line[7:]] for line in lines[1:] if line[0].isdigit()])
        self.forms = None
        if not self.sensors:
            # No shape was measured: a mode is known by the likeness of its shape to that of the first model's which the job names.
            partners = [rigid + partner - 1 for partner in job["test"]["partners"]]
            self.forms = self.mass @ eigh(self.stiffness, self.mass)[1][:, partners]

    def matrices(self, factors):
        stiffness, mass = self.stiffness.copy(), self.mass.copy()
        stiffer, heavier = [], []
        for (part, is_mass), factor in zip(self.parts, factors):
            changed = mass if is_mass else stiffness
            changed += (factor - 1) * part
            stiffer.append(None if is_mass else factor * part)
            heavier.append(factor * part if is_mass else None)
        return stiffness, mass, stiffer, heavier


def unit(shapes):
    return shapes / np.linalg.norm(shapes, axis=0)


class Fit:
    """Residuals and their derivatives; analyses are counted, and the last one is kept for its derivatives."""

    def __init__(self, of):
        self.of, self.analyses, self.last = of, 0, None

    def analyze(self, x):
        if self.last is not None and np.array_equal(self.last[0], x):
            return self.last[1:]
        stiffness, mass, *gains = self.of.matrices(np.exp(x))
        squares, shapes = eigh(stiffness, mass)
        self.analyses += 1
        elastic = np.arange(self.of.rigid, len(squares))
        if self.of.forms is None:
            likeness = unit(shapes[self.of.sensors][:, elastic]).T @ unit(self.of.shapes)
        else:
            likeness = shapes[:, elastic].T @ self.of.forms
        pairs, tested = linear_sum_assignment(-(likeness**2))
        pairs = elastic[pairs[np.argsort(tested)]]
        self.last = (x.copy(), squares, shapes, pairs, gains)
        return self.last[1:]

    def residuals(self, x):
        squares, shapes, pairs, _ = self.analyze(x)
        frequencies = np.sqrt(squares[pairs]) / (2 * np.pi) / self.of.frequencies - 1
        if self.of.forms is not None:
            return frequencies
        found, tested = unit(shapes[self.of.sensors][:, pairs]), unit(self.of.shapes)
        signs = np.sign(np.sum(found * tested, axis=0))
        return np.concatenate([frequencies, (found * signs - tested).T.ravel()])

    def derivatives(self, x):
        squares, shapes, pairs, (stiffer, heavier) = self.analyze(x)
        columns = []
        for stiff, heavy in zip(stiffer, heavier):
            by_stiff, by_heavy = (0.0 * shapes[:, pairs] if part is None else shapes.T @ part @ shapes[:, pairs] for part in (stiff, heavy))
            of_frequencies, of_shapes = [], []
            for mode, pair in enumerate(pairs):
                gain = by_stiff[:, mode] - squares[pair] * by_heavy[:, mode]
                of_frequencies.append(0.5 * gain[pair] / np.sqrt(squares[pair]) / (2 * np.pi) / self.of.frequencies[mode])
                if self.of.forms is None:
                    apart = squares[pair] - squares
                    apart[pair] = np.inf
                    parts = gain / apart
                    parts[pair] = -0.5 * by_heavy[pair, mode]
                    seen, moved = shapes[self.of.sensors][:, pair], (shapes @ parts)[self.of.sensors]
                    length = np.linalg.norm(seen)
                    moved = moved / length - seen * (seen @ moved) / length**3
                    of_shapes.append(moved * np.sign(seen @ self.of.shapes[:, mode]))
            columns.append(np.concatenate([of_frequencies, *of_shapes]))
        return np.array(columns).T


def rms(values):
    return 100 * float(np.sqrt(np.mean(np.square(values))))


def answer(analyses, seconds, of, factors):
    """Analyses and seconds, and what is left of the errors of frequencies, and of gages or factors if they are known, %."""
    frequencies = Fit(of).residuals(np.log(factors))[: len(of.frequencies)]
    of_factors = None if of.truth is None else round(rms(factors / of.truth - 1), 6)
    found = {"analyses": analyses, "seconds": round(seconds, 4), "frequencies": round(rms(frequencies), 6), "factors": of_factors}
    return {**found, "values": " ".join(f"{factor:.3f}" for factor in factors)}


def by_least_squares(of, jacobian, solver):
    fit, start = Fit(of), time.perf_counter()
    jacobian = fit.derivatives if jacobian == "analytic" else jacobian
    found = least_squares(fit.residuals, np.zeros(of.parameters), jac=jacobian, tr_solver=solver)
    seconds = time.perf_counter() - start
    return answer(fit.analyses, seconds, of, np.exp(found.x))


def by_program(program, of, method):
    """The program's own way, its start and its report in the seconds; nothing if it refuses the job."""
    if isinstance(of, Case):
        arguments = ["cases", str(of.number)]
    else:
        folder = pathlib.Path(tempfile.mkdtemp())
        shutil.copytree(of.folder, folder, dirs_exist_ok=True)
        job = (folder / "job.toml").read_text().replace('method = "gauss_newton"\n', "")
        (folder / "job.toml").write_text(job.replace("[compare]", f'[compare]\nmethod = "{method}"'))
        arguments = ["correlate", str(folder / "job.toml")]
    start = time.perf_counter()
    done = subprocess.run([program, *arguments, "--quiet", "--format", "json"], capture_output=True, text=True)
    seconds = time.perf_counter() - start
    if not done.stdout:
        print(f"{of.folder.name} by {method}: {done.stderr}", file=sys.stderr)
        return None
    found = json.loads(done.stdout)
    if isinstance(of, Case):
        found = found["cases"][0]["correlation"]
    analyses = found.get("analyses") or len(found["passes"]) + 1
    return answer(analyses, seconds, of, np.array([row["factor"] for row in found["parameters"]]))


def main(arguments):
    program = arguments[1] if arguments[:1] == ["--corfem"] else str(ROOT / "target" / "release" / "corfem")
    jobs = ROOT / "tests" / "jobs"
    subjects = {f"Case {number}": Case(number) for number in (1, 2, 3)}
    subjects["building"] = Job(jobs / "building", 0, np.array(STORIES))
    subjects["GARTEUR"] = Job(jobs / "garteur", 6)
    answers = {}
    for name, of in subjects.items():
        ways = {
            "first model": answer(1, 0.0, of, np.ones(of.parameters)),
            "analytic": by_least_squares(of, "analytic", None),
            "analytic, lsmr": by_least_squares(of, "analytic", "lsmr"),
            "finite differences": by_least_squares(of, "2-point", None),
            "paper's rule": by_program(program, of, "paper"),
        }
        if not isinstance(of, Case):
            ways["weighted"] = by_program(program, of, "gauss_newton")
        if isinstance(of, Case):
            # Combinations of gages that the test says nothing of, where they are right and some tenth beside.
            beside = 0.1 * np.random.default_rng(1).standard_normal(of.parameters)
            sizes = [np.linalg.svd(Fit(of).derivatives(np.log(of.truth) + off), compute_uv=False) for off in (0.0, beside)]
            ways["first model"]["open"] = [int(np.sum(size < 1e-12 * size[0])) for size in sizes]
        answers[name] = {way: found for way, found in ways.items() if found}
    print(json.dumps(answers, indent=1))


if __name__ == "__main__":
    main(sys.argv[1:])
