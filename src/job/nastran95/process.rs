//! One run of the program: its files in a temporary folder, its time limited.

use super::{Answer, Nastran95};
use crate::files::disk;
use crate::files::error::FileError;
use crate::files::nastran95::shown;
#[cfg(unix)]
use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
use std::io::{ErrorKind, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// The program and the rigid formats in its folder.
pub(super) const PROGRAM: &str = "bin/nastrn";
pub(super) const RIGID_FORMATS: &str = "rf";
/// Interval at which a running program is looked at.
const POLL: Duration = Duration::from_millis(5);
/// Words of memory the program takes: the defaults of its own scripts.
const MEMORY: [(&str, &str); 2] = [("DBMEM", "12000000"), ("OCMEM", "2000000")];
/// Fortran units that are given files; OUTPUT5 writes on 15.
const UNITS: std::ops::RangeInclusive<u32> = 11..=23;
const ANSWER: &str = "ftn15";
/// Lines of a fatal message, and of the end of the output of a crashed run, that an error carries.
const MESSAGE_LINES: usize = 3;
/// Files of a run that are looked at while it runs and read when it has ended.
const PRINTED: &str = "printed";
const ERRORS: &str = "errors";

impl Nastran95 {
    /// Runs a deck in a temporary folder that is removed, however the run ends.
    ///
    /// # Errors
    /// The variants of [`FileError`] about the solver, also when it writes too much or no files; [`FileError::File`].
    pub fn run(&self, deck: &str) -> Result<Answer, FileError> {
        // The model may be confidential.
        let scratch = disk::scratch_folder("corfem-nastran95-");
        let scratch = scratch.map_err(FileError::of_file(&std::env::temp_dir(), "write"))?;
        let answer = in_scratch(self, deck, scratch.path());
        let failed = FileError::of_file(scratch.path(), "remove");
        let removed = scratch.close();
        // An error of the run matters more than one of tidying up.
        answer.and_then(|answer| removed.map(|()| answer).map_err(failed))
    }
}

fn in_scratch(solver: &Nastran95, deck: &str, scratch: &Path) -> Result<Answer, FileError> {
    let path = |name: &str| scratch.join(name);
    let open =
        |name: &str| disk::open(&path(name)).map_err(FileError::of_file(&path(name), "read"));
    let create =
        |name: &str| disk::create(&path(name)).map_err(FileError::of_file(&path(name), "write"));
    create("deck")?
        .write_all(deck.as_bytes())
        .map_err(FileError::of_file(&path("deck"), "write"))?;
    let program = solver.home.join(PROGRAM);
    let mut command = Command::new(&program);
    command
        .current_dir(scratch)
        .stdin(Stdio::from(open("deck")?))
        .stdout(Stdio::from(create(PRINTED)?))
        .stderr(Stdio::from(create(ERRORS)?))
        .envs(MEMORY)
        .env("RFDIR", solver.home.join(RIGID_FORMATS))
        .env("DIRCTY", scratch)
        .env("OPTPNM", "none");
    let files = [
        ("LOGNM", "log"),
        ("NPTPNM", "nptp"),
        ("DICTNM", "dict"),
        ("PLTNM", "plt"),
        ("PUNCHNM", "punch"),
    ];
    command.envs(files.map(|(variable, name)| (variable, path(name))));
    command.envs((1..*UNITS.start()).map(|unit| (format!("SOF{unit}"), "none")));
    command.envs(UNITS.map(|unit| (format!("FTN{unit}"), path(&format!("ftn{unit}")))));
    // The program and what it may start are stopped together.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    let child = command
        .spawn()
        .map_err(FileError::of_file(&program, "run"))?;
    let status = wait(solver, child, &program, scratch)?;
    let printed = read(scratch, PRINTED, solver.output_limit)?.unwrap_or_default();
    if let Some(message) = fatal_message(&printed) {
        return Err(FileError::SolverFatal { message });
    }
    if !status.success() {
        let errors = read(scratch, ERRORS, solver.output_limit)?.unwrap_or_default();
        let message = last_lines(&format!("{printed}\n{errors}"));
        return Err(FileError::SolverCrashed {
            status: status.to_string(),
            message,
        });
    }
    let unit_15 = read(scratch, ANSWER, solver.output_limit)?;
    Ok(Answer { printed, unit_15 })
}

/// Waits for the program, within its time limit, and kills whatever is left of it, so that nothing writes into the folder
/// that is read and removed next.
fn wait(
    solver: &Nastran95,
    mut child: Child,
    program: &Path,
    scratch: &Path,
) -> Result<ExitStatus, FileError> {
    let ended = watch(solver, &mut child, program, scratch);
    // Its children are in its group, whose number is not reused before the program is reaped.
    #[cfg(unix)]
    let _ =
        rustix::process::kill_process_group(Pid::from_child(&child), rustix::process::Signal::KILL);
    let _ = child.kill();
    let status = child.wait().map_err(FileError::of_file(program, "run"))?;
    ended.map(|()| status)
}

/// Returns when the program has ended, or an error when it is to be stopped.
fn watch(
    solver: &Nastran95,
    child: &mut Child,
    program: &Path,
    scratch: &Path,
) -> Result<(), FileError> {
    let start = Instant::now();
    while !has_ended(child).map_err(FileError::of_file(program, "run"))? {
        if solver.stop.load(Ordering::Relaxed) {
            return Err(FileError::SolverInterrupted);
        }
        if start.elapsed() >= solver.time_limit {
            return Err(FileError::SolverTimeLimit {
                seconds: solver.time_limit.as_secs_f64(),
            });
        }
        for name in [PRINTED, ERRORS, ANSWER] {
            let bytes = disk::symlink_metadata(scratch.join(name)).map_or(0, |found| found.len());
            within_limit(name, bytes, solver.output_limit)?;
        }
        std::thread::sleep(POLL);
    }
    Ok(())
}

/// True if the program has ended. On Unix it is not reaped yet, so that its number is not given to another process.
fn has_ended(child: &mut Child) -> std::io::Result<bool> {
    #[cfg(unix)]
    let ended = waitid(
        WaitId::Pid(Pid::from_child(child)),
        WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT,
    );
    #[cfg(not(unix))]
    let ended = child.try_wait();
    Ok(ended?.is_some())
}

/// The first fatal message in NASTRAN's printed output, its lines joined.
fn fatal_message(printed: &str) -> Option<String> {
    let mut lines = printed.lines().skip_while(|line| !line.contains("FATAL"));
    let first = lines.next()?;
    // A message ends with a blank line, or where the next one begins.
    let rest = lines
        .take(MESSAGE_LINES - 1)
        .take_while(|line| !line.trim().is_empty() && !line.contains("***"));
    let words: Vec<&str> = [first]
        .into_iter()
        .chain(rest)
        .flat_map(str::split_whitespace)
        .collect();
    // The first column is the printer's carriage control.
    Some(shown(
        words.join(" ").trim_start_matches(['0', '1', '*', ' ']),
    ))
}

/// The last lines that are not blank.
pub(super) fn last_lines(text: &str) -> String {
    let lines: Vec<&str> = text
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect();
    match &lines[lines.len().saturating_sub(MESSAGE_LINES)..] {
        [] => "nothing printed".to_owned(),
        last => shown(&last.join(" / ")),
    }
}

/// A file's text, if it is there; bytes that are not UTF-8 are replaced.
fn read(scratch: &Path, name: &str, limit: u64) -> Result<Option<String>, FileError> {
    let path = scratch.join(name);
    // Only a regular file is opened, since opening a pipe would block. The program has ended and cannot swap it.
    let found = match disk::symlink_metadata(&path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        found => found.map_err(FileError::of_file(&path, "read"))?,
    };
    if !found.is_file() {
        return Err(FileError::answer(format!(
            "its {name} is not a regular file"
        )));
    }
    within_limit(name, found.len(), limit)?;
    let mut bytes = Vec::new();
    let read = disk::open(&path).and_then(|file| file.take(limit).read_to_end(&mut bytes));
    read.map_err(FileError::of_file(&path, "read"))?;
    Ok(Some(String::from_utf8_lossy(&bytes).into_owned()))
}

fn within_limit(name: &str, bytes: u64, limit: u64) -> Result<(), FileError> {
    if bytes <= limit {
        return Ok(());
    }
    Err(FileError::answer(format!(
        "its file {name} has {bytes} bytes, more than the {limit} allowed"
    )))
}
