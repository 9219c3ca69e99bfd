//! What is not the paper: structures of any size, weighted steps, pre-flight, and that the text, the machine and the plain program are one.

mod next_measurement;
pub mod any_size;
pub mod assignment;
pub mod intervals;
pub mod linear_algebra;
pub mod localization;
pub mod misfit;
pub mod plain_program;
pub mod preflight;
pub mod second_order;
pub mod two_programs;
pub mod weighted;
pub mod weighted_components;
pub mod weighted_coverage;
pub mod weighted_laws;
pub mod weighted_masses;
pub mod weighted_metamorphic;
pub mod weighted_steps;
