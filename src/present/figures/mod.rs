//! The figures as SVG: drawings that do not know where their data come from, and those of a report.
//!
//! The same data give the same bytes. Drawing fails with
//! [`PresentError::Drawing`](crate::present::PresentError::Drawing).

pub mod canvas;
pub mod chart;
mod colors;
pub mod error_history;
pub mod factors;
pub mod matrices;
pub mod frame;
pub mod mode_shapes;
pub mod structure;
pub mod report;
pub mod view;

pub use report::report_figures;

/// A figure, drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Name for files, such as `case_1_errors`.
    pub name: String,
    /// Words on what to see in it.
    pub caption: String,
    /// The drawing.
    pub svg: String,
}

impl Figure {
    /// A figure of these parts.
    pub fn new(name: &str, caption: impl Into<String>, svg: String) -> Self {
        Self {
            name: name.to_owned(),
            caption: caption.into(),
            svg,
        }
    }
}

/// Numbers from one, as labels.
pub fn numbers(count: usize) -> Vec<String> {
    (1..=count).map(|number| number.to_string()).collect()
}
