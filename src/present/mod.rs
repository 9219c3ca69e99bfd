//! The reader's view of results: tables as data and as text, Markdown or CSV, JSON, and the report as one page.
//!
//! A [`report::Report`] is a finished job as rows with all that a reader needs; tables, CSV, JSON and the page are views of it. The paper's
//! cases, which `paper/presentation` shows, share rows of modes and what draws and renders them.

#[doc(hidden)]
pub mod check;
pub mod compared;
#[doc(hidden)]
pub mod deck;
#[doc(hidden)]
pub mod drawing;
#[doc(hidden)]
pub mod json;
#[doc(hidden)]
pub mod page;
#[doc(hidden)]
pub mod render;
pub mod report;
#[doc(hidden)]
pub mod table;
#[doc(hidden)]
pub mod universal;
#[doc(hidden)]
pub mod views;

use crate::files::error::FileError;
use crate::method::error::Error;
use crate::torque_box::error::CaseError;

/// An error of tables, figures, pages and the files they are written to. The message above a variant is the documentation of its
/// fields.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "a variant's message says what its fields are")]
pub enum PresentError {
    /// A number to be shown that cannot be computed.
    #[error(transparent)]
    Method(#[from] Error),
    /// The case to be shown or its data are wrong.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A file or another program fails.
    #[error(transparent)]
    Files(#[from] FileError),
    /// A figure that cannot be drawn.
    #[error("cannot draw figure {figure}: {found}")]
    Drawing { figure: String, found: String },
    /// A document that cannot be written as JSON.
    #[error("cannot write the JSON document: {0}")]
    Json(#[from] serde_json::Error),
}
