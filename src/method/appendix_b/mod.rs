//! Appendix B: measured modes made fit for correlation.
//! Tour: [chapter 9](crate::tour::chapter_09_noise).
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

pub use balance::{
    ANTISYMMETRIC, Balanced, LARGEST_SUSPENSION_RATIO, MeasuringPoint, Motion, SYMMETRIC, balance,
    rigid_body_vectors,
};
pub use examine::{Examination, ModeReport, ModeVerdict, MovementLimits, Supports, examine};
pub use orthogonalize::{Movement, Orthogonalized, generalized_mass, orthogonalize};
