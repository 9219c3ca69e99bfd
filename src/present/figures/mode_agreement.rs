//! Cross-orthogonality and modal assurance criterion, before and after the correlation.

use super::canvas::{Area, BLUE, Drawn, LETTERS, Letters, Side, VERMILION, WIDTH, svg, write};
use super::heat_map::{HeatMap, percent};
use crate::cases::CaseResult;
use crate::method::model::Check;
use crate::method::pairing::{cross_orthogonality, modal_assurance};
use crate::present::error::PresentError;
use nalgebra::DMatrix;

/// The two matrices of one exact solution, analysis modes by test modes.
#[derive(Debug, Clone, PartialEq)]
pub struct Agreement {
    /// Cross-orthogonality $V_F^t M V_G$ (4).
    pub cross_orthogonality: DMatrix<f64>,
    /// Modal assurance criterion.
    pub modal_assurance: DMatrix<f64>,
}

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeAgreement {
    /// Case number.
    pub case: usize,
    /// Of the first model.
    pub before: Agreement,
    /// Of the last exact solution.
    pub after: Agreement,
}

/// Matrices of a case before and after its correlation.
///
/// # Errors
/// [`Error::WrongShape`] when shapes and mass do not fit.
pub fn mode_agreement(result: &CaseResult) -> Result<ModeAgreement, PresentError> {
    let mass = result.case.reconstruction.mass();
    let agreement = |check: &Check| -> Result<Agreement, PresentError> {
        Ok(Agreement {
            cross_orthogonality: cross_orthogonality(&check.modes, &result.test, &mass)?,
            modal_assurance: modal_assurance(&check.modes.shapes, &result.test.shapes)?,
        })
    };
    let correlation = &result.correlation;
    let last = correlation.passes.last().map_or(&correlation.initial, |pass| &pass.check);
    Ok(ModeAgreement { case: result.case.number, before: agreement(&correlation.initial)?, after: agreement(last)? })
}

impl ModeAgreement {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let name = format!("case_{}_agreement", self.case);
        let title = format!("Case {}: analysis against test modes before and after", self.case);
        svg(&name, &title, (WIDTH, 760.0), |area| self.on(area))
    }

    fn on(&self, area: &Area) -> Drawn {
        let columns = [("before", &self.before, 66.0), ("after", &self.after, 446.0)];
        for (when, agreement, left) in columns {
            for (what, values, top) in [
                ("Cross-orthogonality", &agreement.cross_orthogonality, 64.0),
                ("Modal assurance criterion", &agreement.modal_assurance, 424.0),
            ] {
                let (rows, columns) = values.shape();
                HeatMap {
                    values: &values.map(Some),
                    title: &format!("{what} {when}"),
                    row_heading: "analysis mode",
                    column_heading: "test mode",
                    rows: (1..=rows).map(|mode| mode.to_string()).collect(),
                    columns: (1..=columns).map(|mode| mode.to_string()).collect(),
                    full: 1.0,
                    colors: (VERMILION, BLUE),
                    cell: (33.0, 30.0),
                    write: percent,
                }
                .draw(area, (left, top))?;
            }
        }
        let note = "Hundredths; an empty cell rounds to zero. Blue is positive, red negative.";
        write(area, note, (66.0, 728.0), Letters::new(LETTERS, Side::Right))
    }
}
