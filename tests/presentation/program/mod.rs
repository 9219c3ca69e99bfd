//! The program from outside.

pub mod cli;
pub mod cli_environment;
pub mod cli_init;
pub mod cli_jobs;
pub mod cli_places;
mod cli_shapes;
mod cli_shown;
pub mod cli_streams;
pub mod cli_trust;
pub mod deck_cli;
pub mod dump;
pub mod stops;
#[cfg(unix)]
mod transcripts;
