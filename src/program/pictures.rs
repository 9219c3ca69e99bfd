//! `corfem figures`, `corfem report` and `corfem dump`: files in a folder.

use super::output::note;
use super::paper::dump::dump as open;
use super::paper::figures::{Figure, case_figures, comparison_figures};
use super::paper::page::{Contents, page};
use super::place::{write_files, write_report};
use clap::Args;
use corfem::present::PresentError;
use corfem::present::table::counted;
use corfem::torque_box::fewer_modes::{FewerModesRun, PUBLISHED_CASE, all_runs};
use corfem::torque_box::{CASES, Case, CaseResult, run_case};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct FiguresArguments {
    /// Write into this folder, created if new
    #[arg(long, value_name = "DIR")]
    folder: PathBuf,
}

#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
pub struct ReportArguments {
    /// Write the page to this file, or to standard output (-)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write the page as report.html into this folder, created if new
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
}

/// The four cases, Case 2 with fewer modes, and the figures of both.
type CasesAndFigures = (Vec<CaseResult>, Vec<FewerModesRun>, Vec<Figure>);

/// Runs the four cases, and Case 2 with fewer modes, and draws them.
fn drawn(quiet: bool) -> Result<CasesAndFigures, PresentError> {
    let mut results = Vec::new();
    for number in CASES {
        let result = run_case(&Case::new(number)?, |_, _| {})?;
        let passes = counted(result.correlation.passes.len(), "pass", "passes");
        if !quiet {
            note(format_args!("case {number}: {passes}"));
        }
        results.push(result);
    }
    let fewer_modes = all_runs(&Case::new(PUBLISHED_CASE)?)?;
    let mut figures = case_figures(&results)?;
    figures.extend(comparison_figures(PUBLISHED_CASE, &fewer_modes)?);
    Ok((results, fewer_modes, figures))
}

/// Writes the files of a run and notes their number.
fn write_counted(
    folder: &Path,
    files: &[(String, String)],
    quiet: bool,
) -> Result<(), PresentError> {
    write_files(folder, files.iter().cloned())?;
    if !quiet {
        let count = files.len();
        note(format_args!("{count} files in {}", folder.display()));
    }
    Ok(())
}

/// Writes the figures.
pub fn figures(
    FiguresArguments { folder }: &FiguresArguments,
    quiet: bool,
) -> Result<(), PresentError> {
    let (_, _, figures) = drawn(quiet)?;
    let files = figures.into_iter();
    let files = files.map(|Figure { name, svg, .. }| (format!("{name}.svg"), svg));
    let files: Vec<_> = files.collect();
    write_counted(folder, &files, quiet)
}

/// Writes the page that has the figures and the tables.
pub fn report(arguments: &ReportArguments, quiet: bool) -> Result<(), PresentError> {
    let (results, fewer_modes, figures) = drawn(quiet)?;
    let place = match (&arguments.output, &arguments.folder) {
        (Some(file), _) => format!("--output {}", file.display()),
        (None, folder) => format!(
            "--folder {}",
            folder.as_deref().unwrap_or(Path::new("")).display()
        ),
    };
    let html = page(&Contents {
        results: &results,
        fewer_modes: &fewer_modes,
        figures: &figures,
        command: &format!("corfem report {place}"),
    })?;
    if let Some(folder) = &arguments.folder {
        write_files(folder, [("report.html", html)])
    } else {
        write_report(arguments.output.as_deref(), html)
    }
}

#[derive(Debug, Args)]
pub struct DumpArguments {
    /// Number of the case, 1 to 4
    #[arg(value_name = "CASE")]
    case: usize,
    /// Write dump.json and every matrix in the format of the Matrix Market into this folder, created if new, instead of only
    /// the JSON document to standard output
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
}

/// Runs a case and writes its matrices and every iteration.
pub fn dump(arguments: &DumpArguments, quiet: bool) -> Result<(), PresentError> {
    let dump = open(&Case::new(arguments.case)?)?;
    let Some(folder) = &arguments.folder else {
        return write_report(None, dump.json);
    };
    let mut files = vec![("dump.json".to_owned(), dump.json)];
    files.extend(dump.matrices);
    write_counted(folder, &files, quiet)
}
