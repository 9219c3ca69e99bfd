//! A weighted correlation beside the paper's step: bounded Gauss–Newton steps on residuals in units of their standard
//! deviations. Their sum of squares is the test's chi-squared and its curvature says how sure the factors are, which the
//! paper's error sum, where every mode and sensor counts alike, cannot tell.

pub mod close_modes;
pub mod gauss_newton;
pub mod identifiability;
pub mod intervals;
pub mod misfit;
pub mod next_step;
pub mod noise;
pub mod residuals;
pub mod starts;
