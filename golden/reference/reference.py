"""Independent numpy program for the torque box: reads paper/reconstruction.toml, writes expected_*.toml beside it.

    python3 golden/reference/reference.py            (numpy as in requirements.txt; elements.py beside it)

Plain and slow on purpose. It shares no code with the crate; the crate must agree with what it writes.

Step rule, c = 1 - R e_S (de/dk): how dk of a 0.1 % change of an element is measured on the test modes,
  matrix    Frobenius norm of the relative generalized stiffness, V_G^t dK V_G / (w_i w_j), off-diagonals and all (default)
  own       the same, diagonal alone
  relative  the relative change itself, 0.001
  gage      the change of gage, in units of 0.01 in
Inside an inner loop stiffness changes add, K_e (1 + sum(c - 1)) with the stored K_e; gages multiply. At most 30 iterations a pass.
"""
import pathlib
import sys
import tomllib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import elements  # noqa: E402

PANELS = {1: (14, 10, 9, 13), 2: (10, 12, 16, 14), 3: (16, 12, 11, 15), 4: (1, 3, 7, 5), 5: (10, 6, 5, 9),
          6: (12, 8, 7, 11), 7: (2, 4, 3, 1), 8: (2, 4, 8, 6), 9: (5, 7, 11, 9), 10: (6, 2, 1, 5),
          11: (6, 8, 12, 10), 12: (6, 8, 7, 5), 13: (10, 12, 11, 9), 14: (8, 4, 3, 7), 15: (9, 11, 15, 13)}
COVERS = (2, 4, 8, 9, 11, 15)
RODS = [(1, 5), (5, 9), (9, 13), (2, 6), (6, 10), (10, 14), (3, 7), (7, 11), (11, 15), (4, 8), (8, 12), (12, 16)]
for s in (0, 4, 8):
    RODS += [(1 + s, 2 + s), (3 + s, 4 + s), (1 + s, 3 + s), (2 + s, 4 + s)]
GVT = np.full(15, 0.010)
GAGES = {
    "case 1 initial": np.full(15, 0.015), "case 2 initial": np.full(15, 0.015),
    "case 3 initial": np.array([0.013, 0.007] * 8)[:15], "case 4 initial": np.where(np.arange(15) == 7, 0.0001, 0.010),
}
# published gages after each pass (Tables 4, 6, 8)
PASSES = {
    "case 1 pass 1": [.01063, .01147, .01038, .01092, .00952, .00950, .01018, .00937, .00949, .00928, .00924, .00952, .00957, .00926, .00923],
    "case 1 pass 2": [.01018, .01083, .00999, .01066, .00947, .00964, .01007, .00957, .00977, .00958, .00966, .00987, .00993, .00977, .00965],
    "case 2 pass 1": [.01051, .00951, .01087, .01060, .01105, .01080, .01200, .00956, .01013, .01339, .01077, .01445, .01456, .01400, .01116],
    "case 2 pass 2": [.01017, .00922, .01010, .01039, .01006, .00982, .01114, .00900, .00949, .01291, .01047, .01456, .01464, .01389, .01082],
    "case 3 pass 1": [.00915, .00780, .00990, .00949, .01251, .01007, .01299, .01049, .01204, .00912, .00912, .00700, .01088, .00700, .01256],
    "case 3 pass 2": [.00971, .00901, .01083, .01057, .01300, .01077, .01300, .01132, .01183, .00917, .00837, .00700, .00998, .00700, .01286],
    "case 3 pass 3": [.00958, .00843, .00997, .00972, .01167, .00993, .01207, .01046, .01171, .00894, .00845, .00710, .01010, .00720, .01270],
}


GAUSS = np.polynomial.legendre.leggauss(20)


