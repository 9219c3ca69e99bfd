//! The history of the cases as JSON.

use super::report::case_report;
use super::tables::cases::{outcome, published_iterations};
use corfem::present::PresentError;
use corfem::present::json::{document, report};
use corfem::torque_box::CaseResult;
use corfem::torque_box::wing_box::TEST_GAGE;
use serde_json::{Value, json};

/// The history of the cases run.
///
/// # Errors
/// [`PresentError::Case`] if Table 13 were damaged; the errors of [`document`].
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
        "correlation": report(&case_report(result)?)?,
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
