//! The one ledger of tolerances. Each line says why it is what it is; no test has a tolerance of its own.

/// A few roundings of numbers of order one.
pub const ROUND_OFF: f64 = 1e-13;
/// A matrix product chain of a dozen DOF, relative to its largest entry.
pub const MATRIX_ROUND_OFF: f64 = 1e-11;
/// Round-off of a solution per unit of its matrix's condition number: some fifty roundings.
pub const CONDITIONED_ROUND_OFF: f64 = 1e-14;
/// A difference of a hundred-millionth of its terms, relative: what is left of sixteen digits, and some.
pub const DIFFERENCE_ROUND_OFF: f64 = 1e-6;
/// An eigenvalue of 3e-15 of the largest, relative: a tenth of it is one rounding of the largest.
pub const SMALLEST_EIGENVALUE: f64 = 0.1;
/// Two routes to the free motion of a mechanism, of its largest component: inverse iteration sheds the other motions to
/// 1e-10 a step.
pub const SAME_MOTION: f64 = 1e-6;
/// Part of the mean over all free motions above which a DOF takes part in them: the one that moves most in some of
/// them may have less than the mean over all, one that is held has nothing but round-off.
pub const TAKES_PART: f64 = 1e-2;
/// Eigenvalue over the largest of its matrix below which it is zero: element matrices leave 1e-15 where the theory has
/// zero, and the strategies' panels have nothing below 1e-3 where it has not.
pub const RANK_THRESHOLD: f64 = 1e-9;
/// Element matrices computed in two frames: coordinates 100 in from the origin carry 1e-13 of a panel's size, and
/// the strategies' distortion multiplies that by ten or so; relative to the largest entry.
pub const ELEMENT_ROUND_OFF: f64 = 1e-11;
/// Quadrature of a trapezoid tapered to no less than 0.3 against its closed form: what twelve points leave.
pub const QUADRATURE_TRAPEZOID: f64 = 5e-10;
/// The closed form of a panel without parallel sides: its terms exceed their sum some ten thousand times when
/// opposite sides meet five sides away, and more beyond.
pub const CLOSED_FORM_GENERAL: f64 = 1e-11;
/// An order of convergence read off a log-log slope, where the next order's share is still a few percent.
pub const SLOPE: f64 = 0.05;
/// Two dense eigensolvers on the same matrix, relative to the eigenvalue; scaled by the condition number where used.
pub const EIGEN_ROUND_OFF: f64 = 1e-11;
/// NASTRAN-95 holds geometry and material in single precision; relative to the largest entry.
pub const NASTRAN_SINGLE_PRECISION: f64 = 3e-7;
/// Eigenvalues of NASTRAN-95's own matrices against those of double-precision ones.
pub const NASTRAN_EIGENVALUE: f64 = 1e-6;
/// Eigenvalues that NASTRAN-95's own methods found, printed with seven digits of which it gets about six right.
pub const NASTRAN_PRINTED_EIGENVALUE: f64 = 5e-6;
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
