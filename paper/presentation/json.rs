//! The history of the cases as JSON.

use super::report::CaseReport;
use super::tables::cases::{outcome, published_iterations};
use super::words::case_in_words;
use corfem::job::verdict::Verdict;
use corfem::method::inner_loop::Iteration;
use corfem::method::outer_loop::Pass;
use corfem::present::PresentError;
use corfem::present::json::{BOX_UNITS, document};
use corfem::torque_box::CaseResult;
use corfem::torque_box::wing_box::TEST_GAGE;
use serde_json::{Value, json};

/// The history of the cases run.
///
/// # Errors
/// [`PresentError::Case`] if Table 13 were damaged; the errors of [`document`].
pub fn cases(results: &[CaseResult]) -> Result<String, PresentError> {
    let cases = results.iter().map(case).collect::<Result<Value, _>>()?;
    document(BOX_UNITS, json!({ "cases": cases }))
}

fn case(result: &CaseResult) -> Result<Value, PresentError> {
    let report = CaseReport::new(result);
    let compared = report.compared();
    Ok(json!({
        "case": result.case.number,
        "settings": result.case.settings,
        "outcome": outcome(result),
        "succeeded": result.succeeded(),
        "correlation": {
            "is_within": result.correlation.converged,
            "end": Verdict::of_case(result).end,
            "verdict": case_in_words(result),
            "errors": compared.errors(&[]),
            "parameters": report.parameters(),
            "modes": compared.modes()?,
            "first": compared.agreement(&report.first)?,
            "corrected": compared.agreement(&report.last)?,
            "derivatives": report.derivatives()?,
            "passes": result.correlation.passes.iter().map(pass).collect::<Value>(),
        },
        "published_iterations": published_iterations(result)?,
        "element_numbers": result.case.panels.iter().map(|panel| panel.label).collect::<Value>(),
        "test_gage_in": TEST_GAGE,
        "first_gages_in": result.case.first_gages(),
        "pass_gages_in": result.pass_gages,
        "anomaly": result.anomaly,
        "next_step": result.next_step,
        "gage_errors": result.gage_errors(),
    }))
}

/// A pass: factors are totals since the first model, those of its iterations totals since the last exact solution.
fn pass(pass: &Pass) -> Value {
    let (errors, iterations) = (&pass.check.errors, &pass.inner.iterations);
    json!({
        "stop": pass.inner.stop,
        "factors": pass.factors,
        "frequency_rms": errors.frequency_rms(),
        "shape_rms": errors.shape_rms(),
        "unlimited_factors": iterations.first().map(|first| &first.unlimited_factors),
        "history": iterations.iter().map(iteration).collect::<Value>(),
    })
}

/// One iteration of an inner loop: its errors, halvings and factors.
pub fn iteration(iteration: &Iteration) -> Value {
    json!({
        "frequency_error": iteration.errors.frequency,
        "shape_error": iteration.errors.shape,
        "error_sum": iteration.errors.sum(),
        "halvings": iteration.halvings,
        "unlimited_factors": iteration.unlimited_factors,
        "factors": iteration.gage_factors,
    })
}
