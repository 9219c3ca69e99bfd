#!/usr/bin/env python3
"""Makes the stored NASTRAN-95 answers of this folder: elements.toml, boxes.toml and decks/.

    python3 generate.py [--box FILE]

It writes a deck, runs it with NASTRAN-95, reads the matrices that the run wrote with its module OUTPUT5 and
stores them. It needs Python 3.11, numpy and the program; the crate's tests need none of them.

The environment variable NASTRAN95 names the program's data folder, the one that holds `bin/nastrn` and
`rf/` (the rigid formats). Without it `.cache/nastran95/nastran95/_data` in the home folder is tried,
which is where the wheel `nastran95` 0.3 ends up when it is unzipped in `.cache/nastran95`.

--box names the file with the reconstructed torque box (keys youngs_modulus, poissons_ratio and a table
`grids`); without it `paper/reconstruction.toml` of this project is read. See README.md for the rest.
"""

import argparse
import math
import os
import pathlib
import re
import subprocess
import tempfile
import tomllib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
DECKS = HERE / "decks"
PROGRAM = "NASTRAN-95 (the 1995 COSMIC release opened by NASA), PyPI wheel nastran95 0.3"
TIME_LIMIT = 120  # seconds for one run; a run takes about one

# ---------------------------------------------------------------------------------------------------------
# Single elements. Every coordinate, area and thickness is a short binary fraction, so that neither the
# 8-character field nor single precision changes it.

E = 1.0e7
PLANE = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
TILTED = 0.25 * np.array([[2.0, 1.0, -2.0], [1.0, 2.0, 2.0]])  # orthogonal and equally long: shapes stay similar
ORIGIN = np.zeros(3)
AWAY = np.array([5.5, -3.25, 2.0])


def place(corners, axes=PLANE, origin=ORIGIN):
    """Plane corners (x, y) put into space."""
    return (origin + np.array(corners, float) @ axes).tolist()


def turned(grids, start, backwards=False):
    """The same panel numbered from another corner, or round the other way."""
    grids = grids[start:] + grids[:start]
    return grids[:1] + grids[:0:-1] if backwards else grids


RECTANGLE = [(0, 0), (4, 0), (4, 3), (0, 3)]
PARALLELOGRAM = [(0, 0), (5, 0), (6.5, 3), (1.5, 3)]
TRAPEZOID_12_34 = [(0, 0), (6, 0), (4.5, 4), (1, 4)]
TRAPEZOID_14_23 = [(0, 0), (5, 1), (5, 3.5), (0, 5)]
GENERAL = [(0, 0), (6, 0.5), (5, 4.75), (-1, 3)]
SLENDER = [(0, 0), (20, 0), (20, 1), (0, 1)]
SLENDER_TAPER = [(0, 0), (20, 0.25), (20.25, 1), (-0.125, 1.5)]
# Sides 12 and 34 differ by 0.4 degrees, inside the band in which SHEAR takes them for parallel.
NEARLY_PARALLEL = [(0, 0), (6, 0), (5, 3.96875), (0.5, 4)]
WARPED_MILDLY = [[0, 0, 0], [6, 0.5, 0.125], [5, 4.75, -0.125], [-1, 3, 0.1875]]
WARPED_STRONGLY = [[0, 0, 0], [6, 0.5, 1.5], [5, 4.75, -1.25], [-1, 3, 2]]


def quadrilaterals():
    return [
        ("rectangle", place(RECTANGLE), 0.25, "in the xy-plane"),
        ("rectangle_from_3", turned(place(RECTANGLE), 2), 0.25, "the same, numbered from the third corner"),
        ("rectangle_backwards", turned(place(RECTANGLE), 1, True), 0.3, "numbered from the second corner the other way round"),
        ("rectangle_tilted", place(RECTANGLE, TILTED, AWAY), 0.3, "in space"),
        ("parallelogram", place(PARALLELOGRAM), 0.25, "in the xy-plane"),
        ("parallelogram_tilted", place(PARALLELOGRAM, TILTED, AWAY), 0.3, "in space"),
        ("trapezoid_12_34", place(TRAPEZOID_12_34), 0.25, "side 12 parallel to 34"),
        ("trapezoid_14_23", place(TRAPEZOID_14_23), 0.3, "side 14 parallel to 23"),
        ("trapezoid_tilted", place(TRAPEZOID_12_34, TILTED, AWAY), 0.3, "side 12 parallel to 34, in space"),
        ("general", place(GENERAL), 0.25, "no two sides parallel"),
        ("general_from_2", turned(place(GENERAL), 1), 0.25, "the same, numbered from the second corner"),
        ("general_tilted", place(GENERAL, TILTED, AWAY), 0.3, "in space"),
        ("warped_mildly", WARPED_MILDLY, 0.3, "corners about 0.1 out of plane in a size of 6"),
        ("warped_strongly", WARPED_STRONGLY, 0.25, "corners more than 1 out of plane in a size of 6"),
        ("slender", place(SLENDER, TILTED, AWAY), 0.25, "rectangle of aspect ratio 20, in space"),
        ("slender_taper", turned(place(SLENDER_TAPER), 2), 0.3, "aspect ratio about 20, no two sides parallel, numbered from the third corner"),
    ]


