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
/// A force or moment that balancing leaves, relative to the sum of the magnitudes of its parts: sums over a dozen DOF.
pub const BALANCE_RESIDUAL: f64 = 1e-12;
/// Coefficients of {1} and {x}, 200 in from the reference axis on structures 20 in long: the balance equations have a
/// condition of some 1e4 when their unknowns are scaled alike.
pub const BALANCE_EQUATIONS: f64 = 1e-10;
/// What an eigensolution leaves of ω²Mv = Kv for the lowest modes, relative; scaled by the spread of ω² where used.
pub const EXACT_MODE_RESIDUAL: f64 = 1e-11;
/// Modes orthogonal to a matrix product's round-off, after a Cholesky factor and an eigensolution of a matrix that is
/// diagonal to that round-off.
pub const ORTHOGONAL_INPUT: f64 = 1e-11;
/// A slope over a decade and a half of noise below 0.3 %: the next order contributes a few percent at the upper end.
pub const ASYMPTOTIC_SLOPE: f64 = 0.1;
/// The balance equations with the reference axis a thousand lengths away, where their condition is 6e6.
pub const FAR_REFERENCE_AXIS: f64 = 1e-8;
