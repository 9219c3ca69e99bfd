//! The content of a report on any correlation.

mod answer;
pub(super) mod job;

use crate::job::verdict::Verdict;
use crate::job::{HeldOut, Trust};
use crate::method::analysis::DERIVATIVE_STEP;
use crate::method::error::Error;
use crate::method::error_sum::Errors;
use crate::method::inner_loop::{InnerRun, Stop};
use crate::method::modes::Modes;
use crate::method::outer_loop::{Correlation, Pass, Settings};
use crate::method::sorting::cross_orthogonality;
use crate::method::step::Bounds;
use crate::method::structure::Structure;
use crate::present::verdict::{advice, outcome_in_words, verdict_in_words};
use crate::sparse::{ParameterMatrix, Work, modal_assurance};
use crate::weighted::close_modes::turned;
use crate::weighted::comparison::{Comparison, ExactResult};
use crate::weighted::identifiability::Identifiability;
use crate::weighted::intervals::{Withheld, is_at_end};
use crate::weighted::misfit::Misfit;
use crate::weighted::starts::{Minimum, StartEnd};
use nalgebra::{DMatrix, Vector3};
use serde::{Serialize, Serializer};
use serde_json::json;

/// A row of the shapes.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorPoint {
    /// Name.
    pub name: String,
    /// Place, if that is known.
    pub place: Option<Vector3<f64>>,
    /// Unit vector along which it measures; zero for a rotation.
    pub direction: Vector3<f64>,
}

/// A step from one exact solution to the next: a pass with an inner loop, or one iteration that has none.
#[derive(Debug, Clone)]
pub struct Stage {
    /// Factor of each parameter on its first value, after it.
    pub factors: Vec<f64>,
    /// The exact solution there.
    pub check: ExactResult,
    /// Its inner loop, if it has one.
    pub inner: Option<InnerRun>,
    /// Why it ended, in words.
    pub stop: String,
}

/// Residuals of a test mode over their standard deviations, or where it is held out over those predicted of them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModeResiduals {
    /// The test mode's number.
    pub mode: usize,
    /// Residual of its frequency, positive where the model's is higher.
    pub frequency: f64,
    /// Residuals of its shape at the sensors; none of a frequency alone.
    pub shape: Vec<f64>,
}

/// Derivatives at the first model by the relative stiffness or mass of each parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Derivatives {
    /// $\partial \ln f_i/\partial \ln s_e$ of the mode paired with test mode $i$ (parameters × test modes, those without shapes last).
    #[serde(rename = "frequency_percent_per_percent", serialize_with = "by_rows")]
    pub frequency: DMatrix<f64>,
    /// $\partial e_S/\partial \ln s_e$ of the error sum, by (12).
    #[serde(rename = "error_sum_per_percent")]
    pub error_sum: Vec<f64>,
}

/// The rows of a matrix.
#[doc(hidden)]
pub fn matrix_rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    let rows = matrix.row_iter();
    rows.map(|row| row.iter().copied().collect()).collect()
}

/// A matrix as the list of its rows.
fn by_rows<S: Serializer>(matrix: &DMatrix<f64>, to: S) -> Result<S::Ok, S::Error> {
    matrix_rows(matrix).serialize(to)
}

/// As [`by_rows`], or nothing.
fn by_rows_if_any<S: Serializer>(matrix: &Option<DMatrix<f64>>, to: S) -> Result<S::Ok, S::Error> {
    matrix.as_ref().map(matrix_rows).serialize(to)
}

/// The ends of every parameter's 95 % interval, or why they are withheld.
fn ends_or_reasons<S: Serializer>(
    intervals: &[Result<Bounds, Withheld>],
    to: S,
) -> Result<S::Ok, S::Error> {
    to.collect_seq(intervals.iter().map(|interval| match interval {
        Ok(ends) => json!(ends),
        Err(withheld) => json!({ "withheld": withheld }),
    }))
}

/// Names alone.
fn names<S: Serializer>(sensors: &[SensorPoint], to: S) -> Result<S::Ok, S::Error> {
    to.collect_seq(sensors.iter().map(|sensor| &sensor.name))
}

