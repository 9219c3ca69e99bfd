//! What can go wrong between a result and its reader.

use crate::cases::error::CaseError;
use crate::files::error::FileError;
use crate::method::error::Error;

/// An error of tables, figures, pages and the files they are written to.
#[derive(Debug, thiserror::Error)]
pub enum PresentError {
    /// What is to be shown cannot be computed.
    #[error(transparent)]
    Method(#[from] Error),
    /// The case to be shown or its data are wrong.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A file or another program fails.
    #[error(transparent)]
    Files(#[from] FileError),
    /// A figure that cannot be drawn.
    #[error("figure {figure}: expected to draw it, found {found}")]
    Drawing {
        /// The figure's name.
        figure: String,
        /// The drawing library's own message.
        found: String,
    },
    /// A page that cannot be put together.
    #[error("page: expected to fill it, found an error: {source}")]
    Page {
        /// The template library's own message.
        source: askama::Error,
    },
}
