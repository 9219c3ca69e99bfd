//! What the studies of `paper/studies` must show beyond their tables, which `cargo bench --bench studies -- --check` holds against the
//! goldens; and comparisons with other programs. Nothing here runs a user's structure.

pub mod certified;
pub mod claims;
pub mod enclosed;
pub mod next_step;

pub use crate::common::presentation::studies::*;
