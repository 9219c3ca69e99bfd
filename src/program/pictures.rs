//! `corfem figures` and `corfem report`: files in a folder, all of them or none.

use super::output::put_all;
use clap::Args;
use corfem::cases::fewer_modes::{FewerModesRun, PUBLISHED_CASE, all_runs};
use corfem::cases::fit::fit;
use corfem::cases::torque_box::Reconstruction;
use corfem::cases::{CASES, Case, CaseResult, run_case};
use corfem::present::PresentError;
use corfem::present::figures::{Figure, case_figures, comparison_figures};
use corfem::present::page::{Contents, page};
use corfem::present::table::counted;
use corfem::studies::matrix_comparison::{
    MatrixComparison, USUAL_CASE, USUAL_TEST_MODES, compare_matrices,
};
use std::path::PathBuf;

/// Arguments of `corfem figures` and of `corfem report`.
#[derive(Debug, Args)]
pub struct FolderArguments {
    /// Write into this folder, made if it is new
    #[arg(short, long, value_name = "DIR")]
    out: PathBuf,
    /// Do not report progress
    #[arg(short, long)]
    quiet: bool,
}

/// Everything there is to show.
struct Runs {
    cases: Vec<CaseResult>,
    fewer_modes: Vec<FewerModesRun>,
    matrices: MatrixComparison,
    figures: Vec<Figure>,
}

impl Runs {
    fn new(quiet: bool) -> Result<Self, PresentError> {
        let mut cases = Vec::new();
        for number in CASES {
            let result = run_case(&Case::new(number)?, |_, _| {})?;
            if !quiet {
                let passes = counted(result.correlation.passes.len(), "pass", "passes");
                eprintln!("case {number}: {passes}");
            }
            cases.push(result);
        }
        let fewer_modes = all_runs(&Case::new(PUBLISHED_CASE)?)?;
        let matrices = compare_matrices(&Case::new(USUAL_CASE)?, USUAL_TEST_MODES)?;
        let mut figures = case_figures(&cases)?;
        figures.extend(comparison_figures(PUBLISHED_CASE, &fewer_modes, &matrices)?);
        Ok(Self {
            cases,
            fewer_modes,
            matrices,
            figures,
        })
    }
}

/// Runs the four cases and what is compared with them, and writes the figures.
pub fn figures(arguments: &FolderArguments) -> Result<(), PresentError> {
    let runs = Runs::new(arguments.quiet)?;
    let figures = runs.figures.iter();
    let files: Vec<(String, &str)> = figures
        .map(|figure| (format!("{}.svg", figure.name), figure.svg.as_str()))
        .collect();
    put_all(&arguments.out, &files)?;
    if !arguments.quiet {
        eprintln!("{} files in {}", files.len(), arguments.out.display());
    }
    Ok(())
}

/// Runs the four cases and what is compared with them, and writes the report.
pub fn report(arguments: &FolderArguments) -> Result<(), PresentError> {
    let runs = Runs::new(arguments.quiet)?;
    let html = page(&Contents {
        results: &runs.cases,
        fit: &fit(&Reconstruction::embedded()?)?,
        fewer_modes: &runs.fewer_modes,
        matrices: &runs.matrices,
        figures: &runs.figures,
        command: &format!("corfem report --out {}", arguments.out.display()),
    })?;
    put_all(&arguments.out, &[("report.html".to_owned(), &html)])?;
    if !arguments.quiet {
        eprintln!("{}", arguments.out.join("report.html").display());
    }
    Ok(())
}
