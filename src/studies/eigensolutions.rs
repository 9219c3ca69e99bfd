//! How many full eigensolutions a correlation takes: perturbation between exact checks against a new analysis after every step.

use crate::cases::Case;
use crate::cases::error::CaseError;
use crate::method::error::Error;
use crate::method::inner_loop::InnerSettings;
use crate::method::outer_loop::{Correlation, Settings, correlate};
use crate::studies::delta_wing::correlation;
use crate::studies::known::Known;
use crate::studies::wing::Wing;
use serde::Serialize;

/// Error sums to be reached, fractions.
pub const ERRORS: [f64; 2] = [0.05, 0.025];
/// Modes of the wing's test and analysis, and most passes before a correlation counts as one that does not get there.
const WING_MODES: usize = 10;
const MOST_PASSES: usize = 200;

/// What one way of getting to an error takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Effort {
    /// Full finite element analyses, each with its eigensolution.
    pub analyses: usize,
    /// Steps of all parameters.
    pub steps: usize,
    /// Whether the error was reached.
    pub reached: bool,
}

/// Both ways on one structure to one error.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Counted {
    /// The structure.
    pub name: String,
    /// The exact error sum to be reached, a fraction.
    pub error: f64,
    /// How many parameters there are: as many eigensolutions a step would differences take for derivatives.
    pub parameters: usize,
    /// The method's: modes follow the steps by perturbation, and only the end of an inner loop is analyzed.
    pub perturbation: Effort,
    /// By the same rule of the step, with an analysis after every single step.
    pub reanalysis: Effort,
}

/// A wing whose groups want factors from 0.75 to 1.3, with the lowest modes of the right wing as its test.
///
/// # Errors
/// Those of [`Wing::model`] and its modes.
pub fn planted(wing: &Wing) -> Result<Known, Error> {
    let model = wing.model()?;
    let pattern = [1.0, 1.2, 0.8, 1.1, 0.75, 1.0, 1.3, 0.9];
    let truth: Vec<f64> = pattern.into_iter().cycle().take(model.parameters().len()).collect();
    let test = model.modes(&truth)?.lowest(WING_MODES)?.into();
    Ok(Known { name: "Wing".to_owned(), model, test, truth })
}

/// The planted wing of 1,458 structural DOF, correlated to the smaller of the [`ERRORS`].
///
/// # Errors
/// Those of [`planted`] and [`correlate`].
pub fn recovered() -> Result<(Known, Correlation), Error> {
    let known = planted(&Wing::default())?;
    let settings = Settings { error_sum_tolerance: ERRORS[1], ..correlation::settings() };
    let analyze = |factors: &[f64]| known.model.analyze(factors, &known.test, Some(WING_MODES));
    let run = correlate(analyze, &known.model.factor_ranges()?, &settings, |_, _| {})?;
    Ok((known, run))
}

/// Counts both ways on one structure to an exact error sum, with the rule of the step of given settings.
///
/// # Errors
/// Those of the analysis and of [`correlate`].
pub fn counted(known: &Known, modes: Option<usize>, settings: &Settings, error: f64) -> Result<Counted, Error> {
    let effort = |inner: InnerSettings| {
        let mut settings = Settings { inner, later_inner_tolerance: 0.5 * error, ..settings.clone() };
        (settings.inner.tolerance, settings.error_sum_tolerance) = (error, error);
        // Neither error alone exceeds the sum.
        (settings.frequency_tolerance, settings.shape_tolerance, settings.most_passes) = (error, error, MOST_PASSES);
        let mut analyses = 0;
        let analyze = |factors: &[f64]| {
            analyses += 1;
            known.model.analyze(factors, &known.test, modes)
        };
        let found = correlate(analyze, &known.model.factor_ranges()?, &settings, |_, _| {})?;
        let steps = found.passes.iter().map(|pass| pass.inner.iterations.len()).sum();
        Ok(Effort { analyses, steps, reached: found.converged })
    };
    let inner = settings.inner.clone();
    let single = InnerSettings { iterations: 1, first_relaxation: inner.relaxation, ..inner.clone() };
    let (name, parameters) = (known.name.clone(), known.truth.len());
    Ok(Counted { name, error, parameters, perturbation: effort(inner)?, reanalysis: effort(single)? })
}

/// Cases 1 to 3, the delta wing and the wing of 1,458 structural DOF, each to all the errors.
///
/// # Errors
/// Those of the models and of [`counted`].
pub fn count_all(errors: &[f64]) -> Result<Vec<Counted>, CaseError> {
    let of = |number: usize| -> Result<Vec<Counted>, CaseError> {
        let (known, modes, settings) = match number {
            4 => (Known::delta_wing()?, None, correlation::settings()),
            5 => (planted(&Wing::default())?, Some(WING_MODES), correlation::settings()),
            case => (Known::of_case(case)?, None, Case::new(case)?.settings),
        };
        Ok(errors.iter().map(|error| counted(&known, modes, &settings, *error)).collect::<Result<_, _>>()?)
    };
    Ok((1..=5).map(of).collect::<Result<Vec<_>, _>>()?.concat())
}
