//! The paper's four cases on its wing torque box.

use crate::error::Error;
use crate::inner_loop::InnerSettings;
use crate::model::{FiniteElementModel, Parameter};
use crate::modes::Modes;
use crate::outer_loop::{Correlation, Pass, Settings, correlate};
use crate::published::PublishedTable;
use crate::step::Range;
use crate::structure::ElementKind;
use crate::torque_box::{
    PANEL_COUNT, Panel, Reconstruction, TEST_GAGE, load_distribution, structure,
};

/// Numbers of the paper's cases.
pub const CASES: [usize; 4] = [1, 2, 3, 4];

/// How many widths of the factor bounds beyond them an unlimited factor must lie to be reported as an anomaly.
///
/// Within a few widths the bounds do their work over several iterations; the parasitic answers of Case 4's sound
/// elements reach 9 widths, its faulty one 60.
const ANOMALY_WIDTHS: f64 = 20.0;

/// A case: what the structure really is, what the model says it is, and how it is correlated.
#[derive(Debug, Clone)]
pub struct Case {
    /// Its number, 1 to 4.
    pub number: usize,
    /// The box.
    pub reconstruction: Reconstruction,
    /// Panels with their first gages (Table 2).
    pub panels: Vec<Panel>,
    /// Area of every rod, in² (Table 2).
    pub rod_area: f64,
    /// Bounds on the gages, in, if the paper set any.
    pub gage_range: Option<Range>,
    /// Tolerances and passes.
    pub settings: Settings,
}

impl Case {
    /// A case of the paper on the embedded box.
    ///
    /// # Errors
    /// [`Error::UnknownCase`] for another number; those of [`Self::on`].
    pub fn new(number: usize) -> Result<Self, Error> {
        Self::on(number, Reconstruction::embedded()?)
    }

    /// A case of the paper on a given box.
    ///
    /// # Errors
    /// [`Error::UnknownCase`] for another number; [`Error::Table`] if Table 2 were damaged.
    pub fn on(number: usize, reconstruction: Reconstruction) -> Result<Self, Error> {
        if !CASES.contains(&number) {
            return Err(Error::UnknownCase { found: number });
        }
        let table = PublishedTable::number(2)?;
        let gage_heading = format!("gage_{number}");
        let panels = (1..=PANEL_COUNT)
            .map(|label| {
                let row = label.to_string();
                let grids = (1..=4)
                    .map(|corner| Ok(table.required(&row, &format!("grid_{corner}"))? as usize))
                    .collect::<Result<_, Error>>()?;
                let kind = match table.text(&row, &format!("type_{number}")) {
                    Some("S") => ElementKind::ShearPanel,
                    Some("M") => ElementKind::Membrane,
                    other => {
                        return Err(Error::Table {
                            name: table.name.clone(),
                            expected: format!("S or M for element {label}"),
                            found: other.unwrap_or("nothing").to_owned(),
                        });
                    }
                };
                Ok(Panel {
                    label,
                    grids,
                    kind,
                    gage: table.required(&row, &gage_heading)?,
                })
            })
            .collect::<Result<Vec<_>, Error>>()?;
        // Case 3 kept its gages between its own two; the others were bounded by the factor limits alone.
        let gage_range = (number == 3).then_some(Range {
            lower: 0.007,
            upper: 0.013,
        });
        Ok(Self {
            number,
            reconstruction,
            panels,
            rod_area: table.required("16-39", &gage_heading)?,
            gage_range,
            settings: published_settings(number),
        })
    }

    /// The model of this case with other gages than its first, in inches, elements 1 to 15.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there are 15; those of [`FiniteElementModel::new`].
    pub fn model_with(&self, gages: &[f64]) -> Result<FiniteElementModel, Error> {
        if gages.len() != self.panels.len() {
            return Err(Error::WrongShape {
                what: "panel gages",
                expected_rows: self.panels.len(),
                expected_columns: 1,
                rows: gages.len(),
                columns: 1,
            });
        }
        let panels: Vec<Panel> = self
            .panels
            .iter()
            .zip(gages)
            .map(|(panel, &gage)| Panel {
                gage,
                ..panel.clone()
            })
            .collect();
        FiniteElementModel::new(
            structure(&self.reconstruction, &panels, self.rod_area)?,
            load_distribution(&self.reconstruction)?,
            self.reconstruction.mass(),
            panels
                .iter()
                .map(|panel| Parameter::element(panel.label, self.gage_range))
                .collect(),
        )
    }

    /// The model with the case's first gages.
    ///
    /// # Errors
    /// Those of [`Self::model_with`].
    pub fn model(&self) -> Result<FiniteElementModel, Error> {
        self.model_with(&self.first_gages())
    }

