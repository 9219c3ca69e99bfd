//! `corfem cases`: the paper's cases.

use super::output::{OutputArguments, note, reconstruction, tell};
use super::paper::{json, overview::overview, tables};
use super::settings::SettingsArguments;
use clap::Args;
use corfem::present::PresentError;
use corfem::present::table::counted;
use corfem::torque_box::wing_box::Reconstruction;
use corfem::torque_box::{CASES, Case, CaseResult, Grouping, run_case};
use std::path::PathBuf;

#[derive(Debug, Default, Args)]
pub struct CasesArguments {
    /// Cases to run, 1 to 4, and to print in full; without any all four in brief. Cases 1 to 3 are correlated; Case 4
    /// detects a modeling error in one iteration and corrects no gage
    #[arg(value_name = "CASE")]
    cases: Vec<usize>,
    /// Print all four cases in full
    #[arg(long, conflicts_with = "cases")]
    all: bool,
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
}

/// The cases asked for.
fn chosen(
    arguments: &CasesArguments,
    reconstruction: &Reconstruction,
) -> Result<Vec<Case>, PresentError> {
    let numbers = if arguments.cases.is_empty() {
        &CASES[..]
    } else {
        &arguments.cases
    };
    let case = |&number: &usize| {
        let mut case = Case::from_reconstruction(number, reconstruction.clone())?;
        arguments.settings.apply(&mut case.settings)?;
        if arguments.groups {
            case.grouping = Grouping::Substructures;
        }
        Ok(case)
    };
    numbers.iter().map(case).collect()
}

/// Runs the cases asked for and writes the report; true if all of them succeeded.
pub fn cases(arguments: &CasesArguments, quiet: bool) -> Result<bool, PresentError> {
    let reconstruction = reconstruction(arguments.box_file.as_deref())?;
    let is_brief = arguments.cases.is_empty() && !arguments.all && arguments.output.is_text();
    let mut results = Vec::new();
    for case in chosen(arguments, &reconstruction)? {
        let number = case.number;
        results.push(run_case(&case, |pass, done| {
            let words = format!(
                "case {number}, pass {pass}: {}, error sum {:.4}",
                counted(done.inner.iterations.len(), "iteration", "iterations"),
                done.check.errors.sum(),
            );
            match is_brief {
                true => tell(quiet, &words),
                false if quiet => (),
                false => note(words),
            }
        })?);
    }
    tell(quiet, "");
    if is_brief {
        arguments.output.write_text(&overview(&results)?)?;
    } else {
        let mut tables = tables::cases::all_tables(&results)?;
        let here = tables::paper_tables(tables.iter().map(|table| table.name.as_str()));
        if let Some(last) = tables.last_mut() {
            last.notes.push(here);
        }
        arguments.output.write(&tables, || json::cases(&results))?;
    }
    Ok(results.iter().all(CaseResult::succeeded))
}