/// The content of a report on any correlation. Lengths are in the model's own unit. Text, CSV, page and JSON are views of it; the last
/// has what is serialized here and what follows from it ([`json::report`](crate::present::json::report)).
#[derive(Debug, Clone, Serialize)]
pub struct Report {
    /// Stem of the names of its tables, figures and files.
    #[serde(skip)]
    pub name: String,
    /// The title that readers see.
    #[serde(rename = "name")]
    pub title: String,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Bounds on their factors, if any.
    pub ranges: Vec<Option<Bounds>>,
    /// Standard deviation of every factor of the best stage, where an interval holds.
    #[serde(rename = "standard_deviations")]
    pub deviations: Option<Vec<Option<f64>>>,
    /// Identifiability of the parameters by the test, at the first model and at the best factors, where that is known.
    #[serde(skip)]
    pub seen: Option<[Identifiability; 2]>,
    /// Residuals at a job's end, compared with the noise.
    pub misfit: Option<Misfit>,
    /// Words for modes held out that the model does not hold for.
    #[serde(skip)]
    pub missed: Option<String>,
    /// True if the misfit decides the verdict, and not the tolerances.
    #[serde(skip)]
    pub is_judged_by_noise: bool,
    /// Number of exact analyses that the result took.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub analyses: Option<usize>,
    /// Work that they took.
    #[serde(flatten)]
    pub work: Option<Work>,
    /// The minima that noise allows, of several starts.
    pub minima: Vec<Minimum>,
    /// The end of every start of weighted steps; none where it failed.
    pub starts: Vec<Option<StartEnd>>,
    /// The interval of every parameter, or why it has none; none of a report without a result.
    #[serde(serialize_with = "ends_or_reasons")]
    pub intervals: Vec<Result<Bounds, Withheld>>,
    /// Residuals at the best factors over their standard deviations, of every test mode, those without shapes last.
    pub residuals: Vec<ModeResiduals>,
    /// Test modes, sensors × modes.
    #[serde(skip)]
    pub test: Modes,
    /// The numbers in the test's file of the test modes, then of those without shapes.
    #[serde(rename = "test_mode_numbers")]
    pub mode_numbers: Vec<usize>,
    /// Test modes that are not compared: their numbers and frequencies, Hz.
    #[serde(skip)]
    pub left_out: Vec<(usize, f64)>,
    /// Test modes that are held out, with their errors.
    #[serde(skip)]
    pub held_out: Vec<HeldOut>,
    /// Doubts about it and remarks; none of the paper's cases.
    pub trust: Option<Trust>,
    /// Rows of the shapes; none where nothing is known of them.
    #[serde(serialize_with = "names")]
    pub sensors: Vec<SensorPoint>,
    /// The structure, or the wire frame of its test: corners of panels, and ends of rods and lines.
    #[serde(skip)]
    pub frame: Vec<Vec<Vector3<f64>>>,
    /// The parameters that scale each piece of it; none where that is not known.
    #[serde(skip)]
    pub owners: Vec<Vec<usize>>,
    /// Numbered grids.
    #[serde(skip)]
    pub grids: Vec<(usize, Vector3<f64>)>,
    /// Motions of the grids in the modes paired with the test modes, of test, first and corrected model, in the scale and with the signs
    /// of the shapes; the test's by expansion, where it has shapes. None where the whole model is not known.
    #[serde(skip)]
    pub moved: Option<[Vec<Vec<Vector3<f64>>>; 3]>,
    /// Places that do not move.
    #[serde(skip)]
    pub supports: Vec<Vector3<f64>>,
    /// Mass at the sensors, for cross-orthogonality.
    #[serde(skip)]
    pub mass: Option<DMatrix<f64>>,
    /// The exact solution of the first model.
    #[serde(skip)]
    pub initial: ExactResult,
    /// Settings of the loops, where their tolerances are to be drawn.
    #[serde(skip)]
    pub settings: Option<Settings>,
    /// The stages after it.
    #[serde(skip)]
    pub stages: Vec<Stage>,
    /// The stage with the best factors, from zero; none when none is better than the first model.
    #[serde(skip)]
    pub best: Option<usize>,
    /// The verdict, once it ran.
    pub verdict: Option<Verdict>,
    /// Derivatives, where they were taken.
    pub derivatives: Option<Derivatives>,
}

