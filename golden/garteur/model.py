"""A beam model of the GARTEUR SM-AG19 airplane, written as matrices for the jobs in tests/jobs.

    python3 golden/garteur/model.py tests/jobs/garteur
    python3 golden/garteur/model.py tests/jobs/garteur_joints joints

Meters, newtons, kilograms. Dimensions are the published ones (golden/README.md names the sources), Young's modulus 72 GPa, Poisson's ratio
0.3 and density 2700 kg/m3 a textbook's of aluminum. The damping layer is a sheet of aluminum, 1.1 mm by 76 mm, glued to the wing stiffly.
No number of these is chosen with the measured frequencies in view. Beams of 12 DOF are held together by rigid links, which are eliminated.
With joints four of the links give way in one rotation each, against a spring. Nobody has published these springs: each begins at a power of
ten, which leaves the first model's modes in their order, and its parameter has a prior deviation of a factor of seven either way.
"""
import sys
from pathlib import Path
import numpy as np

HAS_JOINTS = sys.argv[2:] == ["joints"]
# Where the fin begins above the axis of the fuselage: at its upper face. Some sources have 50 mm.
FOOT = 0.075

E, NU, RHO = 72e9, 0.3, 2700.0
G = E / (2 * (1 + NU))


def bar(width, height, rho=RHO):
    """Area, second moments about the local y (height cubed) and z (width cubed), torsion constant, mass per length."""
    long, short = max(width, height), min(width, height)
    torsion = long * short**3 / 3 * (1 - 0.63 * short / long + 0.052 * (short / long) ** 5)
    return width * height, width * height**3 / 12, height * width**3 / 12, torsion, rho * width * height


def beam(length, area, iy, iz, torsion, mu, parts):
    """Stiffness of these parts and consistent mass in local axes, DOF u, v, w, rx, ry, rz at both ends."""
    k, m = np.zeros((12, 12)), np.zeros((12, 12))
    pair = np.array([[1, -1], [-1, 1]])
    two = np.array([[2, 1], [1, 2]]) / 6
    polar = mu / area * (iy + iz)
    for dof, stiffness, mass, name in [(0, E * area, mu, "axial"), (3, G * torsion, polar, "torsion")]:
        at = np.ix_([dof, dof + 6], [dof, dof + 6])
        k[at] += stiffness / length * pair * (name in parts)
        m[at] += mass * length * two
    h = length
    bend = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                     [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]) / h**3
    inertia = np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                        [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]]) * mu * h / 420
    for dofs, turn, moment, name in [((1, 5, 7, 11), 1, iz, "z"), ((2, 4, 8, 10), -1, iy, "y")]:
        sign = np.diag([1, turn, 1, turn])
        at = np.ix_(dofs, dofs)
        k[at] += E * moment * sign @ bend @ sign * (name in parts)
        m[at] += sign @ inertia @ sign
    return k, m


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


grids, links = [], {}  # places; dependent grid -> independent one
joints = {}  # (dependent grid, axis of its rotation relative to the independent one) -> (parameter, N m/rad)


def line(*places):
    grids.extend(np.array(place, float) for place in places)
    return list(range(len(grids) - len(places), len(grids)))


elements = []  # (ends, up, section, {parameter: parts}), local x along the bar, z near `up`


def chain(nodes, up, section, parameters):
    elements.extend((pair, up, section, parameters) for pair in zip(nodes, nodes[1:]))


# The fuselage, 150 mm high and 50 mm wide, and the wing 96 mm above its axis.
fuselage_x = [0.6, 0.45, 0.3, 0.15, 0.05, 0.0, -0.05, -0.2, -0.35, -0.5, -0.65, -0.75, -0.85, -0.9]
fuselage = line(*[(x, 0, 0) for x in fuselage_x])
all_parts = ("axial", "torsion", "y", "z")
chain(fuselage, (0, 0, 1), bar(0.05, 0.15), {"fuselage": all_parts})
half = [0.035, 0.15, 0.27, 0.39, 0.51, 0.63, 0.75, 0.85, 0.95, 1.0]
wing = line(*[(0, y, 0.096) for y in [-y for y in half[::-1]] + [0.0] + half])
bending = {"wing bending": ("y", "axial"), "wing in its plane": ("z",)} if HAS_JOINTS else {"wing bending": ("y", "z", "axial")}
chain(wing, (0, 0, 1), bar(0.1, 0.01), {**bending, "wing torsion": ("torsion",)})
# The layer: its sheet at a distance of half the thicknesses from the wing's middle plane, on all but the tips.
sheet = bar(0.076, 0.0011)
layer = (sheet[0], sheet[1] + sheet[0] * (0.005 + 0.0011 / 2) ** 2, *sheet[2:])
chain(wing[1:-1], (0, 0, 1), layer, {"damping layer": ("y", "z", "axial")})
# The drums at the tips and their masses of 0.2 kg.
masses = []
for y in (-0.95, 0.95):
    drum = line(*[(x, y, 0.106) for x in (-0.2, -0.1, 0.0, 0.1, 0.2)])
    links[drum[2]] = wing[1 if y < 0 else -2]
    chain(drum, (0, 0, 1), bar(0.1, 0.01), {"drums": all_parts})
    (point,) = line((0.18, np.sign(y) * 0.93, 0.111))
    links[point] = drum[4]
    masses.append(point)