# Where NASTRAN's own closed form of the shear panel loses more digits than single precision does.
LOOSE = {"shear_slender_taper_from_1": 1e-6}


def elements():
    """All single elements: (name, kind, grids, Poisson's ratio, thickness or area, note)."""
    out = [
        ("rod_x", "rod", [[0, 0, 0], [4, 0, 0]], 0.25, 0.5, "along x"),
        ("rod_minus_y", "rod", [[1, 2.5, -1], [1, -2.5, -1]], 0.3, 0.25, "along -y"),
        ("rod_z", "rod", [[1, 1, 0.5], [1, 1, 3]], 0.25, 0.125, "along z"),
        ("rod_plane", "rod", [[0, 0, 1], [3, 4, 1]], 0.3, 0.5, "in the xy-plane"),
        ("rod_space", "rod", [[1.25, -0.5, 2.75], [-3.5, 4.125, 0.375]], 0.25, 0.03125, "in space"),
    ]
    for n, (name, grids, nu, note) in enumerate(quadrilaterals()):
        out.append(("shear_" + name, "shear", grids, nu, (0.0625, 0.125)[n % 2], note))
    snapped = place(NEARLY_PARALLEL)
    out.append(("shear_nearly_parallel", "shear", snapped, 0.25, 0.0625, "sides 12 and 34 0.4 degrees apart: taken for parallel"))
    out.append(("shear_nearly_parallel_from_2", "shear", turned(snapped, 1), 0.25, 0.0625, "the same, numbered from the second corner"))
    out.append(("shear_slender_taper_from_1", "shear", place(SLENDER_TAPER), 0.3, 0.125, "the slender taper from its first corner: NASTRAN loses digits"))
    for n, (name, grids, nu, note) in enumerate(quadrilaterals()):
        out.append(("membrane_" + name, "membrane", grids, nu, (0.0625, 0.125)[n % 2], note))
    acute, obtuse = [(0, 0), (4, 0), (1.5, 3)], [(0, 0), (4, 0), (-2.5, 1.75)]
    out += [
        ("triangle", "triangle", place(acute), 0.25, 0.0625, "in the xy-plane"),
        ("triangle_right", "triangle", [[0, 0, 0], [0, 3, 0], [0, 0, 2]], 0.3, 0.125, "right angle, in the yz-plane"),
        ("triangle_tilted", "triangle", place(acute, TILTED, AWAY), 0.3, 0.0625, "in space"),
        ("triangle_obtuse", "triangle", place(obtuse), 0.25, 0.125, "angles of 145, 15 and 20 degrees"),
        ("triangle_obtuse_tilted", "triangle", place(obtuse, TILTED, AWAY), 0.3, 0.125, "the same in space"),
    ]
    return out


# ---------------------------------------------------------------------------------------------------------
# Torque boxes: 16 grids, 15 panels, 24 rods. Grids 13 to 16 are fixed, odd grids are the upper surface.