def shear_panel(x, g, nu):
    """Garvey panel of unit thickness: Z by quadrature of the assumed field, free of special cases.

    With homogeneous coordinates the two intersection points of opposite sides may lie at infinity.
    """
    geo = elements.shear_geometry(x)
    c = np.array([[0, 0, 1], [geo["x2"], 0, 1], [geo["x3"], geo["y3"], 1], [geo["x4"], geo["y4"], 1]], float)
    side = [np.cross(c[k], c[(k + 1) % 4]) for k in range(4)]
    p, q = np.cross(side[0], side[2]), np.cross(side[1], side[3])
    line = np.cross(p, q)
    z = 0.0
    for s, ws in zip(*GAUSS):
        for t, wt in zip(*GAUSS):
            n = 0.25 * np.array([(1 - s) * (1 - t), (1 + s) * (1 - t), (1 + s) * (1 + t), (1 - s) * (1 + t)])
            dn = 0.25 * np.array([[-(1 - t), 1 - t, 1 + t, -(1 + t)], [-(1 - s), -(1 + s), 1 + s, 1 - s]])
            at = n @ c
            flow = (line @ c[0]) * (line @ c[1]) / (line @ at) ** 2
            to_p, to_q = p[:2] - p[2] * at[:2], q[:2] - q[2] * at[:2]
            cot = (to_p @ to_q) / (to_p[0] * to_q[1] - to_p[1] * to_q[0])
            z += ws * wt * np.linalg.det(dn @ c[:, :2]) * flow**2 / (2 * g) * (1 + 2 * cot**2 / (1 + nu))
    a = elements.shear_vector(geo)
    return np.outer(a, a) / (2 * z)


def dof(grids):
    return np.array([3 * (g - 1) + a for g in grids for a in range(3)])


class Box:
    def __init__(self, data):
        self.x = np.array([data["grids"][str(g)] for g in range(1, 17)], float)
        self.mass = np.array(data["masses"], float)
        e, nu = data["youngs_modulus"], data["poissons_ratio"]
        g = e / (2 * (1 + nu))
        self.t = self.load_distribution(data["mid_chord_fraction"])
        self.unit = {}
        for shear_only in (True, False):
            u = np.zeros((15, 48, 48))
            for el, grids in PANELS.items():
                xe = self.x[[k - 1 for k in grids]]
                k = shear_panel(xe, g, nu) if shear_only or el not in COVERS else elements.qdmem(xe, 1.0, e, nu, g)
                u[el - 1][np.ix_(dof(grids), dof(grids))] = k
            self.unit[shear_only] = u[:, :36, :36]
        k = np.zeros((48, 48))
        for a, b in RODS:
            k[np.ix_(dof((a, b)), dof((a, b)))] += elements.rod(self.x[a - 1], self.x[b - 1], 1.0, e)
        self.rods = k[:36, :36]

    def load_distribution(self, xi):
        t = np.zeros((36, 9))
        for rib, xi in enumerate(np.broadcast_to(xi, 3)):
            h1, h2 = 1 - 3 * xi**2 + 2 * xi**3, xi - 2 * xi**2 + xi**3
            h3, h4 = 3 * xi**2 - 2 * xi**3, xi**3 - xi**2
            fu, fl, ru, rl = (4 * rib + k for k in range(4))
            chord = (self.x[ru] - self.x[fu])[:2]
            length = np.hypot(*chord)
            direction = chord / length
            depth_f, depth_r = self.x[fu, 2] - self.x[fl, 2], self.x[ru, 2] - self.x[rl, 2]
            front, mid, rear = 3 * rib, 3 * rib + 1, 3 * rib + 2
            for grid, share, column in ((fu, .5, front), (fl, .5, front), (ru, .5, rear), (rl, .5, rear),
                                        (fu, h1 / 2, mid), (fl, h1 / 2, mid), (ru, h3 / 2, mid), (rl, h3 / 2, mid)):
                t[3 * grid + 2, column] = share
            for axis in (0, 1):
                t[3 * fu + axis, mid] = -h2 * length * direction[axis] / depth_f
                t[3 * fl + axis, mid] = +h2 * length * direction[axis] / depth_f
                t[3 * ru + axis, mid] = -h4 * length * direction[axis] / depth_r
                t[3 * rl + axis, mid] = +h4 * length * direction[axis] / depth_r
        return t

    def dynamic(self, case, gages):
        unit, area = self.unit[case == 1], 0.20 if case == 1 else 0.01
        ks = np.tensordot(gages, unit, 1) + area * self.rods
        flexible = np.linalg.solve(ks, self.t)
        kd = np.linalg.inv(self.t.T @ flexible)
        bt = flexible @ kd
        return 0.5 * (kd + kd.T), np.array([gages[e] * bt.T @ unit[e] @ bt for e in range(15)])

    def modes(self, kd):
        s = np.sqrt(self.mass)
        w, v = np.linalg.eigh(kd / np.outer(s, s))
        return np.sqrt(w) / (2 * np.pi), v / s[:, None]