# Fin and tailplane.
fin = line(*[(-0.85, 0, z) for z in (FOOT, 0.15, 0.225, 0.3, 0.35)])
chain(fin, (1, 0, 0), bar(0.01, 0.1), {"fin": all_parts})
plane = line(*[(-0.85, y, 0.355) for y in (-0.2, -0.1, 0.0, 0.1, 0.2)])
chain(plane, (0, 0, 1), bar(0.1, 0.01), {"tailplane": all_parts})
links[plane[2]] = fin[-1]
links[fin[0]] = fuselage[fuselage_x.index(-0.85)]
# The joint of wing and fuselage: a steel plate, 130 mm by 70 mm and 16 mm high, as a beam along z.
foot, head = line((0, 0, 0.075), (0, 0, 0.091))
links[foot], links[wing[len(half)]] = fuselage[fuselage_x.index(0.0)], head
steel = [210e9 / E * part for part in bar(0.07, 0.13)[:4]]
plate = (*steel, 7850 * 0.07 * 0.13)
chain([foot, head], (1, 0, 0), plate, {"joint": all_parts})

if HAS_JOINTS:
    middle = wing[len(half)]
    joints = {(middle, 0): ("wing root roll", 1e4), (middle, 2): ("wing root yaw", 1e6),
              (fin[0], 0): ("fin root roll", 1e4), (plane[2], 0): ("tail roll", 1e4)}

independent = [g for g in range(len(grids)) if g not in links]
place = {g: 6 * n for n, g in enumerate(independent)}
turns = {joint: 6 * len(independent) + place for place, joint in enumerate(joints)}
n = 6 * len(independent) + len(turns)


def follow(g):
    """The six motions of a grid from those of the independent one and of the joints on the way (6 × n)."""
    base, reading = g, np.zeros((6, n))
    while True:
        for (grid, axis), column in turns.items():
            if grid == base:
                reading[:, column] = np.concatenate([np.cross(np.eye(3)[axis], grids[g] - grids[base]), np.eye(3)[axis]])
        if base not in links:
            break
        base = links[base]
    reading[:, place[base]:place[base] + 6] = np.eye(6)
    reading[:3, place[base] + 3:place[base] + 6] = -skew(grids[g] - grids[base])
    return reading


stiffness, mass, parts = np.zeros((n, n)), np.zeros((n, n)), {"drums mass": np.zeros((n, n))}
for ends, up, section, parameters in elements:
    a, b = (grids[end] for end in ends)
    x = (b - a) / np.linalg.norm(b - a)
    y = np.cross(up, x) / np.linalg.norm(np.cross(up, x))
    turn = np.kron(np.eye(4), np.array([x, y, np.cross(x, y)])) @ np.vstack([follow(end) for end in ends])
    inertia = turn.T @ beam(np.linalg.norm(b - a), *section, ())[1] @ turn
    mass += inertia
    if "drums" in parameters:
        parts["drums mass"] += inertia
    for name, which in parameters.items():
        part = turn.T @ beam(np.linalg.norm(b - a), *section, which)[0] @ turn
        stiffness += part
        parts[name] = parts.get(name, 0) + part
for joint, (name, spring) in joints.items():
    parts[name] = np.zeros((n, n))
    parts[name][turns[joint], turns[joint]] = spring
    stiffness += parts[name]
tips = sum(0.2 * follow(point)[:3].T @ follow(point)[:3] for point in masses)
mass, parts["drums mass"] = mass + tips, parts["drums mass"] + tips


def write(path, matrix):
    least = 1e-15 * abs(matrix).max()
    rows = [f"{i + 1} {j + 1} {float(matrix[i, j])!r}" for j in range(n) for i in range(j, n) if abs(matrix[i, j]) > least]
    path.write_text(f"%%MatrixMarket matrix coordinate real symmetric\n{n} {n} {len(rows)}\n" + "\n".join(rows) + "\n")


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    del parts["drums"]
    for name, matrix in {"stiffness": stiffness, "mass": mass, **parts}.items():
        write(folder / (name.replace(" ", "_") + ".mtx"), (matrix + matrix.T) / 2)
    directions = ("x", "y", "z", "rx", "ry", "rz")
    table = [f"{g + 1},{d},{','.join(f'{v:g}' for v in grids[g])}\n" for g in independent for d in directions]
    table += [f"{g + 1},{directions[3 + axis]},{','.join(f'{v:g}' for v in grids[g])}\n" for g, axis in turns]
    (folder / "rows.csv").write_text("grid,direction,x,y,z\n" + "".join(table))
