//! A case from its first gages to its last exact check.

use super::Case;
use crate::cases::error::CaseError;
use crate::cases::torque_box::PANEL_COUNT;
use crate::method::error::Error;
use crate::method::model::{FiniteElementModel, ModalModel, Range};
use crate::method::modes::ModeSet;
use crate::method::outer_loop::{Correlation, Pass, correlate};

/// How many widths of the factor bounds beyond them an unlimited factor must lie to be reported as an anomaly.
///
/// Within a few widths the bounds do their work over several iterations; the parasitic answers of Case 4's sound
/// elements reach 9 widths, its faulty one 60.
const ANOMALY_WIDTHS: f64 = 20.0;

/// The finite element analysis of a run unless another is given: the crate's own elements.
pub const BUILT_IN: &str = "built-in";

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
    /// What did the finite element analyses: [`BUILT_IN`] or another program.
    pub solver: &'static str,
    /// Its test modes.
    pub test: ModeSet,
    /// Its whole history.
    pub correlation: Correlation,
    /// Names of what was scaled: element numbers or substructures.
    pub parameter_names: Vec<String>,
    /// Gages after every pass, in, elements 1 to 15.
    pub pass_gages: Vec<Vec<f64>>,
    /// Parameters reported as modeling errors after the first iteration.
    pub anomalies: Vec<Anomaly>,
}

impl CaseResult {
    /// Unlimited factors of the first iteration, one per parameter.
    pub fn unlimited_factors(&self) -> &[f64] {
        self.correlation.passes.first().map_or(&[], |pass| &pass.inner.first_unlimited_factors)
    }

    /// Whether the case did what the paper asked of it: Cases 1 to 3 correlate; Case 4, a single iteration, names a
    /// faulty element.
    pub fn succeeded(&self) -> bool {
        match (self.case.number, self.case.settings.inner.iterations) {
            (4, 1) => !self.anomalies.is_empty(),
            _ => self.correlation.converged,
        }
    }
}

/// Correlates a case; `progress` is told of every pass.
///
/// # Errors
/// Those of the model, the analysis and the loops.
pub fn run_case(case: &Case, progress: impl FnMut(usize, &Pass)) -> Result<CaseResult, CaseError> {
    run_case_with(case, BUILT_IN, |model, _| Ok(model.clone()), progress)
}

/// Correlates a case with another finite element analysis than the crate's own: `solver` is its name for the report,
/// `elements` is given the model and the factors on its parameters, and returns the model with that program's element
/// stiffness. The test modes come from it too, as in the paper, so that what is peculiar to an
/// element is the same on both sides.
///
/// # Errors
/// Those of `elements` and of [`run_case`].
pub fn run_case_with<E: From<CaseError> + From<Error>>(
    case: &Case,
    solver: &'static str,
    mut elements: impl FnMut(&FiniteElementModel, &[f64]) -> Result<FiniteElementModel, E>,
    progress: impl FnMut(usize, &Pass),
) -> Result<CaseResult, E> {
    let model = case.model()?;
    let test = ModeSet::from(case.test_modes_with(&mut elements)?);
    let correlation = correlate(
        |factors| -> Result<ModalModel, E> { Ok(elements(&model, factors)?.analyze(factors, &test, None)?) },
        &model.factor_ranges()?,
        &case.settings,
        progress,
    )?;
    let pass_gages = correlation.passes.iter().map(|pass| Ok(model.sizes(&pass.factors)?[..PANEL_COUNT].to_vec()));
    let pass_gages = pass_gages.collect::<Result<_, Error>>()?;
    let parameter_names: Vec<String> = model.parameters().iter().map(|p| p.name.clone()).collect();
    let anomalies = correlation.passes.first().map_or_else(Vec::new, |pass| {
        anomalies(&parameter_names, &pass.inner.first_unlimited_factors, case.settings.inner.factor_range)
    });
    Ok(CaseResult { case: case.clone(), solver, test, correlation, parameter_names, pass_gages, anomalies })
}

/// Parameters whose unlimited factors lie far outside the bounds of one iteration, largest first.
///
/// Far is twenty widths of the bounds beyond them: no sequence of bounded steps is meant to go there.
pub fn anomalies(names: &[String], unlimited_factors: &[f64], factor_range: Range) -> Vec<Anomaly> {
    let width = factor_range.upper - factor_range.lower;
    let beyond = |factor: f64| (factor - factor_range.upper).max(factor_range.lower - factor);
    let all = names.iter().zip(unlimited_factors).filter(|(_, factor)| beyond(**factor) > ANOMALY_WIDTHS * width);
    let mut found: Vec<_> = all.map(|(name, &factor)| Anomaly { parameter: name.clone(), factor }).collect();
    found.sort_by(|a, b| beyond(b.factor).total_cmp(&beyond(a.factor)));
    found
}
