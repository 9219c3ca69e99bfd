//! `corfem correlate`, `corfem check` and `corfem init`: the user's own structure.

use super::example::Example;
use super::folder::write_files;
use super::output::{OutputArguments, note};
use super::place::write_report;
use super::{progress, signals};
use clap::Args;
use corfem::files::error::FileError;
use corfem::files::escaped;
use corfem::job::{LoadedJob, Method, TEMPLATE, TEST_TEMPLATE, Trust, run};
use corfem::present::page::report_page;
use corfem::present::report::Report;
use corfem::present::table::Table;
use corfem::present::tables::deck::not_read;
use corfem::present::tables::job::{
    inputs_table, minima_table, places_table, seen_table, suspects_table, trust_table,
};
use corfem::present::tables::report::{factor_table, history_table, paired_table};
use corfem::present::{PresentError, json, render};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

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
    /// The job: corfem init explains its entries
    #[arg(value_name = "JOB")]
    job: PathBuf,
    /// Also write report.html, factors.csv, correlation.json and the corrected deck into this folder, created if new
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Start Gauss-Newton steps from this many points: the model itself, and others drawn from the seed
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    starts: Option<u32>,
    /// Seed of the starting points
    #[arg(long, value_name = "S", requires = "starts")]
    seed: Option<u64>,
    /// Answer for the doubt of this identifier, which then no longer makes the status 3; may be repeated
    #[arg(long, value_name = "IDENTIFIER")]
    accept: Vec<String>,
    #[command(flatten)]
    output: OutputArguments,
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

/// The job's file name without its folders, which say nothing about the run.
pub fn file_name(job: &Path) -> String {
    job.file_name()
        .map_or_else(String::new, |name| escaped(&name.to_string_lossy()))
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

/// Reports every doubt about a job and ranks its parameters, without a step; true if no doubt stands.
pub fn check_job(
    CheckArguments {
        job,
        accept,
        output,
    }: &CheckArguments,
    quiet: bool,
) -> Result<bool, PresentError> {
    let (trust, tables) = progress::during(quiet, "looking at the job", || {
        let mut loaded = LoadedJob::new(job)?;
        loaded.accepted.clone_from(accept);
        let trust = Trust::before(&loaded)?;
        let report = Report {
            trust: Some(trust.clone()),
            ..Report::from_job(&loaded, None)?
        };
        let tables = [
            trust_table(&trust),
            places_table(&loaded, None)?,
            paired_table(&report)?,
            suspects_table(&loaded)?,
        ];
        Ok::<_, PresentError>((trust, tables))
    })?;
    let document = || json::own_document(json!({ "trust": trust, "tables": tables }));
    output.write(&tables, document)?;
    Ok(!trust.has_doubt())
}

/// Corrects the model of a job and writes the report; true if it is within tolerance.
pub fn correlate(arguments: &CorrelateArguments, quiet: bool) -> Result<bool, PresentError> {
    let mut loaded = LoadedJob::new(&arguments.job)?;
    if let Some(starts) = arguments.starts {
        let compare = &mut loaded.job.compare;
        compare.method = Method::GaussNewton;
        compare.starts = Some(starts as usize);
        compare.seed = arguments.seed.unwrap_or(compare.seed);
    }
    loaded.accepted.clone_from(&arguments.accept);
    for card in loaded.source.deck.iter().flat_map(|(_, deck)| &deck.unread) {
        note(format_args!("corfem: {}: {}", loaded.title, not_read(card)));
    }
    let bar = progress::spinner(quiet);
    // Postponed until the report is written, so that a request to stop ends the program with the best so far.
    let (stop, _postponed) = signals::postpone_first();
    let go_on = || !stop.load(Ordering::SeqCst);
    let result = run(&loaded, |words| bar.set_message(words.to_owned()), go_on);
    bar.finish_and_clear();
    let result = result?;
    let report = Report::from_job(&loaded, Some(&result))?;
    // The verdict stands under the history, at the end.
    let [paired, factors, history] = [
        paired_table(&report)?,
        factor_table(&report),
        history_table(&report),
    ];
    let trust = trust_table(&result.trust);
    let seen = seen_table(&loaded, &result)?;
    let minima = minima_table(&report);
    let head = [trust, paired, factors, seen.clone()].into_iter();
    let tables: Vec<Table> = head.chain(minima.clone()).chain([history]).collect();
    let document = || json::own_document(json::report(&report)?);
    arguments.output.write(&tables, document)?;
    if let Some(folder) = &arguments.folder {
        let places = [
            places_table(&loaded, Some(&result))?,
            inputs_table(&loaded)?,
        ];
        let extra: Vec<Table> = [seen].into_iter().chain(minima).chain(places).collect();
        let mut command = format!("corfem correlate {}", arguments.job.display());
        let starts = arguments.starts.map(|starts| format!(" --starts {starts}"));
        let seed = arguments.seed.map(|seed| format!(" --seed {seed}"));
        let accepted = arguments
            .accept
            .iter()
            .map(|doubt| format!(" --accept {doubt}"));
        command.extend(starts.into_iter().chain(seed).chain(accepted));
        // Any folder gets the same page.
        command += " --folder FOLDER";
        let identity = loaded.identity(&format!("{:?} {:?}", arguments.starts, arguments.seed))?;
        let run = format!("correlate {}, inputs {identity}", file_name(&arguments.job));
        let mut files = vec![
            (
                "report.html".to_owned(),
                report_page(&report, &extra, &command, &loaded.job.text)?.into_bytes(),
            ),
            (
                "factors.csv".to_owned(),
                render::csv(&[tables[0].clone(), factor_table(&report)]).into_bytes(),
            ),
            ("correlation.json".to_owned(), document()?.into_bytes()),
        ];
        // A deck that cannot be written must not lose the report of a long correlation.
        let deck = loaded.corrected_deck(&result.factors);
        files.extend(
            deck.as_ref()
                .ok()
                .cloned()
                .flatten()
                .map(|deck| ("corrected.bdf".to_owned(), deck)),
        );
        write_files(folder, &files, &run)?;
        deck?;
    }
    if result.trust.is_interrupted {
        note("corfem: stopped by request; the best factors so far are given");
    }
    Ok(result.verdict.is_within && result.trust.is_clear() && !result.trust.is_interrupted)
}
