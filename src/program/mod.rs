//! Arguments, progress, output and exit status; all the work is the library's.

mod cases;
mod deck;
mod output;
mod pictures;
mod settings;
mod solver;
mod studies;

use cases::CasesArguments;
use clap::{Parser, Subcommand};
use deck::{DeckArguments, ModesArguments};
use output::OutputArguments;
use pictures::FolderArguments;
use std::process::ExitCode;
use studies::{DeltaWingArguments, FewerModesArguments, MatricesArguments, TablesArguments};

const BAD_INPUT: u8 = 2;
const NOT_CONVERGED: u8 = 3;

/// Corrects a finite element model until its frequencies and mode shapes agree with a ground vibration test.
///
/// Without a command it does what `corfem cases` does: it correlates the paper's four cases on its wing torque box
/// and prints their frequencies, gages and iterations (Tables 3 to 8 and 13) with the published ones, and Table 1.
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
    /// Correlate the paper's cases and print Tables 3 to 8 and 13 with the published numbers, and Table 1
    Cases(CasesArguments),
    /// Print Table 1, computed anew, and Tables 2 to 13 as published; CPU seconds are in Table 13
    Tables(TablesArguments),
    /// Correlate Case 2 with fewer test and analysis modes (Tables 9 to 12), and show what truncation costs
    FewerModes(FewerModesArguments),
    /// Compare every reading of the step with the printed gages, and say which reading each case is run by
    Readings(OutputArguments),
    /// Correct a case by elements and by whole matrices, and compare what either knows afterwards
    Matrices(MatricesArguments),
    /// Correlate Case 2 with noisy test modes, as they are and after Appendix B, and compare the gages found
    Noise(OutputArguments),
    /// Look at models and tests before the first step, and count how often mistakes made on purpose are named
    Check(OutputArguments),
    /// Compare the delta wing of NACA TN 3114 with its tests and analyses, and recover wrong gages from its modes
    DeltaWing(DeltaWingArguments),
    /// Write the figures of the cases, of fewer modes and of matrices as SVG
    Figures(FolderArguments),
    /// Write one web page with the tables and figures of cases, fewer modes and matrices, and the assumptions
    Report(FolderArguments),
    /// Write the torque box of a case as a NASTRAN deck
    Deck(DeckArguments),
    /// Print frequencies and mode shapes of a NASTRAN deck
    Modes(ModesArguments),
}

/// Runs the program.
pub fn run() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match arguments.command {
        None => cases::cases(&arguments.cases),
        Some(Command::Cases(arguments)) => cases::cases(&arguments),
        Some(Command::Tables(arguments)) => studies::tables(&arguments).map(|()| true),
        Some(Command::FewerModes(arguments)) => studies::fewer_modes(&arguments).map(|()| true),
        Some(Command::Readings(arguments)) => studies::readings(&arguments).map(|()| true),
        Some(Command::Matrices(arguments)) => studies::matrices(&arguments).map(|()| true),
        Some(Command::Noise(arguments)) => studies::noise(&arguments).map(|()| true),
        Some(Command::Check(arguments)) => studies::check(&arguments).map(|()| true),
        Some(Command::DeltaWing(arguments)) => studies::delta_wing(&arguments),
        Some(Command::Figures(arguments)) => pictures::pictures(&arguments, false).map(|()| true),
        Some(Command::Report(arguments)) => pictures::pictures(&arguments, true).map(|()| true),
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
