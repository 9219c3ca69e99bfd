#!/usr/bin/env python3
"""Lets pyNastran, a reader that shares nothing with this project, read the decks that `corfem deck` writes.

    pip install pyNastran            # 1.4.1 was used; neither the crate nor its tests need it
    python3 golden/nastran95/read_with_pynastran.py [DECK ...]

Without arguments it has the program write the decks of all cases and passes (with cargo) and reads them. It fails if
pyNastran warns, leaves a card out, cannot resolve a reference, or reads other things than the crate meant.

One exception: pyNastran knows the names CQDMEM and PQDMEM but has no objects for them, as later NASTRANs dropped
them. It keeps their text, and this script splits the text itself.
"""

import pathlib
import subprocess
import sys
import tempfile

from cpylog import SimpleLogger
from pyNastran.bdf.bdf import BDF

PROJECT = pathlib.Path(__file__).resolve().parents[2]
PASSES = {1: 2, 2: 2, 3: 3, 4: 1}
EVERY_BOX = {"GRID": 25, "CROD": 24, "PROD": 24, "MAT1": 1, "CMASS2": 9, "MPC": 9, "SPC1": 3, "EIGR": 1}
KEPT_AS_TEXT = ("CQDMEM", "PQDMEM")


def read(path):
    """The deck as pyNastran reads it, and everything it complained of."""
    complaints = []

    def listen(level, _file, _line, message):
        if level.strip().upper() not in ("DEBUG", "INFO"):
            complaints.append(f"{level}: {message}")

    deck = BDF(mode="nasa95", log=SimpleLogger("debug", log_func=listen))
    deck.read_bdf(str(path), xref=True)
    text = [lines[1] for lines in deck.reject_lines]
    known = [line for line in text if line.startswith(KEPT_AS_TEXT)]
    complaints += [f"left out: {line}" for line in text if line not in known]
    complaints += [f"left out: {card}" for card in deck.reject_cards]
    return deck, known, complaints


def check(path):
    """Reads one deck and says what is in it."""
    deck, text, complaints = read(path)
    if complaints:
        raise SystemExit(f"{path}: " + "; ".join(map(str, complaints)))
    counts = dict(deck.card_count)
    for card, count in EVERY_BOX.items():
        assert counts.get(card) == count, f"{path}: {counts.get(card)} {card} cards, not {count}"
    membranes = [[int(field) for field in line.split()[1:]] for line in text if line.startswith("CQDMEM")]
    thicknesses = [line for line in text if line.startswith("PQDMEM")]
    assert counts.get("CSHEAR", 0) + len(membranes) == counts.get("PSHEAR", 0) + len(thicknesses) == 15, counts
    assert all(len(fields) == 6 and all(grid in deck.nodes for grid in fields[2:]) for fields in membranes), membranes
    for number, mass in deck.masses.items():
        assert mass.mass > 0.0 and mass.G1() == number and mass.c1 == 3, mass
    for equation in deck.mpcs[1]:
        # Coefficient -1 on the dynamic point, and as much as one in all on z of the structure: a lift by one lifts it by one.
        assert equation.coefficients[0] == -1.0, equation
        lift = sum(a for a, c in zip(equation.coefficients[1:], equation.components[1:]) if str(c) == "3")
        assert abs(lift - 1.0) < 1e-12, (equation, lift)
    print(f"{path.name}: " + ", ".join(f"{count} {card}" for card, count in sorted(counts.items())))


def main():
    if len(sys.argv) > 1:
        for name in sys.argv[1:]:
            check(pathlib.Path(name))
        return
    with tempfile.TemporaryDirectory() as folder:
        for case, passes in PASSES.items():
            for number in range(passes + 1):
                path = pathlib.Path(folder) / f"case_{case}_pass_{number}.inp"
                command = ["cargo", "run", "--quiet", "--release", "--", "deck", str(case), "--pass", str(number), "-o", str(path)]
                subprocess.run(command, cwd=PROJECT, check=True)
                check(path)


if __name__ == "__main__":
    main()
