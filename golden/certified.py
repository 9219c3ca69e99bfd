"""Optima of three weighted fits to fifteen digits, as the Statistical Reference Datasets of NIST certify those of other nonlinear fits.

    python3 certified.py [--check]      (python-flint as in enclosure.txt)

A fit is a job's files: the building of tests/jobs, and two chains that are made here and stored with their optimum, one that hangs free
with masses among its parameters, and one with deviations of its components, a frequency alone and a factor that ends at its bound.
Measured numbers are those of a chain with other factors and noise, and have four digits.

The objective is half the sum of the squares of (f / f_test - 1) / deviation, of (a v - u) / deviation at every sensor, with the least
squares scale a and the test's shape u of a largest component of one, and of ln c / prior of every factor c. Roots of a chain of springs
are simple and keep their order whatever the factors, so that the n-th test mode is the n-th vibration: nothing is paired. Residuals are
balls of two hundred digits (Arb isolates the roots). Slopes and curvatures are differences of them over 1e-48, which err by the square of
that, mixed curvatures by that itself: no formula of a derivative is used, and no code of the crate.

Newton's steps go on until the slope of no free logarithm can exceed 1e-30. The curvature there must be positive definite, a factor at a
bound pressed against it, and the ends from the first model and from one far from it the same to twenty digits. Deviations are those of
Gauss and Newton's curvature, with all parameters.
"""
import csv
import json
import pathlib
import random
import sys
import tomllib

from flint import acb_mat, arb, arb_mat, ctx

HERE = pathlib.Path(__file__).parent
ctx.prec = 700
STEP = arb(2) ** -160
LEAST_SLOPE, SAME, MOST_STEPS = arb("1e-30"), arb("1e-20"), 60
SEED = 48
STARTS = (1,), (1.3, 0.75, 1.2, 0.8)  # first factors, in turn: the first model, and one far from it


def total(terms):
    return sum(terms, arb(0))


# A job's files.

def matrix(text):
    rows = [line.split() for line in text.splitlines() if not line.startswith("%")]
    whole = arb_mat(int(rows[0][0]), int(rows[0][1]))
    for i, j, value in rows[1:]:
        whole[int(i) - 1, int(j) - 1] = whole[int(j) - 1, int(i) - 1] = arb(value)
    return whole


class Model:
    """The matrices of a job, and those of its parameters."""

    def __init__(self, files):
        self.job = tomllib.loads(files["job.toml"])
        model, parameters = self.job["model"], self.job["parameter"]
        self.parts, self.rigid = [matrix(files[model[kind]]) for kind in ("stiffness", "mass")], model.get("rigid_bodies", 0)
        self.shares = [(own.get("scales") == "mass", matrix(files[own["matrix"]])) for own in parameters]

    def vibrations(self, logs):
        """Frequencies, ascending, and shapes, of factors with these logarithms."""
        stiffness, mass = (arb_mat(part) for part in self.parts)
        for log, (is_mass, share) in zip(logs, self.shares):
            change = share * (log.exp() - 1)
            stiffness, mass = (stiffness, mass + change) if is_mass else (stiffness + change, mass)
        roots, vectors = acb_mat(mass.solve(stiffness)).eig(right=True)
        order = sorted(range(len(roots)), key=lambda j: float(roots[j].real.mid()))
        assert all(roots[a].real < roots[b].real for a, b in zip(order, order[1:]))
        for j in order[self.rigid:]:
            largest = max((vectors[i, j] for i in range(len(roots))), key=lambda x: float(abs(x).mid()))
            yield roots[j].real.sqrt() / (2 * arb.pi()), [(vectors[i, j] / largest).real for i in range(len(roots))]


