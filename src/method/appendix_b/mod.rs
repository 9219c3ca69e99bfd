//! Appendix B: measured modes made fit for correlation.
//!
//! Measured modes violate equilibrium and orthogonality by the errors of the test. Three steps, in order:
//!
//! 1. [`balance`] adds to every shape the rigid-body motion that brings its forces and moments to zero (B.1 to B.4);
//!    [`rigid_body_vectors`] writes those motions for given measuring points.
//! 2. [`orthogonalize`] solves for the combinations of the shapes that are orthogonal in mass (B.5 to B.7).
//! 3. [`examine`] does both, reports how far each mode moved, and leaves out the modes that moved past the limits.
//!
//! Only free and softly suspended structures are balanced: where supports hold the structure, their reactions balance
//! the forces, which are then not zero at the dynamic DOF.

mod balance;
mod examine;
mod orthogonalize;
mod rigid_body;

pub use balance::{Balanced, LARGEST_SUSPENSION_RATIO, balance};
pub use examine::{Examination, ModeReport, ModeVerdict, MovementLimits, Supports, examine};
pub use orthogonalize::{Movement, Orthogonalized, generalized_mass, orthogonalize};
pub use rigid_body::{ANTISYMMETRIC, MeasuringPoint, Motion, SYMMETRIC, rigid_body_vectors};

use crate::method::error::Error;
use crate::method::linear_algebra::{check_finite, check_shape, cholesky};
use crate::method::modes::ModeSet;
use crate::method::structure::positive;
use nalgebra::{DMatrix, DVector};

/// Every shape's generalized mass $v_i^t M v_i$, after refusing test modes and masses that no step can work with.
fn checked_generalized_masses(raw: &ModeSet, mass: &DMatrix<f64>) -> Result<DVector<f64>, Error> {
    if raw.is_empty() {
        return Err(Error::Empty { what: "test modes" });
    }
    cholesky("dynamic mass", mass, 0.0)?;
    check_shape("test mode shapes", &raw.shapes, mass.nrows(), raw.len())?;
    check_finite("test mode shapes", &raw.shapes)?;
    let weighted = mass * &raw.shapes;
    let masses = DVector::from_fn(raw.len(), |mode, _| raw.shapes.column(mode).dot(&weighted.column(mode)));
    for mode in 0..raw.len() {
        let owner = || format!("test mode {mode} (from zero)");
        positive("squared circular frequency", owner, raw.omega_squared[mode])?;
        positive("generalized mass", owner, masses[mode])?;
    }
    Ok(masses)
}