PANELS = {
    1: (14, 10, 9, 13), 2: (10, 12, 16, 14), 3: (16, 12, 11, 15), 4: (1, 3, 7, 5), 5: (10, 6, 5, 9),
    6: (12, 8, 7, 11), 7: (2, 4, 3, 1), 8: (2, 4, 8, 6), 9: (5, 7, 11, 9), 10: (6, 2, 1, 5),
    11: (6, 8, 12, 10), 12: (6, 8, 7, 5), 13: (10, 12, 11, 9), 14: (8, 4, 3, 7), 15: (9, 11, 15, 13),
}
COVERS = (2, 4, 8, 9, 11, 15)
RODS = [  # twelve spar caps; then for tip, outboard and inboard rib two posts and two rib caps
    (1, 5), (5, 9), (9, 13), (2, 6), (6, 10), (10, 14), (3, 7), (7, 11), (11, 15), (4, 8), (8, 12), (12, 16),
    (1, 2), (3, 4), (1, 3), (2, 4), (5, 6), (7, 8), (5, 7), (6, 8), (9, 10), (11, 12), (9, 11), (10, 12),
]
MASS = 0.005  # lbf s2/in on z of each of grids 1 to 12

SWEPT = [
    [29.546875, 46.109375, 2.59375], [29.546875, 45.953125, 1.765625], [22.640625, 42.984375, 3.28125], [22.390625, 43.0625, 2.671875],
    [23.0, 33.0625, 2.140625], [22.9375, 32.90625, 0.859375], [13.984375, 29.9375, 2.765625], [13.921875, 30.0, 1.734375],
    [15.390625, 17.046875, 1.5625], [15.15625, 16.921875, -0.234375], [3.78125, 14.90625, 1.828125], [3.796875, 15.03125, 0.296875],
    [6.890625, 0.0, 1.234375], [6.890625, 0.0, -1.171875], [-6.984375, 0.0, 1.1875], [-7.0, 0.0, -1.046875],
]
FORWARD = [
    [-10.1875, 51.921875, -0.453125], [-10.140625, 52.046875, -1.28125], [-18.140625, 53.828125, -1.765625], [-17.78125, 54.03125, -2.90625],
    [-4.375, 36.0625, 0.140625], [-4.15625, 36.1875, -1.0], [-14.859375, 38.875, -0.765625], [-14.625, 39.15625, -2.28125],
    [2.375, 17.171875, 0.96875], [2.609375, 16.84375, -1.28125], [-10.671875, 19.15625, 0.59375], [-10.3125, 19.0625, -1.8125],
    [8.5, 0.0, 1.84375], [8.46875, 0.0, -1.453125], [-8.375, 0.0, 1.578125], [-8.5625, 0.0, -1.40625],
]
STUB = [
    [18.3125, 24.8125, 1.140625], [18.328125, 24.71875, -0.671875], [7.890625, 20.765625, 3.671875], [7.1875, 20.921875, 1.375],
    [15.578125, 17.0625, 1.265625], [15.65625, 16.84375, -1.1875], [2.875, 14.859375, 2.484375], [2.734375, 14.859375, 0.015625],
    [12.34375, 8.5625, 1.453125], [12.109375, 8.171875, -1.46875], [-3.96875, 6.71875, 2.828125], [-3.78125, 6.796875, -1.09375],
    [9.28125, 0.0, 2.484375], [9.359375, 0.0, -1.5625], [-9.453125, 0.0, 2.109375], [-9.21875, 0.0, -3.109375],
]
# Eigenvalues of the box of round numbers that another installation of the same program printed; NASTRAN's own
# eigenvalues are good to about six digits.
ROUND_EIGENVALUES = [6.805324e3, 1.323392e5, 1.956462e5, 6.637611e5, 1.350153e6, 1.873818e6]


def round_numbers():
    """Ribs every 20 in, chord 20 in to 12 in, depth 4 in to 2 in, symmetric about mid-chord and mid-depth."""
    grids = []
    for y in (60.0, 40.0, 20.0, 0.0):
        x, z = (20 - 8 * y / 60) / 2, (4 - 2 * y / 60) / 2
        grids += [[x, y, z], [x, y, -z], [-x, y, z], [-x, y, -z]]
    return [[float("%.9g" % v) for v in grid] for grid in grids]


