//! The derivatives at a case's start as a heat map: what each panel does to each frequency and to the error sum.

use super::canvas::{Area, BLUE, Drawn, LETTERS, Letters, Side, VERMILION, WIDTH, svg, write};
use super::heat_map::HeatMap;
use crate::cases::CaseResult;
use crate::method::derivatives::{DERIVATIVE_STEP, by_definition};
use crate::method::state::ModalState;
use crate::present::error::PresentError;
use nalgebra::DMatrix;

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct DerivativeMap {
    /// Case number.
    pub case: usize,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Relative change of each test mode's frequency for a relative change of each parameter's stiffness,
    /// $\partial \ln f_i/\partial \ln k_e$ (parameters × test modes).
    pub frequency: DMatrix<f64>,
    /// Change of the error sum for a relative change of each parameter's stiffness, $\Delta e_e/0.001$ of (12)
    /// (parameters × 1).
    pub error_sum: DMatrix<f64>,
}

/// Derivatives of a case's first model.
///
/// $$ \frac{\partial \ln f_i}{\partial \ln k_e} = \frac{V_i^t K_e V_i}{2\omega_i^2} $$
///
/// with the mode paired with test mode $i$; the error sum's are those of the first iteration.
///
/// # Errors
/// Those of the model, its analysis and [`by_definition`].
pub fn derivative_map(result: &CaseResult) -> Result<DerivativeMap, PresentError> {
    let model = result.case.model()?;
    let first = model.analyze(&vec![1.0; result.parameter_names.len()], &result.test, None)?;
    let error_changes = by_definition(&first, &ModalState::start(&first))?;
    let rows = first.shares.len();
    let frequency = DMatrix::from_fn(rows, result.test.len(), |e, j| {
        let i = first.exact.pairing.analysis_mode[j];
        let share = first.shares[e].matrix();
        share[(i, i)] / (2.0 * first.exact.modes.omega_squared[i])
    });
    let error_sum = DMatrix::from_fn(rows, 1, |e, _| error_changes[e] / DERIVATIVE_STEP);
    Ok(DerivativeMap { case: result.case.number, parameters: result.parameter_names.clone(), frequency, error_sum })
}

impl DerivativeMap {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let name = format!("case_{}_derivatives", self.case);
        let title = format!("Case {}: derivatives of the first model", self.case);
        let height = 106.0 + 26.0 * self.parameters.len() as f64;
        svg(&name, &title, (WIDTH, height), |area| self.on(area))
    }

    fn on(&self, area: &Area) -> Drawn {
        let modes = (1..=self.frequency.ncols()).map(|mode| mode.to_string()).collect();
        HeatMap {
            values: &self.frequency.map(Some),
            title: "Percent of frequency for one percent of stiffness",
            row_heading: "panel",
            column_heading: "test mode",
            rows: self.parameters.clone(),
            columns: modes,
            full: self.frequency.amax(),
            colors: (VERMILION, BLUE),
            cell: (50.0, 26.0),
            write: decimals,
        }
        .draw(area, (66.0, 64.0))?;
        HeatMap {
            values: &self.error_sum.map(Some),
            title: "Error sum",
            row_heading: "",
            column_heading: "percent points for",
            rows: self.parameters.clone(),
            columns: vec!["one percent of stiffness".to_owned()],
            full: self.error_sum.amax(),
            colors: (VERMILION, BLUE),
            cell: (90.0, 26.0),
            write: decimals,
        }
        .draw(area, (612.0, 64.0))?;
        let bottom = 64.0 + 26.0 * self.parameters.len() as f64;
        let words = Letters::new(LETTERS, Side::Right);
        let note = "An empty cell rounds to zero. Red is negative: more of that panel lowers the error.";
        write(area, note, (66.0, bottom + 24.0), words)
    }
}

fn decimals(value: f64) -> String {
    let text = format!("{value:.2}");
    if text.trim_start_matches('-') == "0.00" { String::new() } else { text.replace('-', "−") }
}
