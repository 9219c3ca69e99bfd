//! The whole history of a run as JSON.

use crate::cases::CaseResult;
use crate::cases::error::CaseError;
use crate::cases::fewer_modes::FewerModesRun;
use crate::cases::fit::Fit;
use crate::cases::published::PublishedTable;
use crate::method::inner_loop::{Iteration, Stop};
use crate::method::step::Limit;
use crate::present::error::PresentError;
use crate::studies::matrix_comparison::MatrixComparison;
use serde::Serialize;

pub(super) const PROGRAM: &str = env!("CARGO_PKG_NAME");
pub(super) const VERSION: &str = env!("CARGO_PKG_VERSION");
pub(super) const UNITS: &str = "inch, pound-force, second, hertz; errors are fractions";

/// The document: program, cases, fit of the box.
#[derive(Debug, Serialize)]
struct Document<'a> {
    program: &'static str,
    version: &'static str,
    units: &'static str,
    cases: Vec<CaseDocument>,
    reconstruction_fit: &'a Fit,
}

#[derive(Debug, Serialize)]
struct CaseDocument {
    case: usize,
    solver: &'static str,
    succeeded: bool,
    converged: bool,
    element_numbers: Vec<usize>,
    parameters: Vec<String>,
    test_gage_in: f64,
    test_frequencies_hz: Vec<f64>,
    initial: Initial,
    passes: Vec<PassDocument>,
    unlimited_factors: Vec<f64>,
    anomalies: Vec<AnomalyDocument>,
}

#[derive(Debug, Serialize)]
struct Initial {
    frequencies_hz: Vec<f64>,
    frequency_rms: f64,
    shape_rms: f64,
    gages_in: Vec<f64>,
}

#[derive(Debug, Serialize)]
struct PassDocument {
    pass: usize,
    iterations: usize,
    published_iterations: Option<usize>,
    stop: Stop,
    inner_error_sums: Vec<f64>,
    gages_in: Vec<f64>,
    frequencies_hz: Vec<f64>,
    frequency_rms: f64,
    shape_rms: f64,
    history: Vec<IterationDocument>,
}

#[derive(Debug, Serialize)]
struct IterationDocument {
    frequency_error: f64,
    shape_error: f64,
    halvings: usize,
    unlimited_factors: Vec<f64>,
    factors: Vec<f64>,
    limits: Vec<Limit>,
}

#[derive(Debug, Serialize)]
struct AnomalyDocument {
    element: String,
    factor: f64,
}

/// The history of the cases run, as pretty-printed JSON with a final newline.
///
/// RMS and SRSS errors are fractions, gages inches, frequencies hertz in the order of the test modes;
/// `unlimited_factors` of a case are those of its first iteration; factors of an iteration are totals since the
/// last exact solution; `solver` did the finite element analyses.
///
/// # Errors
/// [`CaseError::Table`] if Table 13 were damaged or a number were not finite.
pub fn json(results: &[CaseResult], fit: &Fit) -> Result<String, PresentError> {
    let paper = PublishedTable::number(13)?;
    let document = Document {
        program: PROGRAM,
        version: VERSION,
        units: UNITS,
        cases: results
            .iter()
            .map(|result| case_document(result, &paper))
            .collect(),
        reconstruction_fit: fit,
    };
    written(&document)
}

/// Runs with fewer modes as JSON, units and errors as in [`json`].
///
/// # Errors
/// [`CaseError::Table`] if a number were not finite.
pub fn fewer_modes(runs: &[FewerModesRun]) -> Result<String, PresentError> {
    written(&Headed {
        program: PROGRAM,
        version: VERSION,
        units: UNITS,
        content: Content::Runs(runs),
    })
}

/// A comparison of matrix corrections as JSON, units and errors as in [`json`].
///
/// # Errors
/// [`CaseError::Table`] if a number were not finite.
pub fn matrices(comparison: &MatrixComparison) -> Result<String, PresentError> {
    written(&Headed {
        program: PROGRAM,
        version: VERSION,
        units: UNITS,
        content: Content::Comparison(comparison),
    })
}

/// A document with one entry beside the heading.
#[derive(Debug, Serialize)]
struct Headed<'a> {
    program: &'static str,
    version: &'static str,
    units: &'static str,
    #[serde(flatten)]
    content: Content<'a>,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum Content<'a> {
    Runs(&'a [FewerModesRun]),
    Comparison(&'a MatrixComparison),
}

/// A document as pretty-printed JSON with a final newline.
pub(super) fn written(document: &impl Serialize) -> Result<String, PresentError> {
    let mut text = serde_json::to_string_pretty(document).map_err(|error| CaseError::Table {
        name: "JSON output".into(),
        expected: "finite numbers".into(),
        found: error.to_string(),
    })?;
    text.push('\n');
    Ok(text)
}

fn case_document(result: &CaseResult, paper: &PublishedTable) -> CaseDocument {
    let correlation = &result.correlation;
    let case = result.case.number;
    let passes = correlation
        .passes
        .iter()
        .zip(&result.pass_gages)
        .enumerate();
    CaseDocument {
        case,
        solver: result.solver,
        succeeded: result.succeeded(),
        converged: correlation.converged,
        element_numbers: result.case.panels.iter().map(|panel| panel.label).collect(),
        parameters: result.parameter_names.clone(),
        test_gage_in: crate::cases::torque_box::TEST_GAGE,
        test_frequencies_hz: result.test.frequencies_hz(),
        initial: Initial {
            frequencies_hz: correlation.initial.frequencies_hz.clone(),
            frequency_rms: correlation.initial.errors.frequency_rms(),
            shape_rms: correlation.initial.errors.shape_rms(),
            gages_in: result.case.first_gages(),
        },
        passes: passes
            .map(|(row, (pass, gages))| PassDocument {
                pass: row + 1,
                iterations: pass.inner.iterations.len(),
                published_iterations: paper
                    .value(&case.to_string(), &format!("pass_{}_iterations", row + 1))
                    .map(|count| count as usize),
                stop: pass.inner.stop,
                inner_error_sums: pass
                    .inner
                    .iterations
                    .iter()
                    .map(|i| i.errors.sum())
                    .collect(),
                gages_in: gages.clone(),
                frequencies_hz: pass.check.frequencies_hz.clone(),
                frequency_rms: pass.check.errors.frequency_rms(),
                shape_rms: pass.check.errors.shape_rms(),
                history: pass
                    .inner
                    .iterations
                    .iter()
                    .map(iteration_document)
                    .collect(),
            })
            .collect(),
        unlimited_factors: result.unlimited_factors().to_vec(),
        anomalies: result
            .anomalies
            .iter()
            .map(|anomaly| AnomalyDocument {
                element: anomaly.parameter.clone(),
                factor: anomaly.factor,
            })
            .collect(),
    }
}

fn iteration_document(iteration: &Iteration) -> IterationDocument {
    IterationDocument {
        frequency_error: iteration.errors.frequency,
        shape_error: iteration.errors.shape,
        halvings: iteration.halvings,
        unlimited_factors: iteration.unlimited_factors.clone(),
        factors: iteration.factors.clone(),
        limits: iteration.limits.clone(),
    }
}
