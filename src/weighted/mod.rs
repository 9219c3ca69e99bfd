//! A weighted correlation beside the paper's step: bounded Gauss–Newton steps on residuals in units of their standard
//! deviations. Their sum of squares is the test's chi-squared and its curvature says how sure the factors are, which the
//! paper's error sum, where every mode and sensor counts alike, cannot tell.

#[doc(hidden)]
pub mod close_modes;
pub mod comparison;
pub mod gauss_newton;
pub mod identifiability;
pub mod intervals;
pub mod misfit;
pub(crate) mod lower_place;
pub(crate) mod measurements;
pub mod next_step;
pub mod noise;
pub mod residuals;
pub mod second_order;
pub mod starts;
