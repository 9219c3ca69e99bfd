"""The torque box in balls: elements from their definitions, Table 2 and paper/reconstruction.toml as exact decimals. For enclosure.py."""
import csv
import pathlib
import tomllib
from fractions import Fraction

from flint import arb, arb_mat, fmpq

PAPER = pathlib.Path(__file__).parents[1] / "paper"
PANELS, DYNAMIC, FREE = 15, 9, 36  # elements that are corrected, dynamic and structural DOF


def exact(decimal):
    """A decimal as the smallest ball that holds it."""
    fraction = Fraction(decimal)
    return arb(fmpq(fraction.numerator, fraction.denominator))


# Vectors of space, of balls or fractions.

def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def scaled(a, factor):
    return [x * factor for x in a]


def length(a):
    return dot(a, a).sqrt()


def balls(point):
    return [exact(x) for x in point]


# Elements, for unit area or gage; corners are fractions. See golden/reference/elements.py.

def rod(ends, e):
    d = minus(balls(ends[1]), balls(ends[0]))
    b = arb_mat([scaled(d, -1) + d])
    return b.transpose() * b * (e / length(d) ** 3)


def triangle(corners, e, nu):
    """Constant strain, plane stress."""
    a, b, c = map(balls, corners)
    ab, ac = minus(b, a), minus(c, a)
    x2 = length(ab)
    i = scaled(ab, 1 / x2)
    x3, normal = dot(i, ac), cross(i, ac)
    y3 = length(normal)
    j = cross(scaled(normal, 1 / y3), i)
    along = [-1 / x2, 1 / x2, arb(0)]
    across = [(x3 / x2 - 1) / y3, -x3 / (x2 * y3), 1 / y3]
    strains = arb_mat([[d * x for d in along for x in i], [d * y for d in across for y in j],
                       [dy * x + dx * y for dx, dy in zip(along, across) for x, y in zip(i, j)]])
    c = e / (1 - nu * nu)
    elastic = arb_mat([[c, nu * c, 0], [nu * c, c, 0], [0, 0, e / (2 * (1 + nu))]])
    return strains.transpose() * elastic * strains * (x2 * y3 / 2)


def membrane(corners, e, nu):
    """Four overlapping triangles of half the thickness."""
    k = arb_mat(12, 12)
    for nodes in ((0, 1, 3), (1, 2, 0), (2, 3, 1), (3, 0, 2)):
        scatter(k, [3 * node + axis for node in nodes for axis in range(3)], triangle([corners[n] for n in nodes], e, nu) * arb(0.5))
    return k


def shear_panel(corners, e, nu):
    """Garvey's: K = a aᵗ/(2Z), forces a and energy Z of a unit mean flow on side 1-2."""
    x2, (x3, y3), (x4, y4), d13, d24 = mean_plane(corners)
    tau = x4 * y3 - x3 * y4
    f1, f2 = scaled(d13, -x2 * y4 / (2 * tau)), scaled(d24, x2 * y3 / (2 * (tau - x2 * (y3 - y4))))
    a = arb_mat([f1 + f2 + scaled(f1, -1) + scaled(f2, -1)])
    return a.transpose() * a * (1 / (2 * energy(corners, e / (2 * (1 + nu)), nu)))


def mean_plane(corners):
    """Corners in the plane of both diagonals, the first at the origin, the second on the x axis; and the diagonals."""
    p = [balls(corner) for corner in corners]
    d13, d24, v12, v14 = minus(p[2], p[0]), minus(p[3], p[1]), minus(p[1], p[0]), minus(p[3], p[0])
    normal = cross(d13, d24)
    k = scaled(normal, 1 / length(normal))
    i = minus(v12, scaled(k, dot(v12, k)))
    x2 = length(i)
    i = scaled(i, 1 / x2)
    j = cross(k, i)
    return x2, (dot(i, d13), dot(j, d13)), (dot(i, v14), dot(j, v14)), d13, d24


def are_parallel(corners, side, other):
    """Whether two sides are parallel in the mean plane: decided in fractions."""
    normal = cross(minus(corners[2], corners[0]), minus(corners[3], corners[1]))
    return dot(normal, cross(minus(corners[side[1]], corners[side[0]]), minus(corners[other[1]], corners[other[0]]))) == 0


def energy(corners, g, nu):
    """Z = ∫ (p₁p₂/p²)² (1 + 2cot²φ/(1+ν))/(2G) dA in closed form; `energy_by_quadrature` is the integral itself."""
    x2, (x3, y3), (x4, y4), d13, d24 = mean_plane(corners)
    area, m = length(cross(d13, d24)) / 2, 1 / (1 + nu)
    if are_parallel(corners, (0, 3), (1, 2)):
        d = -x4 / y4
        if are_parallel(corners, (0, 1), (3, 2)):
            return area / (2 * g) * (1 + 2 * m * d * d)
        xq = x4 - y4 * (x3 - x4) / (y3 - y4)
        p = [xq, xq - x2, xq - x3 - d * y3, xq - x4 - d * y4]
        b = ((xq - x4) * d + y4) / ((xq - x4) - y4 * d)
        return p[0] * p[1] / (p[2] * p[3]) * area / (2 * g) * (1 + 2 * m * (b * b + b * d + d * d) / 3)
    assert not are_parallel(corners, (0, 1), (3, 2)), "sides 1-2 and 3-4 alone are parallel nowhere in the box"
    xq, den = x4 - (x3 - x4) / (y3 - y4) * y4, y3 * x4 - y4 * (x3 - x2)
    xp, yp = x2 * y3 * x4 / den, x2 * y3 * y4 / den
    l = ((xq - xp) ** 2 + yp**2).sqrt()
    d, r = (xq - xp) / yp, yp / l
    p = [r * xq, r * (xq - x2), r * (xq - x3 - d * y3), r * (xq - x4 - d * y4)]
    c = l / p[0] - d
    b, a = l / p[3] - c, l / p[1] - d

    def w(u, v):
        return (u + v + 2 * (u**3 + v**3) / 3 + (u**5 + v**5) / 5) * abs(u + v).log()
    f = p[0] * p[1] * p[2] * p[3] / (2 * l**2) * (
        w(a, b) + w(c, d) - w(b, c) - w(d, a) + ((a**2 - c**2) * (b**3 - d**3) + (b**2 - d**2) * (a**3 - c**3)) / 10
        - ((a - c) * (b**4 - d**4) + (b - d) * (a**4 - c**4)) / 5)
    return p[0] * p[1] / (p[2] * p[3]) / (2 * g) * (area + 4 * m * (f - 2 * area / 3))


