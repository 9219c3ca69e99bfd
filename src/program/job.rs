//! `corfem correlate`, `corfem check` and `corfem init`: the user's own structure.

use super::example::Example;
use super::output::{OutputArguments, note, tell, write, write_files};
use clap::Args;
use corfem::files::error::FileError;
use corfem::job::{FILES, LoadedJob, PreparedJob, TEMPLATE, TEST_TEMPLATE, Trust, run};
use corfem::present::check::check_tables;
use corfem::present::deck::not_read;
use corfem::present::page::report_page;
use corfem::present::report::Report;
use corfem::present::table::separated;
use corfem::present::universal::universal;
use corfem::present::{PresentError, json};
use serde_json::json;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

#[derive(Debug, Args)]
pub struct InitArguments {
    /// Write an example of a test's table instead of a job
    #[arg(long)]
    test: bool,
    /// Write a whole job that runs, with its files, into the folder PATH, created if new
    #[arg(
        long,
        value_enum,
        value_name = "NAME",
        conflicts_with = "test",
        requires = "path"
    )]
    example: Option<Example>,
    /// Write to this new file instead of standard output
    path: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct CheckArguments {
    /// The job: corfem init explains its entries
    #[arg(value_name = "JOB")]
    job: PathBuf,
    /// Answer for the doubt of this identifier, which then no longer makes the status 3; may be repeated
    #[arg(long, value_name = "IDENTIFIER")]
    accept: Vec<String>,
    #[command(flatten)]
    output: OutputArguments,
}

#[derive(Debug, Args)]
pub struct CorrelateArguments {
    #[command(flatten)]
    of: CheckArguments,
    /// Also write report.html, factors.csv, shapes.csv, shapes.unv, modes.csv, correlation.json and the corrected model into this folder, created if new
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Start Gauss-Newton steps from this many points: the model itself, and others drawn from the seed
    #[arg(long, value_name = "N")]
    starts: Option<NonZeroUsize>,
    /// Seed of the starting points
    #[arg(long, value_name = "S", requires = "starts")]
    seed: Option<u64>,
}

/// The path of a job.
///
/// # Errors
/// [`FileError::Refused`] for a folder.
fn job_file(path: &Path) -> Result<&Path, FileError> {
    if !path.is_dir() {
        return Ok(path);
    }
    let job = path.join("job.toml");
    let (remedy, job) = match job.is_file() {
        true => ("name the job in it", job),
        false => ("write a job that explains its entries by corfem init", job),
    };
    let reason = format!("is a folder; {remedy}: {}", job.display());
    let of = path.display().to_string();
    Err(FileError::Refused { of, reason })
}

/// Writes a job, or a test's table, that explains itself, or a whole example.
pub fn init(
    InitArguments {
        test,
        example,
        path,
    }: &InitArguments,
    quiet: bool,
) -> Result<bool, PresentError> {
    let path = path.as_deref();
    if let (Some(example), Some(folder)) = (example, path) {
        return example.write(folder, quiet).map(|()| true);
    }
    if let Some(path) = path.filter(|path| path.exists()) {
        let found = std::io::Error::from(std::io::ErrorKind::AlreadyExists);
        return Err(FileError::of_file(path, "write")(found).into());
    }
    let text = if *test { TEST_TEMPLATE } else { TEMPLATE };
    write(path, text.as_bytes()).map(|()| true)
}

/// Reports every doubt about a job and ranks its parameters, without a step; true if none stands.
pub fn check_job(arguments: &CheckArguments, quiet: bool) -> Result<bool, PresentError> {
    tell(quiet, "looking at the job");
    let prepared = LoadedJob::new(job_file(&arguments.job)?)?.prepare()?;
    let trust = Trust::before(&prepared)?.accepting(&arguments.accept)?;
    looked_at(&prepared, &trust, arguments, quiet)
}

/// Reports a job before its first step; true if no doubt stands.
fn looked_at(
    prepared: &PreparedJob,
    trust: &Trust,
    arguments: &CheckArguments,
    quiet: bool,
) -> Result<bool, PresentError> {
    let tables = check_tables(prepared, trust)?;
    tell(quiet, "");
    let document = json!({ "concerns": trust, "checks": trust.answers(false), "tables": tables });
    arguments
        .output
        .write(&tables, || json::document(json::OWN_UNITS, document))?;
    Ok(!trust.has_doubt())
}

/// Corrects the model of a job and writes the report; true if it is within tolerance. Where a doubt leaves nothing to compare, it is a check.
pub fn correlate(arguments: &CorrelateArguments, quiet: bool) -> Result<bool, PresentError> {
    let stop = stopped_by_signals();
    let mut loaded = LoadedJob::new(job_file(&arguments.of.job)?)?;
    let compare = &mut loaded.job.compare;
    compare.starts = arguments.starts.map(NonZeroUsize::get).or(compare.starts);
    compare.seed = arguments.seed.unwrap_or(compare.seed);
    for card in loaded.source.deck.iter().flat_map(|(_, deck)| &deck.unread) {
        note(format_args!("corfem: {}: {}", loaded.title, not_read(card)));
    }
    let prepared = loaded.prepare()?;
    let trust = Trust::before(&prepared)?.accepting(&arguments.of.accept)?;
    if prepared.is_without_pairs() && trust.has_doubt() {
        note("corfem: no mode of the model is like a test mode, so nothing is corrected");
        return looked_at(&prepared, &trust, &arguments.of, quiet);
    }
    let go_on = || !stop.load(Ordering::SeqCst);
    let result = run(&prepared, &trust, |words| tell(quiet, words), go_on)?;
    tell(quiet, "");
    let report = Report::new(&result, &command(arguments))?;
    let document = || json::document(json::OWN_UNITS, &report);
    arguments
        .of
        .output
        .write_beside(&report.brief(), report.csv(), document)?;
    if let Some(folder) = &arguments.folder {
        let loaded = &result.found.prepared.loaded;
        let texts = [
            report_page(&report)?,
            separated(&report.surest),
            separated(&report.readings),
            universal(&report, loaded),
            separated(&report.modes),
            document()?,
        ];
        write_files(folder, FILES.into_iter().zip(texts))?;
        // A model that cannot be written does not lose the other files of a long correlation.
        write_files(folder, loaded.corrected_model(&result.found.factors)?)?;
    }
    if result.found.is_interrupted {
        note("corfem: stopped by request; the best factors so far are given");
    }
    Ok(result.verdict.is_within && !result.trust.stands_against() && !result.found.is_interrupted)
}

/// A flag that the first request to stop sets; the second ends the program.
fn stopped_by_signals() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        // A program that cannot be told to stop still does its work.
        let _ = flag::register_conditional_default(signal, Arc::clone(&stop));
        let _ = flag::register(signal, Arc::clone(&stop));
    }
    stop
}

/// The command of a report, which is the same page in any folder.
fn command(arguments: &CorrelateArguments) -> String {
    let starts = arguments.starts.map(|starts| format!(" --starts {starts}"));
    let seed = arguments.seed.map(|seed| format!(" --seed {seed}"));
    let accepted = arguments
        .of
        .accept
        .iter()
        .map(|doubt| format!(" --accept {doubt}"));
    let options: String = starts.into_iter().chain(seed).chain(accepted).collect();
    let job = arguments.of.job.display();
    format!("corfem correlate {job}{options} --folder FOLDER")
}
