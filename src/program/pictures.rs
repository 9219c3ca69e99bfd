//! `corfem figures`, `corfem report` and `corfem dump`: files in a folder.

use super::folder::write_files;
use super::output::note;
use super::place::write_report;
use clap::Args;
use corfem::present::PresentError;
use corfem::present::dump::dump as open;
use corfem::present::figures::{case_figures, comparison_figures};
use corfem::present::page::{Contents, page};
use corfem::present::table::counted;
use corfem::torque_box::fewer_modes::{PUBLISHED_CASE, all_runs};
use corfem::torque_box::{CASES, Case, run_case};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct FolderArguments {
    /// Write into this folder, created if new (also --out)
    #[arg(short = 'o', long = "output", alias = "out", value_name = "DIR")]
    folder: PathBuf,
}

/// Runs the four cases, and Case 2 with fewer modes, and writes the figures, or the page that has them and the
/// tables.
pub fn pictures(
    FolderArguments { folder }: &FolderArguments,
    as_page: bool,
    quiet: bool,
) -> Result<(), PresentError> {
    let say = |words: String| (!quiet).then(|| note(words));
    let mut results = Vec::new();
    for number in CASES {
        let result = run_case(&Case::new(number)?, |_, _| {})?;
        say(format!(
            "case {number}: {}",
            counted(result.correlation.passes.len(), "pass", "passes")
        ));
        results.push(result);
    }
    let fewer_modes = all_runs(&Case::new(PUBLISHED_CASE)?)?;
    let mut figures = case_figures(&results)?;
    figures.extend(comparison_figures(PUBLISHED_CASE, &fewer_modes)?);
    if as_page {
        let html = page(&Contents {
            results: &results,
            fewer_modes: &fewer_modes,
            figures: &figures,
            command: &format!("corfem report --output {}", folder.display()),
        })?;
        write_files(
            folder,
            &[("report.html".to_owned(), html.into_bytes())],
            "report",
        )?;
        say(folder.join("report.html").display().to_string());
    } else {
        let files: Vec<_> = figures
            .into_iter()
            .map(|figure| (figure.name + ".svg", figure.svg.into_bytes()))
            .collect();
        write_files(folder, &files, "figures")?;
        say(format!("{} files in {}", files.len(), folder.display()));
    }
    Ok(())
}

#[derive(Debug, Args)]
pub struct DumpArguments {
    /// Which case
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
        return write_report(None, &dump.json);
    };
    let mut files = vec![("dump.json".to_owned(), dump.json.into_bytes())];
    files.extend(
        dump.matrices
            .into_iter()
            .map(|(name, text)| (name, text.into_bytes())),
    );
    write_files(folder, &files, &format!("dump {}", arguments.case))?;
    if !quiet {
        note(format_args!(
            "{} files in {}",
            files.len(),
            folder.display()
        ));
    }
    Ok(())
}
