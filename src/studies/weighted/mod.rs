//! A weighted correlation beside the paper's step: bounded Gauss–Newton steps on residuals in units of their own
//! standard deviations, and what the test modes can tell of each parameter.
//!
//! The paper lowers $e_f + e_v$, in which every mode and every sensor counts alike, and says nothing of how sure its factors
//! are. Here each residual has a weight, so that the sum of squares is the $\chi^2$ of the test, and its curvature the
//! covariance of the factors. [`residuals`] are compared by exact modes, [`gauss_newton`] steps from one exact analysis to the
//! next, [`identifiability`] says what the data can see, [`comparison`] runs both rules side by side.

pub mod comparison;
pub mod gauss_newton;
pub mod identifiability;
pub mod residuals;

pub use comparison::{Compared, RuleResult, compare_all};
pub use gauss_newton::{
    SeveralStarts, Swap, WeightedCorrelation, WeightedIteration, WeightedSettings, WeightedStop, from_several_starts,
    gauss_newton,
};
pub use identifiability::{Identifiability, Parallel, identifiability};
pub use residuals::{DEVIATIONS, Weights, jacobian, residuals};
