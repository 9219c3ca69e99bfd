//! `corfem cases`: the paper's cases, by the built-in elements or by NASTRAN-95.

use super::command_meant;
use super::output::{OutputArguments, note, reconstruction};
use super::settings::SettingsArguments;
use super::solver::{Solver, SolverArguments};
use clap::Args;
use corfem::method::error::Error;
use corfem::present::table::counted;
use corfem::present::{PresentError, json, tables};
use corfem::torque_box::wing_box::Reconstruction;
use corfem::torque_box::{CASES, Case, CaseResult, Grouping, run_case_with};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct CasesArguments {
    /// Which cases to run, 1 to 4; all four if none is named. Cases 1 to 3 are correlated; Case 4 detects a modeling
    /// error in one iteration and corrects no gage
    #[arg(value_name = "CASE", value_parser = case_number)]
    cases: Vec<usize>,
    #[command(flatten)]
    output: OutputArguments,
    /// Torque box to use instead of the built-in one (a file like paper/reconstruction.toml)
    #[arg(long = "box", value_name = "FILE")]
    box_file: Option<PathBuf>,
    /// Scale covers, spars and ribs as groups instead of every panel on its own
    #[arg(long)]
    groups: bool,
    #[command(flatten)]
    settings: SettingsArguments,
    #[command(flatten)]
    solver: SolverArguments,
}

/// The number of a case; for a word that is none, the command that may have been meant.
fn case_number(word: &str) -> Result<usize, String> {
    let meant = || match command_meant(word) {
        Some(command) if command == word => format!("; a command comes first: corfem {command}"),
        Some(command) => format!("; did you mean corfem {command}?"),
        None => String::new(),
    };
    word.parse()
        .map_err(|_| format!("{word} is not the number of a case, 1 to 4{}", meant()))
}

/// The cases asked for, each once.
fn chosen(
    arguments: &CasesArguments,
    reconstruction: &Reconstruction,
) -> Result<Vec<Case>, PresentError> {
    let numbers = if arguments.cases.is_empty() {
        &CASES[..]
    } else {
        &arguments.cases
    };
    let case = |(row, &number): (usize, &usize)| {
        if numbers[..row].contains(&number) {
            return Err(Error::Duplicate {
                what: "case",
                label: number,
            }
            .into());
        }
        let mut case = Case::from_reconstruction(number, reconstruction.clone())?;
        arguments.settings.apply(&mut case.settings)?;
        if arguments.groups {
            case.grouping = Grouping::Substructures;
        }
        Ok(case)
    };
    numbers.iter().enumerate().map(case).collect()
}

/// Runs the cases asked for and writes the report; whether all of them succeeded.
pub fn cases(arguments: &CasesArguments, quiet: bool) -> Result<bool, PresentError> {
    let reconstruction = reconstruction(arguments.box_file.as_deref())?;
    let solver = Solver::from_arguments(&arguments.solver)?;
    let mut results = Vec::new();
    for case in chosen(arguments, &reconstruction)? {
        let number = case.number;
        let elements = |model: &_, factors: &[f64]| solver.elements(model, factors);
        results.push(run_case_with(&case, solver.name(), elements, |pass, done| {
            if !quiet {
                note(format_args!(
                    "case {number}, pass {pass}: {}, error sum {:.4} by perturbation, {:.4} exact",
                    counted(done.inner.iterations.len(), "iteration", "iterations"),
                    done.inner.last.errors().sum(),
                    done.check.errors.sum(),
                ));
            }
        })?);
    }
    let mut tables = tables::cases::all_tables(&results)?;
    if arguments.cases.is_empty() {
        tables.push(tables::published::root_error_table()?);
    }
    let here = tables::paper_tables(tables.iter().map(|table| table.name.as_str()));
    if let Some(last) = tables.last_mut() {
        last.notes.push(here);
    }
    arguments.output.write(&tables, || json::cases(&results))?;
    Ok(results.iter().all(CaseResult::succeeded))
}
