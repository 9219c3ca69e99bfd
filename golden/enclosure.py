"""The method on the paper's four cases in ball arithmetic: every digit and every decision proven, or refused.

    python3 enclosure.py [FILE] [PART OF A RUN'S NAME]      (python-flint as in enclosure.txt)

Every number is a ball (Arb) that holds the exact one. What enters is exact: the decimals of paper/reconstruction.toml, of Table 2
and of the settings, as fractions. Everything behind them is derived here: elements, condensation, modes, sorting, errors, steps,
loops. A comparison that chooses a path is proven by the balls being apart; balls that overlap raise Undecided, and the run starts
again with twice as many bits. So no number and no branch below rests on rounding. It shares no code with the crate.

Every run is made three times more with a noise of 1e-40 where double precision rounds: in the structural stiffness relative to its
diagonal, and in every change of the error sum relative to the sum. What comes out of it over what went in is the condition of a
number, how much one rounding counts; the crate's distance is held to it (tests/evidence/enclosed.rs).

Proven is what the written method gives from these decimals. That the method is the paper's, and the box the one that was tested,
is another matter (paper/print_and_box.md).
"""
import functools
import json
import pathlib
import random
import sys
from collections import defaultdict

from enclosed_box import DYNAMIC, PANELS, Box, exact, length, scaled
from flint import acb_mat, arb, arb_mat, ctx

BITS = (512, 1024, 2048, 4096)
NOISE, SEEDS = "1e-40", (1, 2, 3)
READINGS = ("own", "matrix", "relative", "gage")
PASSES = {1: 2, 2: 2, 3: 3, 4: 1}  # as many as the paper prints
FEWER_MODES = ((7, 7), (7, 9), (5, 5), (5, 7), (5, 9), (3, 5), (3, 7), (3, 9))  # test and analysis modes of Tables 9 to 12


class Undecided(Exception):
    """Two balls that must be compared overlap."""


class NoVibration(Exception):
    """A trial step that the perturbation cannot follow: a root lost, two modes too close, or not settled."""


class Ledger:
    """How many decisions of each kind were proven, and how near the nearest of each was, relative to the larger side."""

    def __init__(self):
        self.count, self.nearest = defaultdict(int), defaultdict(lambda: float("inf"))

    def less(self, a, b, kind):
        difference = a - b
        if not (difference < 0 or difference > 0):
            raise Undecided(kind)
        self.count[kind] += 1
        scale = max(abs(float(a.mid())), abs(float(b.mid())))
        self.nearest[kind] = min(self.nearest[kind], abs(float(difference.mid())) / scale)
        return bool(difference < 0)


class Noise:
    """None, or numbers from -1e-40 to 1e-40 of a seed."""

    def __init__(self, seed=None):
        self.draws = seed and random.Random(seed)

    def draw(self):
        return exact(NOISE) * self.draws.randint(-1000, 1000) / 1000 if self.draws else arb(0)


def total(terms):
    return sum(terms, arb(0))


# Modes, pairs and errors: (3) to (6).

class Modes:
    def __init__(self, omega_squared, shapes):
        self.omega_squared, self.shapes, self.count = omega_squared, shapes, len(omega_squared)

    @functools.cached_property
    def unit(self):
        """Shapes with a largest component of one."""
        return [scaled(v, 1 / functools.reduce(lambda a, b: a.max(b), map(abs, v))) for v in columns(self.shapes)]


def columns(matrix):
    return list(zip(*matrix.tolist()))


def eigen(stiffness, mass, count, ledger):
    """The lowest modes; Arb isolates the roots and encloses the vectors."""
    s = [m.sqrt() for m in mass]
    reduced = [[(stiffness[i, j] + stiffness[j, i]) / (2 * s[i] * s[j]) for j in range(DYNAMIC)] for i in range(DYNAMIC)]
    try:
        roots, vectors = acb_mat(arb_mat(reduced)).eig(right=True)
    except (ValueError, ArithmeticError) as error:
        raise Undecided(f"roots: {error}") from None
    order = sorted(range(DYNAMIC), key=lambda j: float(roots[j].real.mid()))
    for a, b in zip(order, order[1:]):
        assert ledger.less(roots[a].real, roots[b].real, "order of modes")
    shapes = []
    for j in order[:count]:
        z = [vectors[i, j] for i in range(DYNAMIC)]
        largest = max(z, key=lambda x: float(abs(x).mid()))
        z = [(x / largest).real for x in z]  # a root apart from all others has one real direction
        shapes.append([x / length(z) / m for x, m in zip(z, s)])
    return Modes([roots[j].real for j in order[:count]], arb_mat(shapes).transpose())


