//! What the corrections do to the dynamic stiffness, entry by entry.

use super::canvas::{Area, BLUE, Drawn, LETTERS, Letters, Side, VERMILION, WIDTH, svg, write};
use super::heat_map::{HeatMap, percent};
use crate::present::error::PresentError;
use crate::studies::matrix_comparison::MatrixComparison;
use nalgebra::DMatrix;

/// The change of one model's stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelChange {
    /// Which model.
    pub model: String,
    /// $\Delta K_{ij}/\sqrt{K_{ii} K_{jj}}$ with the stiffness before (d × d).
    pub entries: DMatrix<f64>,
}

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct StiffnessChange {
    /// Case number.
    pub case: usize,
    /// Number of test modes that the corrections were given.
    pub test_modes: usize,
    /// The change that is right and those of the corrections.
    pub models: Vec<ModelChange>,
}

/// Changes of the stiffness from a comparison: the truth's and every correction's.
pub fn stiffness_change(comparison: &MatrixComparison) -> StiffnessChange {
    // The first prediction is the start, which changes nothing.
    let models = comparison.predictions.iter().skip(1).map(|prediction| {
        let rows = &prediction.stiffness_change;
        ModelChange {
            model: prediction.model.to_owned(),
            entries: DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i][j]),
        }
    });
    StiffnessChange { case: comparison.case, test_modes: comparison.test_modes, models: models.collect() }
}

/// Left edges and upper edges of the matrices, px.
const LEFT: [f64; 2] = [66.0, 446.0];
const TOP: [f64; 2] = [64.0, 424.0];

impl StiffnessChange {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let title = format!("Case {}: change of the dynamic stiffness, entry by entry", self.case);
        svg("matrices_stiffness", &title, (WIDTH, 780.0), |area| self.on(area))
    }

    fn on(&self, area: &Area) -> Drawn {
        // One scale for all, so that a pale matrix is a small change.
        let full = self.models.iter().map(|model| model.entries.amax()).fold(0.0, f64::max);
        for (place, model) in self.models.iter().enumerate() {
            let numbers = || (1..=model.entries.nrows()).map(|dof| dof.to_string());
            HeatMap {
                values: &model.entries.map(Some),
                title: &model.model,
                row_heading: "dynamic point",
                column_heading: "dynamic point",
                rows: numbers().collect(),
                columns: numbers().collect(),
                full,
                colors: (VERMILION, BLUE),
                cell: (33.0, 30.0),
                write: percent,
            }
            .draw(area, (LEFT[place % 2], TOP[place / 2 % 2]))?;
        }
        let words = Letters::new(LETTERS, Side::Right);
        let notes = [
            "Percent of the root of the two diagonal entries before; an empty cell rounds to zero.",
            "Blue is positive, red negative.",
        ];
        for (line, note) in notes.into_iter().enumerate() {
            write(area, note, (LEFT[0], 728.0 + 20.0 * line as f64), words)?;
        }
        Ok(())
    }
}
