#!/usr/bin/env python3
"""Has the programs that own the formats read what the crate writes, and stores what they found.

    python3 golden/formats/read_back.py

The files are `written_*.mtx` and `rewritten.bdf`, which tests/files/ compare byte by byte with what the crate writes;
`CORFEM_WRITE=formats cargo test owners_programs` writes them. The answers are `read_back_matrices.csv`, the entries from
SciPy, and `read_back_elements.csv`: size and density of every element, from pyNastran.
"""

import csv
import pathlib

import scipy.io
from pyNastran.bdf.bdf import BDF

HERE = pathlib.Path(__file__).resolve().parent


def store(name, head, lines):
    with open(HERE / name, "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(head)
        writer.writerows(lines)


def matrices():
    for path in sorted(HERE.glob("written_*.mtx")):
        matrix = scipy.io.mmread(path).tocoo()
        for row, column, value in sorted(zip(matrix.row, matrix.col, matrix.data)):
            yield path.name, row + 1, column + 1, repr(float(value))


def elements(file):
    deck = BDF(debug=False)
    deck.read_bdf(str(HERE / file), xref=True)
    assert not deck.reject_lines and not deck.reject_cards, file
    for label, element in sorted(deck.elements.items()):
        material = element.mid_ref if element.type == "CONROD" else element.pid_ref.mid_ref
        size = element.pid_ref.t if element.type == "CSHEAR" else element.Area()
        yield file, label, repr(float(size)), repr(float(material.rho))


store("read_back_matrices.csv", ["file", "row", "column", "value"], matrices())
decks = [line for file in ("original.bdf", "rewritten.bdf") for line in elements(file)]
store("read_back_elements.csv", ["file", "element", "size", "density"], decks)
