//! The report: tables as data first, then their rendering.

pub mod correlation_tables;
pub mod deck_tables;
pub mod delta_wing_correlation;
pub mod delta_wing_json;
pub mod delta_wing_tables;
pub mod fewer_modes_tables;
pub mod json;
pub mod matrix_tables;
pub mod render;
pub mod root_errors;
pub mod run_tables;
pub mod table;
pub mod truncation_tables;

pub use render::{Format, render};
