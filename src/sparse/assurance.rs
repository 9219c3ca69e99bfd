//! Modal assurance: how alike shapes are at sensors, without a mass.

use super::finite;
use crate::method::error::{Error, positive};
use crate::method::linear_algebra::check_shape;
use crate::method::modes::mode;
use nalgebra::DMatrix;

/// Modal assurance criterion between two sets of shapes (columns), n × g:
///
/// $$ \mathrm{MAC}_{ij} = \frac{(v_i^t w_j)^2}{(v_i^t v_i)(w_j^t w_j)} $$
///
/// Source: Allemang and Brown, *Proc. 1st International Modal Analysis Conference* (1982), 110.
///
/// # Errors
/// [`Error::WrongShape`] when the shapes have different numbers of DOF; [`Error::Value`] naming a shape that is zero, or an entry that is
/// not finite.
///
/// # Example
///
/// ```rust
/// use corfem::sparse::modal_assurance;
/// use nalgebra::dmatrix;
///
/// // (3 · 1)² / (3² + 4²): neither scale nor sign counts.
/// let assurance = modal_assurance(&dmatrix![3.0; 4.0], &dmatrix![-1.0; 0.0])?;
/// assert!((assurance[0] - 0.36).abs() < 1e-15);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn modal_assurance(
    shapes: &DMatrix<f64>,
    others: &DMatrix<f64>,
) -> Result<DMatrix<f64>, Error> {
    check_shape("mode shapes", others, shapes.nrows(), others.ncols())?;
    for (of, shapes) in [("shape of", shapes), ("other shape of", others)] {
        for (place, shape) in shapes.column_iter().enumerate() {
            let owner = || format!("{of} {}", mode(place));
            positive("largest component", owner, shape.amax())?;
        }
    }
    Ok(signed_assurance(shapes, others)?.abs())
}

/// Modal assurance with the sign of the product $v_i^t w_j$, and zero for a shape that is zero.
fn signed_assurance(shapes: &DMatrix<f64>, others: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    check_shape("mode shapes", others, shapes.nrows(), others.ncols())?;
    // Of a largest component of one to two: squares of very large or small ones leave the range of numbers. A power of two is
    // exact.
    let unit = |shapes: &DMatrix<f64>| {
        let mut unit = shapes.clone();
        for mut shape in unit.column_iter_mut() {
            let largest = shape.amax();
            if largest > 0.0 {
                shape /= largest.log2().floor().exp2();
            }
        }
        unit
    };
    let (shapes, others) = (unit(shapes), unit(others));
    let squares = [&shapes, &others].map(|shapes| -> Vec<f64> {
        let columns = shapes.column_iter();
        columns.map(|shape| shape.norm_squared()).collect()
    });
    // The kernels of other products may leave wide registers in use, with which each logarithm of a pairing takes ten times as long.
    let cross = shapes.transpose() * &others;
    let assurance = cross.map_with_location(|i, j, product| match product {
        0.0 => 0.0,
        _ => product * product.abs() / (squares[0][i] * squares[1][j]),
    });
    finite("modal assurance", assurance)
}

/// Cosines between two sets of shapes, whose squares are their modal assurance; zero for a shape that is zero.
pub(crate) fn cosines(shapes: &DMatrix<f64>, others: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    Ok(signed_assurance(shapes, others)?.map(|close| close.signum() * close.abs().sqrt()))
}
