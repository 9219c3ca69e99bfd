//! A case opened up: its matrices and every iteration, for a program in another language to be checked against.

use corfem::files::matrices::write_matrix_market;
use corfem::method::inner_loop::Iteration;
use corfem::method::modes::solve;
use corfem::method::outer_loop::Pass;
use corfem::method::structure::{DIRECTIONS, StructuralDof};
use corfem::present::PresentError;
use corfem::present::json::{document, iteration};
use corfem::present::report::matrix_rows;
use corfem::sparse::SparseMatrix;
use corfem::torque_box::{Case, run_case};
use nalgebra::DMatrix;
use serde_json::{Value, json};
use std::iter::once;

/// A case as one JSON document, and its matrices as texts in the format of the Matrix Market with the names of their files.
#[derive(Debug, Clone, PartialEq)]
pub struct Dump {
    /// The document.
    pub json: String,
    /// $T$ (SDOF × d) and $V_G$ (d × g), and of every analysis $K_D$, $M$, $V$ (d × n), $B$ (d × SDOF) and each share (d × d).
    pub matrices: Vec<(String, String)>,
}

/// Runs a case and records everything it computes.
///
/// `analyses` are the exact solutions: pass $p$ begins at the $p$-th and ends at the next. An iteration has $\Delta e$ and $\Delta k$ of
/// every parameter where it began, the unlimited factors of (13), and the totals and errors where it ended.
///
/// # Errors
/// The errors of the case's model and run, and of [`document`].
pub fn dump(case: &Case) -> Result<Dump, PresentError> {
    let (model, result) = (case.model()?, run_case(case, |_, _| {})?);
    let (names, passes) = (&result.parameter_names, &result.correlation.passes);
    let first = vec![1.0; names.len()];
    let mut matrices = vec![
        file("T", model.load_distribution())?,
        file("V_G", result.test.shapes())?,
    ];
    let mut analyses = Vec::new();
    for (number, factors) in (1..).zip(once(&first).chain(passes.iter().map(|pass| &pass.factors)))
    {
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
            matrices.push(file(&format!("analysis_{number}_{name}"), matrix)?);
        }
        analysis["shares"] = dynamic.shares.iter().map(matrix_rows).collect();
        for (name, share) in names.iter().zip(&dynamic.shares) {
            matrices.push(file(&format!("analysis_{number}_share_{name}"), share)?);
        }
        analyses.push(analysis);
    }
    let dof =
        |dof: &StructuralDof| json!({"grid": dof.grid, "direction": DIRECTIONS[dof.direction]});
    let json = document(json!({
        "case": case.number,
        "settings": case.settings,
        "gage_range": case.gage_range,
        "structural_dof": model.structure().free_dof().iter().map(dof).collect::<Value>(),
        "parameters": names,
        "T": matrix_rows(model.load_distribution()),
        "test": {"frequencies_hz": result.test.frequencies_hz(), "V_G": matrix_rows(result.test.shapes())},
        "analyses": analyses,
        "passes": passes.iter().map(pass).collect::<Value>(),
    }))?;
    Ok(Dump { json, matrices })
}

/// A matrix as a file: its name and its text.
fn file(name: &str, matrix: &DMatrix<f64>) -> Result<(String, String), PresentError> {
    let place = |index: usize| {
        (
            index % matrix.nrows(),
            index / matrix.nrows(),
            matrix[index],
        )
    };
    let entries = (0..matrix.len()).map(place).collect();
    let sparse = SparseMatrix::new("matrix of a case", matrix.nrows(), matrix.ncols(), entries)?;
    Ok((format!("{name}.mtx"), write_matrix_market(&sparse)))
}

fn pass(pass: &Pass) -> Value {
    // With the derivatives where it began.
    let whole = |step: &Iteration| {
        let mut value = iteration(step);
        value["error_changes"] = json!(step.error_changes);
        value["stiffness_changes"] = json!(step.stiffness_changes);
        value
    };
    json!({
        "start_error_sum": pass.inner.start.sum(),
        "iterations": pass.inner.iterations.iter().map(whole).collect::<Value>(),
        "stop": pass.inner.stop,
        "exact_error_sum": pass.check.errors.sum(),
    })
}
