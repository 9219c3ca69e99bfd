//! What can go wrong between a result and its reader.

use crate::method::error::Error;
use std::path::{Path, PathBuf};

/// An error of tables, figures, pages and the files they are written to.
#[derive(Debug, thiserror::Error)]
pub enum PresentError {
    /// What is to be shown cannot be computed.
    #[error(transparent)]
    Method(#[from] Error),
    /// A figure that cannot be drawn.
    #[error("figure {figure}: expected to draw it, found {found}")]
    Drawing {
        /// The figure's name.
        figure: String,
        /// The drawing library's own message.
        found: String,
    },
    /// A document that cannot be written as JSON.
    #[error("JSON: expected to write the document, found an error: {0}")]
    Json(#[from] serde_json::Error),
    /// A file that cannot be read or written.
    #[error("{path}: expected to {action} it, found an error: {source}")]
    File {
        /// The file.
        path: PathBuf,
        /// `read` or `write`.
        action: &'static str,
        /// The operating system's message.
        source: std::io::Error,
    },
}

impl PresentError {
    /// Makes an error of the operating system one of a file, for `map_err`.
    pub fn file(path: &Path, action: &'static str) -> impl FnOnce(std::io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self::File {
            path,
            action,
            source,
        }
    }
}
