//! The few dense decompositions the method needs, through faer, with the checks that faer leaves to its caller.

use crate::method::error::{Error, at_least_one};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{MatMut, MatRef, Par, Side};
use nalgebra::{ComplexField, DMatrix, DVector};

/// Asymmetry, relative to the largest entry, above which a matrix is refused.
/// A congruence transformation leaves about 1e-14; 1e-8 is a mistake in the data.
const LARGEST_ASYMMETRY: f64 = 1e-8;

/// Eigenvalue of a unit-diagonal matrix below zero by more than this is no round-off of a semidefinite one.
const SEMIDEFINITE: f64 = 1e-10;

/// A real or complex number.
pub trait Number: ComplexField<RealField = f64> + Copy {}

impl<T: ComplexField<RealField = f64> + Copy> Number for T {}

/// Refuses matrices, real or complex, with NaN or infinite entries.
///
/// # Errors
/// [`Error::NotFinite`] naming the first such entry, column by column, and the part of it that is not finite.
pub fn check_finite<T: Number>(what: &'static str, matrix: &DMatrix<T>) -> Result<(), Error> {
    let Some(index) = matrix
        .as_slice()
        .iter()
        .position(|value| !value.is_finite())
    else {
        return Ok(());
    };
    let (column, row) = (index / matrix.nrows(), index % matrix.nrows());
    let (real, imaginary) = (matrix[index].real(), matrix[index].imaginary());
    Err(Error::NotFinite {
        what,
        row,
        column,
        value: if real.is_finite() { imaginary } else { real },
    })
}

/// Refuses matrices, real or complex, of another shape.
///
/// # Errors
/// [`Error::WrongShape`] with both shapes.
pub fn check_shape<T>(
    what: &'static str,
    matrix: &DMatrix<T>,
    expected_rows: usize,
    expected_columns: usize,
) -> Result<(), Error> {
    let (rows, columns) = matrix.shape();
    let fits = (rows, columns) == (expected_rows, expected_columns);
    if fits {
        Ok(())
    } else {
        Err(Error::WrongShape {
            what,
            expected_rows,
            expected_columns,
            rows,
            columns,
        })
    }
}

/// Refuses matrices, real or complex, of another shape or with entries that are not finite.
///
/// # Errors
/// Those of [`check_shape`] and [`check_finite`].
pub(crate) fn check_matrix<T: Number>(
    what: &'static str,
    matrix: &DMatrix<T>,
    rows: usize,
    columns: usize,
) -> Result<(), Error> {
    check_shape(what, matrix, rows, columns)?;
    check_finite(what, matrix)
}

/// Refuses lists of another length.
///
/// # Errors
/// [`Error::WrongShape`] with both lengths as rows of one column.
pub fn check_length(what: &'static str, found: usize, expected: usize) -> Result<(), Error> {
    if found == expected {
        return Ok(());
    }
    Err(Error::WrongShape {
        what,
        expected_rows: expected,
        expected_columns: 1,
        rows: found,
        columns: 1,
    })
}

/// Refuses matrices that are not square, finite and symmetric to working precision.
///
/// # Errors
/// [`Error::WrongShape`], [`Error::NotFinite`], [`Error::NotSymmetric`].
pub fn check_symmetric(what: &'static str, matrix: &DMatrix<f64>) -> Result<(), Error> {
    check_matrix(what, matrix, matrix.nrows(), matrix.nrows())?;
    let pairs = (0..matrix.ncols())
        .flat_map(|column| (column..matrix.nrows()).map(move |row| (row, column)));
    let apart =
        |(row, column): (usize, usize)| (matrix[(row, column)] - matrix[(column, row)]).abs();
    let Some((row, column)) = pairs.reduce(|worst, pair| {
        if apart(pair) > apart(worst) {
            pair
        } else {
            worst
        }
    }) else {
        return Ok(());
    };
    let (difference, largest) = (apart((row, column)), matrix.amax());
    let refused = Error::NotSymmetric {
        what,
        row,
        column,
        difference: difference / largest,
    };
    if difference <= LARGEST_ASYMMETRY * largest {
        Ok(())
    } else {
        Err(refused)
    }
}

/// Hands on a matrix whose entries are all finite.
pub(crate) fn finite(what: &'static str, matrix: DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    check_finite(what, &matrix).map(|()| matrix)
}

/// The same of a list.
pub(crate) fn finite_list(what: &'static str, list: Vec<f64>) -> Result<Vec<f64>, Error> {
    finite(what, DMatrix::from_vec(list.len(), 1, list)).map(|list| list.data.into())
}

/// The symmetric part, $(A + A^t)/2$: removes the round-off asymmetry of a congruence transformation. A matrix that is not square
/// has none and comes back as it is.
pub fn symmetric_part(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    if matrix.is_square() {
        0.5 * matrix + 0.5 * matrix.transpose()
    } else {
        matrix.clone()
    }
}

/// Lower Cholesky factor $L$ of a symmetric positive definite matrix, $A = L L^t$.
///
/// A pivot below `smallest_pivot` times its diagonal entry counts as not positive.
///
/// # Errors
/// Those of [`check_symmetric`]; [`Error::NotPositiveDefinite`] naming the row of the first bad pivot.
pub fn cholesky(
    what: &'static str,
    matrix: &DMatrix<f64>,
    smallest_pivot: f64,
) -> Result<DMatrix<f64>, Error> {
    check_symmetric(what, matrix)?;
    let lower = match as_faer(matrix).llt(Side::Lower) {
        Ok(factor) => from_faer(factor.L()),
        Err(faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot { index }) => {
            // A pivot before it may have been too small already.
            cholesky(
                what,
                &matrix.view((0, 0), (index, index)).into_owned(),
                smallest_pivot,
            )?;
            return Err(Error::NotPositiveDefinite { what, dof: index });
        }
    };
    let bad =
        (0..matrix.nrows()).find(|&i| lower[(i, i)].powi(2) <= smallest_pivot * matrix[(i, i)]);
    bad.map_or(Ok(lower), |dof| {
        Err(Error::NotPositiveDefinite { what, dof })
    })
}

