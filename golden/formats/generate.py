#!/usr/bin/env python3
"""Writes matrices with the programs that own the formats, and what they hold, for tests/files/matrices.rs.

    python3 golden/formats/generate.py

`entries.csv` has every entry that is not zero (row and column from one, or as grid-component) and `sizes.csv` the sizes.
What DMIG cards hold is what pyNastran reads from them, for their fields are rounded; the other formats lose nothing.
"""

import csv
import pathlib

import numpy as np
import scipy.io
import scipy.sparse as sp
from pyNastran.bdf.bdf import BDF
from pyNastran.op4 import op4
from pyNastran.op4.op4 import OP4

HERE = pathlib.Path(__file__).resolve().parent
RANDOM = np.random.default_rng(1988)


def awkward():
    """Rectangular, with very small and large numbers and 17 digits, a column and a row of zeros."""
    matrix = np.zeros((6, 5))
    matrix[0, 0], matrix[1, 0], matrix[4, 0] = 1e-300, -1.5e10, 0.1 + 0.2
    matrix[0, 1], matrix[3, 1] = np.pi * 1e17, -np.e * 1e-17
    matrix[3, 3], matrix[4, 3], matrix[5, 3] = 1.0, -1.0 / 3.0, 1.7976931348623157e308
    matrix[1, 4] = 2.2250738585072014e-308
    return matrix


def banded(size):
    """Symmetric, of half-width three."""
    matrix = np.zeros((size, size))
    for diagonal in range(4):
        values = RANDOM.normal(size=size - diagonal) * 10.0 ** RANDOM.integers(-8, 9, size=size - diagonal)
        matrix += np.diag(values, -diagonal) + (np.diag(values, diagonal) if diagonal else 0.0)
    return matrix


def market(entries, sizes):
    banded(7)  # The numbers of the others come behind it.
    whole = (RANDOM.integers(-9, 10, size=(4, 6))).astype(int)
    for name, matrix, symmetry in [
        ("general", sp.coo_matrix(awkward()), "general"),
        ("general_array", awkward(), "general"),
        ("symmetric", sp.coo_matrix(banded(30)), "symmetric"),
        ("symmetric_array", banded(6), "symmetric"),
        ("integer", sp.coo_matrix(whole), "general"),
    ]:
        file = f"{name}.mtx"
        scipy.io.mmwrite(HERE / file, matrix, comment=" written by SciPy", precision=17, symmetry=symmetry)
        read = scipy.io.mmread(HERE / file)
        read = read.toarray() if sp.issparse(read) else read
        dense = matrix.toarray() if sp.issparse(matrix) else matrix
        assert np.array_equal(read, dense), name
        keep(entries, sizes, file, "", dense)


def keep(entries, sizes, file, name, matrix):
    sizes.append([file, name, *matrix.shape])
    for row, column in zip(*np.nonzero(matrix)):
        entries.append([file, name, row + 1, column + 1, repr(float(matrix[row, column]))])


def output4(entries, sizes):
    matrices = {"KAA": (6, banded(20)), "T": (2, awkward())}
    sparse = {name: (form, sp.csc_matrix(matrix).tocoo()) for name, (form, matrix) in matrices.items()}
    for file, what, big in [("dense.op4", matrices, False), ("sparse.op4", sparse, False), ("bigmat.op4", sparse, True)]:
        with open(HERE / file, "w") as stream:
            for name, (form, matrix) in what.items():
                if sp.issparse(matrix):
                    op4._write_sparse_matrix_ascii(stream, name, matrix, form=form, is_big_mat=big)
                else:
                    op4._write_dense_matrix_ascii(None, stream, name, matrix, form=form)
        read = OP4().read_op4(str(HERE / file))
        for name, (_, matrix) in matrices.items():
            found = read[name].data
            found = found.toarray() if sp.issparse(found) else found
            assert np.array_equal(found, matrix), (file, name)
            keep(entries, sizes, file, name, matrix)


def dmig(entries, sizes):
    grids = [(grid, component) for grid in (3, 11, 40) for component in range(1, 7)] + [(1001, 0), (1002, 0)]
    stiffness = banded(len(grids))
    load = RANDOM.normal(size=(len(grids), 3)) * 1e3
    for tin, size, file in [(1, 8, "small.dmig"), (1, 16, "large.dmig"), (2, 16, "double.dmig")]:
        model = BDF(debug=False)
        lower = [(row, column) for column in range(len(grids)) for row in range(column, len(grids)) if stiffness[row, column]]
        model.add_dmig("KAAX", 6, tin, 0, 0, None, [grids[c] for _, c in lower], [grids[r] for r, _ in lower],
                       Real=[stiffness[place] for place in lower])
        square = [(row, column) for row, column in lower if row >= column + 2]
        model.add_dmig("BAAX", 1, tin, 0, 0, None, [grids[c] for _, c in square], [grids[r] for r, _ in square],
                       Real=[-stiffness[place] for place in square])
        all_of = [(row, column) for column in range(3) for row in range(len(grids))]
        model.add_dmig("PAX", 9, tin, 0, 0, 3, [(column + 1, 0) for _, column in all_of], [grids[r] for r, _ in all_of],
                       Real=[load[place] for place in all_of])
        with open(HERE / file, "w") as stream:
            for matrix in model.dmigs.values():
                stream.write(matrix.write_card(size=size).lstrip("\n"))
        read = BDF(debug=False)
        read.read_bdf(str(HERE / file), punch=True, xref=False)
        for name, matrix in read.dmigs.items():
            values, rows, columns = matrix.get_matrix(is_sparse=False)
            label = lambda pair: f"{pair[0]}-{pair[1]}"
            mark = {"KAAX": "symmetric", "BAAX": "square", "PAX": "rectangular"}[name]
            sizes.append([file, name, mark, ""])
            # The cards themselves, as pyNastran reads them: what it makes of them row by row it orders in its own way.
            for row, column, value in zip(matrix.GCi, matrix.GCj, matrix.Real):
                entries.append([file, name, label(row), label(column), repr(float(value))])
                if mark == "symmetric" and tuple(row) != tuple(column):
                    entries.append([file, name, label(column), label(row), repr(float(value))])
            assert np.count_nonzero(values) == sum(1 for entry in entries if entry[:2] == [file, name]), name


def main():
    entries, sizes = [], []
    market(entries, sizes)
    output4(entries, sizes)
    dmig(entries, sizes)
    for name, head, lines in [
        ("entries.csv", ["file", "matrix", "row", "column", "value"], entries),
        ("sizes.csv", ["file", "matrix", "rows", "columns"], sizes),
    ]:
        with open(HERE / name, "w", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(head)
            writer.writerows(lines)


if __name__ == "__main__":
    main()
