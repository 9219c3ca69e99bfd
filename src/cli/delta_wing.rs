//! `corfem delta-wing`.

use super::solver::{Solver, SolverArguments};
use super::{FormatArgument, put};
use clap::Args;
use corfem::delta_wing::DeltaWing;
use corfem::delta_wing::correlation::correlate_wing_with;
use corfem::error::Error;
use corfem::model::FiniteElementModel;
use corfem::report::delta_wing_json::delta_wing_json;
use corfem::report::delta_wing_tables::delta_wing_tables;
use corfem::report::{Format, render};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct DeltaWingArguments {
    /// How to write the report
    #[arg(short, long, value_enum, default_value = "text")]
    format: FormatArgument,
    /// Write the report to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    solver: SolverArguments,
}

/// Writes the wing's answers beside others' and the correlation of its gages; whether it converged.
pub fn delta_wing(arguments: &DeltaWingArguments) -> Result<bool, Error> {
    let wing = DeltaWing::embedded()?;
    let solver = Solver::of(&arguments.solver)?;
    let analyze = |model: &FiniteElementModel, factors: &[f64]| solver.analyze(model, factors);
    let run = correlate_wing_with(&wing, solver.name(), analyze, |_, _| {})?;
    let tables = delta_wing_tables(&wing, &run)?;
    let report = match arguments.format.into() {
        Format::Text => render::render_tables(&tables, false),
        Format::Markdown => render::render_tables(&tables, true),
        Format::Json => delta_wing_json(&wing, &run)?,
        Format::Csv => render::csv(&tables)?,
    };
    put(arguments.output.as_deref(), &report)?;
    Ok(run.correlation.converged)
}
