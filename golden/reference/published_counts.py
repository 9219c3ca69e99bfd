"""The fifteen columns of Tables 4, 6, 8, 10, 11 and 12 one by one: writes expected_published_counts.toml beside it.

    python3 golden/reference/published_counts.py            (needs numpy; reference.py and elements.py beside it)

Every column starts from the published gages of the pass before and makes exactly the published number of iterations. No tolerance and no cap takes
part. Written are, by each rule, the gages (in), their RMS difference d from the print (percent points of 0.010 in), the error sum reached (%), and
the RMS of all differences. "half" is the step c = 1 - R e_S y_e/sum(y^2), y = (de/0.001)/sqrt(||kappa||): evidence, not a reading of the text.
"""
import pathlib
import tomllib

import numpy as np

import reference as r

COUNTS = {1: (6, 6), 2: (8, 12), 3: (25, 10, 8)}
FEWER = {  # Tables 10 to 12: (test modes, analysis modes): iterations, gages (in)
    (7, 7): (9, [.01075, .00974, .01075, .01029, .01058, .01117, .01251, .00956, .01009, .01324, .01084, .01470, .01472, .01438, .01100]),
    (7, 9): (8, [.01063, .00969, .01058, .01045, .01062, .01064, .01191, .00947, .01003, .01310, .01094, .01473, .01477, .01413, .01104]),
    (5, 5): (30, [.01024, .01073, .01070, .01076, .01269, .01189, .01494, .01003, .01044, .01442, .01031, .01442, .01438, .01325, .01036]),
    (5, 7): (17, [.01039, .01023, .01063, .01080, .01141, .01153, .01330, .01019, .01031, .01350, .01054, .01408, .01409, .01354, .01080]),
    (5, 9): (9, [.01047, .01020, .01062, .01095, .01118, .01114, .01266, .01008, .01012, .01311, .01055, .01392, .01396, .01339, .01081]),
    (3, 5): (30, [.01199, .01038, .01127, .01226, .01353, .01366, .01383, .01214, .00969, .01423, .01001, .01500, .01497, .01475, .01046]),
    (3, 7): (30, [.01195, .01042, .01126, .01217, .01346, .01362, .01378, .01202, .00965, .01418, .01004, .01500, .01497, .01466, .01047]),
    (3, 9): (30, [.01194, .01042, .01126, .01216, .01345, .01362, .01377, .01203, .00965, .01419, .01005, .01500, .01498, .01466, .01047]),
}
TABLES = {7: 10, 5: 11, 3: 12}
RULES = ("relative", "own", "matrix", "gage", "half")


def factors(box, f, v, shares, fg, vg, relax, rule, gages):
    if rule != "half":
        return r.factors(box, f, v, shares, fg, vg, relax, rule, 1.0, gages)
    unit, es = r.factors(box, f, v, shares, fg, vg, 1.0, "relative", 1.0, gages)
    slope = (1 - unit) / es  # de / 0.001
    omega = 2 * np.pi * fg
    kappa = np.array([np.linalg.norm(vg.T @ share @ vg / np.outer(omega, omega)) for share in shares])
    y = slope / np.sqrt(kappa)
    return 1 - relax * es * y / (y @ y), es


def column(box, case, start, count, limits, rule, test_modes=9, fem_modes=9):
    """`count` iterations of one pass without a tolerance: gages and the error sum at the end."""
    fg, vg = box.modes(box.dynamic(case, r.GVT)[0])
    fg, vg = fg[:test_modes], vg[:, :test_modes]
    kd, shares = box.dynamic(case, start)
    f0, v0 = box.modes(kd)
    f0, v0 = f0[:fem_modes], v0[:, :fem_modes]
    total, stiff, f, v = np.ones(15), np.ones(15), f0, v0
    es = sum(r.errors(f, v, fg, vg, box.mass))
    for it in range(count):
        c, es = factors(box, f, v, stiff[:, None, None] * shares, fg, vg, 0.8 if it == 0 else 1.0, rule, start * total)
        for halving in range(6):
            trial = total * (1 + (np.clip(c, 0.55, 1.50) - 1) / 2**halving)
            if limits:
                trial = np.clip(start * trial, *limits) / start
            added = np.maximum(stiff + trial / total - 1, 1e-3)
            f1, v1 = r.perturbed(f0, v0, np.tensordot(added - 1, shares, 1), box.mass, 60)
            e1 = sum(r.errors(f1, v1, fg, vg, box.mass))
            if np.isfinite(e1) and e1 < es:
                break
        else:
            break
        total, stiff, f, v, es = trial, added, f1, v1, e1
    return start * total, es


def columns(box, rule):
    """Name of every printed column, the gages and the error sum that the rule reaches, and the printed gages."""
    for case, counts in COUNTS.items():
        starts = [r.GAGES[f"case {case} initial"]] + [np.array(r.PASSES[f"case {case} pass {p}"]) for p in range(1, len(counts))]
        for p, (start, count) in enumerate(zip(starts, counts), 1):
            limits = (0.007, 0.013) if case == 3 else None
            yield f"Case {case} pass {p}", *column(box, case, np.array(start, float), count, limits, rule), r.PASSES[f"case {case} pass {p}"]
    for (test_modes, fem_modes), (count, published) in FEWER.items():
        gages, es = column(box, 2, r.GAGES["case 2 initial"], count, None, rule, test_modes, fem_modes)
        yield f"Table {TABLES[test_modes]} FEM {fem_modes}", gages, es, published


def main():
    box = r.Box(tomllib.loads((r.HERE.parent.parent / "paper" / "reconstruction.toml").read_text()))
    lines = ["# written by published_counts.py from paper/reconstruction.toml; gages in inches, differences in points, error sums in percent"]
    for rule in RULES:
        differences = []
        for name, gages, es, published in columns(box, rule):
            differences.append(100 * np.sqrt(np.mean(((gages - published) / 0.010) ** 2)))
            lines += [f'["{rule}, {name}"]', "gages = " + r.toml_list(gages), f"difference = {differences[-1]:.10g}", f"error_sum = {100 * es:.10g}"]
        lines += [f'["{rule}, pooled"]', f"difference = {np.sqrt(np.mean(np.square(differences))):.10g}"]
    (r.HERE / "expected_published_counts.toml").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
