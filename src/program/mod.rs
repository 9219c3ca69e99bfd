//! Arguments, progress, output and exit status; all the work is the library's.

mod cases;
mod deck;
mod example;
mod job;
mod output;
#[path = "../../paper/presentation/mod.rs"]
mod paper;
mod pictures;
mod settings;
mod studies;

use cases::CasesArguments;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};
use corfem::job::spare;
use corfem::present::PresentError;
use deck::{DeckArguments, ModesArguments};
use job::{CheckArguments, CorrelateArguments, InitArguments};
use output::{check, note};
use pictures::{FiguresArguments, ReportArguments};
use std::path::PathBuf;
use std::process::ExitCode;
use studies::{FewerModesArguments, TablesArguments};

const BAD_INPUT: u8 = 2;
const NOT_CONVERGED: u8 = 3;

/// Corrects a finite element model until its frequencies and mode shapes agree with a ground vibration test.
///
/// Without a command it correlates the paper's four cases on its wing torque box and prints what became of them.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100, after_help = AFTER_HELP)]
struct Arguments {
    /// Show no progress
    #[arg(short, long, global = true)]
    quiet: bool,
    #[command(subcommand)]
    command: Option<Command>,
}

const AFTER_HELP: &str = "\
Units: inch, pound-force, second; mass in lbf·s²/in; frequency in hertz.

Exit status: 0 Cases 1 to 3 correlated and Case 4 detected a modeling error (its gages are not corrected); \
2 bad input, or a file or standard output that cannot be read or written; \
3 not converged within the limits, or nothing detected (the best found is still printed, and the outcome of every \
case).

Results go to standard output, progress to standard error. A signal that ends the program leaves no half-written file.";

const PLAIN_HELP: &str = "\
Exit status: 0 all is printed or written; 2 bad input, or a file or standard output that cannot be read or written.";

const JOB_HELP: &str = "\
Ctrl-C lets the analysis under way end and keeps the best so far; a second one ends the program at once and leaves no half-written file.

Exit status: 0 within tolerance and no doubt stands; 2 bad input, or a file that cannot be read or written; 3 not within tolerance, stopped, or a doubt \
stands, which --accept answers for; the best found is printed all the same, or what check prints if no mode of the model is like a test mode.";

const CHECK_HELP: &str = "\
Exit status: 0 no doubt stands; 2 bad input, or a file that cannot be read; 3 a doubt stands, which --accept answers for.";

const MODES_HELP: &str = "\
Exit status: 0 all modes asked for were found; 2 bad input, or a file that cannot be read; 3 modes are lost or may not be those of the structure.";

#[derive(Debug, Subcommand)]
enum Command {
    /// Correlate the paper's cases: what became of all four, or every table of those that are named (3 to 8 and 13)
    #[command(after_help = AFTER_HELP)]
    Cases(CasesArguments),
    /// Print Table 1, computed anew, and Tables 2 to 13 as published; CPU seconds are in Table 13
    #[command(after_help = PLAIN_HELP)]
    Tables(TablesArguments),
    /// Correlate Case 2 with fewer test and analysis modes (Tables 9 to 12), and show what truncation costs
    #[command(after_help = PLAIN_HELP)]
    FewerModes(FewerModesArguments),
    /// Correct the model of your own structure: a job file names its deck or matrices and its ground vibration test
    #[command(after_help = JOB_HELP)]
    Correlate(CorrelateArguments),
    /// Write a job file or the table of a test that explains its entries, or a whole example that runs
    #[command(after_help = PLAIN_HELP)]
    Init(InitArguments),
    /// Look at a job before the first step
    #[command(after_help = CHECK_HELP)]
    Check(CheckArguments),
    /// Write the figures of the cases and of fewer modes as SVG
    #[command(after_help = PLAIN_HELP)]
    Figures(FiguresArguments),
    /// Write one web page with the tables and figures of cases and fewer modes, and the assumptions
    #[command(after_help = PLAIN_HELP)]
    Report(ReportArguments),
    /// Write the torque box of a case as a NASTRAN deck
    #[command(after_help = PLAIN_HELP)]
    Deck(DeckArguments),
    /// Print frequencies and mode shapes of a NASTRAN deck or of matrices
    #[command(after_help = MODES_HELP)]
    Modes(ModesArguments),
}

/// Runs the program.
pub fn run() -> ExitCode {
    let matches = Arguments::command().get_matches();
    let Arguments { command, quiet } =
        Arguments::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    status(check_places(&matches).and_then(|()| match command {
        None => cases::cases(&CasesArguments::default(), quiet),
        Some(Command::Cases(arguments)) => cases::cases(&arguments, quiet),
        Some(Command::Tables(arguments)) => studies::tables(&arguments),
        Some(Command::FewerModes(arguments)) => studies::fewer_modes(&arguments, quiet),
        Some(Command::Correlate(arguments)) => job::correlate(&arguments, quiet),
        Some(Command::Init(arguments)) => job::init(&arguments, quiet),
        Some(Command::Check(arguments)) => job::check_job(&arguments, quiet),
        Some(Command::Figures(arguments)) => pictures::figures(&arguments, quiet),
        Some(Command::Report(arguments)) => pictures::report(&arguments, quiet),
        Some(Command::Deck(arguments)) => deck::deck(&arguments),
        Some(Command::Modes(arguments)) => deck::modes(&arguments),
    }))
}

/// Refuses a file or folder that could not be written before the work is done.
fn check_places(matches: &ArgMatches) -> Result<(), PresentError> {
    let Some((_, own)) = matches.subcommand() else {
        return Ok(());
    };
    let path = |name| own.try_get_one::<PathBuf>(name).ok().flatten();
    let [file, folder] = ["output", "folder"].map(path);
    let named = ["deck", "stiffness", "mass", "box_file"].map(path);
    spare(path("job"), named, [file, folder])?;
    Ok(check(
        file.map(PathBuf::as_path),
        folder.map(PathBuf::as_path),
    )?)
}

fn status(done: Result<bool, PresentError>) -> ExitCode {
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(NOT_CONVERGED),
        Err(error) => {
            note(format_args!("corfem: {error}"));
            ExitCode::from(BAD_INPUT)
        }
    }
}
