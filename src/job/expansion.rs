//! Test shapes at all degrees of freedom of the model, from the sensors' readings.

use nalgebra::DMatrix;

/// Smallest singular value over the largest, of modes scaled to unit length at the sensors, below which they are dependent there.
const RANK: f64 = 1e-9;

/// Expands test shapes from the sensors to all DOF as the nearest combinations of analysis modes in least squares (SEREP),
///
/// $$ W = V V_s^+ W_s , $$
///
/// for analysis modes `all` $V$ (d × n), the same `at_sensors` $V_s$ (s × n), and `test` shapes $W_s$ (s × g); d × g. None where the sensors
/// do not tell the modes apart, whose least singular value at unit length must be more than `least`.
///
/// Source: O'Callahan, Avitabile and Riemer, *Proc. 7th International Modal Analysis Conference* (1989), 29.
pub fn expand(
    all: &DMatrix<f64>,
    at_sensors: &DMatrix<f64>,
    test: &DMatrix<f64>,
    least: f64,
) -> Option<DMatrix<f64>> {
    let (mut all, mut unit) = (all.clone(), at_sensors.clone());
    for (mode, mut shape) in unit.column_iter_mut().enumerate() {
        all.column_mut(mode).unscale_mut(shape.normalize_mut());
    }
    if unit.ncols() == 0 || unit.ncols() > unit.nrows() || unit.iter().any(|own| !own.is_finite()) {
        return None;
    }
    let svd = unit.try_svd(true, true, f64::EPSILON, 10_000)?;
    let is_full = svd.singular_values.min() > least.max(RANK * svd.singular_values.max());
    let parts = svd.solve(test, 0.0).ok()?;
    is_full.then(|| all * parts)
}

/// The mass at the sensors (s × s) with which n ≤ s modes are orthonormal there, $M_a = (V_s^+)^t V_s^+$: that of the expansion. With
/// it a test shape has the generalized mass of the combination of modes that is nearest to it.
pub fn mass_by_modes(at_sensors: &DMatrix<f64>, least: f64) -> Option<DMatrix<f64>> {
    let (sensors, modes) = at_sensors.shape();
    let one = DMatrix::identity;
    let inverse = expand(
        &one(modes, modes),
        at_sensors,
        &one(sensors, sensors),
        least,
    )?;
    Some(inverse.tr_mul(&inverse))
}