/// Agreement of analysis modes (rows) and test modes (columns).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairAgreement {
    /// The analysis mode paired with every test mode, from one.
    #[serde(rename = "paired_analysis_modes")]
    pub partners: Vec<usize>,
    /// Modal assurance criterion, which uses no mass.
    #[serde(rename = "modal_assurance", serialize_with = "by_rows")]
    pub assurance: DMatrix<f64>,
    /// Cross-orthogonality (4) of shapes of unit generalized mass, where the mass at the sensors is known.
    #[serde(rename = "cross_orthogonality", serialize_with = "by_rows_if_any")]
    pub orthogonality: Option<DMatrix<f64>>,
}

impl Derivatives {
    /// Derivatives at a model: $V_i^t K_e V_i/2\omega_i^2$, or $-V_i^t M_e V_i/2$ of a mass.
    ///
    /// # Errors
    /// [`Error::CoalescingModes`] and [`Error::NotAVibration`] where a thousandth of a parameter is too much.
    pub fn at(comparison: &Comparison) -> Result<Self, Error> {
        let first = comparison.model();
        let changes = comparison.error_changes()?;
        let partners = comparison.partners();
        let frequency = DMatrix::from_fn(first.shares.len(), partners.len(), |e, j| {
            let i = partners[j];
            match &first.shares[e] {
                ParameterMatrix::Stiffness(share) => {
                    share[(i, i)] / (2.0 * first.exact.modes.omega_squared[i])
                }
                ParameterMatrix::Mass(share) => -0.5 * share[(i, i)],
            }
        });
        Ok(Self {
            frequency,
            error_sum: changes
                .iter()
                .map(|change| change / DERIVATIVE_STEP)
                .collect(),
        })
    }
}

impl Report {
    /// A first model and the outer loop's run from it, if there was one. Everything else (title, sensors, frame, mass, deviations,
    /// derivatives) is left empty, to be filled in.
    pub fn from_correlation(
        name: &str,
        parameters: &[String],
        test: &Modes,
        initial: &ExactResult,
        run: Option<&Correlation>,
    ) -> Self {
        let stage = |pass: &Pass| {
            let stop = match pass.inner.stop {
                Stop::Tolerance => "tolerance",
                Stop::LocalMinimum => "local minimum",
                Stop::Iterations => "iterations",
            };
            let (factors, check, inner) = (
                pass.factors.clone(),
                (&pass.check).into(),
                pass.inner.clone(),
            );
            Stage {
                factors,
                check,
                inner: Some(inner),
                stop: stop.to_owned(),
            }
        };
        Self {
            name: name.to_owned(),
            title: name.to_owned(),
            parameters: parameters.to_vec(),
            ranges: vec![None; parameters.len()],
            deviations: None,
            seen: None,
            misfit: None,
            missed: None,
            is_judged_by_noise: false,
            analyses: None,
            work: None,
            minima: Vec::new(),
            starts: Vec::new(),
            intervals: Vec::new(),
            residuals: Vec::new(),
            test: test.clone(),
            mode_numbers: (1..=test.len()).collect(),
            left_out: Vec::new(),
            held_out: Vec::new(),
            trust: None,
            sensors: Vec::new(),
            frame: Vec::new(),
            owners: Vec::new(),
            grids: Vec::new(),
            moved: None,
            supports: Vec::new(),
            mass: None,
            initial: initial.clone(),
            settings: None,
            stages: run.iter().flat_map(|run| &run.passes).map(stage).collect(),
            best: run.and_then(|run| run.best),
            verdict: None,
            derivatives: None,
        }
    }

    /// This report with the panels, rods, grids and supports of a structure.
    pub fn with_structure(mut self, structure: &Structure) -> Self {
        self.frame = structure.corners().to_vec();
        self.grids = structure
            .grids()
            .iter()
            .map(|grid| (grid.label, grid.position))
            .collect();
        let fixed = structure
            .grids()
            .iter()
            .filter(|grid| grid.constrained == [true; 3]);
        self.supports = fixed.map(|grid| grid.position).collect();
        self
    }

    /// True if the best is within tolerance.
    pub fn converged(&self) -> bool {
        self.verdict
            .as_ref()
            .is_some_and(|verdict| verdict.is_within)
    }