def matched(f, v, vg, mass):
    order = np.abs(v.T @ (mass[:, None] * vg)).argmax(0)
    v = v[:, order]
    return f[order], v * np.sign(np.sum(v * mass[:, None] * vg, 0))


def errors(f, v, fg, vg, mass):
    f, v = matched(f, v, vg, mass)
    a, b = v / np.abs(v).max(0), vg / np.abs(vg).max(0)
    return np.sqrt(np.sum((f / fg - 1) ** 2)), np.sqrt(np.sum((a - b) ** 2) / len(mass))


def perturbed(f, v, dk, mass, order):
    """Van de Vooren: first order (order=1) or Recursive 1."""
    k = (2 * np.pi * f) ** 2
    lam = 1 / k
    beta = v.T @ dk @ v
    d = np.diag(beta).copy()
    off = beta - np.diag(d)
    gam = 1 / (k + d)

    def shapes(rhs, g):
        den = (k + d)[:, None] - 1 / g[None, :]
        np.fill_diagonal(den, 1.0)
        p = -rhs / den
        np.fill_diagonal(p, 1.0)
        return p
    p = shapes(off, gam)
    for _ in range(order - 1):
        q = p - np.eye(len(k))
        new = lam - (d * lam + gam * np.einsum("ij,ji->i", off, p)) / (k + d)
        p = shapes(off + off @ q, gam)
        done = np.max(np.abs(new / gam - 1)) < 1e-13
        gam = new
        if done:
            break
    w = v @ p
    return 1 / np.sqrt(gam) / (2 * np.pi), w / np.sqrt(np.sum(w * mass[:, None] * w, 0))


def factors(box, f, v, shares, fg, vg, relax, rule="matrix", scale=1.0, gages=None):
    """Unlimited stiffness change factors of Eq. 13, and e_S. `shares` are the element stiffnesses as they now are."""
    es = sum(errors(f, v, fg, vg, box.mass))
    c = np.zeros(15)
    for e in range(15):
        de = sum(errors(*perturbed(f, v, 1e-3 * shares[e], box.mass, 1), fg, vg, box.mass)) - es
        generalized = vg.T @ shares[e] @ vg / np.outer(2 * np.pi * fg, 2 * np.pi * fg)
        dk = 1e-3 * {"matrix": np.linalg.norm(generalized), "own": np.linalg.norm(np.diag(generalized)), "relative": 1.0, "gage": 1.0 if gages is None else gages[e] / 0.010}[rule]
        c[e] = 1 - scale * relax * es * de / dk
    return c, es


def correlate(box, case, start, passes, limits=None, rule="matrix", scale=1.0, add=None, test_modes=9, fem_modes=9, cap=30):
    """`add`: inside the inner loop K_e (1 + sum(c - 1)) of the stored K_e; otherwise K_e prod(c). Gages always multiply."""
    add = True if add is None else add
    fg, vg = box.modes(box.dynamic(case, GVT)[0])
    fg, vg = fg[:test_modes], vg[:, :test_modes]
    gages, out = start.copy(), []
    for number in range(1, passes + 1):
        kd, shares = box.dynamic(case, gages)
        f0, v0 = box.modes(kd)
        f0, v0 = f0[:fem_modes], v0[:, :fem_modes]
        total, inner, f, v = np.ones(15), np.ones(15), f0, v0
        es, history = sum(errors(f, v, fg, vg, box.mass)), []
        for it in range(cap):
            c, es = factors(box, f, v, inner[:, None, None] * shares, fg, vg, 0.8 if it == 0 else 1.0, rule, scale, gages * total)
            for halving in range(6):  # a local minimum is one that five halvings of the step do not leave
                trial = total * (1 + (np.clip(c, 0.55, 1.50) - 1) / 2**halving)
                if limits:
                    trial = np.clip(gages * trial, *limits) / gages
                stiff = np.maximum(inner + trial / total - 1, 1e-3) if add else trial
                f1, v1 = perturbed(f0, v0, np.tensordot(stiff - 1, shares, 1), box.mass, 60)
                e1 = sum(errors(f1, v1, fg, vg, box.mass))
                if np.isfinite(e1) and e1 < es:
                    break
            else:
                break
            total, inner, f, v, es = trial, stiff, f1, v1, e1
            history.append(float(e1))
            if es < (0.025 if number == 1 else 0.015):
                break
        gages = gages * total
        fx, vx = box.modes(box.dynamic(case, gages)[0])
        ef, ev = errors(fx[:fem_modes], vx[:, :fem_modes], fg, vg, box.mass)
        fi, vi = errors(f, v, fg, vg, box.mass)
        out.append(dict(iterations=len(history), inner=history, gages=gages.copy(), frequencies=matched(fx, vx, vg, box.mass)[0], frequency_rms=ef / test_modes**.5, shape_rms=ev / test_modes**.5,
                        inner_frequencies=f, inner_frequency_rms=fi / test_modes**.5, inner_shape_rms=vi / test_modes**.5))
    return out


