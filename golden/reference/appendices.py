"""Appendix B and changes of mass by numpy, for vectors.py.

It shares no code with the crate and goes other ways where there are any: balance by its own linear equations, the general formulae
as matrices.
"""
import numpy as np

RNG = np.random.default_rng(1947)


def listed(matrix):
    """Rows of a matrix, or a list, in full precision."""
    matrix = np.asarray(matrix, float)
    return "[" + ", ".join(map(listed, matrix)) + "]" if matrix.ndim > 1 else "[" + ", ".join("%.17g" % x for x in matrix) + "]"


def pencil_modes(k, m):
    """Modes of a symmetric pencil, mass-orthonormal, ascending."""
    inverse = np.linalg.inv(np.linalg.cholesky(m))
    w, y = np.linalg.eigh(inverse @ k @ inverse.T)
    return w, inverse.T @ y


# Appendix B.

def balance_and_orthogonalize():
    """A free beam of seven points on two soft springs, its four lowest elastic modes with noise."""
    x = np.linspace(0.0, 60.0, 7)
    mass = np.diag([0.02, 0.03, 0.05, 0.08, 0.05, 0.03, 0.02]) + 0.002 * (np.eye(7, k=1) + np.eye(7, k=-1))
    bend = np.zeros((5, 7))
    for i in range(5):
        bend[i, i:i + 3] = 1.0, -2.0, 1.0
    k = bend.T @ np.diag([300.0, 500.0, 800.0, 500.0, 300.0]) @ bend
    k[1, 1] += 0.05
    k[5, 5] += 0.08
    w, v = pencil_modes(k, mass)
    w = w[2:6] * (1 + 0.01 * RNG.standard_normal(4))
    raw = v[:, 2:6] * np.array([1.0, -3.0, 0.5, 2.0]) * (1 + 0.05 * RNG.standard_normal((7, 4)))
    phi = np.column_stack([np.ones(7), x])
    coefficients, balanced = np.zeros((2, 4)), np.zeros((7, 4))
    for i in range(4):
        r = w[i] * mass - k
        coefficients[:, i] = np.linalg.solve(phi.T @ r @ phi, -phi.T @ r @ raw[:, i])
        balanced[:, i] = raw[:, i] + phi @ coefficients[:, i]
    added = phi @ coefficients
    change = np.sqrt(np.sum(added * (mass @ added), 0) / np.sum(raw * (mass @ raw), 0))
    unit = balanced / np.sqrt(np.sum(balanced * (mass @ balanced), 0))
    m1 = unit.T @ mass @ unit
    w_new, q = pencil_modes(np.diag(w), m1)
    shapes = unit @ q
    cross = shapes.T @ mass @ unit
    order = np.abs(cross).argmax(0)
    shapes, w_new = shapes[:, order] * np.sign(cross[order, range(4)]), w_new[order]
    moved = shapes - unit
    movement = np.sqrt(np.sum(moved * (mass @ moved), 0))
    return ["[appendix_b]"] + [f"{name} = {listed(value)}" for name, value in dict(
        stiffness=k, mass=mass, rigid_body=phi, omega_squared=w, raw=raw, coefficients=coefficients, balanced=balanced, change=change,
        overlap=m1, orthogonal_omega_squared=w_new, orthogonal=shapes, frequency_movement=np.sqrt(w_new / w) - 1,
        shape_movement=movement).items()]


# Appendix C with changes of mass: A g - G on column p, A = k + beta, G = 1 + alpha.

def general_recursive_1(k, beta, alpha, order):
    n = len(k)
    big_a, big_g = np.diag(k) + beta, np.eye(n) + alpha
    roots, p = np.diag(big_g) / np.diag(big_a), np.eye(n, dtype=big_a.dtype)
    for _ in range(order):
        new, q = roots.copy(), p.copy()
        for j in range(n):
            f = big_a * roots[j] - big_g
            rest = f @ p[:, j] - np.diag(f) * p[:, j]
            q[:, j] = -rest / np.where(np.arange(n) == j, 1.0, np.diag(f))
            q[j, j] = 1.0
            new[j] = (big_g[j, j] - rest[j]) / big_a[j, j]
        roots, p = new, q
    return roots, p


def explicit_roots(k, beta, alpha, p):
    return np.diag((np.eye(len(k)) + alpha) @ p) / np.diag((np.diag(k) + beta) @ p)


def general_recursive_2(k, beta, alpha, order):
    n = len(k)
    roots, p = general_recursive_1(k, beta, alpha, 1)
    for _ in range(order - 1):
        roots, p = explicit_roots(k, beta, alpha, p), p.copy()
        for j in range(n):
            f = (np.diag(k) + beta) * roots[j] - np.eye(n) - alpha
            rest = [i for i in range(n) if i != j]
            p[rest, j] = np.linalg.solve(f[np.ix_(rest, rest)], -f[rest, j])
    return roots, p


def exact(k, beta, alpha):
    """Roots and shapes of the changed pencil, each in the place of the mode that it is most like."""
    roots, p = np.linalg.eig(np.linalg.solve(np.diag(k) + beta, np.eye(len(k)) + alpha))
    order = np.abs(p).argmax(0).argsort()
    return roots[order], p[:, order] / np.diag(p[:, order])