    /// The number of a test mode (its place from zero) in the test's file; its place from one where that is not known.
    pub fn mode_number(&self, place: usize) -> usize {
        self.mode_numbers.get(place).copied().unwrap_or(place + 1)
    }

    /// The verdict in words.
    pub fn words(&self) -> String {
        let judged = self.misfit.as_ref().filter(|_| self.is_judged_by_noise);
        let judged = judged.map(Misfit::in_words);
        let missed = self.missed.iter().cloned().chain(judged);
        let judged = missed.reduce(|missed, judged| missed + " " + &judged);
        let verdict = self.verdict.iter();
        // Of a job bounds and what is not seen are remarks, and a doubt is answered before anything else is tried.
        let words = verdict.map(|verdict| match &self.trust {
            None => verdict_in_words(verdict, &self.parameters, &self.mode_numbers),
            Some(trust) => {
                let next = if trust.has_doubt() {
                    ""
                } else {
                    advice(verdict)
                };
                outcome_in_words(verdict, judged.as_deref(), &self.mode_numbers) + next
            }
        });
        words.collect()
    }

    /// Number of starts that failed.
    pub fn failed_starts(&self) -> usize {
        self.starts.iter().filter(|start| start.is_none()).count()
    }

    fn best_stage(&self) -> Option<&Stage> {
        self.stages.get(self.best?)
    }

    /// The exact solution of the best stage.
    pub fn corrected(&self) -> &ExactResult {
        self.best_stage()
            .map_or(&self.initial, |stage| &stage.check)
    }

    /// The factors of the best stage, all one without any.
    pub fn factors(&self) -> Vec<f64> {
        self.best_stage().map_or_else(
            || vec![1.0; self.parameters.len()],
            |stage| stage.factors.clone(),
        )
    }

    /// True if the factor of a parameter is at an end of its range.
    pub fn is_at_bound(&self, parameter: usize, factor: f64) -> bool {
        self.ranges
            .get(parameter)
            .copied()
            .flatten()
            .is_some_and(|range| is_at_end(range, factor))
    }

    /// Errors of a stage: of the exact solution it starts from, then after every iteration of its inner loop.
    pub fn inner_errors(&self, stage: usize) -> Vec<Errors> {
        let before = stage
            .checked_sub(1)
            .map_or(&self.initial, |before| &self.stages[before].check);
        let inner = self.stages[stage]
            .inner
            .iter()
            .flat_map(|inner| &inner.iterations);
        std::iter::once(before.errors)
            .chain(inner.map(|iteration| iteration.errors))
            .collect()
    }

    /// Agreement of the modes of an exact solution, up to the highest that is paired by shape, with the test's; paired ones are signed like them.
    ///
    /// # Errors
    /// [`Error::WrongShape`] when shapes and mass do not fit; [`Error::Value`] for a shape that is zero or has no mass.
    pub fn agreement(&self, check: &ExactResult) -> Result<PairAgreement, Error> {
        let Some(highest) = check.pairing.analysis_mode.iter().max() else {
            return Ok(PairAgreement {
                partners: Vec::new(),
                assurance: DMatrix::zeros(0, 0),
                orthogonality: None,
            });
        };
        let modes = turned(&check.modes, &check.pairing, &check.together, &self.test)?;
        let mut modes = modes.lowest(highest + 1)?;
        for (&mode, &sign) in check.pairing.analysis_mode.iter().zip(&check.pairing.sign) {
            modes.shapes.column_mut(mode).scale_mut(sign);
        }
        // The paired modes are brought to unit generalized mass as well; the mass need not know of the others.
        let orthogonality = |mass: &DMatrix<f64>| {
            let mut unit = modes.clone();
            for &mode in &check.pairing.analysis_mode {
                let mut shape = unit.shapes.column_mut(mode);
                let generalized_mass = shape.dot(&(mass * &shape));
                if generalized_mass > 0.0 {
                    shape /= generalized_mass.sqrt();
                }
            }
            cross_orthogonality(&unit, &self.test.scaled_with(mass)?, mass)
        };
        let partners = check.pairing.analysis_mode.iter();
        Ok(PairAgreement {
            partners: partners.map(|mode| mode + 1).collect(),
            assurance: modal_assurance(&modes.shapes, &self.test.shapes)?,
            orthogonality: self.mass.as_ref().map(orthogonality).transpose()?,
        })
    }
}
