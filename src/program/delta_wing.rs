//! `corfem delta-wing`.

use super::report::ReportArguments;
use super::solver::{Solver, SolverArguments};
use clap::Args;
use corfem::method::model::FiniteElementModel;
use corfem::present::error::PresentError;
use corfem::present::report::delta_wing_json::delta_wing_json;
use corfem::present::report::delta_wing_tables::delta_wing_tables;
use corfem::present::report::render;
use corfem::studies::delta_wing::DeltaWing;
use corfem::studies::delta_wing::correlation::correlate_wing_with;

#[derive(Debug, Args)]
pub struct DeltaWingArguments {
    #[command(flatten)]
    report: ReportArguments,
    #[command(flatten)]
    solver: SolverArguments,
}

/// Writes the wing's answers beside others' and the correlation of its gages; whether it converged.
pub fn delta_wing(arguments: &DeltaWingArguments) -> Result<bool, PresentError> {
    let wing = DeltaWing::embedded()?;
    let solver = Solver::of(&arguments.solver)?;
    let elements = |model: &FiniteElementModel, factors: &[f64]| {
        Ok::<_, PresentError>(solver.elements(model, factors)?)
    };
    let run = correlate_wing_with(&wing, solver.name(), elements, |_, _| {})?;
    let tables = delta_wing_tables(&wing, &run)?;
    arguments.report.write(&tables, render::render_tables, || {
        delta_wing_json(&wing, &run)
    })?;
    Ok(run.correlation.converged)
}
