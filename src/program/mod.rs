//! Arguments, progress, output and exit status; all the work is the library's.

mod cases;
mod deck;
mod delta_wing;
mod fewer_modes;
mod matrices;
mod pictures;
mod report;
mod solver;

use cases::CasesArguments;
use clap::{Parser, Subcommand, ValueEnum};
use corfem::cases::torque_box::Reconstruction;
use corfem::files::error::FileError;
use corfem::present::error::PresentError;
use corfem::present::report::Format;
use deck::{DeckArguments, ModesArguments};
use delta_wing::DeltaWingArguments;
use fewer_modes::FewerModesArguments;
use matrices::MatricesArguments;
use std::io::Write;
use std::path::Path;
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
    /// Correlate Case 2 with fewer test and analysis modes (Tables 9 to 12), and show what truncation costs
    FewerModes(FewerModesArguments),
    /// Correct a case by elements and by whole matrices, and compare what either knows afterwards
    Matrices(MatricesArguments),
    /// Compare the delta wing of NACA TN 3114 with its tests and analyses, and recover wrong gages from its modes
    DeltaWing(DeltaWingArguments),
    /// Write every figure as SVG
    Figures(pictures::FiguresArguments),
    /// Write the report as one web page with tables, figures and assumptions
    Report(pictures::ReportArguments),
    /// Write the torque box of a case as a NASTRAN deck
    Deck(DeckArguments),
    /// Print frequencies and mode shapes of a NASTRAN deck
    Modes(ModesArguments),
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
        None => cases::cases(&arguments.cases),
        Some(Command::Cases(arguments)) => cases::cases(&arguments),
        Some(Command::FewerModes(arguments)) => fewer_modes::fewer_modes(&arguments).map(|()| true),
        Some(Command::Matrices(arguments)) => matrices::matrices(&arguments).map(|()| true),
        Some(Command::DeltaWing(arguments)) => delta_wing::delta_wing(&arguments),
        Some(Command::Figures(arguments)) => pictures::figures(&arguments).map(|()| true),
        Some(Command::Report(arguments)) => pictures::report(&arguments).map(|()| true),
        Some(Command::Deck(arguments)) => deck::deck(&arguments).map(|()| true),
        Some(Command::Modes(arguments)) => deck::modes(&arguments).map(|()| true),
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

/// The box of a file, or the reconstructed one.
fn reconstruction(box_file: Option<&Path>) -> Result<Reconstruction, PresentError> {
    Ok(match box_file {
        None => Reconstruction::embedded()?,
        Some(path) => Reconstruction::parse(&path.display().to_string(), &read(path)?)?,
    })
}

fn read(path: &Path) -> Result<String, PresentError> {
    Ok(std::fs::read_to_string(path).map_err(FileError::of_file(path, "read"))?)
}

/// Writes to a file, whole or not at all, or to standard output.
fn put(path: Option<&Path>, text: &str) -> Result<(), PresentError> {
    let Some(path) = path else {
        // A reader that has seen enough closes the pipe; that is no error of ours.
        let _ = std::io::stdout().write_all(text.as_bytes());
        return Ok(());
    };
    let failed = FileError::of_file(path, "write");
    // A bare name has an empty parent, which is the present folder.
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(&failed)?;
    file.write_all(text.as_bytes()).map_err(&failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}
