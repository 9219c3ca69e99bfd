//! Studies beyond the paper's own cases.

pub mod assignment;
pub mod complex_modes;
pub mod delta_wing;
pub mod expansion;
pub mod free_modes;
pub mod known;
pub mod linearization;
pub mod localization;
pub mod matrix_comparison;
pub mod matrix_correction;
pub mod metrics;
pub mod noise;
pub mod preflight;
pub mod weighted;
pub mod whole_modes;
pub mod whole_model;
pub mod wing;
