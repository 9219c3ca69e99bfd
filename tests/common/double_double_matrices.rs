//! The little linear algebra that a chain in [`super::double_double`] needs, plain: rows of numbers.

use super::double_double::Dd;

/// Rows.
pub type Rows = Vec<Vec<Dd>>;

pub fn rows(count: usize, columns: usize, entry: impl Fn(usize, usize) -> Dd) -> Rows {
    (0..count)
        .map(|i| (0..columns).map(|j| entry(i, j)).collect())
        .collect()
}

/// $A^t B$.
pub fn transposed_product(a: &Rows, b: &Rows) -> Rows {
    rows(a[0].len(), b[0].len(), |i, j| {
        a.iter().zip(b).map(|(a, b)| a[i] * b[j]).sum()
    })
}

/// $A B$.
pub fn product(a: &Rows, b: &Rows) -> Rows {
    rows(a.len(), b[0].len(), |i, j| {
        a[i].iter().zip(b).map(|(&a, b)| a * b[j]).sum()
    })
}

/// $A^{-1} B$ of a symmetric positive definite $A$, by Cholesky; fails for another.
pub fn solve(a: &Rows, b: &Rows) -> Rows {
    let size = a.len();
    let mut lower = rows(size, size, |_, _| Dd::ZERO);
    for i in 0..size {
        for j in 0..=i {
            let rest = a[i][j] - (0..j).map(|s| lower[i][s] * lower[j][s]).sum::<Dd>();
            assert!(i > j || rest > Dd::ZERO, "not positive definite");
            lower[i][j] = if i == j {
                rest.sqrt()
            } else {
                rest / lower[j][j]
            };
        }
    }
    let solved = |column: usize| {
        let mut x: Vec<Dd> = b.iter().map(|row| row[column]).collect();
        for i in 0..size {
            let known: Dd = (0..i).map(|s| lower[i][s] * x[s]).sum();
            x[i] = (x[i] - known) / lower[i][i];
        }
        for i in (0..size).rev() {
            let known: Dd = (i + 1..size).map(|s| lower[s][i] * x[s]).sum();
            x[i] = (x[i] - known) / lower[i][i];
        }
        x
    };
    let columns: Rows = (0..b[0].len()).map(solved).collect();
    rows(size, columns.len(), |i, j| columns[j][i])
}

/// The inverse of a symmetric positive definite matrix, symmetric to the last bit.
pub fn inverse(a: &Rows) -> Rows {
    let size = a.len();
    let x = solve(
        a,
        &rows(size, size, |i, j| if i == j { Dd::ONE } else { Dd::ZERO }),
    );
    rows(size, size, |i, j| x[i.max(j)][i.min(j)])
}

/// Eigenvalues, ascending, and orthonormal eigenvectors (columns) of a symmetric matrix by Jacobi's rotations.
pub fn eigen(a: &Rows) -> (Vec<Dd>, Rows) {
    let size = a.len();
    let mut a = a.clone();
    let mut vectors = rows(size, size, |i, j| if i == j { Dd::ONE } else { Dd::ZERO });
    // Convergence is quadratic: a matrix of nine has done with it after some eight sweeps.
    for _ in 0..16 {
        for p in 0..size {
            for q in p + 1..size {
                // What is nothing beside both roots needs no rotation, and would overflow its tangent.
                if a[p][q].abs() <= Dd::from(1e-40) * a[p][p].abs().smaller(a[q][q].abs()) {
                    continue;
                }
                let theta = (a[q][q] - a[p][p]) / (a[p][q] + a[p][q]);
                let tangent = (theta.abs() + (theta * theta + Dd::ONE).sqrt()).recip();
                let tangent = if theta < Dd::ZERO { -tangent } else { tangent };
                let cosine = (tangent * tangent + Dd::ONE).sqrt().recip();
                let sine = tangent * cosine;
                let turn = |x: Dd, y: Dd| (cosine * x - sine * y, sine * x + cosine * y);
                for row in a.iter_mut().chain(vectors.iter_mut()) {
                    (row[p], row[q]) = turn(row[p], row[q]);
                }
                let (above, below) = a.split_at_mut(q);
                for (x, y) in above[p].iter_mut().zip(&mut below[0]) {
                    (*x, *y) = turn(*x, *y);
                }
                (a[p][q], a[q][p]) = (Dd::ZERO, Dd::ZERO);
            }
        }
    }
    let mut order: Vec<usize> = (0..size).collect();
    order.sort_by(|&i, &j| a[i][i].partial_cmp(&a[j][j]).expect("numbers"));
    (
        order.iter().map(|&i| a[i][i]).collect(),
        rows(size, size, |i, j| vectors[i][order[j]]),
    )
}