# The torque box.

def scatter(k, dof, part):
    for a, row in enumerate(dof):
        for b, column in enumerate(dof):
            if row < k.nrows() and column < k.ncols():
                k[row, column] += part[a, b]


class Box:
    """A case's box: each panel's stiffness for unit gage, the rods', T, M and first gages."""

    def __init__(self, case):
        data = tomllib.loads((PAPER / "reconstruction.toml").read_text(), parse_float=str)
        lines = (PAPER / "tables/table_2.csv").read_text().splitlines()
        *rows, rods = csv.DictReader(line for line in lines if not line.startswith("#"))
        self.grids = {int(grid): [Fraction(x) for x in at] for grid, at in data["grids"].items()}
        self.mass = [exact(m) for m in data["masses"]]
        e, nu = exact(data["youngs_modulus"]), exact(data["poissons_ratio"])
        self.gages = [exact(row[f"gage_{case}"]) for row in rows]
        self.panels = []
        for row in rows:
            grids = [int(row[f"grid_{k}"]) for k in range(1, 5)]
            stiffness = {"S": shear_panel, "M": membrane}[row[f"type_{case}"]]([self.grids[g] for g in grids], e, nu)
            free = [(at, dof) for at, dof in enumerate(self.dof(grids)) if dof < FREE]  # the root is held
            self.panels.append(([dof for _, dof in free], arb_mat([[stiffness[a, b] for b, _ in free] for a, _ in free])))
        self.rods = arb_mat(FREE, FREE)
        for ends in self.rod_ends():
            scatter(self.rods, self.dof(ends), rod([self.grids[g] for g in ends], e) * exact(rods[f"gage_{case}"]))
        self.t = self.load_distribution(exact(data["mid_chord_fraction"]))

    @staticmethod
    def dof(grids):
        return [3 * (grid - 1) + axis for grid in grids for axis in range(3)]

    @staticmethod
    def rod_ends():
        spars = [(line + 4 * rib, line + 4 * rib + 4) for line in range(1, 5) for rib in range(3)]
        return spars + [(a + 4 * rib, b + 4 * rib) for rib in range(3) for a, b in ((1, 2), (3, 4), (1, 3), (2, 4))]

    def load_distribution(self, xi):
        """A point on a spar loads both its grids alike; a mid point loads the rib as a beam clamped to both spars."""
        t = arb_mat(FREE, DYNAMIC)
        hermite = (1 - 3 * xi**2 + 2 * xi**3, xi - 2 * xi**2 + xi**3), (3 * xi**2 - 2 * xi**3, xi**3 - xi**2)
        for rib in range(3):
            ru, rl, fu, fl = (4 * rib + k for k in range(1, 5))
            chord = balls(minus(self.grids[fu], self.grids[ru])[:2])
            for (upper, lower), own, (displacement, rotation) in zip(((ru, rl), (fu, fl)), (3 * rib, 3 * rib + 2), hermite):
                couple = rotation / exact(self.grids[upper][2] - self.grids[lower][2])
                for grid, sign in ((upper, -1), (lower, 1)):
                    t[3 * grid - 1, own], t[3 * grid - 1, 3 * rib + 1] = arb(0.5), displacement / 2
                    for axis in (0, 1):  # the rib's length and direction in one: the chord
                        t[3 * (grid - 1) + axis, 3 * rib + 1] = sign * couple * chord[axis]
        return t

    def analysis(self, gages, noise):
        """K_D and Bᵗ (A.5, A.8)."""
        stiffness = arb_mat(self.rods)
        for gage, (dof, unit) in zip(gages, self.panels):
            scatter(stiffness, dof, unit * gage)
        scale = [stiffness[i, i].sqrt() for i in range(FREE)]
        for i in range(FREE):
            for j in range(i + 1):
                stiffness[i, j] = stiffness[j, i] = stiffness[i, j] + scale[i] * scale[j] * noise.draw()
        deflections = stiffness.solve(self.t)
        dynamic = (self.t.transpose() * deflections).inv()
        return dynamic, deflections * dynamic

    def shares(self, gages, transformation, shapes):
        """Vᵗ B K_e Bᵗ V of every panel."""
        structural = transformation * shapes
        own = [arb_mat([[structural[i, j] for j in range(shapes.ncols())] for i in dof]) for dof, _ in self.panels]
        return [rows.transpose() * (unit * rows) * gage for rows, gage, (_, unit) in zip(own, gages, self.panels)]
