//! Measures of the agreement of analysis and test modes, beside [`modal_assurance`](crate::sparse::modal_assurance) and
//! [`cross_orthogonality`](crate::method::sorting::cross_orthogonality).
//!
//! AutoMAC is the modal assurance of a set of shapes with itself: modes with large off-diagonal entries are ones that the sensors cannot tell apart.

use crate::method::error::{Error, at_least_one, positive};
use crate::method::linear_algebra::{check_finite, check_length, check_shape};
use nalgebra::{DMatrix, DVector};

/// Coordinate modal assurance (COMAC) of every DOF over paired modes of analysis (d × n) and test (d × g), d numbers from 0 to 1:
///
/// $$ c_p = \frac{(\sum_l |v_{pl} w_{pl}|)^2}{\sum_l v_{pl}^2 \sum_l w_{pl}^2} $$
///
/// for shapes of unit length, so that scale and sign do not matter. `pairs` has the analysis mode of every test mode,
/// or none, as [`pair_optimally`](crate::job::assignment::pair_optimally) gives it. A DOF that does not move on
/// either side has 1, one that moves on one side only has 0. A low value names a sensor at fault or a place where the
/// model is wrong, or one that moves little. Source: Lieven and Ewins, *Proc. 6th International Modal Analysis
/// Conference* (1988), 690.
///
/// # Errors
/// [`Error::WrongShape`]; [`Error::Count`] without a pair; [`Error::Unknown`] for a pair with a mode that is not there;
/// [`Error::Value`]; [`Error::Value`] for a shape that is zero.
pub fn coordinate_assurance(
    analysis: &DMatrix<f64>,
    test: &DMatrix<f64>,
    pairs: &[Option<usize>],
) -> Result<DVector<f64>, Error> {
    check_shape("test mode shapes", test, analysis.nrows(), test.ncols())?;
    check_length("pairs", pairs.len(), test.ncols())?;
    let (tests, modes): (Vec<usize>, Vec<usize>) = pairs
        .iter()
        .enumerate()
        .filter_map(|(j, mode)| Some((j, (*mode)?)))
        .unzip();
    if let Some(&label) = modes.iter().find(|mode| **mode >= analysis.ncols()) {
        return Err(Error::Unknown {
            owner: "pairs".to_owned(),
            what: "analysis mode (from zero)",
            label,
        });
    }
    at_least_one("pairs", modes.len())?;
    let v = scaled("paired analysis", &analysis.select_columns(&modes))?;
    let w = scaled("paired test", &test.select_columns(&tests))?;
    let assurance = v
        .row_iter()
        .zip(w.row_iter())
        .map(|(v, w)| match (v.norm(), w.norm()) {
            (0.0, 0.0) => 1.0,
            (0.0, _) | (_, 0.0) => 0.0,
            (one, other) => ((v / one).abs().dot(&(w / other).abs())).powi(2).min(1.0),
        });
    Ok(DVector::from_iterator(v.nrows(), assurance))
}

/// The shapes with unit length.
fn scaled(of: &str, shapes: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    check_finite("mode shapes", shapes)?;
    let mut scaled = shapes.clone();
    for (mode, mut shape) in scaled.column_iter_mut().enumerate() {
        let largest = shape.amax();
        positive(
            "largest component",
            || format!("{of} mode {mode} (from zero)"),
            largest,
        )?;
        // In two steps: squares of very large or small components leave the range of numbers.
        shape /= largest;
        shape.normalize_mut();
    }
    Ok(scaled)
}
