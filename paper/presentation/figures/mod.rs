//! The paper's figures as SVG.
//!
//! The same data give the same bytes. Drawing fails with
//! [`PresentError::Drawing`](corfem::present::PresentError::Drawing).

pub mod box_elements;
pub mod canvas;
pub mod cases;
pub mod chart;
pub mod colors;
pub mod cover_gages;
pub mod error_history;
pub mod mode_shapes;
pub mod structure;
pub mod view;

pub use cases::{SHOWN, case_figures};

use colors::with_dark;

/// A figure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Name for files, such as `case_1_errors`.
    pub name: String,
    /// Words on what to see in it.
    pub caption: String,
    /// The drawing, 760 px wide.
    pub svg: String,
}

impl Figure {
    /// A figure of a drawing, which gets its colors on a dark page.
    pub fn drawn(name: &str, caption: impl Into<String>, svg: &str) -> Self {
        Self {
            name: name.to_owned(),
            caption: caption.into(),
            svg: with_dark(svg),
        }
    }
}