    /// First gages, in, elements 1 to 15.
    pub fn first_gages(&self) -> Vec<f64> {
        self.panels.iter().map(|panel| panel.gage).collect()
    }

    /// The test modes: the exact modes of the box with every panel at the test gage.
    ///
    /// # Errors
    /// Those of [`Self::model_with`] and of the analysis.
    pub fn test_modes(&self) -> Result<Modes, Error> {
        let model = self.model_with(&[TEST_GAGE; PANEL_COUNT])?;
        let dynamic = model.analyze(&[1.0; PANEL_COUNT])?;
        crate::modes::solve(&dynamic.stiffness, &dynamic.mass, dynamic.mass.nrows())
    }
}

/// The paper's tolerances, and its number of passes: two, two, three; Case 4 was a single iteration.
///
/// The number of passes is prescribed, not found, so that tables line up with the published ones pass by pass; the
/// tolerances then judge the result.
fn published_settings(number: usize) -> Settings {
    let passes = match number {
        1 | 2 => 2,
        3 => 3,
        _ => 1,
    };
    let iterations = if number == 4 { 1 } else { 100 };
    Settings {
        inner: InnerSettings {
            iterations,
            ..InnerSettings::default()
        },
        least_passes: passes,
        most_passes: passes,
        ..Settings::default()
    }
}

/// An element whose unlimited factor cannot be meant: a modeling error, in all likelihood.
#[derive(Debug, Clone, PartialEq)]
pub struct Anomaly {
    /// Name of the parameter.
    pub parameter: String,
    /// Its unlimited factor.
    pub factor: f64,
}

/// What became of a case.
#[derive(Debug, Clone)]
pub struct CaseResult {
    /// The case.
    pub case: Case,
    /// Its test modes.
    pub test: Modes,
    /// Its whole history.
    pub correlation: Correlation,
    /// Gages after every pass, in, elements 1 to 15.
    pub pass_gages: Vec<Vec<f64>>,
    /// Elements reported as modeling errors after the first iteration.
    pub anomalies: Vec<Anomaly>,
}

impl CaseResult {
    /// Unlimited factors of the first iteration, elements 1 to 15.
    pub fn unlimited_factors(&self) -> &[f64] {
        self.correlation
            .passes
            .first()
            .map_or(&[], |pass| &pass.inner.first_unlimited_factors)
    }

    /// Whether the case did what the paper asked of it: Cases 1 to 3 correlate; Case 4, a single iteration, names a
    /// faulty element.
    pub fn succeeded(&self) -> bool {
        if self.case.number == 4 && self.case.settings.inner.iterations == 1 {
            !self.anomalies.is_empty()
        } else {
            self.correlation.converged
        }
    }
}

/// Correlates a case; `progress` is told of every pass.
///
/// # Errors
/// Those of the model, the analysis and the loops.
pub fn run_case(case: &Case, progress: impl FnMut(usize, &Pass)) -> Result<CaseResult, Error> {
    let model = case.model()?;
    let test = case.test_modes()?;
    let correlation = correlate(
        |factors| model.analyze(factors),
        &test,
        &model.factor_ranges()?,
        &case.settings,
        progress,
    )?;
    let pass_gages = correlation
        .passes
        .iter()
        .map(|pass| Ok(model.sizes(&pass.factors)?[..PANEL_COUNT].to_vec()))
        .collect::<Result<_, Error>>()?;
    let anomalies = correlation.passes.first().map_or_else(Vec::new, |pass| {
        let names: Vec<&str> = model.parameters().iter().map(|p| p.name.as_str()).collect();
        anomalies(
            &names,
            &pass.inner.first_unlimited_factors,
            case.settings.inner.factor_range,
        )
    });
    Ok(CaseResult {
        case: case.clone(),
        test,
        correlation,
        pass_gages,
        anomalies,
    })
}

/// Parameters whose unlimited factors lie far outside the bounds of one iteration, largest first.
///
/// Far is twenty widths of the bounds beyond them: no sequence of bounded steps is meant to go there.
pub fn anomalies(names: &[&str], unlimited_factors: &[f64], factor_range: Range) -> Vec<Anomaly> {
    let width = factor_range.upper - factor_range.lower;
    let mut found: Vec<(f64, Anomaly)> = names
        .iter()
        .zip(unlimited_factors)
        .filter_map(|(&name, &factor)| {
            let beyond = (factor - factor_range.upper).max(factor_range.lower - factor);
            (beyond > ANOMALY_WIDTHS * width).then(|| {
                let parameter = name.to_owned();
                (beyond, Anomaly { parameter, factor })
            })
        })
        .collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.into_iter().map(|(_, anomaly)| anomaly).collect()
}
