//! `corfem study`: runs a job many times with its test varied within its uncertainty.

use super::folder::write_files;
use super::job::file_name;
use super::output::{OutputArguments, note};
use super::settings::named;
use super::{progress, signals};
use clap::Args;
use corfem::files::disk::{OpenFile, TryLockError, make_folder, open_or_create};
use corfem::files::error::FileError;
use corfem::job::{Samples, Study, Vary};
use corfem::present::figures::histogram;
use corfem::present::tables::job::{study_table, trust_table};
use corfem::present::{PresentError, json, render};
use serde_json::json;
use std::io::{Error, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering::SeqCst;
use std::sync::{Mutex, PoisonError};
use std::thread::{Builder, available_parallelism, scope};

/// Most samples: the place of each in its file takes some forty bytes, so that all take 400 MB.
const MOST_SAMPLES: u64 = 10_000_000;
/// Most samples at a time: more than any machine has cores, and their stacks take at most 2 GB.
const MOST_THREADS: i64 = 1024;

#[derive(Debug, Args)]
pub struct StudyArguments {
    /// The job: corfem init explains its entries
    #[arg(value_name = "JOB")]
    job: PathBuf,
    /// Number of samples
    #[arg(long, value_name = "N", required_unless_present = "sample", value_parser = clap::value_parser!(u64).range(1..=MOST_SAMPLES))]
    samples: Option<u64>,
    /// Seed of the random numbers; each sample depends on it and its own number alone
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Variations: noise (the test, by its standard deviations), start (the first factors), subset (sensors or modes left out)
    #[arg(long, value_delimiter = ',', default_value = "noise", value_parser = named::<Vary>)]
    vary: Vec<Vary>,
    /// Results folder (samples.csv, summary.csv, histogram.svg), created if new; an unfinished study in it is resumed
    #[arg(long, value_name = "DIR", required_unless_present = "sample")]
    folder: Option<PathBuf>,
    /// Number of samples to run at a time; the number of cores if not given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MOST_THREADS))]
    threads: Option<u32>,
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
    let study = Study::new(
        &arguments.job,
        arguments.seed,
        &arguments.vary,
        &arguments.accept,
    )?;
    let is_clear = !study.trust.has_doubt();
    // Postponed until the finished samples are written, so that a request to stop ends the program then.
    let (stop, _postponed) = signals::postpone_first();
    let (Some(folder), Some(last)) = (&arguments.folder, arguments.samples) else {
        let (line, failure) = study.run(arguments.sample.unwrap_or(1), || !stop.load(SeqCst))?;
        failure
            .into_iter()
            .for_each(|failure| note(format_args!("corfem: {failure}")));
        // The line belongs to a file of samples; doubts about all of them go to standard error.
        for doubt in study.trust.concerns.iter().filter(|doubt| doubt.stands()) {
            note(format_args!(
                "corfem: doubt {}: {}",
                doubt.identifier, doubt.words
            ));
        }
        arguments.output.write_text(&line)?;
        return Ok(is_clear);
    };
    if !folder.is_dir() {
        make_folder(folder).map_err(FileError::of_file(folder, "write"))?;
    }
    let path = folder.join("samples.csv");
    let (file, found) = opened(&path, &study)?;
    let cores = || available_parallelism().map_or(1, usize::from);
    let threads = arguments.threads.map_or_else(cores, |count| count as usize);
    let missing = (1..=last).filter(|sample| !found.contains(*sample));
    let bar = progress::bar(quiet, missing.clone().count() as u64);
    let (missing, written) = (Mutex::new(missing), Mutex::new((file, Ok(()))));
    let work = || {
        let next = || {
            missing
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .next()
        };
        while let Some(sample) = next().filter(|_| !stop.load(SeqCst)) {
            let Ok((line, _)) = study.run(sample, || !stop.load(SeqCst)) else {
                return;
            };
            let (file, done) = &mut *written.lock().unwrap_or_else(PoisonError::into_inner);
            // Write nothing after a torn line.
            if done.is_err() {
                return;
            }
            *done = file.write_all(line.as_bytes());
            bar.inc(1);
        }
    };
    scope(|scope| {
        // Where the system gives no more threads, those there are do the work.
        let begun = |_: &usize| Builder::new().spawn_scoped(scope, work).is_ok();
        if (0..threads).take_while(begun).count() == 0 {
            work();
        }
    });
    bar.finish_and_clear();
    let (_file, done) = written.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.map_err(FileError::of_file(&path, "write"))?;
    let samples = Samples::read(&path, &study)?;
    let left = (1..=last)
        .filter(|sample| !samples.contains(*sample))
        .count();
    if left > 0 {
        note(format_args!(
            "corfem: stopped by request; {} of {last} samples are done; the same command resumes",
            last - left as u64
        ));
        return Ok(is_clear);
    }
    let summary = samples.summary(&study, last)?;
    let tables = [trust_table(&study.trust), study_table(&study, &summary)];
    let figure = histogram::draw("histogram", &tables[1].title, &summary)?;
    let files = [
        ("summary.csv", render::csv(&tables)),
        ("histogram.svg", figure),
    ];
    write_files(
        folder,
        &files.map(|(name, text)| (name.to_owned(), text.into_bytes())),
        &format!(
            "study {}, inputs {}",
            file_name(&arguments.job),
            study.identity
        ),
    )?;
    arguments.output.write(&tables, || {
        json::own_document(json!({ "trust": study.trust, "tables": tables }))
    })?;
    Ok(is_clear)
}

/// The file of samples, opened to continue behind its last whole line, and its samples. A lock keeps other studies out.
fn opened(path: &Path, study: &Study) -> Result<(OpenFile, Samples), FileError> {
    let failed = FileError::of_file(path, "write");
    let mut file = open_or_create(path).map_err(&failed)?;
    if !file.metadata().is_ok_and(|found| found.is_file()) {
        return Err(failed(Error::new(
            ErrorKind::InvalidInput,
            "it is not a regular file",
        )));
    }
    if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
        return Err(failed(Error::new(
            ErrorKind::ResourceBusy,
            "another study is writing it",
        )));
    }
    let samples = Samples::read(path, study)?;
    let begin = |file: &mut OpenFile| {
        file.go_on_from(samples.whole)?;
        if samples.whole == 0 {
            file.write_all(study.header().as_bytes())
        } else {
            Ok(())
        }
    };
    begin(&mut file).map_err(failed)?;
    Ok((file, samples))
}
