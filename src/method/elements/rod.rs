//! The rod: an axial member.

use crate::method::error::Error;
use crate::method::linear_algebra::finite;
use nalgebra::{DMatrix, DVector, Vector3};

/// Stiffness of a rod of unit cross section, lbf/in per in² of area (6 × 6; x, y, z of each end).
///
/// $$ K = \frac{E}{L} b b^t, \qquad b = (-n, n), \qquad n = (x_2 - x_1)/L $$
///
/// `youngs_modulus` in lbf/in², `ends` in inches. Rank one: it resists only stretching.
///
/// # Errors
/// [`Error::ZeroLength`] when the ends coincide to working precision.
///
/// Source: Przemieniecki, *Theory of Matrix Structural Analysis*, section 5.2.
pub fn rod(ends: [Vector3<f64>; 2], youngs_modulus: f64) -> Result<DMatrix<f64>, Error> {
    let along = ends[1] - ends[0];
    let length = along.norm();
    // Ends closer than the round-off of their own coordinates have no direction.
    if length.is_nan() || length <= 1e-12 * (ends[0].norm() + ends[1].norm()) {
        return Err(Error::ZeroLength(length));
    }
    let n = along / length;
    let b = DVector::from_iterator(6, (-n).iter().chain(n.iter()).copied());
    finite("element stiffness", (youngs_modulus / length) * &b * b.transpose())
}
