//! What a reader sees: tables as data and as text, Markdown or CSV, JSON, figures, and the report as one page.
//!
//! [`tables`] and [`figures`] each have functions that know any correlation by its names, its test modes and its
//! [`crate::method::outer_loop::Correlation`]; what the paper's cases and the studies add is built from these.

pub mod error;
pub mod figures;
pub mod json;
pub mod page;
pub mod render;
pub mod table;
pub mod tables;

pub use error::PresentError;
