"""The inner and outer loop, written in numpy from the text of paper/tour alone, against a dump of a case.

    python3 golden/tour/method.py dump.json        (tests/ledgers/programs.rs gives it one)

It is given what the finite element model is asked for, K_D, M and the elements' shares of every analysis, and what was tested. All
else it computes: modes (chapter 7), pairs and errors (3), derivatives (4), the step with its bounds and halvings (4 to 6), new modes by
Recursive 1 (2), and where the loops end (6). It prints the largest relative difference from the dump and fails above 1e-9.
"""
import json
import sys

import numpy as np


def modes(k, m):
    """K v = w^2 M v with V^t M V = I, lowest first; M is diagonal (chapter 7)."""
    s = np.sqrt(np.diag(m))
    w2, v = np.linalg.eigh(k / np.outer(s, s))
    return w2, v / s[:, None]


def pairs(v, m, test):
    """The model's mode for every test mode, and the sign that turns it the same way (4): the entry closest to one first."""
    cross = v.T @ m @ test["v"]
    left, pair = np.abs(1 - np.abs(cross)), np.zeros(cross.shape[1], int)
    for _ in pair:
        i, j = np.unravel_index(np.argmin(left), left.shape)
        pair[j] = i
        left[i, :], left[:, j] = np.inf, np.inf
    return pair, np.sign(cross[pair, range(len(pair))])


def errors(w2, v, paired, test):
    """e_f and e_v (5, 6), every shape scaled to a largest component of one."""
    pair, sign = paired
    a, b = v[:, pair] * sign, test["v"]
    a, b = a / np.abs(a).max(0), b / np.abs(b).max(0)
    e_f = np.sqrt(np.sum((np.sqrt(w2[pair] / test["w2"]) - 1) ** 2))
    return e_f, np.sqrt(np.sum((a - b) ** 2) / len(v))


def first_order(k, beta):
    """(C.20) and (C.21): new roots, and the new shapes in the old ones."""
    stiff = k + np.diag(beta)
    below = stiff[:, None] - stiff[None, :]
    np.fill_diagonal(below, 1.0)
    p = -beta / below
    np.fill_diagonal(p, 1.0)
    return 1 / stiff, p


def recursive_1(k, beta):
    """(7) and (8) until no root changes."""
    d = np.diag(beta)
    off = beta - np.diag(d)
    gamma, p = first_order(k, beta)
    for _ in range(500):
        with_it = off + off @ (p - np.eye(len(k)))
        new = 1 / k - (d / k + gamma * np.sum(off * p.T, 1)) / (k + d)
        below = (k + d)[:, None] - 1 / gamma[None, :]
        np.fill_diagonal(below, 1.0)
        p = -with_it / below
        np.fill_diagonal(p, 1.0)
        still, gamma = np.abs(new / gamma - 1).max() < 1e-13, new
        if still:
            return gamma, p
    raise ArithmeticError("Recursive 1 does not settle")


def changed(base, beta, recursion):
    """New w^2 and shapes from the exact modes at the beginning of the pass, at unit generalized mass."""
    gamma, p = recursion(base["w2"], beta)
    v = base["v"] @ p
    return 1 / gamma, v / np.sqrt(np.einsum("ij,ik,kj->j", v, base["m"], v))


