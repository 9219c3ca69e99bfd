//! Studies beyond the paper.

pub mod delta_wing;
pub mod delta_wing_answers;
pub mod delta_wing_correlation;
pub mod delta_wing_scenario;

pub mod matrix_comparison;
pub mod matrix_comparison_elements;
pub mod matrix_correction;

pub mod assignment;
pub mod complex_modes;
pub mod expansion;
pub mod metrics;

pub mod condensation;
pub mod free_modes;
pub mod noisy_modes;

pub mod preflight;
pub mod preflight_modes;
pub mod preflight_orders;
pub mod preflight_rates;

pub mod whole_model;
pub mod whole_model_modes;
pub mod whole_model_pencils;
pub mod weighted;
pub mod weighted_coverage;
pub mod weighted_steps;

pub mod localization;

pub mod eigensolutions;
pub mod linearization;
pub mod wing;