def boxes(reconstruction):
    """All boxes: dictionaries with the keys named below, and with the panels that snap and those left out."""
    paper = [[float(v) for v in reconstruction["grids"][str(k)]] for k in range(1, 17)]
    e, nu = float(reconstruction["youngs_modulus"]), float(reconstruction["poissons_ratio"])
    unlike = [(0.010, 0.012, 0.009, 0.015, 0.011, 0.008, 0.013)[k % 7] for k in range(15)]
    rows = [
        ("case 1 gvt", "reconstructed box, case 1 ground vibration test", e, nu, (), [0.010] * 15, 0.20, paper),
        ("case 2 gvt", "reconstructed box, ground vibration test of cases 2 to 4", e, nu, COVERS, [0.010] * 15, 0.01, paper),
        ("case 1 initial", "reconstructed box", e, nu, (), [0.015] * 15, 0.20, paper),
        ("case 2 initial", "reconstructed box", e, nu, COVERS, [0.015] * 15, 0.01, paper),
        ("case 3 initial", "reconstructed box", e, nu, COVERS, ([0.013, 0.007] * 8)[:15], 0.01, paper),
        ("case 4 initial", "reconstructed box", e, nu, COVERS, [0.0001 if k == 8 else 0.010 for k in range(1, 16)], 0.01, paper),
        ("round", "box of round numbers, to see that a run is sane", E, 0.3, COVERS, [0.010] * 15, 0.01, round_numbers()),
        ("swept", "swept back, twisted, covers warped, top and bottom unlike", E, 0.25, COVERS, unlike, 0.015625, SWEPT),
        ("forward", "swept forward, anhedral, twisted, every panel a shear panel", E, 0.3, (), unlike[::-1], 0.125, FORWARD),
        ("stub", "short and deep, strongly twisted and warped, ribs of membranes too", E, 0.3125, COVERS + (7, 12, 13), unlike, 0.03125, STUB),
    ]
    keys = ("name", "note", "youngs_modulus", "poissons_ratio", "membranes", "gages", "rod_area", "grids")
    found = []
    for box in (dict(zip(keys, row)) for row in rows):
        box["omitted"] = []
        box["snapped"] = [n for n, grids in PANELS.items() if n not in box["membranes"] and snaps([box["grids"][g - 1] for g in grids])]
        found.append(box)
        if box["snapped"]:  # once more without these panels: nothing in that stiffness is an exception
            found.append(box | {"name": box["name"] + " unsnapped", "note": box["note"] + ", without its snapped panels",
                                "omitted": box["snapped"], "snapped": []})
    return found


# ---------------------------------------------------------------------------------------------------------
# Decks

ELEMENT_CARDS = {"rod": ("CROD", "PROD"), "shear": ("CSHEAR", "PSHEAR"), "membrane": ("CQDMEM", "PQDMEM"), "triangle": ("CTRMEM", "PTRMEM")}


def number(value, width):
    """A NASTRAN real with its decimal point, in at most `width` characters, that reads back as exactly `value`."""
    text = re.sub(r"^(-?)0\.(?=\d)", r"\1.", np.format_float_positional(value, trim="."))
    if len(text) > width:
        mantissa, exponent = np.format_float_scientific(value, trim=".").split("e")
        text = f"{mantissa}{int(exponent):+d}"
    if len(text) > width:
        raise ValueError(f"{value!r} does not fit a field of {width} characters")
    return text


def card(*fields):
    """One card of 8-character fields."""
    text = [number(v, 8) if isinstance(v, float) else str(v) for v in fields]
    assert all(len(v) <= 8 for v in text), text
    return "".join(f"{v:8}" for v in text).rstrip()


def wide_grid(grid, point):
    """A GRID card with 16-character fields, which takes two lines."""
    x, y, z = (number(float(v), 16) for v in point)
    tag = f"*G{grid}"
    return [f"{'GRID*':8}{grid:<16}{'':16}{x:16}{y:16}{tag:8}".rstrip(), f"{tag:8}{z}"]


def deck(title, solution, alters, case_control, bulk):
    """A whole deck. What must not be left out: BANDIT=-1 keeps the grids in the order of their numbers,
    DIAG 44 takes the decomposition that gives right answers, each OUTPUT5 call has a Fortran unit of its own."""
    head = ["NASTRAN BANDIT=-1", "ID      CORFEM,GOLDEN", "APP     DISPLACEMENT", f"SOL     {solution},0", "TIME    5", "DIAG    44"]
    return "\n".join(head + alters + ["ENDALTER", "CEND", f"TITLE = {title.upper()}"] + case_control + ["BEGIN BULK"] + bulk + ["ENDDATA"]) + "\n"


