//! The one ledger of tolerances. Each line says why it is what it is; no test has a tolerance of its own.

/// A few roundings of numbers of order one.
pub const ROUND_OFF: f64 = 1e-13;
/// A matrix product chain of a dozen DOF, relative to its largest entry.
pub const MATRIX_ROUND_OFF: f64 = 1e-11;
/// Two dense eigensolvers on the same matrix, relative to the eigenvalue; scaled by the condition number where used.
pub const EIGEN_ROUND_OFF: f64 = 1e-11;
/// NASTRAN-95 holds geometry and material in single precision; relative to the largest entry.
pub const NASTRAN_SINGLE_PRECISION: f64 = 3e-7;
/// The independent program writes ten digits and steps through some thirty finite-difference iterations.
pub const EXPECTED_HISTORY: f64 = 1e-5;
/// The independent program's exact frequencies, ten digits written, another quadrature order of summation.
pub const EXPECTED_FREQUENCY: f64 = 1e-6;
/// Twelve-point quadrature of a strongly distorted panel against its closed form.
pub const QUADRATURE_DISTORTED: f64 = 1e-6;
/// A measured order of convergence falls short of the theoretical one by this much where the next order still shows.
pub const ORDER_SLACK: f64 = 0.15;
/// Complex eigensolutions of pencils of six DOF, conditions of stiffness and shapes a few hundred together.
pub const COMPLEX_EIGEN_ROUND_OFF: f64 = 1e-10;
/// A relative separation of 1e-10 is a difference of numbers of order one: six digits are left, half of them asked for.
pub const CANCELLED_DIFFERENCE: f64 = 1e-3;
