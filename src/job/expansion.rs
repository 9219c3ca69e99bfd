//! Test shapes at all degrees of freedom of the model, from the sensors' readings.

use crate::method::error::Error;
use crate::method::error::check_count;
use crate::method::linear_algebra::{check_finite, check_shape};
use crate::sparse::finite;
use nalgebra::DMatrix;

/// Smallest singular value over the largest, of modes scaled to unit length at the sensors, below which they are dependent there.
const RANK: f64 = 1e-9;

/// Expands test shapes from the sensors to all DOF as the nearest combinations of analysis modes in least squares (SEREP),
///
/// $$ W = V V_s^+ W_s , $$
///
/// for analysis modes `all` $V$ (d × n), the same `at_sensors` $V_s$ (s × n), and `test` shapes $W_s$ (s × g); d × g.
///
/// # Errors
/// [`Error::Count`] without modes, or for more of them than sensors; [`Error::NotPositiveDefinite`] naming the first mode that
/// the sensors do not see or cannot tell from those before it; [`Error::WrongShape`] and [`Error::Value`] for shapes that do not fit or are not finite.
///
/// Source: O'Callahan, Avitabile and Riemer, *Proc. 7th International Modal Analysis Conference* (1989), 29.
pub fn expand(
    all: &DMatrix<f64>,
    at_sensors: &DMatrix<f64>,
    test: &DMatrix<f64>,
) -> Result<DMatrix<f64>, Error> {
    let what = "analysis mode at the sensors";
    let (sensor_count, mode_count) = at_sensors.shape();
    check_count(
        "analysis modes for these sensors",
        mode_count,
        1,
        sensor_count,
    )?;
    check_shape(
        "analysis modes at all degrees of freedom",
        all,
        all.nrows(),
        mode_count,
    )?;
    check_shape("test mode shapes", test, sensor_count, test.ncols())?;
    check_finite(what, at_sensors)?;
    let (mut all, mut unit) = (all.clone(), at_sensors.clone());
    for (index, mut shape) in unit.column_iter_mut().enumerate() {
        all.column_mut(index).unscale_mut(shape.norm());
        if !shape.normalize_mut().is_normal() {
            return Err(Error::NotPositiveDefinite { what, row: index });
        }
    }
    let decomposed = |count: usize| {
        let first = unit.columns(0, count).into_owned();
        first
            .try_svd(true, true, f64::EPSILON, 10_000)
            .ok_or(Error::no_convergence(what))
    };
    let full_rank = |count| {
        decomposed(count).map(|svd| svd.singular_values.min() >= RANK * svd.singular_values.max())
    };
    if !full_rank(mode_count)? {
        let index = (1..mode_count)
            .find(|&index| !full_rank(index + 1).unwrap_or(true))
            .unwrap_or_default();
        return Err(Error::NotPositiveDefinite { what, row: index });
    }
    let shares = decomposed(mode_count)?
        .solve(test, 0.0)
        .map_err(|_| Error::no_convergence(what))?;
    finite("expanded test shapes", all * shares)
}

/// The mass at the sensors (s × s) with which n ≤ s modes are orthonormal there, $M_a = (V_s^+)^t V_s^+$: that of the expansion. With
/// it a test shape has the generalized mass of the combination of modes that is nearest to it.
///
/// # Errors
/// The errors of [`expand`].
///
/// Source: as for [`expand`].
pub fn mass_by_modes(at_sensors: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    let (sensors, modes) = at_sensors.shape();
    let inverse = expand(
        &DMatrix::identity(modes, modes),
        at_sensors,
        &DMatrix::identity(sensors, sensors),
    )?;
    Ok(inverse.tr_mul(&inverse))
}
