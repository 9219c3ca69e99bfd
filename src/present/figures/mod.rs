//! The figures as SVG: drawings that do not know where their data come from, and the paper's figures made from them.
//!
//! The same data give the same bytes. Drawing fails with
//! [`PresentError::Drawing`](crate::present::PresentError::Drawing).

pub mod box_elements;
mod canvas;
mod chart;
mod colors;
pub mod cases;
pub mod comparisons;
pub mod cover_gages;
pub mod error_history;
pub mod factors;
pub mod matrices;
pub mod frame;
pub mod mode_shapes;
pub mod structure;
pub mod report;
mod view;

pub(in crate::present) use cases::SHOWN;
pub use cases::case_figures;
pub use comparisons::comparison_figures;
pub use report::report_figures;

use crate::files::escaped;
use crate::present::PresentError;

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
    fn new(name: &str, caption: impl Into<String>, svg: String) -> Self {
        Self {
            name: name.to_owned(),
            caption: caption.into(),
            svg,
        }
    }
}

/// Numbers from one, as labels.
fn numbers(count: usize) -> Vec<String> {
    (1..=count).map(|number| number.to_string()).collect()
}
