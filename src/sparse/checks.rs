//! Small pieces that several parts of the room share.

use crate::method::error::Error;
use crate::method::linear_algebra::{
    as_faer, check_finite, from_faer, symmetric_eigen, symmetric_part,
};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::linalg::matmul::matmul;
use faer::linalg::solvers::{DenseSolveCore, Llt, Solve};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par, Side};
use nalgebra::{DMatrix, DVector};
use std::borrow::Borrow;

/// Indices of values above a limit. NaN is not above it.
pub(crate) fn places_above(numbers: &DVector<f64>, limit: f64) -> Vec<usize> {
    (0..numbers.len())
        .filter(|&place| numbers[place] > limit)
        .collect()
}

/// Adds $A B$, times a number, to a matrix of many rows.
fn add_product(into: &mut DMatrix<f64>, a: MatRef<f64>, b: MatRef<f64>, number: f64) {
    let (rows, columns) = into.shape();
    let into = MatMut::from_column_major_slice_mut(into.as_mut_slice(), rows, columns);
    matmul(into, Accum::Add, a, b, number, Par::Seq);
}

/// $A^t B$ of matrices of many rows.
pub(crate) fn transposed_product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut product = DMatrix::zeros(a.ncols(), b.ncols());
    add_product(&mut product, as_faer(a).transpose(), as_faer(b), 1.0);
    product
}

/// $A^t A$.
pub(crate) fn gram(a: &DMatrix<f64>) -> DMatrix<f64> {
    let mut product = transposed_product(a, a);
    product.fill_upper_triangle_with_lower_triangle();
    product
}

/// Combinations $Y$ of columns for which $Y^t G Y = I$ with their Gram matrix $G$, whose eigenvalues come too, ascending: those alone
/// that are above a limit, which the largest gives.
pub(super) fn independent(
    what: &'static str,
    gram: &DMatrix<f64>,
    limit: impl Fn(f64) -> f64,
) -> Result<(DVector<f64>, DMatrix<f64>), Error> {
    let (sizes, vectors) = symmetric_eigen(what, &symmetric_part(gram))?;
    let own = places_above(&sizes, limit(sizes.max()));
    let sizes = sizes.select_rows(&own);
    let scale = DMatrix::from_diagonal(&sizes.map(|size| 1.0 / size.sqrt()));
    Ok((sizes, vectors.select_columns(&own) * scale))
}

/// Subtracts $A B$ from a matrix of many rows.
pub(crate) fn take_product(from: &mut DMatrix<f64>, a: &DMatrix<f64>, b: &DMatrix<f64>) {
    add_product(from, as_faer(a), as_faer(b), -1.0);
}

/// Hands on a matrix whose entries are all finite.
pub(crate) fn finite<M: Borrow<DMatrix<f64>>>(what: &'static str, matrix: M) -> Result<M, Error> {
    // One question for all entries takes a tenth of the time of one for each.
    let all = matrix.borrow().iter();
    match all.fold(true, |all, value| all & value.is_finite()) {
        true => Ok(matrix),
        false => check_finite(what, matrix.borrow()).map(|()| matrix),
    }
}

/// Solution $L^{-1} R$ for a lower triangular $L$ with nonzero diagonal.
pub(crate) fn solve_lower(lower: &DMatrix<f64>, mut right: DMatrix<f64>) -> DMatrix<f64> {
    let (rows, columns) = right.shape();
    let solved = MatMut::from_column_major_slice_mut(right.as_mut_slice(), rows, columns);
    solve_lower_triangular_in_place(as_faer(lower), solved, Par::Seq);
    right
}

/// Solution of $A x = b$ for a symmetric positive definite $A$.
///
/// # Errors
/// [`Error::NotPositiveDefinite`].
pub(crate) fn solve_positive(
    what: &'static str,
    matrix: &DMatrix<f64>,
    right: &DVector<f64>,
) -> Result<DVector<f64>, Error> {
    let factor = positive_factor(what, matrix)?;
    let mut solved = right.clone();
    let count = right.len();
    let column = MatMut::from_column_major_slice_mut(solved.as_mut_slice(), count, 1);
    factor.solve_in_place(column);
    Ok(solved)
}

/// Inverse of a symmetric positive definite matrix.
///
/// # Errors
/// [`Error::NotPositiveDefinite`].
pub(crate) fn inverse_of_positive(
    what: &'static str,
    matrix: &DMatrix<f64>,
) -> Result<DMatrix<f64>, Error> {
    let inverse = positive_factor(what, matrix)?.inverse();
    Ok(from_faer(inverse.as_ref()))
}

fn positive_factor(what: &'static str, matrix: &DMatrix<f64>) -> Result<Llt<f64>, Error> {
    let factor = as_faer(matrix).llt(Side::Lower);
    factor.map_err(
        |LltError::NonPositivePivot { index }| Error::NotPositiveDefinite { what, row: index },
    )
}