def toml_list(values, fmt="%.10g"):
    return "[" + ", ".join(fmt % v for v in values) + "]"


def write_expected(box, rule, scale=1.0):
    lines = ["# written by reference.py from paper/reconstruction.toml; frequencies in Hz, gages in inches, RMS as fractions"]
    for case in (1, 2):
        f, _ = box.modes(box.dynamic(case, GVT)[0])
        lines += [f'["case {case} gvt"]', "frequencies = " + toml_list(f)]
    for name, gages in {**GAGES, **PASSES}.items():
        case = int(name.split()[1])
        fg, vg = box.modes(box.dynamic(case, GVT)[0])
        f, v = box.modes(box.dynamic(case, np.array(gages))[0])
        ef, ev = errors(f, v, fg, vg, box.mass)
        lines += [f'["{name}"]' if "initial" in name else f'["{name}, published gages"]', "frequencies = " + toml_list(f), f"frequency_rms = {ef / 3:.10g}", f"shape_rms = {ev / 3:.10g}"]
    fg, vg = box.modes(box.dynamic(2, GVT)[0])
    kd, shares = box.dynamic(4, GAGES["case 4 initial"])
    c, es = factors(box, *box.modes(kd), shares, fg, vg, 0.8, rule, scale, GAGES["case 4 initial"])
    lines += ['["case 4 first iteration"]', f"error_sum = {es:.10g}", "unlimited_factors = " + toml_list(c)]
    for case, passes, limits in ((1, 2, None), (2, 2, None), (3, 3, (0.007, 0.013))):
        for number, r in enumerate(correlate(box, case, GAGES[f"case {case} initial"], passes, limits, rule, scale), 1):
            lines += [f'["case {case} computed pass {number}"]', f"iterations = {r['iterations']}", "inner_error_sums = " + toml_list(r["inner"]), "gages = " + toml_list(r["gages"]),
                      "frequencies = " + toml_list(r["frequencies"]), f"frequency_rms = {r['frequency_rms']:.10g}", f"shape_rms = {r['shape_rms']:.10g}"]
    for test, fem in ((7, 7), (7, 9), (5, 5), (5, 7), (5, 9), (3, 5), (3, 7), (3, 9)):
        (r,) = correlate(box, 2, GAGES["case 2 initial"], 1, None, rule, scale, None, test, fem)
        lines += [f'["case 2, {test} test and {fem} analysis modes"]', f"iterations = {r['iterations']}", "gages = " + toml_list(r["gages"]), "inner_frequencies = " + toml_list(r["inner_frequencies"]),
                  f"inner_frequency_rms = {r['inner_frequency_rms']:.10g}", f"inner_shape_rms = {r['inner_shape_rms']:.10g}"]
    (HERE / f"expected_{rule}.toml").write_text("\n".join(lines) + "\n")


def main():
    box = Box(tomllib.loads((HERE.parent.parent / "paper" / "reconstruction.toml").read_text()))
    for rule in ("matrix", "own", "relative", "gage"):
        write_expected(box, rule)


if __name__ == "__main__":
    main()
