//! A case opened up: its matrices and every iteration, for a program in another language to be checked against.

use crate::paper::json::iteration;
use corfem::method::analysis::State;
use corfem::method::inner_loop::Iteration;
use corfem::method::modes::solve;
use corfem::method::outer_loop::Pass;
use corfem::method::structure::{DIRECTIONS, StructuralDof};
use corfem::present::PresentError;
use corfem::present::compared::matrix_rows;
use corfem::present::json::{BOX_UNITS, document};
use corfem::torque_box::{Case, run_case};
use nalgebra::DMatrix;
use serde_json::{Value, json};
use std::iter::once;

/// Runs a case and records everything it computes.
///
/// `analyses` are the exact solutions: pass $p$ begins at the $p$-th and ends at the next. An iteration has $\Delta e$ and $\Delta k$ of
/// every parameter where it began, the unlimited factors of (13), and the totals and errors where it ended.
///
/// # Errors
/// The errors of the case's model and run, and of [`document`].
pub fn dump(case: &Case) -> Result<String, PresentError> {
    let (model, result) = (case.model()?, run_case(case, |_, _| {})?);
    let (names, passes) = (&result.parameter_names, &result.correlation.passes);
    let checks = passes.iter().map(|pass| &pass.check);
    let starts = once(&result.correlation.initial).chain(checks);
    let first = vec![1.0; names.len()];
    let mut analyses = Vec::new();
    for factors in once(&first).chain(passes.iter().map(|pass| &pass.factors)) {
        let (dynamic, condensed) = (model.matrices(factors)?, model.condense(factors)?);
        let modes = solve(&dynamic.stiffness, &dynamic.mass, dynamic.mass.nrows())?;
        let points = DMatrix::identity(dynamic.mass.nrows(), dynamic.mass.nrows());
        let b = (&condensed.transformation * &points).transpose();
        let mut analysis = json!({"factors": factors, "sizes": model.sizes(factors)?, "frequencies_hz": modes.frequencies_hz()});
        for (name, matrix) in [
            ("K_D", &dynamic.stiffness),
            ("M", &dynamic.mass),
            ("V", modes.shapes()),
            ("B", &b),
        ] {
            analysis[name] = json!(matrix_rows(matrix));
        }
        analysis["shares"] = dynamic.shares.iter().map(matrix_rows).collect();
        analyses.push(analysis);
    }
    let dof =
        |dof: &StructuralDof| json!({"grid": dof.grid, "direction": DIRECTIONS[dof.direction]});
    document(
        BOX_UNITS,
        json!({
            "case": case.number,
            "settings": case.settings,
            "gage_range": case.gage_range,
            "structural_dof": model.structure().free_dof().iter().map(dof).collect::<Value>(),
            "parameters": names,
            "T": matrix_rows(model.load_distribution()),
            "test": {"frequencies_hz": result.test.frequencies_hz(), "V_G": matrix_rows(result.test.shapes())},
            "analyses": analyses,
            "passes": starts.zip(passes).map(pass).collect::<Value>(),
        }),
    )
}

fn pass((start, pass): (&State, &Pass)) -> Value {
    // With the derivatives where it began.
    let whole = |step: &Iteration| {
        let mut value = iteration(step);
        value["error_changes"] = json!(step.error_changes);
        value["stiffness_changes"] = json!(step.stiffness_changes);
        value
    };
    json!({
        "start_error_sum": start.errors.sum(),
        "iterations": pass.inner.iterations.iter().map(whole).collect::<Value>(),
        "stop": pass.inner.stop,
        "exact_error_sum": pass.check.errors.sum(),
    })
}