def pair(m, ledger):
    """(4): the entry closest to one first. A pair is certain when it beats all that share its row or its column."""
    left = {(i, j): abs(1 - abs(m[i, j])) for i in range(m.nrows()) for j in range(m.ncols())}
    mode = {}
    while left:
        best = min(left, key=lambda at: float(left[at].mid()))
        rivals = [at for at in left if at != best and (at[0] == best[0] or at[1] == best[1])]
        assert all(ledger.less(left[best], left[at], "pairing") for at in rivals)
        mode[best[1]] = best[0]
        left = {at: value for at, value in left.items() if at != best and at not in rivals}
    return [(mode[j], 1 if ledger.less(arb(0), m[mode[j], j], "sign") else -1) for j in range(m.ncols())]


def errors(analysis, pairs, test):
    f = total(((analysis.omega_squared[i] / test.omega_squared[j]).sqrt() - 1) ** 2 for j, (i, _) in enumerate(pairs))
    v = total((sign * x - y) ** 2 for j, (i, sign) in enumerate(pairs) for x, y in zip(analysis.unit[i], test.unit[j]))
    return f.sqrt(), (v / DYNAMIC).sqrt()


# Perturbation: (7), (8), (C.20) to (C.23) for changes of stiffness.

def shapes_from(k, beta, roots, sums, ledger):
    n = len(k)
    if not all([ledger.less(arb(0), root, "root lost") for root in roots]):
        raise NoVibration("root lost")
    shapes = arb_mat(n, n)
    for i in range(n):
        own = k[i] + beta[i, i]
        for j in range(n):
            if i == j or sums[i, j] == 0:
                shapes[i, j] = arb(i == j)
                continue
            difference = own - 1 / roots[j]
            if not ledger.less(exact("1e-9") * own, abs(difference), "denominator"):
                raise NoVibration("close modes")
            shapes[i, j] = -sums[i, j] / difference
    return shapes


def first_order(k, beta, ledger):
    roots = [1 / (k[j] + beta[j, j]) for j in range(len(k))]
    return roots, shapes_from(k, beta, roots, beta, ledger)


def recursive_1(k, beta, ledger, tolerance="1e-13", orders=60):
    n = len(k)
    roots, shapes = first_order(k, beta, ledger)
    coupling = arb_mat([[arb(0) if i == j else beta[i, j] for j in range(n)] for i in range(n)])
    for _ in range(1, orders):
        sums = coupling * shapes
        shapes = shapes_from(k, beta, roots, sums, ledger)
        following = [1 / k[j] - (beta[j, j] / k[j] + roots[j] * sums[j, j]) / (k[j] + beta[j, j]) for j in range(n)]
        change = functools.reduce(lambda a, b: a.max(b), (abs(b / a - 1) for a, b in zip(roots, following)))
        roots = following
        if ledger.less(change, exact(tolerance), "settled"):
            break
    else:
        if not ledger.less(change, exact("1e-6"), "unsettled"):
            raise NoVibration("unsettled")
    # The exact roots are the eigenvalues of Γ + E, within Gershgorin's discs of the γ; two shapes that are one have no inverse.
    ap = arb_mat([[(k[i] if i == j else 0) + beta[i, j] for j in range(n)] for i in range(n)]) * shapes
    try:
        e = ap.solve(arb_mat([[shapes[i, j] - ap[i, j] * roots[j] for j in range(n)] for i in range(n)]))
    except ZeroDivisionError:
        raise Undecided("inverse") from None
    for j in range(n):
        radius = sum((abs(e[j, s]) / (roots[j] * roots[s]).sqrt() for s in range(n)), arb(0))
        if not ledger.less(radius, exact("1e-4"), "proven"):
            raise NoVibration("unsettled")
    return roots, shapes


# The loops: (9) to (13).

STEP, TEN_STEPS = "0.001", "0.010"


def error_changes(model, state, ledger, noise):
    k, p = state["modes"].omega_squared, state["generalized"]
    n = len(k)
    close = {(i, j) for i in range(n) for j in range(n) if i != j and i < j and ledger.less(abs(k[i] - k[j]), exact(TEN_STEPS) * k[i].max(k[j]), "close")}
    changes = []
    for share, factor in zip(model["shares"], state["factors"]):
        beta = p.transpose() * (share * p) * (exact(STEP) * factor)
        for i, j in close:
            beta[i, j] = beta[j, i] = arb(0)
        roots, shapes = first_order(k, beta, ledger)
        changed = Modes([1 / root for root in roots], state["modes"].shapes * shapes)
        changes.append(total(errors(changed, state["pairs"], model["test"])) - state["sum"] * (1 + noise.draw()))
    return changes


