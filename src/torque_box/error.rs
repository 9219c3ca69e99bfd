//! Errors of the paper's cases and their data, beside those of the method itself.

use serde::de::DeserializeOwned;
use thiserror::Error;

/// An error of a case, of its torque box or of a published table. The message above a variant is the documentation of its fields.
#[derive(Debug, Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "a variant's message says what its fields are")]
pub enum CaseError {
    /// The method refuses its input or cannot go on.
    #[error(transparent)]
    Method(#[from] crate::method::error::Error),
    /// A case that the paper does not have.
    #[error("there is no case {found}; choose 1 to 4")]
    UnknownCase { found: usize },
    /// A torque box lacks one of its grid points.
    #[error("torque box: grid {grid} of 1 to {count} is missing")]
    MissingGrid { grid: usize, count: usize },
    /// Data that cannot be read as TOML of the expected form.
    #[error("{name} is not {expected}: {source}")]
    Toml {
        name: String,
        expected: &'static str,
        source: Box<toml::de::Error>,
    },
    /// A table that cannot be read as CSV of the expected form.
    #[error("{name}: {found} instead of {expected}")]
    Table {
        name: String,
        expected: String,
        found: String,
    },
}

impl CaseError {
    pub(crate) fn table(name: &str, expected: String, found: impl Into<String>) -> Self {
        Self::Table {
            name: name.to_owned(),
            expected,
            found: found.into(),
        }
    }
}

/// Reads TOML text; the error states `name` and what is `expected`.
pub(crate) fn read_toml<T: DeserializeOwned>(
    name: &str,
    expected: &'static str,
    text: &str,
) -> Result<T, CaseError> {
    let wrong = |source| CaseError::Toml {
        name: name.to_owned(),
        expected,
        source: Box::new(source),
    };
    toml::from_str(text).map_err(wrong)
}