class Fit(Model):
    """The problem of a job with a table as its test."""

    def __init__(self, files):
        super().__init__(files)
        parameters, compare = self.job["parameter"], self.job.get("compare", {})
        self.bounds = [[arb(str(own[end])).log().mid() for end in ("lower", "upper")] if "lower" in own else None for own in parameters]
        self.tikhonov = arb(str(compare.get("prior_deviation", 1.0))) ** -2
        table = list(csv.reader(files["test.csv"].splitlines()))
        above = {row[0]: row for row in table if row[0].startswith("frequency") or row[0].startswith("shape")}
        header, sensors = next((row, table[at + 1:]) for at, row in enumerate(table) if "direction" in row)
        self.rows = [int(row[header.index("grid")]) - 1 for row in sensors]
        self.modes = []
        for column, title in enumerate(header):
            if not title.startswith("mode"):
                continue
            deviation = "deviation" + title.removeprefix("mode")
            frequency, shape = (above.get(f"{kind}_deviation") for kind in ("frequency", "shape"))
            every = str(shape[column] if shape else 0.02)
            of_shape = [row[header.index(deviation)] if deviation in header else every for row in sensors]
            read = [row[column] for row in sensors]
            self.modes.append((
                arb(above["frequency_hz"][column]), arb(frequency[column] if frequency else "0.005"),
                [arb(value) for value in read] if any(read) else None, [arb(value) for value in of_shape] if any(read) else None))

    def residuals(self, logs):
        """Of every test mode its frequency's, then those of its shape if it has one."""
        found = []
        for (hertz, shape), (measured, of_frequency, read, deviations) in zip(self.vibrations(logs), self.modes):
            found.append((hertz / measured - 1) / of_frequency)
            if read:
                largest = max(map(abs, read), key=float)
                seen = [shape[row] for row in self.rows]
                v, u = ([x / scale / d for x, d in zip(own, deviations)] for own, scale in ((seen, 1), (read, largest)))
                a = total(x * y for x, y in zip(v, u)) / total(x * x for x in v)
                found += [a * x - y for x, y in zip(v, u)]
        return found

    def objective(self, logs, residuals):
        return (total(r * r for r in residuals) + self.tikhonov * total(x * x for x in logs)) / 2

    def place(self, logs):
        """Residuals, and the objective's gradient, its curvature, and that of Gauss and Newton."""
        count = len(logs)
        residuals = self.residuals(logs)

        def at(*moves):
            moved = list(logs)
            for e, by in moves:
                moved[e] += by
            return self.residuals(moved)
        up, down = ([at((e, by)) for e in range(count)] for by in (STEP, -STEP))
        slopes = [[(p - m) / (2 * STEP) for p, m in zip(*pair)] for pair in zip(up, down)]
        gradient = [total(s * r for s, r in zip(slope, residuals)) + self.tikhonov * x for slope, x in zip(slopes, logs)]
        gauss, curvature = arb_mat(count, count), arb_mat(count, count)
        for a in range(count):
            for b in range(a + 1):
                if a == b:
                    bent = [p + m - 2 * r for r, p, m in zip(residuals, up[a], down[a])]
                else:
                    bent = [c - p - q + r for r, p, q, c in zip(residuals, up[a], up[b], at((a, STEP), (b, STEP)))]
                gauss[a, b] = gauss[b, a] = total(s * t for s, t in zip(slopes[a], slopes[b])) + self.tikhonov * (a == b)
                curvature[a, b] = curvature[b, a] = gauss[a, b] + total(r * s for r, s in zip(residuals, bent)) / STEP ** 2
        return residuals, gradient, curvature, gauss

    def within(self, logs):
        """Numbers without radius, within the bounds."""
        return [min(max(x.mid(), own[0]), own[1]) if own else x.mid() for x, own in zip(logs, self.bounds)]

    def free(self, logs, gradient):
        """Parameters that are not pressed against a bound."""
        def is_pressed(x, slope, own):
            return own and (x <= own[0] and slope > 0 or x >= own[1] and slope < 0)
        return [e for e, of in enumerate(zip(logs, gradient, self.bounds)) if not is_pressed(*of)]

    def optimum(self, factors):
        """Logarithms where Newton's steps from some factors end, and the place there."""
        logs = self.within([factor.log() for factor in factors])
        for _ in range(MOST_STEPS):
            place = residuals, gradient, curvature, gauss = self.place(logs)
            free = self.free(logs, gradient)
            if all(abs(gradient[e]) < LEAST_SLOPE for e in free):
                assert is_definite(selected(curvature, free))
                return logs, free, place
            own = next(own for own in (selected(curvature, free), selected(gauss, free)) if is_definite(own))
            step = dict(zip(free, own.solve(arb_mat([[-gradient[e]] for e in free])).entries()))
            logs = self.lower(logs, residuals, step)
        raise ArithmeticError("steps do not end")

    def lower(self, logs, residuals, step):
        """The first lower place at a step, a half of it, a quarter and so on."""
        for halvings in range(MOST_STEPS):
            trial = self.within([x + step.get(e, 0) / 2 ** halvings for e, x in enumerate(logs)])
            if self.objective(trial, self.residuals(trial)) < self.objective(logs, residuals):
                return trial
        raise ArithmeticError("no lower place")

    def certified(self):
        """Factors, the sum of squared residuals and deviations of logarithms at the optimum. A row of `slopes` says how the objective's
        slope by a parameter rises with every logarithm, times the deviation that the parameter would have alone; that of a factor at its
        bound, which has a slope there, how many such deviations it moves."""
        every = range(len(self.shares))
        (logs, free, place), (again, *_) = (self.optimum([arb(first[e % len(first)]) for e in every]) for first in STARTS)
        assert all(abs(a - b) < SAME for a, b in zip(logs, again))
        residuals, _, curvature, gauss = place
        covariance, alone = gauss.inv(), [gauss[e, e].sqrt() for e in every]
        rises = [[curvature[e, f] / alone[e] if e in free else alone[e] * (e == f) for f in every] for e in every]
        return dict(factors=digits(x.exp() for x in logs), chi_squared=digits([total(r * r for r in residuals)])[0],
                    deviations=digits(covariance[e, e].sqrt() for e in every), slopes=list(map(digits, rises)))


