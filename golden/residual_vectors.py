"""Exact analyses that SciPy's least_squares takes with exact derivatives on the net of tests/extensions/any_size/deflections.rs.

    python3 golden/residual_vectors.py

Unknowns are logarithms of the factors; residuals are those of corfem's weighted steps: frequencies over 0.5 %, shapes of unit largest
component over 2 %, scaled by least squares.
"""
import numpy as np
from scipy.linalg import eigh
from scipy.optimize import least_squares

ROWS, COLUMNS, TESTED = 20, 15, 8
N = ROWS * COLUMNS


def vary(place):
    return 1 + 0.3 * np.sin(7.0 * place)


parts = np.zeros((COLUMNS, N, N))
for row in range(ROWS):
    for column in range(COLUMNS):
        i = row * COLUMNS + column
        for j, k, there in ((i + 1, 1e5 * vary(2 * i), column + 1 < COLUMNS), (i + COLUMNS, 8e4 * vary(2 * i + 1), row + 1 < ROWS)):
            if there:
                parts[column][np.ix_((i, j), (i, j))] += k * np.array([[1, -1], [-1, 1]])
        if row == 0:
            parts[column][i, i] += 1e5
mass = 60 * vary(3 * np.arange(N))
sensors = np.arange(N) % 3 == 1


def modes(logs):
    squares, shapes = eigh(np.tensordot(np.exp(logs), parts, 1), np.diag(mass))
    return squares, shapes


truth = 0.4 * np.cos(3.0 * np.arange(COLUMNS))
tested, shapes = modes(truth)
tested, units = tested[:TESTED], shapes[sensors, :TESTED]
units = units / units[np.abs(units).argmax(0), range(TESTED)]


def paired(logs):
    squares, all_shapes = modes(logs)
    v = all_shapes[sensors]
    mac = (v.T @ units) ** 2 / np.outer((v**2).sum(0), (units**2).sum(0))
    return squares, all_shapes, mac[:12].argmax(0)


def residuals(logs):
    squares, all_shapes, pairs = paired(logs)
    out = []
    for j, i in enumerate(pairs):
        v = all_shapes[sensors, i]
        out += [[(np.sqrt(squares[i] / tested[j]) - 1) / 0.005], (v @ units[:, j] / (v @ v) * v - units[:, j]) / 0.02]
    return np.concatenate(out)


def jacobian(logs):
    squares, all_shapes, pairs = paired(logs)
    columns = []
    for e in range(COLUMNS):
        beta, out = np.exp(logs[e]) * all_shapes.T @ parts[e] @ all_shapes, []
        for j, i in enumerate(pairs):
            apart = squares[i] - squares
            apart[i] = np.inf
            v, dv = all_shapes[sensors, i], (all_shapes @ (beta[:, i] / apart))[sensors]
            scale = v @ units[:, j] / (v @ v)
            off = scale * v - units[:, j]
            out += [[np.sqrt(squares[i] / tested[j]) * beta[i, i] / (2 * squares[i]) / 0.005],
                    (scale * (dv - v * (v @ dv) / (v @ v)) - v * (off @ dv) / (v @ v)) / 0.02]
        columns.append(np.concatenate(out))
    return np.array(columns).T


for method in ("trf", "lm", "dogbox"):
    found = least_squares(residuals, np.zeros(COLUMNS), jacobian, method=method)
    print(method, found.nfev, "analyses", found.njev, np.abs(np.exp(found.x - truth) - 1).max())
