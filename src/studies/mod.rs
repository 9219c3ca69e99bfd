//! Studies beyond the paper's own cases.

pub mod delta_wing;
pub mod known;
pub mod linearization;
pub mod localization;
pub mod matrix_comparison;
pub mod matrix_correction;
pub mod wing;
