//! What a reader sees: tables as data and as text, Markdown or CSV, JSON, figures, and the report as one page.
//!
//! A [`subject::Subject`] is any correlation with what a reader must know of it; [`tables::subject`], [`figures::subject`],
//! [`json::subject`] and [`page::subject_page`] show it. The paper's cases and the delta wing are subjects with more beside them.

pub mod dump;
pub mod error;
pub mod figures;
pub mod json;
pub mod page;
pub mod render;
pub mod subject;
pub mod table;
pub mod tables;

pub use error::PresentError;
