//! A weighted correlation beside the paper's step: bounded Gauss–Newton steps on residuals in units of their own
//! standard deviations, and what the test modes can tell of each parameter.
//!
//! The paper lowers $e_f + e_v$, in which every mode and sensor counts alike, and says nothing of how sure its factors are.
//! Here each residual has a weight, so that the sum of squares is the $\chi^2$ of the test, and its curvature the
//! covariance of the factors.

pub mod comparison;
pub mod gauss_newton;
pub mod identifiability;
pub mod residuals;
