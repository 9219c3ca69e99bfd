//! `corfem figures` and `corfem report`: files in a folder, all of them or none.

use clap::Args;
use corfem::cases::fewer_modes::{FewerModesRun, PUBLISHED_CASE, all_runs};
use corfem::cases::fit::fit;
use corfem::cases::torque_box::Reconstruction;
use corfem::cases::{CASES, Case, CaseResult, run_case};
use corfem::files::error::FileError;
use corfem::present::error::PresentError;
use corfem::present::figures::{Figure, all_figures, comparison_figures, picture};
use corfem::present::page::{Contents, page};
use corfem::studies::matrix_comparison::{
    MatrixComparison, USUAL_CASE, USUAL_TEST_MODES, compare_matrices,
};
use std::path::{Path, PathBuf};

/// Arguments of `corfem figures`.
#[derive(Debug, Args)]
pub struct FiguresArguments {
    /// Write the figures into this folder, made if it is new
    #[arg(short, long, value_name = "DIR")]
    out: PathBuf,
    /// Write a PNG picture beside every SVG
    #[arg(long)]
    png: bool,
    /// Do not report progress
    #[arg(short, long)]
    quiet: bool,
}

/// Arguments of `corfem report`.
#[derive(Debug, Args)]
pub struct ReportArguments {
    /// Write report.html into this folder, made if it is new
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
}

impl Runs {
    fn new(quiet: bool) -> Result<Self, PresentError> {
        let run = |number| {
            let result = run_case(&Case::new(number)?, |_, _| {})?;
            if !quiet {
                eprintln!("case {number}: {} passes", result.correlation.passes.len());
            }
            Ok(result)
        };
        Ok(Self {
            cases: CASES
                .into_iter()
                .map(run)
                .collect::<Result<_, PresentError>>()?,
            fewer_modes: all_runs(&Case::new(PUBLISHED_CASE)?)?,
            matrices: compare_matrices(&Case::new(USUAL_CASE)?, USUAL_TEST_MODES)?,
        })
    }

    fn figures(&self) -> Result<Vec<Figure>, PresentError> {
        let mut figures = all_figures(&self.cases)?;
        figures.extend(comparison_figures(
            PUBLISHED_CASE,
            &self.fewer_modes,
            &self.matrices,
        )?);
        Ok(figures)
    }
}

/// Runs the four cases and what is compared with them, and writes the figures.
pub fn figures(arguments: &FiguresArguments) -> Result<(), PresentError> {
    let runs = Runs::new(arguments.quiet)?;
    let mut files = Vec::new();
    for figure in runs.figures()? {
        if arguments.png {
            let png = picture::png(&figure.name, &figure.svg)?;
            files.push((format!("{}.png", figure.name), png));
        }
        files.push((format!("{}.svg", figure.name), figure.svg.into_bytes()));
    }
    put_all(&arguments.out, &files)?;
    if !arguments.quiet {
        eprintln!("{} files in {}", files.len(), arguments.out.display());
    }
    Ok(())
}

/// Runs the four cases and what is compared with them, and writes the report.
pub fn report(arguments: &ReportArguments) -> Result<(), PresentError> {
    let runs = Runs::new(arguments.quiet)?;
    let fit = fit(&Reconstruction::embedded()?)?;
    let command = format!("corfem report --out {}", arguments.out.display());
    let html = page(&Contents {
        results: &runs.cases,
        fit: &fit,
        fewer_modes: &runs.fewer_modes,
        matrices: &runs.matrices,
        figures: &runs.figures()?,
        command: &command,
    })?;
    put_all(
        &arguments.out,
        &[("report.html".to_owned(), html.into_bytes())],
    )?;
    if !arguments.quiet {
        eprintln!("{}", arguments.out.join("report.html").display());
    }
    Ok(())
}

/// Writes files into a folder, all of them or none: they are written elsewhere beside it first. A new folder then takes
/// its place in one move; in an old one each file does, once every place is known to be free for a file.
fn put_all(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<(), PresentError> {
    let failed = |path: &Path| FileError::of_file(path, "write");
    // A bare name has an empty parent, which is the present folder.
    let beside = folder.parent().unwrap_or(Path::new(""));
    let scratch = tempfile::tempdir_in(beside).map_err(failed(folder))?;
    // The scratch folder is its owner's alone; one made in it has the rights any new folder has.
    let staged = scratch.path().join("staged");
    std::fs::create_dir(&staged).map_err(failed(folder))?;
    for (name, bytes) in files {
        std::fs::write(staged.join(name), bytes).map_err(failed(&folder.join(name)))?;
    }
    if !folder.exists() {
        return Ok(std::fs::rename(&staged, folder).map_err(failed(folder))?);
    }
    for (name, _) in files {
        let path = folder.join(name);
        if path.is_dir() {
            let source = std::io::Error::from(std::io::ErrorKind::IsADirectory);
            return Err(failed(&path)(source).into());
        }
    }
    for (name, _) in files {
        let path = folder.join(name);
        std::fs::rename(staged.join(name), &path).map_err(failed(&path))?;
    }
    Ok(())
}
