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
/// Goldens on another machine: the inner loop steps through some thirty finite-difference iterations, each of which
/// multiplies a difference in the last digit; two builds of the independent program differ by 1e-6.
pub const GOLDEN_RELATIVE: f64 = 1e-5;
/// Goldens of percent errors, which are differences of numbers that agree to `GOLDEN_RELATIVE`.
pub const GOLDEN_ABSOLUTE_PERCENT: f64 = 1e-4;
/// A measured order of convergence falls short of the theoretical one by this much where the next order still shows.
pub const ORDER_SLACK: f64 = 0.15;
/// Complex eigensolutions of pencils of six DOF, conditions of stiffness and shapes a few hundred together.
pub const COMPLEX_EIGEN_ROUND_OFF: f64 = 1e-10;
/// A derivative of the error sum by a 0.1 % change and first order, beside exact differences with the same step: what is
/// left is of second order in the change, a thousandth of a derivative of order one.
pub const FORWARD_DIFFERENCE: f64 = 2e-3;
