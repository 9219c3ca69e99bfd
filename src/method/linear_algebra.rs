//! Dense decompositions of the method, through faer, with the checks that faer leaves to its caller.

use super::error::{Error, Result, at_least_one, require};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::{MatRef, Side};
use nalgebra::{ComplexField, DMatrix, DVector};

/// Asymmetry, relative to the largest entry, above which a matrix is refused.
/// A congruence transformation leaves about 1e-14; 1e-8 is a mistake in the data.
const LARGEST_ASYMMETRY: f64 = 1e-8;

/// A matrix, of real numbers where nothing is said.
pub type Matrix<T = f64> = DMatrix<T>;

/// A vector, of real numbers where nothing is said.
pub type Vector<T = f64> = DVector<T>;

/// A real or complex number.
pub trait Number: ComplexField<RealField = f64> + Copy {}

impl<T: ComplexField<RealField = f64> + Copy> Number for T {}

/// Refuses matrices, real or complex, with NaN or infinite entries.
///
/// # Errors
/// The first such entry, column by column, with the sum of its parts.
pub fn check_finite<T: Number>(what: &'static str, matrix: &Matrix<T>) -> Result<()> {
    for (at, entry) in matrix.iter().enumerate() {
        let owner = || format!("entry ({}, {})", at % matrix.nrows(), at / matrix.nrows());
        // The part that is not finite outweighs the other.
        let value = entry.real() + entry.imaginary();
        require(entry.is_finite(), what, owner, value, "a finite number")?;
    }
    Ok(())
}

/// Refuses matrices, real or complex, of another shape.
///
/// # Errors
/// A matrix of another shape, with both shapes.
pub fn check_shape<T>(
    what: &'static str,
    matrix: &Matrix<T>,
    expected_rows: usize,
    expected_columns: usize,
) -> Result<()> {
    let (rows, columns) = matrix.shape();
    if (rows, columns) == (expected_rows, expected_columns) {
        return Ok(());
    }
    Err(Error::WrongShape {
        what,
        expected_rows,
        expected_columns,
        rows,
        columns,
    })
}

/// Refuses matrices, real or complex, of another shape or with entries that are not finite.
pub(crate) fn check_matrix<T: Number>(
    what: &'static str,
    matrix: &Matrix<T>,
    rows: usize,
    columns: usize,
) -> Result<()> {
    check_shape(what, matrix, rows, columns)?;
    check_finite(what, matrix)
}

/// Refuses lists of another length.
///
/// # Errors
/// A list of another length, with both lengths as rows of one column.
pub fn check_length(what: &'static str, found: usize, expected: usize) -> Result<()> {
    check_shape(what, &Matrix::from_element(found, 1, ()), expected, 1)
}

/// Refuses matrices that are not square, finite and symmetric to working precision.
///
/// # Errors
/// A matrix that is not square or not finite, and one with an entry that differs from its mirror, with the largest difference over the
/// largest entry.
pub fn check_symmetric(what: &'static str, matrix: &Matrix) -> Result<()> {
    check_matrix(what, matrix, matrix.nrows(), matrix.nrows())?;
    let apart = (matrix - matrix.transpose()).amax() / matrix.amax();
    // Only a matrix of zeros, or none, leaves no number.
    let is_met = apart <= LARGEST_ASYMMETRY || apart.is_nan();
    require(
        is_met,
        "relative asymmetry",
        || what.into(),
        apart,
        "at most 1e-8",
    )
}

/// Symmetric part $(A + A^t)/2$, without the round-off asymmetry of a congruence transformation. A matrix that is not square has none
/// and comes back as it is.
pub fn symmetric_part(matrix: &Matrix) -> Matrix {
    if !matrix.is_square() {
        return matrix.clone();
    }
    0.5 * matrix + 0.5 * matrix.transpose()
}

/// Congruence $V^t A V$ (n × n): stiffness or mass as it is for shapes in columns (d × n).
pub(crate) fn congruence(matrix: &Matrix, shapes: &Matrix) -> Matrix {
    shapes.tr_mul(&(matrix * shapes))
}

