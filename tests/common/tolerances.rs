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
/// Percent errors recomputed from frequencies printed to four digits: half a unit of the last digit of a frequency
/// is 0.02 % of the lowest mode's, and nine of them are squared and summed.
pub const PRINTED_PERCENT: f64 = 0.02;
/// The recursion stops when roots change by less than 1e-13; with changes of some percent each order gains a digit
/// or more, so that what is left is a fraction of that and round-off. Shapes follow the roots times the spread of the
/// spectrum.
pub const CONVERGED_RECURSION: f64 = 1e-12;
/// Slopes this near an order are that order: half way to the next one.
pub const ORDER_SLACK: f64 = 0.45;
/// Errors below this are round-off of roots near one, a few hundred units in the last place.
pub const MEASURABLE_ERROR: f64 = 5e-14;
/// Coefficient of the third-order term of a root relative to the largest stiffness, with neighbours a factor of two
/// apart and couplings up to one; below 3 in five thousand draws.
pub const SECOND_ORDER_REMAINDER: f64 = 10.0;
/// A state by Recursive 1 to roots within 1e-13, whose shapes then enter mass and stiffness products.
pub const CONVERGED_STATE: f64 = 1e-9;
/// Coefficient of the second-order terms of the error sum in the ratio of coupling to separation of two modes.
pub const FIRST_ORDER_REMAINDER: f64 = 10.0;
/// A forward difference of 0.1 % against a central one: half the step times the curvature, relative to the largest
/// derivative.
pub const CENTRAL_DIFFERENCE: f64 = 0.01;
/// Two update rules exact to 1e-13 in roots through the same two dozen iterations, each of which multiplies what
/// differs; the same reason as `GOLDEN_RELATIVE`, on one machine.
pub const SAME_HISTORY: f64 = 1e-6;
