//! What truncation costs: errors over all pairs of numbers of modes.

use super::canvas::{Area, BLUE, Drawn, LETTERS, Letters, Side, VERMILION, WIDTH, svg, write};
use super::heat_map::HeatMap;
use crate::cases::fewer_modes::FewerModesRun;
use crate::present::error::PresentError;
use nalgebra::DMatrix;

/// One error over the pairs.
#[derive(Debug, Clone, PartialEq)]
pub struct Cost {
    /// Which error.
    pub name: &'static str,
    /// The error, a fraction, by test modes (rows) and analysis modes (columns), from one up; nothing where no run was made.
    pub values: DMatrix<Option<f64>>,
}

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Truncation {
    /// Case number.
    pub case: usize,
    /// The errors, those of gages first.
    pub costs: Vec<Cost>,
}

/// An error of a run: its name and its value, a fraction.
type Quantity = (&'static str, fn(&FewerModesRun) -> f64);

const QUANTITIES: [Quantity; 4] = [
    ("Gages of the shear panels", |run| run.shear_gage_rms),
    ("Gages of the membranes", |run| run.membrane_gage_rms),
    ("Frequencies of all nine test modes", |run| run.exact_all_modes.frequency_rms),
    ("Shapes of all nine test modes", |run| run.exact_all_modes.shape_rms),
];

/// Errors of runs with fewer modes.
pub fn truncation(case: usize, runs: &[FewerModesRun]) -> Truncation {
    let most = |count: fn(&FewerModesRun) -> usize| runs.iter().map(count).max().unwrap_or(0);
    let (tests, analyses) = (most(|run| run.test_modes), most(|run| run.analysis_modes));
    let cost = |(name, value): Quantity| {
        let mut values = DMatrix::from_element(tests, analyses, None);
        for run in runs {
            values[(run.test_modes - 1, run.analysis_modes - 1)] = Some(value(run));
        }
        Cost { name, values }
    };
    Truncation { case, costs: QUANTITIES.into_iter().map(cost).collect() }
}

/// Left edges and upper edges of the matrices, px.
const LEFT: [f64; 2] = [66.0, 446.0];
const TOP: [f64; 2] = [64.0, 424.0];

impl Truncation {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let title = format!("Case {}: errors with fewer modes", self.case);
        svg("truncation", &title, (WIDTH, 760.0), |area| self.on(area))
    }

    fn on(&self, area: &Area) -> Drawn {
        for (place, cost) in self.costs.iter().enumerate() {
            let numbers = |count: usize| (1..=count).map(|modes| modes.to_string()).collect();
            let (rows, columns) = cost.values.shape();
            HeatMap {
                values: &cost.values,
                title: cost.name,
                row_heading: "number of test modes",
                column_heading: "number of analysis modes",
                rows: numbers(rows),
                columns: numbers(columns),
                full: cost.values.iter().flatten().copied().fold(0.0, f64::max),
                colors: (VERMILION, BLUE),
                cell: (33.0, 30.0),
                write: tenths,
            }
            .draw(area, (LEFT[place % 2], TOP[place / 2 % 2]))?;
        }
        let note = "RMS error in percent after one pass, by exact solution; each matrix has a scale of its own.";
        write(area, note, (LEFT[0], 728.0), Letters::new(LETTERS, Side::Right))
    }
}

/// A fraction in percent with one decimal.
fn tenths(value: f64) -> String {
    format!("{:.1}", 100.0 * value)
}