def inner_loop(base, factors, bounds, tolerance, settings, test):
    """One pass: total factors on the gages, and what every iteration did."""
    shares, beta = base["shares"], base["beta"]
    gage, share = np.ones(len(shares)), np.ones(len(shares))  # g_e and s_e
    w2, v, paired = base["w2"], base["v"], base["pairs"]
    e = errors(w2, v, paired, test)
    history = []
    while len(history) < settings["iterations"]:
        de, dk = np.zeros(len(shares)), np.zeros(len(shares))
        for n, k_e in enumerate(shares):
            now = {"w2": w2, "v": v, "m": base["m"]}
            de[n] = sum(errors(*changed(now, 0.001 * share[n] * v.T @ k_e @ v, first_order), paired, test)) - sum(e)
            kappa = share[n] * test["v"].T @ k_e @ test["v"] / np.sqrt(np.outer(test["w2"], test["w2"]))
            dk[n] = 0.001 * {"matrix": np.linalg.norm(kappa), "own": np.linalg.norm(np.diag(kappa)), "relative": 1.0}[settings["step"]]
        r = settings["relaxation"] if history else settings["first_relaxation"]
        c = 1 - r * sum(e) * de / dk
        limited = np.clip(c, settings["factor_range"]["lower"], settings["factor_range"]["upper"])
        for halving in range(settings["halvings"] + 1):
            new_gage = gage * (1 + (limited - 1) / 2**halving)
            if bounds is not None:
                new_gage = np.clip(new_gage, *(bounds / factors))
            new_share = np.maximum(share + new_gage / gage - 1, 0.001)
            trial = changed(base, np.tensordot(new_share - 1, beta, 1), recursive_1)
            new_paired = pairs(trial[1], base["m"], test)
            new_e = errors(*trial, new_paired, test)
            if sum(new_e) < sum(e):
                break
        else:
            return gage, history, "local_minimum"
        gage, share, (w2, v), paired, e = new_gage, new_share, trial, new_paired, new_e
        history.append({"error_changes": de, "stiffness_changes": dk, "unlimited_factors": c, "factors": gage, "halvings": halving,
                        "frequency_error": e[0], "shape_error": e[1], "error_sum": sum(e)})
        if sum(e) < tolerance:
            return gage, history, "tolerance"
    return gage, history, "iterations"


def main():
    dump = json.load(open(sys.argv[1]) if len(sys.argv) > 1 else sys.stdin)
    test = {"w2": (2 * np.pi * np.array(dump["test"]["frequencies_hz"])) ** 2, "v": np.array(dump["test"]["V_G"])}
    settings, worst = dump["settings"], 0.0
    # Case 3 keeps gages between its own two (chapter 6).
    bounds = None
    if dump["case"] == 3:
        first = np.array(dump["analyses"][0]["sizes"][:15])
        bounds = np.array([[0.007], [0.013]]) / first

    def compare(what, mine, theirs, scale=1e-300):
        nonlocal worst
        mine, theirs = np.asarray(mine, float), np.asarray(theirs, float)
        assert mine.shape == theirs.shape, f"{what}: {mine.shape} instead of {theirs.shape}"
        difference = np.abs(mine - theirs).max() / max(np.abs(theirs).max(), scale)
        worst = max(worst, difference)
        assert difference < 1e-9, f"{what}: {mine} instead of {theirs}"

    factors, passes = np.ones(15), 0
    for number, analysis in enumerate(dump["analyses"]):
        k, m = np.array(analysis["K_D"]), np.array(analysis["M"])
        base = {"m": m, "shares": np.array(analysis["shares"])}
        base["w2"], base["v"] = modes(k, m)
        base["pairs"] = pairs(base["v"], m, test)
        base["beta"] = np.array([base["v"].T @ k_e @ base["v"] for k_e in base["shares"]])
        compare("frequencies", np.sqrt(base["w2"]) / (2 * np.pi), analysis["frequencies_hz"])
        compare("factors", factors, analysis["factors"])
        parts = errors(base["w2"], base["v"], base["pairs"], test)
        e = sum(parts)
        within = all(part <= settings[f"{name}_tolerance"] for part, name in zip((e, *parts), ("error_sum", "frequency", "shape")))
        if number > 0:
            compare("exact error sum", e, dump["passes"][number - 1]["exact_error_sum"])
        if within:
            break
        theirs = dump["passes"][number]
        compare("error sum at first", e, theirs["start_error_sum"])
        tolerance = settings["later_inner_tolerance"] if number else settings["inner"]["tolerance"]
        gage, history, stop = inner_loop(base, factors, bounds, tolerance, settings["inner"], test)
        assert stop == theirs["stop"], f"pass {number + 1} ends by {stop} instead of {theirs['stop']}"
        assert len(history) == len(theirs["iterations"]), f"pass {number + 1}: {len(history)} iterations"
        for count, (mine, its) in enumerate(zip(history, theirs["iterations"])):
            for name, value in mine.items():
                # A difference of two error sums is as sharp as they are.
                scale = its["error_sum"] if name == "error_changes" else 1e-300
                compare(f"pass {number + 1}, iteration {count + 1}, {name}", value, its[name], scale)
        factors, passes = factors * gage, passes + 1
    assert passes == len(dump["passes"]), f"{passes} passes instead of {len(dump['passes'])}"
    assert within, f"not correlated: {e}"
    print(f"case {dump['case']}: {passes} passes, largest relative difference {worst:.1e}")


if __name__ == "__main__":
    main()