def element_deck(kind, members):
    """Every element of one kind side by side, none joined to another; the run ends when KGG is written.
    Element number n has the grids 10n+1, 10n+2 and so on, and property and material n."""
    connection, prop = ELEMENT_CARDS[kind]
    bulk = []
    for n, (name, _, grids, nu, size, _) in enumerate(members, 1):
        bulk.append(f"$ {name}")
        bulk += [card("GRID", 10 * n + k, "", *map(float, point)) for k, point in enumerate(grids, 1)]
        bulk.append(card(connection, n, n, *(10 * n + k for k in range(1, len(grids) + 1))))
        bulk.append(card(prop, n, n, float(size)))
        bulk.append(card("MAT1", n, E, "", nu))
    alters = ["INSERT GP4 $", "OUTPUT5 KGG,,,,//-1/15/*CORFEM*/1 $", "EXIT $"]
    return deck(f"single elements, {kind}", 1, alters, [], bulk)


def box_deck(box, eigenvalues):
    """A torque box; the run ends when KAA and MAA are written, or goes on to NASTRAN's own eigenvalues."""
    bulk = [line for k, point in enumerate(box["grids"], 1) for line in wide_grid(k, point)]
    for element, grids in PANELS.items():
        if element in box["omitted"]:
            continue
        connection, prop = ELEMENT_CARDS["membrane" if element in box["membranes"] else "shear"]
        bulk.append(card(connection, element, element, *grids))
        bulk.append(card(prop, element, 1, box["gages"][element - 1]))
    bulk += [card("CROD", 100 + n, 100, *ends) for n, ends in enumerate(RODS, 1)]
    bulk.append(card("PROD", 100, 1, box["rod_area"]))
    bulk.append(card("MAT1", 1, box["youngs_modulus"], "", box["poissons_ratio"]))
    bulk += [card("CMASS2", 200 + n, MASS, n, 3) for n in range(1, 13)]
    bulk.append(card("SPC1", 1, "123456", 13, "THRU", 16))
    bulk.append(card("SPC1", 1, "456", 1, "THRU", 12))
    alters, control = ["INSERT READ,-1 $", "OUTPUT5 KAA,MAA,,,//-1/16/*CORFEM*/1 $"], ["SPC = 1", "METHOD = 1"]
    bulk += [card("EIGR", 1, "INV", 5.0, 250.0, 6, 6, "", "", "+E"), card("+E", "MASS")]  # asked for even if not used
    if not eigenvalues:
        alters.append("EXIT $")
    return deck(f"torque box, {box['name']}", 3, alters, control, bulk)


# ---------------------------------------------------------------------------------------------------------
# Running the program

def data_folder():
    chosen = os.environ.get("NASTRAN95")
    folder = pathlib.Path(chosen) if chosen else pathlib.Path.home() / ".cache" / "nastran95" / "nastran95" / "_data"
    if not (folder / "bin" / "nastrn").is_file() or not (folder / "rf").is_dir():
        raise SystemExit(f"NASTRAN-95 is not in {folder}: set NASTRAN95 to the folder with bin/nastrn and rf/ (see README.md)")
    return folder.resolve()


def run(text, unit):
    """Runs a deck in a temporary folder. Returns the printed output and the matrices written on `unit`."""
    home = data_folder()
    with tempfile.TemporaryDirectory() as scratch:
        files = {f"FTN{n}": f"{scratch}/ftn{n}" for n in range(11, 24)}
        files |= {f"SOF{n}": "none" for n in range(1, 11)}
        files |= {"LOGNM": f"{scratch}/log", "NPTPNM": f"{scratch}/nptp", "DICTNM": f"{scratch}/dict", "PLTNM": f"{scratch}/plt",
                  "PUNCHNM": f"{scratch}/punch", "OPTPNM": "none", "DIRCTY": scratch, "RFDIR": str(home / "rf"),
                  "DBMEM": "12000000", "OCMEM": "2000000"}
        try:
            done = subprocess.run([home / "bin" / "nastrn"], input=text.encode(), cwd=scratch, env=os.environ | files,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=TIME_LIMIT)
        except subprocess.TimeoutExpired:
            raise SystemExit(f"NASTRAN-95 did not end within {TIME_LIMIT} s") from None
        printed = done.stdout.decode("ascii", "replace")
        written = pathlib.Path(files[f"FTN{unit}"])
        if done.returncode or "FATAL" in printed or not written.is_file():
            fatal = [line.strip() for line in printed.splitlines() if "FATAL" in line]
            raise SystemExit(f"NASTRAN-95 failed (exit {done.returncode}): {fatal or printed[-2000:]}")
        return printed, read_output5(written.read_text("latin-1"))


