//! `corfem study`: runs a job many times with its test varied within its uncertainty.

use super::folder::write_files;
use super::job::{file_name, job_file};
use super::output::{OutputArguments, note};
use super::settings::named;
use super::{progress, signals};
use clap::Args;
use corfem::files::disk::{TryLockError, make_folder, open_or_create};
use corfem::files::error::FileError;
use corfem::job::{Samples, Study, Vary};
use corfem::present::tables::job::{study_table, trust_table};
use corfem::present::{PresentError, json, render};
use serde_json::json;
use std::io::{Error, ErrorKind, Write};
use std::iter::repeat_with;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::SeqCst};
use std::sync::{Mutex, PoisonError};
use std::thread::{Builder, available_parallelism, scope};

#[derive(Debug, Args)]
pub struct StudyArguments {
    /// The job: corfem init explains its entries
    #[arg(value_name = "JOB")]
    job: PathBuf,
    /// Number of samples
    #[arg(long, value_name = "N", required_unless_present = "sample", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    samples: Option<u64>,
    /// Seed of the random numbers; each sample depends on it and its own number alone
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Variations: noise (the test, by its standard deviations), start (the first factors), subset (sensors or modes left out)
    #[arg(long, value_delimiter = ',', default_value = "noise", value_parser = named::<Vary>)]
    vary: Vec<Vary>,
    /// Results folder (samples.csv, summary.csv), created if new; an unfinished study in it is resumed
    #[arg(long, value_name = "DIR", required_unless_present = "sample")]
    folder: Option<PathBuf>,
    /// Number of samples to run at a time; the number of cores if not given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Run only this sample and write its line instead of a report
    #[arg(long, value_name = "K", conflicts_with_all = ["samples", "folder", "threads"], value_parser = clap::value_parser!(u64).range(1..))]
    sample: Option<u64>,
    /// Answer for the doubt of this identifier, which then no longer makes the status 3; may be repeated
    #[arg(long, value_name = "IDENTIFIER")]
    accept: Vec<String>,
    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the samples that a folder does not have yet and reports on all, or runs one sample alone; true if no doubt stands.
pub fn study(arguments: &StudyArguments, quiet: bool) -> Result<bool, PresentError> {
    let StudyArguments { job, output, .. } = arguments;
    let study = Study::new(
        job_file(job)?,
        arguments.seed,
        &arguments.vary,
        &arguments.accept,
    )?;
    let trust = &study.trust;
    // Postponed until the finished samples are written, so that a request to stop ends the program then.
    let (stop, _postponed) = signals::postpone_first();
    if let (Some(folder), Some(last)) = (&arguments.folder, arguments.samples) {
        let cores = || available_parallelism().map_or(1, usize::from);
        let threads = arguments.threads.map_or_else(cores, usize::from);
        let samples = run_missing(&study, folder, last, threads, (&stop, quiet))?;
        let done = (1..=last).filter(|sample| samples.contains(*sample));
        let done = done.count() as u64;
        if done < last {
            note(format_args!(
                "corfem: stopped by request; {done} of {last} samples are done; the same command resumes"
            ));
            return Ok(!trust.has_doubt());
        }
        let summary = samples.summary(&study, last);
        let tables = [trust_table(trust), study_table(&study, &summary)];
        let file = ("summary.csv".to_owned(), render::csv(&tables).into_bytes());
        let run = format!("study {}, inputs {}", file_name(job), study.identity);
        write_files(folder, &[file], &run)?;
        let document = || json::own_document(json!({ "trust": trust, "tables": tables }));
        output.write(&tables, document)?;
    } else {
        let (line, failure) = study.run(arguments.sample.unwrap_or(1), || !stop.load(SeqCst))?;
        // The line belongs to a file of samples; doubts about all of them go to standard error.
        let doubts = trust.all().iter().filter(|doubt| doubt.stands());
        let doubts = doubts.map(|doubt| format!("doubt {}: {}", doubt.identifier(), doubt.words()));
        let failure = failure.map(|failure| failure.to_string());
        failure
            .into_iter()
            .chain(doubts)
            .for_each(|words| note(format_args!("corfem: {words}")));
        output.write_text(&line)?;
    }
    Ok(!trust.has_doubt())
}

/// Runs the samples up to `last` that a folder's file does not have, as long as nothing asks to stop, and reads the file again.
fn run_missing(
    study: &Study,
    folder: &Path,
    last: u64,
    threads: usize,
    (stop, quiet): (&AtomicBool, bool),
) -> Result<Samples, PresentError> {
    if !folder.is_dir() {
        make_folder(folder).map_err(FileError::of_file(folder, "write"))?;
    }
    let path = &folder.join("samples.csv");
    let failed = FileError::of_file(path, "write");
    let mut file = open_or_create(path).map_err(&failed)?;
    // A lock keeps other studies out.
    if let Err(TryLockError::WouldBlock) = file.try_lock() {
        let reason = "another study is writing it";
        return Err(failed(Error::new(ErrorKind::ResourceBusy, reason)).into());
    }
    let found = Samples::read(path, study)?;
    let header = if found.whole == 0 {
        study.header()
    } else {
        String::new()
    };
    let begun = file.go_on_from(found.whole);
    let begun = begun.and_then(|()| file.write_all(header.as_bytes()));
    begun.map_err(&failed)?;
    let bar = progress::bar(quiet, last);
    let (next, file) = (AtomicU64::new(1), Mutex::new(Ok(file)));
    let go_on = || !stop.load(SeqCst);
    let work = || {
        let numbers = repeat_with(|| next.fetch_add(1, SeqCst));
        for sample in numbers.take_while(|sample| *sample <= last && go_on()) {
            bar.inc(1);
            if found.contains(sample) {
                continue;
            }
            let Ok((line, _)) = study.run(sample, go_on) else {
                return;
            };
            let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
            // Nothing is written after a torn line.
            let Ok(open) = file.as_mut() else {
                return;
            };
            if let Err(error) = open.write_all(line.as_bytes()) {
                *file = Err(error);
            }
        }
    };
    scope(|scope| {
        // Where the system gives no more threads, those there are do the work.
        let begun = |_: &usize| Builder::new().spawn_scoped(scope, work).is_ok();
        (1..threads).take_while(begun).count();
        work();
    });
    bar.finish_and_clear();
    let file = file.into_inner().unwrap_or_else(PoisonError::into_inner);
    let _locked = file.map_err(failed)?;
    Ok(Samples::read(path, study)?)
}
