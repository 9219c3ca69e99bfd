//! Arguments, progress, output and exit status; all the work is the library's.

mod pictures;

use clap::{Args, Parser, Subcommand, ValueEnum};
use corfem::cases::{CASES, Case, CaseResult, Grouping, run_case};
use corfem::error::Error;
use corfem::fewer_modes::{all_runs, published_runs};
use corfem::fit::fit;
use corfem::report::fewer_modes_tables::fewer_modes_tables;
use corfem::report::run_tables::all_tables;
use corfem::report::table::Table;
use corfem::report::{Format, json, render};
use corfem::torque_box::Reconstruction;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const BAD_INPUT: u8 = 2;
const NOT_CONVERGED: u8 = 3;

/// Corrects a finite element model until its frequencies and mode shapes agree with a ground vibration test.
///
/// Without a command it does what `corfem cases` does: it correlates the paper's four cases on its wing torque box
/// and prints every table beside the published one.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100, after_help = AFTER_HELP, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    cases: CasesArguments,
}

const AFTER_HELP: &str = "\
Units: inch, pound-force, second; mass in lbf·s²/in; frequency in hertz.

Exit status: 0 the cases converged, 2 bad input, 3 not converged within the limits (the best found is still printed).

Results go to standard output, progress to standard error.";

#[derive(Debug, Subcommand)]
enum Command {
    /// Correlate the paper's cases and print the tables beside the published ones
    Cases(CasesArguments),
    /// Write every figure as SVG
    Figures(pictures::FiguresArguments),
    /// Write the report as one web page with tables, figures and assumptions
    Report(pictures::ReportArguments),
    /// Correlate Case 2 with fewer test and analysis modes (Tables 9 to 12), and show what truncation costs
    FewerModes(OutputArguments),
}

#[derive(Debug, Args)]
struct OutputArguments {
    /// How to write the report
    #[arg(short, long, value_enum, default_value = "text")]
    format: FormatArgument,
    /// Write the report to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Debug, Args)]
struct CasesArguments {
    /// Which cases to run; all four if none is named
    #[arg(value_name = "CASE")]
    cases: Vec<usize>,
    #[command(flatten)]
    output: OutputArguments,
    /// Use another torque box than the reconstructed one (a file like paper/reconstruction.toml)
    #[arg(long = "box", value_name = "FILE")]
    box_file: Option<PathBuf>,
    /// Limit every pass to this many inner iterations
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    iterations: Option<u32>,
    /// Scale covers, spars and ribs as groups instead of every panel on its own
    #[arg(long)]
    groups: bool,
    /// Do not report progress
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FormatArgument {
    /// Tables for a terminal
    Text,
    /// Tables in Markdown
    Markdown,
    /// The whole history as JSON
    Json,
    /// One number a line
    Csv,
}

impl From<FormatArgument> for Format {
    fn from(argument: FormatArgument) -> Self {
        match argument {
            FormatArgument::Text => Self::Text,
            FormatArgument::Markdown => Self::Markdown,
            FormatArgument::Json => Self::Json,
            FormatArgument::Csv => Self::Csv,
        }
    }
}

/// Runs the program.
pub fn run() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match arguments.command {
        None => cases(&arguments.cases),
        Some(Command::Cases(arguments)) => cases(&arguments),
        Some(Command::Figures(arguments)) => pictures::figures(&arguments),
        Some(Command::Report(arguments)) => pictures::report(&arguments),
        Some(Command::FewerModes(output)) => fewer_modes(&output),
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(NOT_CONVERGED),
        Err(error) => {
            eprintln!("corfem: {error}");
            ExitCode::from(BAD_INPUT)
        }
    }
}

/// Runs the cases asked for and writes the report; whether all of them succeeded.
fn cases(arguments: &CasesArguments) -> Result<bool, Error> {
    let reconstruction = match &arguments.box_file {
        None => Reconstruction::embedded()?,
        Some(path) => Reconstruction::parse(&path.display().to_string(), &read(path)?)?,
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
        results.push(run_case(&case, |pass, done| {
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
    let tables = all_tables(&results, &fit)?;
    write_report(&arguments.output, &tables, || json::json(&results, &fit))?;
    Ok(results.iter().all(CaseResult::succeeded))
}

/// Runs Case 2 with fewer modes; there is nothing to converge to, so it always succeeds.
fn fewer_modes(output: &OutputArguments) -> Result<bool, Error> {
    let case = Case::new(2)?;
    let runs = all_runs(&case)?;
    let tables = fewer_modes_tables(&case, &published_runs(&case)?, &runs)?;
    write_report(output, &tables, || json::fewer_modes(&runs))?;
    Ok(true)
}

/// Writes tables, or what they were made from as JSON, where the arguments say.
fn write_report(
    output: &OutputArguments,
    tables: &[Table],
    json: impl FnOnce() -> Result<String, Error>,
) -> Result<(), Error> {
    let report = match output.format.into() {
        Format::Text => render::render(tables, false),
        Format::Markdown => render::render(tables, true),
        Format::Json => json()?,
        Format::Csv => render::csv(tables)?,
    };
    put(output.output.as_deref(), &report)
}

fn read(path: &Path) -> Result<String, Error> {
    std::fs::read_to_string(path).map_err(|source| Error::File {
        path: path.to_owned(),
        action: "read",
        source,
    })
}

/// Writes to a file, whole or not at all, or to standard output.
fn put(path: Option<&Path>, text: &str) -> Result<(), Error> {
    let Some(path) = path else {
        // A reader that has seen enough closes the pipe; that is no error of ours.
        let _ = std::io::stdout().write_all(text.as_bytes());
        return Ok(());
    };
    let failed = |source| Error::File {
        path: path.to_owned(),
        action: "write",
        source,
    };
    let folder = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(failed)?;
    file.write_all(text.as_bytes()).map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}
