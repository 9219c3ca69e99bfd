//! Studies beyond the paper's own cases.

pub mod assignment;
pub mod complex_modes;
pub mod delta_wing;
pub mod expansion;
pub mod known;
pub mod linearization;
pub mod localization;
pub mod matrix_comparison;
pub mod matrix_correction;
pub mod metrics;
pub mod preflight;
pub mod wing;