def relative_changes(model, state, gage_factors, reading):
    """Δk of (12) and (13) in parts of the step, by the four readings of it."""
    if reading == "relative":
        return [arb(1)] * PANELS
    if reading == "gage":
        return [factor * gage / exact("0.010") for factor, gage in zip(gage_factors, model["gages"])]
    omega = [w.sqrt() for w in model["test"].omega_squared]
    n = range(len(omega))
    at = [(i, i) for i in n] if reading == "own" else [(i, j) for i in n for j in n]
    return [factor * total((share[i, j] / (omega[i] * omega[j])) ** 2 for i, j in at).sqrt()
            for factor, share in zip(state["factors"], model["test_shares"])]


def trial(model, factors, ledger):
    """All changes since the exact modes at once."""
    beta = functools.reduce(lambda a, b: a + b, (share * (factor - 1) for share, factor in zip(model["shares"], factors)))
    roots, p = recursive_1(model["modes"].omega_squared, beta, ledger)
    p = arb_mat([scaled(column, 1 / length(column)) for column in columns(p)]).transpose()
    modes = Modes([1 / root for root in roots], model["modes"].shapes * p)
    pairs = pair(p.transpose() * model["cross"], ledger)
    return dict(factors=factors, modes=modes, generalized=p, pairs=pairs, sum=total(errors(modes, pairs, model["test"])))


def inner_loop(model, reading, gage_range, tolerance, iterations, ledger, noise):
    ones = [arb(1)] * PANELS
    identity = arb_mat([[arb(i == j) for j in range(model["modes"].count)] for i in range(model["modes"].count)])
    state = dict(factors=ones, modes=model["modes"], generalized=identity, pairs=model["pairs"], sum=total(model["errors"]))
    gage_factors, first, history, halvings = ones, None, [], []
    while len(history) < iterations:
        relaxation = exact("0.8") if not history else arb(1)
        changes, measures = error_changes(model, state, ledger, noise), relative_changes(model, state, gage_factors, reading)
        unlimited = [1 - relaxation * state["sum"] * de / (exact(STEP) * dk) for de, dk in zip(changes, measures)]
        first = first or unlimited
        limited = []
        for c in unlimited:
            low, high = ledger.less(c, exact("0.55"), "factor bound"), ledger.less(exact("1.50"), c, "factor bound")
            limited.append(exact("0.55") if low else exact("1.50") if high else c)
        for halving in range(6):
            following = [f * (1 + (c - 1) / 2**halving) for f, c in zip(gage_factors, limited)]
            if gage_range:  # of a gage at its bound both sides are the same number: no decision
                following = [(g * f).max(gage_range[0]).min(gage_range[1]) / g for g, f in zip(model["gages"], following)]
            shares = [(s + new / old - 1).max(exact("0.001")) for s, new, old in zip(state["factors"], following, gage_factors)]
            try:
                found = trial(model, shares, ledger)
            except NoVibration:
                continue
            if ledger.less(found["sum"], state["sum"], "descent"):
                break
        else:
            break
        gage_factors, state = following, found
        history.append(state["sum"])
        halvings.append(halving)
        if ledger.less(state["sum"], tolerance, "inner tolerance"):
            break
    return gage_factors, state, first, history, halvings


def analyze(box, gages, test, count, ledger, noise):
    dynamic, transformation = box.analysis(gages, noise)
    modes = eigen(dynamic, box.mass, count, ledger)
    weighted = arb_mat([[m * x for x in row] for m, row in zip(box.mass, test.shapes.tolist())])
    cross_orthogonality = modes.shapes.transpose() * weighted
    pairs = pair(cross_orthogonality, ledger)
    return dict(gages=gages, modes=modes, test=test, cross=cross_orthogonality, pairs=pairs, errors=errors(modes, pairs, test),
                shares=box.shares(gages, transformation, modes.shapes), test_shares=box.shares(gages, transformation, test.shapes))