/// Lower Cholesky factor $L$ of a symmetric positive definite matrix, $A = L L^t$.
///
/// A pivot below `smallest_pivot` times its diagonal entry counts as not positive.
///
/// # Errors
/// A matrix that is not symmetric or not finite, and the row of the first bad pivot of one that is not positive definite.
pub fn cholesky(what: &'static str, matrix: &Matrix, smallest_pivot: f64) -> Result<Matrix> {
    check_symmetric(what, matrix)?;
    let refused = |row| Error::NotPositiveDefinite { what, row };
    let factor = as_faer(matrix).llt(Side::Lower);
    let lower = factor.map_err(|LltError::NonPositivePivot { index }| {
        // A pivot before it may have been too small already.
        let before = matrix.view((0, 0), (index, index)).into_owned();
        cholesky(what, &before, smallest_pivot)
            .err()
            .unwrap_or(refused(index))
    })?;
    let lower = from_faer(lower.L());
    let is_bad = |&i: &usize| lower[(i, i)].powi(2) <= smallest_pivot * matrix[(i, i)];
    let bad = (0..matrix.nrows()).find(is_bad);
    bad.map_or(Ok(lower), |row| Err(refused(row)))
}

/// Round-off in place of a zero eigenvalue of a semidefinite matrix of $n$ rows with unit diagonal: $32 \varepsilon \sqrt n$.
///
/// The computed factor is the exact one of $A + E$. With unit diagonal $|L| D |L|^t$ has no entry above one, so that those of $E$ are
/// below $\varepsilon$ times the number of products in a sum, of which there are $n$ at most; errors of either sign make it the root of
/// their number. A structure's matrix has some 32 entries in a row, and no eigenvalue of $E$ exceeds the sum of a row: a matrix whose
/// smallest eigenvalue is no larger may be singular for all that its numbers tell.
/// Source: Higham, *Accuracy and Stability of Numerical Algorithms* (2002), theorem 10.3 and section 2.8.
pub(crate) fn round_off(rows: usize) -> f64 {
    32.0 * f64::EPSILON * (rows as f64).sqrt()
}

/// Congruence $L^{-1} A L^{-t}$ for a lower triangular $L$ with nonzero diagonal.
pub(crate) fn reduced<T: Number>(lower: &Matrix<T>, matrix: &Matrix<T>) -> Matrix<T> {
    let half = lower.solve_lower_triangular_unchecked(matrix).transpose();
    lower.solve_lower_triangular_unchecked(&half).transpose()
}

/// Eigenvalues (ascending) and orthonormal eigenvectors (columns) of a symmetric matrix.
///
/// $$ A Y = Y \mathrm{diag}(\mu), \qquad Y^t Y = I $$
///
/// # Errors
/// A matrix that is empty, not symmetric or not finite.
pub fn symmetric_eigen(what: &'static str, matrix: &Matrix) -> Result<(Vector, Matrix)> {
    check_symmetric(what, matrix)?;
    at_least_one(what, matrix.len())?;
    // Entries of order one: the squares of very large or small ones leave the range of numbers. A power of two is exact.
    let unit = matrix.amax().log2().floor().clamp(-1000.0, 1000.0).exp2();
    let eigen = as_faer(&(matrix / unit))
        .self_adjoint_eigen(Side::Lower)
        .map_err(|_| Error::no_convergence(what))?;
    let values = Vector::from_fn(matrix.nrows(), |i, _| unit * eigen.S()[i]);
    Ok((values, from_faer(eigen.U())))
}

/// Eigenvalues (ascending) of $A v = \mu L L^t v$ for a lower triangular $L$ with nonzero diagonal, and the vectors of the lowest
/// `count`, scaled to $V^t L L^t V = I$, from the symmetric problem of $L^{-1} A L^{-t}$ for $L^t v$.
pub(crate) fn pencil_eigen(
    what: &'static str,
    matrix: &Matrix,
    lower: &Matrix,
    count: usize,
) -> Result<(Vector, Matrix)> {
    let (values, vectors) = symmetric_eigen(what, &symmetric_part(&reduced(lower, matrix)))?;
    let lowest = lower.tr_solve_lower_triangular_unchecked(&vectors.columns(0, count));
    Ok((values, lowest))
}

/// Matrix, real or complex, as faer sees it.
pub(crate) fn as_faer<T>(matrix: &Matrix<T>) -> MatRef<'_, T> {
    MatRef::from_column_major_slice(matrix.as_slice(), matrix.nrows(), matrix.ncols())
}

/// Matrix back from faer.
pub(crate) fn from_faer(matrix: MatRef<f64>) -> Matrix {
    Matrix::from_fn(matrix.nrows(), matrix.ncols(), |row, column| {
        matrix[(row, column)]
    })
}
