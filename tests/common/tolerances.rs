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
/// A node line is a quadratic's zero carried through a bilinear map and back by Newton's iteration: some ten roundings of
/// displacements whose largest is one, times the slope of the map.
pub const NODE_LINE: f64 = 1e-9;
/// Logarithmic derivatives of frequencies by fourth-order central differences of 0.2 %: eigenvalues over a range of 1e5
/// round at 1e-11, which 1.5 over the step makes 1e-8; truncation is the step's fourth power.
pub const CENTRAL_DIFFERENCE_FREQUENCY: f64 = 1e-7;
