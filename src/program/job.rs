//! `corfem correlate`, `corfem check JOB` and `corfem init`: the user's own structure.

use super::folder::put_all;
use super::output::{OutputArguments, say};
use super::place::put;
use super::{progress, signals};
use clap::Args;
use corfem::files::error::FileError;
use corfem::files::escaped;
use corfem::job::{Method, Prepared, TEMPLATE, TEST_TEMPLATE, run};
use corfem::present::page::subject_page;
use corfem::present::subject::Subject;
use corfem::present::tables::deck::not_read;
use corfem::present::tables::job::{doubts_table, places_table, seen_table, suspects_table};
use corfem::present::tables::subject::{factor_table, history_table, paired_table};
use corfem::present::{PresentError, json, render};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

#[derive(Debug, Args)]
pub struct InitArguments {
    /// Write the example of a test's table instead of a job
    #[arg(long)]
    test: bool,
    /// Write it to this file, which must not be there, instead of standard output
    #[arg(value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct CorrelateArguments {
    /// The job: corfem init explains its entries
    #[arg(value_name = "JOB")]
    job: PathBuf,
    /// Also write report.html, factors.csv, correlation.json and the corrected deck into this folder, made if it is new
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Try so many first points by Gauss-Newton steps, the model's own and others drawn from the seed
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    starts: Option<u32>,
    /// The seed of the first points
    #[arg(long, value_name = "S", requires = "starts")]
    seed: Option<u64>,
    #[command(flatten)]
    output: OutputArguments,
}

#[derive(Debug, Args)]
pub struct CheckArguments {
    /// The job
    #[arg(value_name = "JOB")]
    job: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArguments,
}

/// What a run calls its job: the file's name without its folders, which are nothing of the run's.
pub fn file_name(job: &Path) -> String {
    job.file_name()
        .map_or_else(String::new, |name| escaped(&name.to_string_lossy()))
}

/// Writes a job, or a test's table, that explains itself.
pub fn init(arguments: &InitArguments) -> Result<(), PresentError> {
    if let Some(path) = arguments.output.as_deref().filter(|path| path.exists()) {
        let found = std::io::Error::from(std::io::ErrorKind::AlreadyExists);
        return Err(FileError::of_file(path, "write")(found).into());
    }
    put(
        arguments.output.as_deref(),
        if arguments.test {
            TEST_TEMPLATE
        } else {
            TEMPLATE
        },
    )
}

/// Says everything doubtful of a job and ranks its parameters, without a step.
pub fn check_job(
    CheckArguments { job, output }: &CheckArguments,
    quiet: bool,
) -> Result<(), PresentError> {
    let Some(path) = job else {
        return super::studies::check(output);
    };
    let tables = progress::during(quiet, "looking at the job", || {
        let prepared = Prepared::new(path)?;
        let subject = Subject::of_job(&prepared, None)?;
        let [doubts, suspects] = [doubts_table(&prepared)?, suspects_table(&prepared)?];
        Ok::<_, PresentError>([
            doubts,
            places_table(&prepared, None)?,
            paired_table(&subject)?,
            suspects,
        ])
    })?;
    output.write(&tables, || json::document(json!({ "tables": tables })))
}

/// Corrects the model of a job and writes the report; whether it is within tolerance.
pub fn correlate(arguments: &CorrelateArguments, quiet: bool) -> Result<bool, PresentError> {
    let mut prepared = Prepared::new(&arguments.job)?;
    if let Some(starts) = arguments.starts {
        let compare = &mut prepared.job.compare;
        compare.method = Method::GaussNewton;
        compare.starts = Some(starts as usize);
        compare.seed = arguments.seed.unwrap_or(compare.seed);
    }
    for card in prepared
        .source
        .deck
        .iter()
        .flat_map(|(_, deck)| &deck.unread)
    {
        say(format_args!(
            "corfem: {}: {}",
            prepared.title,
            not_read(card)
        ));
    }
    let bar = progress::spinner(quiet);
    let stop = Arc::new(AtomicBool::new(false));
    signals::tell(&stop);
    // Held until the report is written, so that a request to stop ends the program with the best so far.
    let _held = signals::hold();
    let go_on = || !stop.load(Ordering::SeqCst);
    let finished = run(&prepared, |words| bar.set_message(words.to_owned()), go_on);
    bar.finish_and_clear();
    let finished = finished?;
    let subject = Subject::of_job(&prepared, Some(&finished))?;
    // The verdict stands under the history, at the end.
    let [paired, factors, history] = [
        paired_table(&subject)?,
        factor_table(&subject),
        history_table(&subject),
    ];
    let tables = [paired, factors, seen_table(&prepared, &finished)?, history];
    let document = || json::document(json::subject(&subject)?);
    arguments.output.write(&tables, document)?;
    if let Some(folder) = &arguments.folder {
        let [.., seen, _] = &tables;
        let extra = [
            seen.clone(),
            places_table(&prepared, Some(&finished))?,
            doubts_table(&prepared)?,
        ];
        let command = format!("corfem correlate {}", arguments.job.display());
        let identity =
            prepared.identity(&format!("{:?} {:?}", arguments.starts, arguments.seed))?;
        let run = format!(
            "correlate {}, inputs {identity:016x}",
            file_name(&arguments.job)
        );
        let mut files = vec![
            (
                "report.html".to_owned(),
                subject_page(&subject, &extra, &command)?.into_bytes(),
            ),
            (
                "factors.csv".to_owned(),
                render::csv(&[factor_table(&subject)]).into_bytes(),
            ),
            ("correlation.json".to_owned(), document()?.into_bytes()),
        ];
        // The report of a long correlation is not lost with a deck that cannot be written.
        let deck = prepared.corrected_deck(&finished.factors);
        files.extend(
            deck.as_ref()
                .ok()
                .cloned()
                .flatten()
                .map(|deck| ("corrected.bdf".to_owned(), deck)),
        );
        put_all(folder, &files, &run)?;
        deck?;
    }
    if finished.is_interrupted {
        say("corfem: stopped by request; the best factors so far are given");
    }
    Ok(finished.verdict.is_within && !finished.is_interrupted)
}
