//! `corfem cases`: the paper's cases, by the built-in elements or by NASTRAN-95.

use super::{FormatArgument, put, reconstruction};
use clap::{Args, ValueEnum};
use corfem::cases::{BUILT_IN, CASES, Case, CaseResult, Grouping, run_case_with};
use corfem::error::Error;
use corfem::fit::{Fit, fit};
use corfem::modal::DynamicModel;
use corfem::model::FiniteElementModel;
use corfem::nastran95::{NAME, Nastran95, default_folder};
use corfem::report::run_tables::all_tables;
use corfem::report::{Format, json, render};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

#[derive(Debug, Args)]
pub struct CasesArguments {
    /// Which cases to run; all four if none is named
    #[arg(value_name = "CASE")]
    cases: Vec<usize>,
    /// How to write the report
    #[arg(short, long, value_enum, default_value = "text")]
    format: FormatArgument,
    /// Write the report to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Use another torque box than the reconstructed one (a file like paper/reconstruction.toml)
    #[arg(long = "box", value_name = "FILE")]
    box_file: Option<PathBuf>,
    /// Limit every pass to this many inner iterations
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    iterations: Option<u32>,
    /// Scale covers, spars and ribs as groups instead of every panel on its own
    #[arg(long)]
    groups: bool,
    /// Which program does the finite element analyses of the outer loop
    #[arg(long, value_enum, default_value = "built-in")]
    solver: SolverArgument,
    /// Folder of NASTRAN-95, with bin/nastrn and rf/; without it .cache/nastran95/nastran95/_data in the home folder
    #[arg(long, value_name = "FOLDER", env = "NASTRAN95")]
    nastran: Option<PathBuf>,
    /// Seconds after which a run of NASTRAN-95 is stopped
    #[arg(long, value_name = "SECONDS", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..))]
    time_limit: u32,
    /// Do not report progress
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SolverArgument {
    /// The elements of this program
    BuiltIn,
    /// NASTRAN-95, run once for every analysis
    #[value(name = "nastran95")]
    Nastran95,
}

/// Runs the cases asked for and writes the report; whether all of them succeeded.
pub fn cases(arguments: &CasesArguments) -> Result<bool, Error> {
    let reconstruction = reconstruction(arguments.box_file.as_deref())?;
    let solver = match arguments.solver {
        SolverArgument::BuiltIn => None,
        SolverArgument::Nastran95 => Some(nastran(arguments)?),
    };
    let analyze = |model: &FiniteElementModel, factors: &[f64]| -> Result<DynamicModel, Error> {
        match &solver {
            None => model.analyze(factors),
            Some(nastran) => nastran.analyze(model, factors),
        }
    };
    let numbers = if arguments.cases.is_empty() {
        CASES.to_vec()
    } else {
        arguments.cases.clone()
    };
    let mut results = Vec::new();
    for number in numbers {
        let mut case = Case::on(number, reconstruction.clone())?;
        if let Some(most) = arguments.iterations {
            case.settings.inner.iterations = case.settings.inner.iterations.min(most as usize);
        }
        if arguments.groups {
            case.grouping = Grouping::Substructures;
        }
        let name = solver.as_ref().map_or(BUILT_IN, |_| NAME);
        results.push(run_case_with(&case, name, analyze, |pass, done| {
            if !arguments.quiet {
                eprintln!(
                    "case {number}, pass {pass}: {} iterations, error sum {:.4} by perturbation, {:.4} exact",
                    done.inner.iterations.len(),
                    done.inner.last.errors.sum(),
                    done.check.errors.sum(),
                );
            }
        })?);
    }
    let fit = fit(&reconstruction)?;
    let report = write_report(&results, &fit, arguments.format.into())?;
    put(arguments.output.as_deref(), &report)?;
    Ok(results.iter().all(CaseResult::succeeded))
}

fn write_report(results: &[CaseResult], fit: &Fit, format: Format) -> Result<String, Error> {
    let tables = all_tables(results, fit)?;
    match format {
        Format::Text => Ok(render::render(&tables, false)),
        Format::Markdown => Ok(render::render(&tables, true)),
        Format::Json => json::json(results, fit),
        Format::Csv => render::csv(&tables),
    }
}

/// NASTRAN-95, to be stopped by the signals that ask this program to stop.
fn nastran(arguments: &CasesArguments) -> Result<Nastran95, Error> {
    let folder = arguments.nastran.clone().unwrap_or_else(default_folder);
    let mut nastran = Nastran95::in_folder(&folder)?;
    nastran.time_limit = Duration::from_secs(arguments.time_limit.into());
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
        // A program that cannot be told to stop still does its work.
        let _ = signal_hook::flag::register(signal, Arc::clone(&nastran.stop));
    }
    Ok(nastran)
}
