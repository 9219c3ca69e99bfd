//! The delta wing as JSON.

use super::json::{PROGRAM, UNITS, VERSION, written};
use crate::method::inner_loop::Stop;
use crate::method::model::Check;
use crate::method::outer_loop::Pass;
use crate::present::error::PresentError;
use crate::studies::delta_wing::correlation::{Recovered, TEST_MODES, WingCorrelation};
use crate::studies::delta_wing::{DeltaWing, MEASURED_GRIDS, TipLoad};
use serde::Serialize;

#[derive(Debug, Serialize)]
struct Document {
    program: &'static str,
    version: &'static str,
    units: &'static str,
    measured_grids: [usize; MEASURED_GRIDS.len()],
    trailing_edge_load_deflections_in: Vec<f64>,
    leading_edge_load_deflections_in: Vec<f64>,
    frequencies_hz: Vec<f64>,
    solver: &'static str,
    groups: Vec<GroupDocument>,
    test_modes: [usize; TEST_MODES.len()],
    test_frequencies_hz: Vec<f64>,
    converged: bool,
    initial: CheckDocument,
    passes: Vec<PassDocument>,
}

#[derive(Debug, Serialize)]
struct GroupDocument {
    name: &'static str,
    elements: &'static [usize],
    true_factor: f64,
    factor: f64,
    largest_share: f64,
}

#[derive(Debug, Serialize)]
struct CheckDocument {
    frequencies_hz: Vec<f64>,
    frequency_rms: f64,
    shape_rms: f64,
}

#[derive(Debug, Serialize)]
struct PassDocument {
    iterations: usize,
    stop: Stop,
    inner_error_sums: Vec<f64>,
    factors: Vec<f64>,
    exact: CheckDocument,
}

/// The wing's answers and the whole correlation as pretty-printed JSON: deflections along z in inches, errors as fractions,
/// factors on the first gages in the order of the groups; `solver` did the finite element analyses of the correlation.
///
/// # Errors
/// Those of the wing's analyses; [`Error::Table`] if a number were not finite.
pub fn delta_wing_json(wing: &DeltaWing, run: &WingCorrelation) -> Result<String, PresentError> {
    let correlation = &run.correlation;
    written(&Document {
        program: PROGRAM,
        version: VERSION,
        units: UNITS,
        measured_grids: MEASURED_GRIDS,
        trailing_edge_load_deflections_in: wing.deflections(TipLoad::TrailingEdge)?,
        leading_edge_load_deflections_in: wing.deflections(TipLoad::LeadingEdge)?,
        frequencies_hz: wing.modes()?.modes.frequencies_hz(),
        solver: run.solver,
        groups: run.groups.iter().map(group_document).collect(),
        test_modes: TEST_MODES,
        test_frequencies_hz: run.test.frequencies_hz(),
        converged: correlation.converged,
        initial: check_document(&correlation.initial),
        passes: correlation.passes.iter().map(pass_document).collect(),
    })
}

fn group_document(recovered: &Recovered) -> GroupDocument {
    GroupDocument {
        name: recovered.group.name,
        elements: recovered.group.elements,
        true_factor: recovered.true_factor(),
        factor: recovered.factor,
        largest_share: recovered.share,
    }
}

fn check_document(check: &Check) -> CheckDocument {
    CheckDocument {
        frequencies_hz: check.frequencies_hz.clone(),
        frequency_rms: check.errors.frequency_rms(),
        shape_rms: check.errors.shape_rms(),
    }
}

fn pass_document(pass: &Pass) -> PassDocument {
    let iterations = pass.inner.iterations.iter();
    PassDocument {
        iterations: pass.inner.iterations.len(),
        stop: pass.inner.stop,
        inner_error_sums: iterations.map(|step| step.errors.sum()).collect(),
        factors: pass.factors.clone(),
        exact: check_document(&pass.check),
    }
}
