//! The paper's four cases on its wing torque box.

pub mod error;
#[doc(hidden)]
pub mod fewer_modes;
pub mod published;
mod run;
pub mod table_1;
pub mod wing_box;

pub use run::{ANOMALY_RATIO, Anomaly, CaseResult, run_case, stands_out};

use crate::method::inner_loop::InnerSettings;
use crate::method::linear_algebra::check_length;
use crate::method::model::{FiniteElementModel, Parameter};
use crate::method::modes::Modes;
use crate::method::outer_loop::Settings;
use crate::method::step::{Bounds, StepRule};
use crate::method::structure::ElementKind;
use crate::torque_box::error::CaseError;
use crate::torque_box::published::PublishedTable;
use crate::torque_box::wing_box::{
    COVERS, PANEL_COUNT, Panel, Reconstruction, TEST_GAGE, load_distribution, structure,
};

/// Numbers of the paper's cases.
pub const CASES: [usize; 4] = [1, 2, 3, 4];

/// The panels that share one factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Grouping {
    /// Every panel on its own, as in the paper's tables.
    #[default]
    Elements,
    /// The paper's substructures: all covers, all spars, all ribs. In Case 3 a group has panels at both gage bounds and
    /// could not move: there its factor is kept within the ratio of the bounds instead.
    Substructures,
}

/// The box's substructures and their panels.
const SUBSTRUCTURES: [(&str, &[usize]); 3] = [
    ("covers", &COVERS),
    ("spars", &[1, 3, 5, 6, 10, 14]),
    ("ribs", &[7, 12, 13]),
];

/// A case: the true structure, the wrong model of it, and the settings of its correlation.
#[derive(Debug, Clone)]
pub struct Case {
    /// Number of the case, 1 to 4.
    pub number: usize,
    /// The box.
    pub reconstruction: Reconstruction,
    /// Panels with their first gages (Table 2).
    pub panels: Vec<Panel>,
    /// Area of every rod, in² (Table 2).
    pub rod_area: f64,
    /// Bounds on the gages, in, if the paper set any.
    pub gage_range: Option<Bounds>,
    /// Grouping of the panels that share a factor.
    pub grouping: Grouping,
    /// Tolerances and passes.
    pub settings: Settings,
}

impl Case {
    /// A case of the paper on the embedded box.
    ///
    /// # Errors
    /// [`CaseError::UnknownCase`] for another number; the errors of [`Self::from_reconstruction`].
    pub fn new(number: usize) -> Result<Self, CaseError> {
        Self::from_reconstruction(number, Reconstruction::embedded()?)
    }

    /// A case of the paper on a given box.
    ///
    /// # Errors
    /// [`CaseError::UnknownCase`] for another number; [`CaseError::Table`] if Table 2 were damaged.
    pub fn from_reconstruction(
        number: usize,
        reconstruction: Reconstruction,
    ) -> Result<Self, CaseError> {
        if !CASES.contains(&number) {
            return Err(CaseError::UnknownCase { found: number });
        }
        let table = PublishedTable::number(2)?;
        let gage_heading = format!("gage_{number}");
        let panel = |label: usize| {
            let row = label.to_string();
            let grid =
                |corner: usize| Ok(table.required(&row, &format!("grid_{corner}"))? as usize);
            let grids = (1..=4).map(grid).collect::<Result<_, CaseError>>()?;
            let kind = match table.text(&row, &format!("type_{number}")) {
                Some("S") => ElementKind::ShearPanel,
                Some("M") => ElementKind::Membrane,
                other => {
                    let expected = format!("S or M for element {label}");
                    return Err(CaseError::table(
                        &table.name,
                        expected,
                        other.unwrap_or("nothing"),
                    ));
                }
            };
            Ok(Panel {
                label,
                grids,
                kind,
                gage: table.required(&row, &gage_heading)?,
            })
        };
        Ok(Self {
            number,
            reconstruction,
            panels: (1..=PANEL_COUNT)
                .map(panel)
                .collect::<Result<_, CaseError>>()?,
            rod_area: table.required("16-39", &gage_heading)?,
            // Case 3 kept its gages between its own two; the others were bounded by the factor limits alone.
            gage_range: (number == 3).then_some(Bounds {
                lower: 0.007,
                upper: 0.013,
            }),
            grouping: Grouping::Elements,
            settings: published_settings(number),
        })
    }