def real(field):
    """Fortran D26.17; an exponent of three digits drops the letter."""
    return float(re.sub(r"(\d)([+-]\d+)$", r"\1E\2", field.strip().replace("D", "E")))


def read_output5(text):
    """The formatted file of module OUTPUT5: per matrix a header, then every column from its first to its last entry."""
    lines = iter(text.splitlines()[1:])
    matrices, current = {}, None
    for line in lines:
        column, first, last = (int(line[k:k + 8]) for k in (0, 8, 16))
        if column == 0:
            header = next(lines)
            columns, rows, _, kind = (int(header[26 + k:34 + k]) for k in (0, 8, 16, 24))
            if kind != 2:
                raise SystemExit(f"matrix {header[74:].strip()} is not real double precision")
            current = matrices[header[74:82].strip()] = np.zeros((rows, columns))
            continue
        values = []
        while len(values) < last - first + 1:
            record = next(lines)
            values += [real(record[k:k + 26]) for k in range(0, len(record.rstrip()), 26)]
        current[first - 1:last, column - 1] = values
    return matrices


def printed_eigenvalues(printed):
    """The EIGENVALUE column of the printed table REAL EIGENVALUES."""
    table = printed[printed.index("R E A L   E I G E N V A L U E S"):]
    rows = re.findall(r"^\s+\d+\s+\d+\s+(-?\d\.\d{6}E[+-]\d\d)(?:\s+\S+){4}\s*$", table, re.M)
    return [float(v) for v in rows]


# ---------------------------------------------------------------------------------------------------------
# What is computed here

def snaps(panel):
    """Whether NASTRAN's SHEAR treats sides as parallel that are not.

    It compares the tangent of the angle between two opposite sides, in the mean plane, with 0.01. Sides that are
    parallel to rounding are no exception, so the band begins at 1e-6 here.
    """
    p = np.array(panel, float)
    normal = np.cross(p[2] - p[0], p[3] - p[1])
    normal /= math.sqrt(normal @ normal)
    found = False
    for a, b in ((p[1] - p[0], p[2] - p[3]), (p[3] - p[0], p[2] - p[1])):
        a, b = a - (a @ normal) * normal, b - (b @ normal) * normal
        tangent = abs(normal @ np.cross(a, b) / (a @ b))
        found |= 1e-6 < tangent < 0.01
    return found


def condensed_eigenvalues(kaa, maa):
    """Eigenvalues of (KAA, MAA) with the DOF without mass condensed out, ascending."""
    mass = np.diag(maa)
    assert np.all(maa == np.diag(mass))
    keep, drop = np.flatnonzero(mass > 0), np.flatnonzero(mass == 0)
    k = kaa[np.ix_(keep, keep)] - kaa[np.ix_(keep, drop)] @ np.linalg.solve(kaa[np.ix_(drop, drop)], kaa[np.ix_(drop, keep)])
    scale = 1 / np.sqrt(mass[keep])
    return np.linalg.eigvalsh(0.5 * (k + k.T) * np.outer(scale, scale))


# ---------------------------------------------------------------------------------------------------------
# TOML

def plain(values):
    """A list of input numbers, shortest form that reads back exactly."""
    return "[" + ", ".join(repr(float(v)) for v in values) + "]"


def entries(values):
    return "[" + ", ".join("%.9e" % v if v else "0.0" for v in values) + "]"


def exact(values):
    return "[" + ", ".join(repr(float(v)) if v else "0.0" for v in values) + "]"


def nested(key, rows, form):
    return [f"{key} = ["] + [f"  {form(row)}," for row in rows] + ["]"]