def selected(square, places):
    return arb_mat([[square[a, b] for b in places] for a in places])


def is_definite(square):
    return all(selected(square, range(n + 1)).det() > 0 for n in range(square.nrows()))


def digits(values):
    """Fifteen digits of balls that have as many."""
    values = list(values)
    assert all(value.rad() <= abs(value.mid()) * arb("1e-30") for value in values)
    return [float(value.str(15, radius=False)) for value in values]


# Two chains of springs, as files.

def written(whole):
    """A symmetric matrix as Matrix Market has it."""
    entries = [(i + 1, j + 1, value) for i, row in enumerate(whole) for j, value in enumerate(row[:i + 1]) if value]
    lines = ["%%MatrixMarket matrix coordinate real symmetric", f"{len(whole)} {len(whole)} {len(entries)}"]
    return "\n".join(lines + [f"{i} {j} {value:g}" for i, j, value in entries]) + "\n"


def springs(stiffness, is_held):
    """The stiffness of a chain whose first spring holds it, or of one that hangs free."""
    count = len(stiffness) + (not is_held)
    whole = [[0.0] * count for _ in range(count)]
    for place, k in enumerate(stiffness):
        ends = [end for end in (place - is_held, place + (not is_held)) if end >= 0]
        for a in ends:
            for b in ends:
                whole[a][b] += k if a == b else -k
    return whole


def masses(mass):
    return [[value * (i == j) for j in range(len(mass))] for i, value in enumerate(mass)]


def chain(is_held, stiffness, mass, groups, truth, test, compare):
    """The files of a chain with groups of springs or masses as parameters, and a test of the true one: modes at some rows, with noise."""
    files = {"stiffness.mtx": written(springs(stiffness, is_held)), "mass.mtx": written(masses(mass)),
             "rows.csv": "grid,direction\n" + "".join(f"{row + 1},x\n" for row in range(len(mass)))}
    job = ('[model]\nstiffness = "stiffness.mtx"\nmass = "mass.mtx"\nrows = "rows.csv"\n' + "rigid_bodies = 1\n" * (not is_held)
           + '[test]\nfile = "test.csv"\n' + compare)
    for number, (kind, places, *bounds) in enumerate(groups, 1):
        own = [value * (place in places) for place, value in enumerate(mass if kind == "mass" else stiffness)]
        files[f"part_{number}.mtx"] = written(masses(own) if kind == "mass" else springs(own, is_held))
        job += f'[[parameter]]\nname = "part {number}"\nmatrix = "part_{number}.mtx"\nscales = "{kind}"\n'
        job += "".join(f"{end} = {value}\n" for end, value in zip(("lower", "upper"), bounds))
    files["job.toml"] = job
    return files | {"test.csv": table(Model(files), truth, **test)}


