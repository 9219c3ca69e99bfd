//! Decks, the solver, and ground vibration tests.

pub mod deck;
pub mod deck_cards;
pub mod deck_errors;
pub mod deck_errors_lines;
pub mod deck_mass_law;
pub mod deck_modes;
pub mod deck_numbers;
pub mod deck_reading;
pub mod deck_rewrite;
pub mod deck_rewrite_drawn;
pub mod matrices;
pub mod matrices_damaged;
pub mod readers_survive;

pub mod test_data;
pub mod test_data_csv;
pub mod test_data_pyuff;
pub mod test_data_universal;
pub mod test_data_axes;

pub mod nastran95_analysis;
pub mod nastran95_bounds;
pub mod nastran95_delta_wing;
pub mod nastran95_model;
pub mod nastran95_outer_loop;
pub mod nastran95_output5;
pub mod nastran95_process;
pub mod nastran95_program;

pub mod job_errors;
pub mod job_matrices;
pub mod job_prepared;
pub mod job_results;
pub mod jobs;
pub mod study;
pub mod study_draws;
