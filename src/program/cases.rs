//! `corfem cases`: the paper's cases, by the built-in elements or by NASTRAN-95.

use super::output::{OutputArguments, reconstruction};
use super::settings::SettingsArguments;
use super::solver::{Solver, SolverArguments};
use clap::Args;
use corfem::cases::fit::fit;
use corfem::cases::{CASES, Case, CaseResult, Grouping, run_case_with};
use corfem::present::table::counted;
use corfem::present::{PresentError, json, tables};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct CasesArguments {
    /// Which cases to run; all four if none is named
    #[arg(value_name = "CASE")]
    cases: Vec<usize>,
    #[command(flatten)]
    output: OutputArguments,
    /// Use another torque box than the reconstructed one (a file like paper/reconstruction.toml)
    #[arg(long = "box", value_name = "FILE")]
    box_file: Option<PathBuf>,
    /// Scale covers, spars and ribs as groups instead of every panel on its own
    #[arg(long)]
    groups: bool,
    #[command(flatten)]
    settings: SettingsArguments,
    #[command(flatten)]
    solver: SolverArguments,
    /// Do not report progress
    #[arg(short, long)]
    quiet: bool,
}

/// Runs the cases asked for and writes the report; whether all of them succeeded.
pub fn cases(arguments: &CasesArguments) -> Result<bool, PresentError> {
    let reconstruction = reconstruction(arguments.box_file.as_deref())?;
    let solver = Solver::of(&arguments.solver)?;
    let numbers = if arguments.cases.is_empty() { &CASES[..] } else { &arguments.cases };
    let mut results = Vec::new();
    for &number in numbers {
        let mut case = Case::on(number, reconstruction.clone())?;
        arguments.settings.apply(&mut case.settings)?;
        if arguments.groups {
            case.grouping = Grouping::Substructures;
        }
        let elements = |model: &_, factors: &[f64]| solver.elements(model, factors);
        results.push(run_case_with(&case, solver.name(), elements, |pass, done| {
            if !arguments.quiet {
                eprintln!(
                    "case {number}, pass {pass}: {}, error sum {:.4} by perturbation, {:.4} exact",
                    counted(done.inner.iterations.len(), "iteration", "iterations"),
                    done.inner.last.errors.sum(),
                    done.check.errors.sum(),
                );
            }
        })?);
    }
    let fit = fit(&reconstruction)?;
    let mut tables = tables::cases::all_tables(&results, &fit)?;
    if arguments.cases.is_empty() {
        tables.push(tables::table_1::root_error_table()?);
    }
    let held = tables::paper_tables(tables.iter().map(|table| table.name.as_str()));
    if let Some(last) = tables.last_mut() {
        last.notes.push(held);
    }
    arguments.output.write(&tables, || json::cases(&results, &fit))?;
    Ok(results.iter().all(CaseResult::succeeded))
}
