//! The figure to play with: Case 2's first pass, its gages to be dragged, its modes solved in the page.

use corfem::method::analysis::Analysis;
use corfem::method::step::LEAST_SHARE;
use corfem::present::PresentError;
use corfem::torque_box::CaseResult;
use corfem::torque_box::wing_box::TEST_GAGE;
use nalgebra::DMatrix;
use serde_json::json;

/// A case's first pass as HTML with its script and data, to stand in any page; nothing without a pass.
///
/// The script holds the panels' shares $V^t B K_e B^t V$ (9 × 9, lower triangles), and finds modes, pairs and errors from them as
/// the program does, by Jacobi rotations.
///
/// # Errors
/// The errors of the case's model and its analysis.
pub fn play(result: &CaseResult) -> Result<String, PresentError> {
    let Some(pass) = result.correlation.passes.first() else {
        return Ok(String::new());
    };
    let (case, test) = (&result.case, &result.test);
    let ones = vec![1.0; result.parameter_names.len()];
    let first = case.model()?.analyze(&ones, test, None)?;
    let rows = |matrix: &DMatrix<f64>| -> Vec<Vec<f64>> {
        matrix
            .row_iter()
            .map(|row| row.iter().copied().collect())
            .collect()
    };
    let triangle = |matrix: &DMatrix<f64>| -> Vec<f64> {
        (0..matrix.nrows())
            .flat_map(|i| (0..=i).map(move |j| matrix[(i, j)]))
            .collect()
    };
    let shares = first.shares().iter().map(triangle);
    let steps = pass.inner.iterations.iter().map(|step| &step.factors);
    let mils = 1000.0 * case.first_gages().first().copied().unwrap_or(TEST_GAGE);
    let modes = &first.exact().modes;
    let data = json!({
        "squares": modes.omega_squared().as_slice(),
        "shares": shares.collect::<Vec<_>>(),
        "shapes": rows(modes.shapes()),
        "test": rows(test.shapes()),
        "hertz": test.frequencies_hz(),
        "masses": case.reconstruction.masses,
        "steps": std::iter::once(&ones).chain(steps).collect::<Vec<_>>(),
        "mils": mils,
        "truth": 1000.0 * TEST_GAGE,
        "exact": pass.check.errors.sum(),
        "least": LEAST_SHARE,
    });
    Ok([
        include_str!("play.html"),
        "<script>\nconst DATA = ",
        &data.to_string(),
        ";\n",
        include_str!("play.js"),
        "</script>\n",
    ]
    .concat())
}