    /// The case's settings with another reading of the step.
    pub fn settings_by(&self, step: StepRule) -> Settings {
        let inner = InnerSettings {
            step,
            ..self.settings.inner.clone()
        };
        Settings {
            inner,
            ..self.settings.clone()
        }
    }

    /// The model of this case with other gages than its first, in inches, elements 1 to 15.
    ///
    /// # Errors
    /// [`crate::method::error::Error::WrongShape`] unless there are 15; the errors of [`FiniteElementModel::new`].
    pub fn model_with(&self, gages: &[f64]) -> Result<FiniteElementModel, CaseError> {
        check_length("panel gages", gages.len(), self.panels.len())?;
        let panels = self.panels.iter().zip(gages).map(|(panel, &gage)| Panel {
            gage,
            ..panel.clone()
        });
        let structure = structure(
            &self.reconstruction,
            &panels.collect::<Vec<_>>(),
            self.rod_area,
        )?;
        let t = load_distribution(&self.reconstruction)?;
        Ok(FiniteElementModel::new(
            structure,
            t,
            self.reconstruction.mass(),
            self.parameters(gages),
        )?)
    }

    fn parameters(&self, gages: &[f64]) -> Vec<Parameter> {
        if self.grouping == Grouping::Elements {
            let panel = |(panel, gage): (&Panel, &f64)| Parameter {
                factor_range: self.gage_range.map(|range| Bounds {
                    lower: range.lower / gage,
                    upper: range.upper / gage,
                }),
                ..Parameter::new(panel.label, &[panel.label])
            };
            return self.panels.iter().zip(gages).map(panel).collect();
        }
        // A group may have panels at both gage bounds, and no panel may leave them by more than their ratio.
        let ratio = |range: Bounds| Bounds {
            lower: range.lower / range.upper,
            upper: range.upper / range.lower,
        };
        let factor_range = self.gage_range.map(ratio);
        let group = |&(name, elements): &(_, _)| Parameter {
            factor_range,
            ..Parameter::new(name, elements)
        };
        SUBSTRUCTURES.iter().map(group).collect()
    }

    /// The model with the case's first gages.
    ///
    /// # Errors
    /// The errors of [`FiniteElementModel::new`] for a box that is no model, as in [`Self::model_with`].
    pub fn model(&self) -> Result<FiniteElementModel, CaseError> {
        self.model_with(&self.first_gages())
    }

    /// First gages, in, elements 1 to 15.
    pub fn first_gages(&self) -> Vec<f64> {
        self.panels.iter().map(|panel| panel.gage).collect()
    }

    /// The test modes: the exact modes of the box with every panel at the test gage.
    ///
    /// # Errors
    /// The errors of [`FiniteElementModel::new`] for a box that is no model, and of the analysis.
    pub fn test_modes(&self) -> Result<Modes, CaseError> {
        let model = self.test_model()?;
        Ok(model.modes(&vec![1.0; model.parameters().len()])?)
    }

    /// The box as it is tested: every panel of the test gage.
    fn test_model(&self) -> Result<FiniteElementModel, CaseError> {
        self.model_with(&[TEST_GAGE; PANEL_COUNT])
    }
}

/// Number of passes of a case that the paper prints: two, two, three; Case 4 was a single iteration.
pub fn published_passes(case: usize) -> usize {
    match case {
        1 | 2 => 2,
        3 => 3,
        _ => 1,
    }
}

/// The reading of the step that comes nearest to the published gages of a case; for Case 4, which has none, the one that the box
/// was fitted with (`paper/print_and_box.md`).
pub fn published_reading(case: usize) -> StepRule {
    if case == 2 || case == 3 {
        StepRule::Relative
    } else {
        StepRule::Own
    }
}

/// The paper's tolerances, and as many passes as they take; Case 4 is a single iteration.
///
/// Errors are sums over the modes compared. The tolerance of the outer loop on the error sum is not printed: it is taken as that of
/// the first inner loop.
fn published_settings(number: usize) -> Settings {
    let (most_passes, iterations) = if number == 4 { (1, 1) } else { (10, 30) };
    let inner = InnerSettings {
        iterations,
        step: published_reading(number),
        ..InnerSettings::default()
    };
    Settings {
        error_sum_tolerance: inner.tolerance,
        inner,
        most_passes,
        ..Settings::default()
    }
}
