//! A case from its first gages to its last exact check.

use super::{Case, Grouping};
use crate::method::error::Error;
use crate::method::error_sum::{ModeError, mode_errors};
use crate::method::inner_loop::first_factors;
use crate::method::model::ModalModel;
use crate::method::modes::Modes;
use crate::method::outer_loop::{Correlation, Pass, correlate};
use crate::method::step::{Bounds, StepRule};
use crate::torque_box::error::CaseError;
use crate::torque_box::wing_box::{PANEL_COUNT, TEST_GAGE};
use crate::weighted::comparison::Comparison;
use crate::weighted::identifiability::PRIOR_DEVIATION;
use crate::weighted::next_step::NextStep;
use crate::weighted::noise::Noise;
use serde::Serialize;

/// Ratio of the largest demand to the next from which on it is reported as an anomaly.
///
/// The demand is the unlimited factor by the reading gage, the fall of the error per change of gage in inches: a gage a hundred times
/// too small does not make it a hundred times smaller, as it does the fall per relative change. On 900 other boxes it names the faulty
/// element of Case 4 on about seven of ten, and no element in Cases 1 to 3 (`paper/localization.md`).
pub const ANOMALY_RATIO: f64 = 4.0;

/// A parameter whose demand stands far above all others: a modeling error, in all likelihood.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Anomaly {
    /// Name of the parameter.
    pub parameter: String,
    /// Its unlimited factor in the first iteration, by the case's own reading of the step.
    pub factor: f64,
    /// Its demand over the next largest, which counts as one at least: a factor of one asks for nothing.
    pub ratio: f64,
}

/// Outcome of a case.
#[derive(Debug, Clone)]
pub struct CaseResult {
    /// The case.
    pub case: Case,
    /// Its test modes.
    pub test: Modes,
    /// Its whole history.
    pub correlation: Correlation,
    /// Names of what was scaled: element numbers or substructures.
    pub parameter_names: Vec<String>,
    /// Bounds on its factors.
    pub ranges: Vec<Option<Bounds>>,
    /// Largest part of a test mode's generalized stiffness that each parameter had at first.
    pub seen: Vec<f64>,
    /// Unlimited factors of the first iteration, one per parameter.
    pub unlimited_factors: Vec<f64>,
    /// Errors of every test mode at the best factors.
    pub best_errors: Vec<ModeError>,
    /// Gages after every pass, in, elements 1 to 15.
    pub pass_gages: Vec<Vec<f64>>,
    /// The parameter reported as a modeling error after the first iteration, if one is.
    pub anomaly: Option<Anomaly>,
    /// One weighted step from its best factors, by a good test ([`Noise::USUAL`]) and the usual prior, if it correlated: a linear
    /// step from where modes are far apart says nothing.
    pub next_step: Option<NextStep>,
}

impl CaseResult {
    /// Error of every panel's gage, as a fraction, at the best factors and after [`Self::next_step`]; none by substructures.
    pub fn gage_errors(&self) -> Option<Vec<[f64; 2]>> {
        let next = self.next_step.as_ref()?;
        let gages = self.case.first_gages().into_iter();
        let ends = gages.zip(&self.correlation.best_factors).zip(&next.step);
        let errors = ends.map(|((gage, factor), step)| {
            [1.0, step.exp()].map(|change| gage * factor * change / TEST_GAGE - 1.0)
        });
        (self.case.grouping == Grouping::Elements).then(|| errors.collect())
    }

    /// True if the run is that of the paper's Case 4: a single iteration that is to detect a modeling error, and corrects
    /// nothing.
    pub fn is_detection(&self) -> bool {
        (self.case.number, self.case.settings.inner.iterations) == (4, 1)
    }

    /// True if the case did what the paper asked of it: Cases 1 to 3 correlate; Case 4, a single iteration, names a
    /// faulty element.
    pub fn succeeded(&self) -> bool {
        if self.is_detection() {
            self.anomaly.is_some()
        } else {
            self.correlation.converged
        }
    }
}

/// Correlates a case and looks where a weighted step would go from there; `progress` is called after every pass.
///
/// # Errors
/// The errors of the model, the analysis and the loops.
pub fn run_case(
    case: &Case,
    mut progress: impl FnMut(usize, &Pass),
) -> Result<CaseResult, CaseError> {
    let (model, test) = (case.model()?, case.test_modes()?);
    let by_gage = case.settings_by(StepRule::Gage).inner;
    let ranges = model.factor_ranges()?;
    let (mut demands, mut seen, mut unlimited_factors) = (None, Vec::new(), Vec::new());
    let correlation = correlate(
        |factors| -> Result<ModalModel, CaseError> {
            let analysis = model.analyze(factors, &test, None)?;
            if demands.is_none() {
                demands = Some(first_factors(&analysis, &by_gage)?);
                unlimited_factors = first_factors(&analysis, &case.settings.inner)?;
                let shares = analysis.test_shares().iter();
                seen = shares.map(|share| share.diagonal().amax()).collect();
            }
            Ok(analysis)
        },
        &ranges,
        &case.settings,
        |number, pass| {
            progress(number, pass);
            true
        },
    )?;
    let pass_gages = correlation
        .passes
        .iter()
        .map(|pass| Ok(model.sizes(&pass.factors)?[..PANEL_COUNT].to_vec()));
    let pass_gages = pass_gages.collect::<Result<_, Error>>()?;
    let parameter_names: Vec<String> = model.parameters().iter().map(|p| p.name.clone()).collect();
    let anomaly = demands.and_then(|demands| {
        let (parameter, ratio) = stands_out(&demands)?;
        Some(Anomaly {
            parameter: parameter_names[parameter].clone(),
            factor: unlimited_factors[parameter],
            ratio,
        })
    });
    let (best, check) = (&correlation.best_factors, correlation.best_check());
    let best_errors = mode_errors(&check.modes, &check.pairing, &test)?;
    let next_step = correlation
        .converged
        .then(|| -> Result<NextStep, CaseError> {
            let there = model.analyze(best, &test, None)?;
            let there = Comparison::from(&there);
            Ok(NextStep::at(&there, Noise::USUAL, PRIOR_DEVIATION)?)
        });
    Ok(CaseResult {
        next_step: next_step.transpose()?,
        case: case.clone(),
        test,
        correlation,
        parameter_names,
        ranges,
        seen,
        unlimited_factors,
        best_errors,
        pass_gages,
        anomaly,
    })
}

/// The parameter, from zero, whose demand stands out from all others by [`ANOMALY_RATIO`], and by how much: in all likelihood it was
/// modeled far too soft.
pub fn stands_out(demands: &[f64]) -> Option<(usize, f64)> {
    let mut order: Vec<usize> = (0..demands.len()).collect();
    order.sort_by(|&a, &b| demands[b].total_cmp(&demands[a]));
    let (&largest, others) = order.split_first()?;
    let next = others.first().map_or(1.0, |&next| demands[next].max(1.0));
    let ratio = demands[largest] / next;
    (ratio > ANOMALY_RATIO).then_some((largest, ratio))
}
