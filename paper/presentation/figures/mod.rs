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

use canvas::{NARROW, PresentError, WIDE};

/// A figure, drawn in two forms.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Name for files, such as `case_1_errors`.
    pub name: String,
    /// Words on what to see in it.
    pub caption: String,
    /// The drawing, 760 px wide.
    pub svg: String,
    /// The drawing for pages narrower than 640 px.
    pub narrow: String,
}

impl Figure {
    /// A figure, drawn in its two widths, px.
    ///
    /// # Errors
    /// Those of the drawing.
    pub fn drawn(
        name: &str,
        caption: impl Into<String>,
        draw: impl Fn(f64) -> Result<String, PresentError>,
    ) -> Result<Self, PresentError> {
        Ok(Self {
            name: name.to_owned(),
            caption: caption.into(),
            svg: draw(WIDE)?,
            narrow: draw(NARROW)?,
        })
    }

    /// The names of its files, with what stands in them.
    pub fn files(self) -> [(String, String); 2] {
        let Self {
            name, svg, narrow, ..
        } = self;
        [
            (format!("{name}.svg"), svg),
            (format!("{name}_narrow.svg"), narrow),
        ]
    }
}

/// Numbers from one, as labels.
pub fn numbers(count: usize) -> Vec<String> {
    (1..=count).map(|number| number.to_string()).collect()
}