def table(model, truth, rows, modes, frequency, shape, alone=0):
    """A test of a model's lowest modes with noise of these deviations, four digits a number; the last ones have a frequency alone. That of
    shapes is one number, or one a row."""
    draws = random.Random(SEED)
    noisy = [(f"{float(hertz.mid()) * (1 + frequency * draws.gauss(0, 1)):.4g}", [float(v[row].mid()) for row in rows])
             for hertz, v in list(model.vibrations([arb(str(factor)).log() for factor in truth]))[:modes]]
    is_own = isinstance(shape, list)
    own = shape if is_own else [shape] * len(rows)
    read = [[v / max(map(abs, values)) + d * draws.gauss(0, 1) for v, d in zip(values, own)] for _, values in noisy]
    lines = [["frequency_hz", ""] + [hertz for hertz, _ in noisy], ["frequency_deviation", ""] + [str(frequency)] * modes]
    with_shape = modes - alone
    if not is_own:
        lines.append(["shape_deviation", ""] + [str(shape)] * modes)
    lines.append(["grid", "direction"] + [f"mode {j + 1}" for j in range(modes)])
    lines += [[str(row + 1), "x"] + [f"{read[j][at]:.4f}" if j < with_shape else "" for j in range(modes)] for at, row in enumerate(rows)]
    if is_own:
        for line in lines[:2]:
            line += [""] * with_shape
        lines[2] += [f"deviation {j + 1}" for j in range(with_shape)]
        for at, line in enumerate(lines[3:]):
            line += [str(own[at])] * with_shape
    return "".join(",".join(line) + "\n" for line in lines)


def fits():
    """By the name, a job of tests/jobs and no files, or the files of one."""
    yield "building", {}
    yield "free chain with masses", chain(
        False, [8e4, 5e4, 6e4, 9e4, 4e4], [2.0, 1.0, 3.0, 1.5, 1.0, 2.5],
        [("stiffness", (0,)), ("stiffness", (1, 2)), ("stiffness", (3, 4)), ("mass", (0, 1)), ("mass", (4,))],
        (0.85, 1.2, 0.9, 1.15, 0.8), dict(rows=range(6), modes=4, frequency=0.004, shape=0.02),
        "[compare]\nanalysis_modes = 5\nprior_deviation = 0.3\n")
    yield "held chain with a frequency alone", chain(
        True, [6e4, 4e4, 5e4, 7e4, 3e4], [1.0, 2.0, 1.5, 1.0, 2.0],
        [("stiffness", (0,)), ("stiffness", (1,)), ("stiffness", (2, 3)), ("stiffness", (4,), 0.5, 1.1)],
        (0.8, 1.2, 0.9, 1.14), dict(rows=(0, 2, 3, 4), modes=4, frequency=0.005, shape=[0.01, 0.03, 0.02, 0.04], alone=1),
        "partners = [0, 0, 0, 4]\n[compare]\nanalysis_modes = 5\nprior_deviation = 0.2\n")


def main():
    lines = []
    for name, files in fits():
        folder = HERE.parent / "tests" / "jobs" / name
        texts = files or {path.name: path.read_text() for path in folder.iterdir()}
        found = dict(files=list(files.items())) | Fit(texts).certified()
        lines.append(f"  {json.dumps(name)}: {json.dumps(found)}")
        print(name, found["factors"], found["chi_squared"], flush=True)
    text, stored = "{\n" + ",\n".join(lines) + "\n}\n", HERE / "certified.json"
    if "--check" in sys.argv:
        sys.exit(None if stored.read_text() == text else "certified.json differs")
    stored.write_text(text)


if __name__ == "__main__":
    main()