def correlate(case, reading, passes, test_count, count, ledger, noise):
    box = Box(case)
    test = eigen(box.analysis([exact("0.010")] * PANELS, noise)[0], box.mass, test_count, ledger)
    gage_range = [exact("0.007"), exact("0.013")] if case == 3 else None
    model = analyze(box, box.gages, test, count, ledger, noise)
    result = dict(test_frequencies=hertz(test), initial=check(model), passes=[])
    for number in range(passes):
        tolerance, iterations = exact("0.015" if number else "0.025"), 1 if case == 4 else 30
        factors, state, first, history, halvings = inner_loop(model, reading, gage_range, tolerance, iterations, ledger, noise)
        model = analyze(box, [g * f for g, f in zip(model["gages"], factors)], test, count, ledger, noise)
        limits = zip((total(model["errors"]), *model["errors"]), ("0.025", "0.015", "0.04"))
        result["passes"].append(dict(
            iterations=len(history), halvings=halvings, error_sums=history, unlimited_factors=first, gages=model["gages"],
            inner_frequencies=hertz(state["modes"]), **check(model), converged=all([ledger.less(e, exact(limit), "outer tolerance") for e, limit in limits])))
    return result


def hertz(modes):
    return sorted((w.sqrt() / (2 * arb.pi()) for w in modes.omega_squared), key=lambda f: float(f.mid()))


def check(model):
    """An exact solution: frequencies, which of them answers each test mode (from zero), and both errors."""
    f = [w.sqrt() / (2 * arb.pi()) for w in model["modes"].omega_squared]
    return dict(frequencies=f, paired=[mode for mode, _ in model["pairs"]], errors=list(model["errors"]))


# What is run, and what is written.

def runs():
    for case in (1, 2, 3, 4):
        for reading in READINGS:
            yield f"case {case}, {reading}", (case, reading, PASSES[case], DYNAMIC, DYNAMIC)
    for tests, count in FEWER_MODES:
        for reading in READINGS:
            yield f"case 2, {reading}, {tests} test and {count} analysis modes", (2, reading, 1, tests, count)


def proven(arguments):
    for bits in BITS:
        ctx.prec, ledger = bits, Ledger()
        try:
            found = correlate(*arguments, ledger, Noise())
            noisy = [correlate(*arguments, Ledger(), Noise(seed)) for seed in SEEDS]
            return written(found) | dict(
                conditions=conditions(found, noisy), bits=bits, decisions=sum(ledger.count.values()),
                nearest={kind: float(f"{margin:.3g}") for kind, margin in sorted(ledger.nearest.items())})
        except (Undecided, ZeroDivisionError) as undecided:
            print(f"  {bits} bits leave a decision open ({undecided})", flush=True)
    raise Undecided(arguments)


NUMBERS = ("error_sums", "unlimited_factors", "gages", "inner_frequencies", "frequencies", "errors")


def conditions(found, noisy):
    """By the number, how far the noisy runs are from the exact one over their noise, relative; of the first model, and of every pass."""
    def apart(exactly, others):
        assert all(len(exactly) == len(other) for other in others)
        ratios = [abs(float(((b - a) / (a * exact(NOISE))).mid())) for other in others for a, b in zip(exactly, other)]
        return float(f"{max(ratios, default=0.0):.3g}")

    def of(stage, others):
        return {name: apart(stage[name], [other[name] for other in others]) for name in NUMBERS if name in stage}
    first = dict(test_frequencies=apart(found["test_frequencies"], [other["test_frequencies"] for other in noisy]))
    return dict(initial=first | of(found["initial"], [other["initial"] for other in noisy]),
                passes=[of(own, [other["passes"][at] for other in noisy]) for at, own in enumerate(found["passes"])])


def written(value):
    """Balls as decimals of twenty digits, refused when they have fewer."""
    if isinstance(value, arb):
        if not value.rad() <= abs(value.mid()) * exact("1e-22"):
            raise Undecided(f"digits of {value.str(5)}")
        return value.str(20, radius=False)
    if isinstance(value, dict):
        return {key: written(item) for key, item in value.items()}
    return [written(item) for item in value] if isinstance(value, list) else value


def main(output=pathlib.Path(__file__).with_name("enclosed.json"), only=""):
    found = {}
    for name, arguments in runs():
        if only in name:
            found[name] = proven(arguments)
            print(name, found[name]["bits"], "bits,", found[name]["decisions"], "decisions", flush=True)
    lines = [f"  {json.dumps(name)}: {json.dumps(run)}" for name, run in found.items()]
    pathlib.Path(output).write_text("{\n" + ",\n".join(lines) + "\n}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
