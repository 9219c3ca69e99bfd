//! Results as JSON: every document begins with program, version and units, and a correlation always has the same form.
//!
//! Errors are fractions (RMS and sums alike), gages inches, frequencies hertz in the order of the test modes. Factors
//! of a pass are totals since the first model, those of an iteration totals since the last exact solution. A number
//! that is not finite is `null`. Every function that writes a document has the errors of [`document`].

use super::PresentError;
use super::report::{Report, Stage};
use super::tables::cases::{outcome, published_iterations};
use super::tables::deck::{not_read, unit_shapes};
use crate::files::deck::Deck;
use crate::job::preflight::Finding;
use crate::method::inner_loop::Iteration;
use crate::method::model::Check;
use crate::method::structure::DIRECTIONS;
use crate::sparse::whole_modes::WholeModes;
use crate::torque_box::CaseResult;
use crate::torque_box::wing_box::TEST_GAGE;
use nalgebra::DMatrix;
use serde_json::{Value, json};

/// A document with its heading as pretty-printed JSON and a final newline.
///
/// # Errors
/// [`PresentError::Json`], which memory alone could cause.
pub fn document(content: Value) -> Result<String, PresentError> {
    let mut document = json!({
        "program": env!("CARGO_PKG_NAME"),
        "version": env!("CARGO_PKG_VERSION"),
        "units": "inch, pound-force, second, hertz; errors are fractions",
    });
    if let (Some(all), Value::Object(content)) = (document.as_object_mut(), content) {
        all.extend(content);
    }
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

/// Any correlation: its parameters by name, its test, what it came to, and its whole history.
///
/// # Errors
/// Those of [`Report::agreement`].
pub fn report(report: &Report) -> Result<Value, PresentError> {
    let (mut initial, corrected) = (check(&report.initial), report.corrected());
    initial["agreement"] = agreement(report, &report.initial)?;
    let at_bound = |(e, factor): (usize, &f64)| report.is_at_bound(e, *factor);
    let factors = report.factors();
    Ok(json!({
        "name": report.title,
        "solver": report.solver,
        "converged": report.converged(),
        "verdict": report.verdict,
        "verdict_in_words": report.words(),
        "parameters": report.parameters,
        "ranges": report.ranges,
        "factors": factors,
        "standard_deviations": report.deviations,
        "at_bound": factors.iter().enumerate().map(at_bound).collect::<Vec<_>>(),
        "best_pass": report.best.map(|best| best + 1),
        "test_frequencies_hz": report.test.frequencies_hz(),
        "sensors": report.sensors.iter().map(|sensor| &sensor.name).collect::<Vec<_>>(),
        "initial": initial,
        "corrected_agreement": agreement(report, corrected)?,
        "passes": report.stages.iter().map(stage).collect::<Value>(),
        "derivatives": report.derivatives.as_ref().map(|at| json!({
            "frequency_percent_per_percent": matrix_rows(&at.frequency),
            "error_sum_per_percent": at.error_sum,
        })),
    }))
}

/// Modal assurance and cross-orthogonality, analysis modes by test modes, and which analysis mode is paired, from one.
fn agreement(report: &Report, check: &Check) -> Result<Value, PresentError> {
    let found = report.agreement(check)?;
    Ok(json!({
        "paired_analysis_modes": check.pairing.analysis_mode.iter().map(|mode| mode + 1).collect::<Vec<_>>(),
        "modal_assurance": matrix_rows(&found.assurance),
        "cross_orthogonality": found.orthogonality.as_ref().map(matrix_rows),
    }))
}

pub(super) fn matrix_rows(matrix: &DMatrix<f64>) -> Value {
    matrix
        .row_iter()
        .map(|row| row.iter().copied().collect::<Vec<_>>())
        .collect()
}

fn check(check: &Check) -> Value {
    json!({
        "frequencies_hz": check.frequencies_hz,
        "frequency_rms": check.errors.frequency_rms(),
        "shape_rms": check.errors.shape_rms(),
    })
}

fn stage(stage: &Stage) -> Value {
    let inner = stage.inner.as_ref();
    json!({
        "iterations": inner.map_or(1, |inner| inner.iterations.len()),
        "stop": inner.map_or_else(|| json!(stage.stop), |inner| json!(inner.stop)),
        "unlimited_factors": inner.map(|inner| &inner.first_unlimited_factors),
        "factors": stage.factors,
        "exact": check(&stage.check),
        "history": inner.iter().flat_map(|inner| &inner.iterations).map(iteration).collect::<Value>(),
    })
}

pub(super) fn iteration(iteration: &Iteration) -> Value {
    json!({
        "frequency_error": iteration.errors.frequency,
        "shape_error": iteration.errors.shape,
        "error_sum": iteration.errors.sum(),
        "halvings": iteration.halvings,
        "unlimited_factors": iteration.unlimited_factors,
        "factors": iteration.factors,
        "limits": iteration.limits,
    })
}

/// The history of the cases run.
///
/// # Errors
/// [`PresentError::Case`] if Table 13 were damaged; those of [`document`].
pub fn cases(results: &[CaseResult]) -> Result<String, PresentError> {
    let cases = results.iter().map(case).collect::<Result<Value, _>>()?;
    document(json!({ "cases": cases }))
}

fn case(result: &CaseResult) -> Result<Value, PresentError> {
    Ok(json!({
        "case": result.case.number,
        "settings": result.case.settings,
        "outcome": outcome(result),
        "succeeded": result.succeeded(),
        "correlation": report(&Report::from_case(result)?)?,
        "published_iterations": published_iterations(result)?,
        "element_numbers": result.case.panels.iter().map(|panel| panel.label).collect::<Value>(),
        "test_gage_in": TEST_GAGE,
        "first_gages_in": result.case.first_gages(),
        "pass_gages_in": result.pass_gages,
        "anomaly": result.anomaly,
    }))
}

/// What the pre-flight finds in structures; places count from zero.
pub fn preflight(found: &[(String, Vec<Finding>)]) -> Result<String, PresentError> {
    let structure =
        |(name, findings): &(String, Vec<Finding>)| json!({ "name": name, "findings": findings });
    document(json!({ "structures": found.iter().map(structure).collect::<Value>() }))
}

/// The lowest `count` modes of a deck, every shape scaled to a largest component of one; components in the order of
/// `dof`.
pub fn deck_modes(deck: &Deck, modes: &WholeModes, count: usize) -> Result<String, PresentError> {
    let (masses, shapes) = unit_shapes(modes, count);
    let dof = modes
        .dof
        .iter()
        .map(|dof| json!({"grid": dof.grid, "direction": DIRECTIONS[dof.direction]}));
    document(json!({
        "dof": dof.collect::<Value>(),
        "rigid_body_modes": modes.rigid_body,
        "frequencies_hz": modes.modes.frequencies_hz().into_iter().take(count).collect::<Value>(),
        "generalized_masses": masses,
        "shapes": shapes,
        "not_read": deck.unread.iter().map(not_read).collect::<Value>(),
    }))
}
