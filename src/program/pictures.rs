//! `corfem figures` and `corfem report`: files in a folder.

use super::output::{note, write, write_files};
use super::paper::figures::{Figure, case_figures};
use super::paper::page::{Contents, page};
use clap::Args;
use corfem::present::PresentError;
use corfem::present::table::counted;
use corfem::torque_box::fewer_modes::{PUBLISHED_CASE, published_runs};
use corfem::torque_box::{CASES, Case, CaseResult, run_case};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct FiguresArguments {
    /// Write into this folder, created if new
    #[arg(long, value_name = "DIR")]
    folder: PathBuf,
}

#[derive(Debug, Args)]
pub struct ReportArguments {
    /// Write the page to this file instead of standard output (-)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Runs the four cases and draws them.
fn drawn(quiet: bool) -> Result<(Vec<CaseResult>, Vec<Figure>), PresentError> {
    let mut results = Vec::new();
    for number in CASES {
        let result = run_case(&Case::new(number)?, |_, _| {})?;
        let passes = counted(result.correlation.passes.len(), "pass", "passes");
        if !quiet {
            note(format_args!("case {number}: {passes}"));
        }
        results.push(result);
    }
    let figures = case_figures(&results)?;
    Ok((results, figures))
}

/// Writes the figures.
pub fn figures(
    FiguresArguments { folder }: &FiguresArguments,
    quiet: bool,
) -> Result<bool, PresentError> {
    let (_, figures) = drawn(quiet)?;
    let files = figures.into_iter();
    let files = files.map(|Figure { name, svg, .. }| (format!("{name}.svg"), svg));
    let files: Vec<_> = files.collect();
    let count = files.len();
    write_files(folder, files)?;
    if !quiet {
        note(format_args!("{count} files in {}", folder.display()));
    }
    Ok(true)
}

/// Writes the page that has the figures and the tables.
pub fn report(arguments: &ReportArguments, quiet: bool) -> Result<bool, PresentError> {
    let (results, figures) = drawn(quiet)?;
    let place = arguments.output.as_deref().unwrap_or(Path::new("-"));
    let html = page(&Contents {
        results: &results,
        fewer_modes: &published_runs(&Case::new(PUBLISHED_CASE)?)?,
        figures: &figures,
        command: &format!("corfem report --output {}", place.display()),
    })?;
    write(Some(place), html.as_bytes())?;
    Ok(true)
}