def write_elements():
    lines = [
        f"# Stiffness of single elements, computed by {PROGRAM}.",
        "# Written by generate.py; see README.md. inch, lbf. DOF order: x, y, z of the first grid, of the second, ...",
        "",
        f'program = "{PROGRAM}"',
    ]
    everything = elements()
    for kind in ELEMENT_CARDS:
        members = [element for element in everything if element[1] == kind]
        text = element_deck(kind, members)
        (DECKS / f"elements_{kind}.inp").write_text(text)
        kgg = run(text, 15)[1]["KGG"]
        at = 0
        for name, _, grids, nu, size, note in members:
            own = np.array([at + 6 * k + axis for k in range(len(grids)) for axis in range(3)])
            at += 6 * len(grids)
            stiffness = kgg[np.ix_(own, own)]
            rest = kgg[own].copy()
            rest[:, own] = 0.0
            assert not rest.any(), f"{name} is joined to something else"
            snap = kind == "shear" and snaps(grids)
            assert np.array_equal(np.float32(grids), np.array(grids, float)), f"{name} is not exact in single precision"
            lines += ["", "[[element]]", f'name = "{name}"', f'kind = "{kind}"', f'note = "{note}"']
            lines += ["snap = true"] if snap else []
            lines += [f"tolerance = {LOOSE[name]!r}"] if name in LOOSE else []
            lines += [f"youngs_modulus = {E!r}", f"poissons_ratio = {nu!r}", f"{'area' if kind == 'rod' else 'thickness'} = {size!r}"]
            lines += nested("grids", grids, plain) + nested("stiffness", stiffness, entries)
        assert at == len(kgg)
        print(f"{len(members):3d} of kind {kind}")
    (HERE / "elements.toml").write_text("\n".join(lines) + "\n")


def write_boxes(reconstruction):
    lines = [
        f"# Torque boxes: the stiffness KAA of grids 1 to 12, computed by {PROGRAM}.",
        "# Written by generate.py; see README.md. inch, lbf, s. DOF order: x, y, z of grid 1, of grid 2, ..., of grid 12.",
        "",
        f'program = "{PROGRAM}"',
        "fixed_grids = [13, 14, 15, 16]",
        f"mass = {MASS!r}  # on z of each of grids 1 to 12, lbf s2/in",
    ]
    lines += nested("panels", PANELS.values(), lambda grids: str(list(grids)))
    lines += nested("rods", RODS, lambda ends: str(list(ends)))
    for box in boxes(reconstruction):
        known = box["name"] == "round"
        text = box_deck(box, known)
        (DECKS / f"box_{box['name'].replace(' ', '_')}.inp").write_text(text)
        printed, matrices = run(text, 16)
        kaa, maa = matrices["KAA"], matrices["MAA"]
        assert kaa.shape == maa.shape == (36, 36)
        assert np.allclose(np.diag(maa), [0, 0, MASS] * 12, rtol=1e-7)
        assert np.abs(kaa - kaa.T).max() <= 1e-9 * np.abs(kaa).max(), "KAA is not symmetric"
        roots = None if box["omitted"] else condensed_eigenvalues(kaa, maa)  # without some panels it may be a mechanism
        lines += ["", "[[box]]", f'name = "{box["name"]}"', f'note = "{box["note"]}"']
        lines += [f"youngs_modulus = {box['youngs_modulus']!r}", f"poissons_ratio = {box['poissons_ratio']!r}", f"rod_area = {box['rod_area']!r}"]
        lines += [f"membranes = {sorted(box['membranes'])}", f"omitted = {box['omitted']}", f"snapped = {box['snapped']}", f"gages = {plain(box['gages'])}"]
        lines += nested("grids", box["grids"], plain)
        lines += [] if roots is None else [f"eigenvalues = {exact(roots)}"]
        if known:
            own = printed_eigenvalues(printed)
            assert np.allclose(roots[:6], ROUND_EIGENVALUES, rtol=5e-6), f"{roots[:6]} are not {ROUND_EIGENVALUES}"
            lines += [f"known_eigenvalues = {plain(ROUND_EIGENVALUES)}", f"printed_eigenvalues = {plain(own)}"]
        lines += nested("kaa_lower", [kaa[k, :k + 1] for k in range(36)], exact)
        print(f"box {box['name']}: omitted {box['omitted']}, snapped {box['snapped']}, {'' if roots is None else 'lowest eigenvalue %.6e' % roots[0]}")
    (HERE / "boxes.toml").write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description="Makes the stored NASTRAN-95 answers.")
    parser.add_argument("--box", type=pathlib.Path, default=HERE.parent.parent / "paper" / "reconstruction.toml",
                        help="file with the reconstructed torque box (default: paper/reconstruction.toml)")
    options = parser.parse_args()
    if not options.box.is_file():
        raise SystemExit(f"{options.box} is not there: name the reconstructed box with --box")
    DECKS.mkdir(exist_ok=True)
    write_elements()
    write_boxes(tomllib.loads(options.box.read_text()))


if __name__ == "__main__":
    main()