/// What round-off leaves of a zero eigenvalue of a semidefinite matrix of $n$ rows with unit diagonal: $32 \varepsilon \sqrt n$.
///
/// The computed factor is the exact one of $A + E$. With unit diagonal $|L| D |L|^t$ has no entry above one, so that those of $E$ are
/// below $\varepsilon$ times the number of products in a sum, of which there are $n$ at most; errors of either sign make it the root of
/// their number. A structure's matrix has some 32 entries in a row, and no eigenvalue of $E$ exceeds the sum of a row: a matrix whose
/// smallest eigenvalue is no larger may be singular for all that its numbers tell.
/// Source: Higham, *Accuracy and Stability of Numerical Algorithms* (2002), theorem 10.3 and section 2.8.
pub(crate) fn round_off(rows: usize) -> f64 {
    32.0 * f64::EPSILON * (rows as f64).sqrt()
}

/// $L^{-1} R$ for a lower triangular $L$ with nonzero diagonal.
pub(crate) fn solve_lower<T: Number + faer::traits::ComplexField>(
    lower: &DMatrix<T>,
    mut right: DMatrix<T>,
) -> DMatrix<T> {
    let (rows, columns) = right.shape();
    let solved = MatMut::from_column_major_slice_mut(right.as_mut_slice(), rows, columns);
    solve_lower_triangular_in_place(as_faer(lower), solved, Par::Seq);
    right
}

/// $L^{-1} A L^{-t}$ for a lower triangular $L$ with nonzero diagonal.
pub(crate) fn reduced<T: Number + faer::traits::ComplexField>(
    lower: &DMatrix<T>,
    matrix: &DMatrix<T>,
) -> DMatrix<T> {
    solve_lower(lower, solve_lower(lower, matrix.clone()).transpose()).transpose()
}

/// Eigenvalues (ascending) and orthonormal eigenvectors (columns) of a symmetric matrix.
///
/// $$ A Y = Y \mathrm{diag}(\mu), \qquad Y^t Y = I $$
///
/// # Errors
/// Those of [`check_symmetric`]; [`Error::Empty`]; [`Error::NoConvergence`].
pub fn symmetric_eigen(
    what: &'static str,
    matrix: &DMatrix<f64>,
) -> Result<(DVector<f64>, DMatrix<f64>), Error> {
    check_symmetric(what, matrix)?;
    at_least_one(what, matrix.len())?;
    // Entries of order one: the squares of very large or small ones leave the range of numbers. A power of two is exact.
    let largest = matrix.amax();
    let unit = if largest > 0.0 {
        largest.log2().floor().clamp(-1000.0, 1000.0).exp2()
    } else {
        1.0
    };
    let scaled = matrix / unit;
    let eigen = as_faer(&scaled)
        .self_adjoint_eigen(Side::Lower)
        .map_err(|_| Error::NoConvergence(what))?;
    Ok((
        DVector::from_fn(matrix.nrows(), |i, _| unit * eigen.S()[i]),
        from_faer(eigen.U()),
    ))
}

/// The row that moves most where a stiffness resists nothing, and the smallest eigenvalue of the stiffness scaled to unit
/// diagonal; `None` for one that is not semidefinite.
pub(crate) fn free_motion(stiffness: &DMatrix<f64>) -> Option<(usize, f64)> {
    let diagonal = stiffness.diagonal();
    if let Some(row) = diagonal.iter().position(|&entry| entry <= 0.0) {
        return (diagonal[row] == 0.0).then_some((row, 0.0));
    }
    let scale = diagonal.map(|entry| 1.0 / entry.sqrt());
    let scaled = stiffness.component_mul(&(&scale * scale.transpose()));
    let (values, vectors) = symmetric_eigen("structural stiffness", &scaled).ok()?;
    let moved = vectors.column(0).component_mul(&scale).abs();
    (values[0] > -SEMIDEFINITE).then(|| (moved.imax(), values[0]))
}

/// Eigenvalues (ascending) of $A v = \mu L L^t v$ for a lower triangular $L$ with nonzero diagonal, and the vectors of the lowest
/// `count`, scaled to $V^t L L^t V = I$, from the symmetric problem of $L^{-1} A L^{-t}$ for $L^t v$.
pub(crate) fn pencil_eigen(
    what: &'static str,
    matrix: &DMatrix<f64>,
    lower: &DMatrix<f64>,
    count: usize,
) -> Result<(DVector<f64>, DMatrix<f64>), Error> {
    let (values, vectors) = symmetric_eigen(what, &symmetric_part(&reduced(lower, matrix)))?;
    let mut lowest = vectors.columns(0, count).into_owned();
    lower.tr_solve_lower_triangular_unchecked_mut(&mut lowest);
    Ok((values, lowest))
}

/// A matrix, real or complex, as faer sees it.
pub(crate) fn as_faer<T>(matrix: &DMatrix<T>) -> MatRef<'_, T> {
    MatRef::from_column_major_slice(matrix.as_slice(), matrix.nrows(), matrix.ncols())
}

/// The same matrix back from faer.
pub(crate) fn from_faer(matrix: MatRef<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |row, column| {
        matrix[(row, column)]
    })
}
