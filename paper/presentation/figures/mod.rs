//! The figures as SVG: drawings that do not know where their data come from, those of a report, and those of the box.
//!
//! The same data give the same bytes. Drawing fails with
//! [`PresentError::Drawing`](corfem::present::PresentError::Drawing).

pub mod box_elements;
pub mod canvas;
pub mod cases;
pub mod chart;
pub mod colors;
pub mod comparisons;
pub mod cover_gages;
pub mod error_history;
pub mod factors;
pub mod matrices;
pub mod mode_shapes;
pub mod report;
pub mod structure;
pub mod view;

pub use cases::{SHOWN, case_figures};
pub use comparisons::comparison_figures;
pub use report::report_figures;

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

/// Numbers from one, as labels.
pub fn numbers(count: usize) -> Vec<String> {
    (1..=count).map(|number| number.to_string()).collect()
}
