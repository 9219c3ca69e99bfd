//! `corfem correlate`, `corfem check` and `corfem init`: the user's own structure.

use super::example::Example;
use super::output::{OutputArguments, note};
use super::place::{write_files, write_report};
use super::progress;
use clap::Args;
use corfem::files::error::FileError;
use corfem::job::{
    CorrelatedJob, FILES, JobResult, LoadedJob, PreparedJob, TEMPLATE, TEST_TEMPLATE, Trust, run,
};
use corfem::present::page::report_page;
use corfem::present::report::Report;
use corfem::present::table::Table;
use corfem::present::tables::deck::not_read;
use corfem::present::tables::job::{
    doubts_and_remarks, inputs_table, measurement_table, model_table, places_table, suspects_table,
    trust_table,
};
use corfem::present::tables::report::{
    BRIEF_FACTORS, BRIEF_MODES, answer_table, factor_table, history_table, minima_table,
    paired_table,
};
use corfem::present::universal::universal;
use corfem::present::{PresentError, json, rows};
use serde_json::json;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
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
pub struct CorrelateArguments {
    /// Also write report.html, factors.csv, shapes.csv, shapes.unv, residuals.csv, correlation.json and the corrected model into this folder, created if new
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Start Gauss-Newton steps from this many points: the model itself, and others drawn from the seed
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    starts: Option<u32>,
    /// Seed of the starting points
    #[arg(long, value_name = "S", requires = "starts")]
    seed: Option<u64>,
    #[command(flatten)]
    check: CheckArguments,
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

/// The path of a job, unless it is a folder: then an error says which file in it to name, or how to write one.
///
/// # Errors
/// [`FileError::Refused`] for a folder.
fn job_file(path: &Path) -> Result<&Path, FileError> {
    if !path.is_dir() {
        return Ok(path);
    }
    let entries = path.read_dir().into_iter().flatten().flatten();
    let jobs = entries.map(|entry| entry.path());
    let mut jobs: Vec<PathBuf> = jobs
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
        .collect();
    jobs.sort();
    let remedy = match jobs.first() {
        Some(job) => format!("name a job in it: {}", job.display()),
        None => {
            let job = path.join("job.toml");
            format!(
                "corfem init {} writes a job that explains its entries",
                job.display()
            )
        }
    };
    Err(FileError::Refused {
        of: path.display().to_string(),
        reason: format!("is a folder; {remedy}"),
    })
}

/// Writes a job, or a test's table, that explains itself, or a whole example.
pub fn init(
    InitArguments {
        test,
        example,
        path,
    }: &InitArguments,
    quiet: bool,
) -> Result<(), PresentError> {
    let path = path.as_deref();
    if let (Some(example), Some(folder)) = (example, path) {
        return example.write(folder, quiet);
    }
    if let Some(path) = path.filter(|path| path.exists()) {
        let found = std::io::Error::from(std::io::ErrorKind::AlreadyExists);
        return Err(FileError::of_file(path, "write")(found).into());
    }
    write_report(path, if *test { TEST_TEMPLATE } else { TEMPLATE })
}

/// Reports every doubt about a job and ranks its parameters, without a step; true if none stands.
pub fn check_job(
    CheckArguments {
        job,
        accept,
        output,
    }: &CheckArguments,
    quiet: bool,
) -> Result<bool, PresentError> {
    let (trust, tables) = progress::during(quiet, "looking at the job", || {
        let prepared = LoadedJob::new(job_file(job)?)?.prepare()?;
        let trust = Trust::before(&prepared)?.accepting(accept)?;
        let report = Report {
            trust: Some(trust.clone()),
            ..Report::from_job(&prepared, None)?
        };
        let mut tables = vec![
            trust_table(&trust),
            model_table(&prepared)?,
            places_table(&prepared.loaded, None)?,
            paired_table(&report)?,
            suspects_table(&prepared),
            measurement_table(&prepared),
        ];
        // A test that is doubtful accuses any parameter.
        if trust.has_doubt() {
            tables.retain(|own| own.name != "suspects");
        }
        Ok::<_, PresentError>((trust, tables))
    })?;
    output.write(&tables, || {
        json::own_document(
            json!({ "trust": trust, "checks": trust.answers(false), "tables": tables }),
        )
    })?;
    Ok(!trust.has_doubt())
}

/// Corrects the model of a job and writes the report; true if it is within tolerance. Where a doubt leaves nothing to compare, it is a check.
pub fn correlate(arguments: &CorrelateArguments, quiet: bool) -> Result<bool, PresentError> {
    let Some((prepared, result)) = corrected(arguments, quiet)? else {
        note("corfem: no mode of the model is like a test mode, so nothing is corrected");
        return check_job(&arguments.check, quiet);
    };
    let report = Report::from_job(&prepared, Some(&result))?;
    let (paired, factors) = (paired_table(&report)?, factor_table(&report));
    let [doubts, remarks] = doubts_and_remarks(&result.trust);
    let last = || {
        let minima = minima_table(&report).into_iter();
        minima.chain([history_table(&report)])
    };
    // A terminal has doubts first, then the answer, and no room for every column.
    let brief: Vec<Table> = [
        doubts,
        answer_table(&report),
        factors.clone().only(&BRIEF_FACTORS),
        paired.clone().only(&BRIEF_MODES),
        remarks,
    ]
    .into_iter()
    .chain(last())
    .collect();
    let all = [trust_table(&result.trust), factors, paired].into_iter();
    let all: Vec<Table> = all.chain(last()).collect();
    let digest = prepared.loaded.digest()?;
    let document = || {
        let mut document = json::report(&report)?;
        document["inputs"] = json!(digest);
        json::own_document(document)
    };
    arguments
        .check
        .output
        .write_in_brief(&brief, &all, document)?;
    if let Some(folder) = &arguments.folder {
        let texts = [
            report_page(
                &report,
                &[
                    model_table(&prepared)?,
                    places_table(&prepared.loaded, Some(&result))?,
                    inputs_table(&prepared, &digest),
                ],
                &command(arguments),
                &prepared.loaded.job.text,
            )?,
            rows::factor_rows(&report),
            rows::shape_rows(&report)?,
            universal(&report, &prepared.loaded)?,
            rows::residual_rows(&report),
            document()?,
        ];
        write_results(folder, texts, &result.found)?;
    }
    if result.found.is_interrupted {
        note("corfem: stopped by request; the best factors so far are given");
    }
    Ok(result.verdict.is_within && !result.trust.stands_against() && !result.found.is_interrupted)
}

/// Reads, prepares and runs a job; none where no test mode has a partner and a doubt says why.
fn corrected(
    arguments: &CorrelateArguments,
    quiet: bool,
) -> Result<Option<(PreparedJob, JobResult)>, PresentError> {
    let stop = stopped_by_signals();
    let mut loaded = LoadedJob::new(job_file(&arguments.check.job)?)?;
    let go_on = || !stop.load(Ordering::SeqCst);
    if let Some(starts) = arguments.starts {
        let compare = &mut loaded.job.compare;
        compare.starts = Some(starts as usize);
        compare.seed = arguments.seed.unwrap_or(compare.seed);
    }
    for card in loaded.source.deck.iter().flat_map(|(_, deck)| &deck.unread) {
        note(format_args!("corfem: {}: {}", loaded.title, not_read(card)));
    }
    let bar = progress::spinner(quiet);
    let progress = |words: &str| bar.set_message(words.to_owned());
    let finish = || {
        let prepared = loaded.prepare()?;
        let trust = Trust::before(&prepared)?.accepting(&arguments.check.accept)?;
        if prepared.is_without_pairs() && trust.has_doubt() {
            return Ok(None);
        }
        let result = run(&prepared, &trust, progress, go_on)?;
        Ok(Some((prepared, result)))
    };
    let finished = finish();
    bar.finish_and_clear();
    finished
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
        .check
        .accept
        .iter()
        .map(|doubt| format!(" --accept {doubt}"));
    let options: String = starts.into_iter().chain(seed).chain(accepted).collect();
    format!(
        "corfem correlate {}{options} --folder FOLDER",
        arguments.check.job.display()
    )
}

/// Writes the files of a result and then its corrected model: one that cannot be written does not lose the others of a long correlation.
fn write_results(
    folder: &Path,
    texts: [String; 6],
    found: &CorrelatedJob,
) -> Result<(), PresentError> {
    write_files(folder, FILES.into_iter().zip(texts))?;
    let loaded = &found.prepared.loaded;
    write_files(folder, loaded.corrected_model(&found.factors)?)
}
