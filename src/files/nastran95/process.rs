//! One run of the program: its files in a temporary folder, its time limited.

use super::{Answer, Nastran95};
use crate::files::error::FileError;
use std::fs::File;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// The program and the rigid formats in its folder.
pub(super) const PROGRAM: &str = "bin/nastrn";
pub(super) const RIGID_FORMATS: &str = "rf";
/// How often a running program is looked at.
const POLL: Duration = Duration::from_millis(5);
/// Words of memory the program takes: the defaults of its own scripts.
const MEMORY: [(&str, &str); 2] = [("DBMEM", "12000000"), ("OCMEM", "2000000")];
/// Fortran units that are given files; OUTPUT5 writes on 15.
const UNITS: std::ops::RangeInclusive<u32> = 11..=23;
const ANSWER: &str = "ftn15";
/// Lines of a fatal message, and of the end of the output of a crashed run, that an error carries.
const MESSAGE_LINES: usize = 3;

/// Runs a deck in a folder of its own.
pub(super) fn run(solver: &Nastran95, deck: &str) -> Result<Answer, FileError> {
    let scratch = tempfile::Builder::new()
        .prefix("corfem-nastran95-")
        .tempdir()
        .map_err(FileError::of_file(&std::env::temp_dir(), "write"))?;
    let answer = in_scratch(solver, deck, scratch.path());
    let path = scratch.path().to_owned();
    let removed = scratch.close().map_err(FileError::of_file(&path, "remove"));
    // What went wrong with the run matters more than what went wrong in tidying up.
    let answer = answer?;
    removed?;
    Ok(answer)
}

fn in_scratch(solver: &Nastran95, deck: &str, scratch: &Path) -> Result<Answer, FileError> {
    let path = |name: &str| scratch.join(name);
    std::fs::write(path("deck"), deck).map_err(FileError::of_file(&path("deck"), "write"))?;
    let open = |name: &str| File::open(path(name)).map_err(FileError::of_file(&path(name), "read"));
    let create = |name: &str| File::create(path(name)).map_err(FileError::of_file(&path(name), "write"));
    let program = solver.home.join(PROGRAM);
    let mut command = Command::new(&program);
    command
        .current_dir(scratch)
        .stdin(Stdio::from(open("deck")?))
        .stdout(Stdio::from(create("printed")?))
        .stderr(Stdio::from(create("errors")?))
        .envs(MEMORY)
        .env("RFDIR", solver.home.join(RIGID_FORMATS))
        .env("DIRCTY", scratch)
        .env("OPTPNM", "none");
    let files = [("LOGNM", "log"), ("NPTPNM", "nptp"), ("DICTNM", "dict"), ("PLTNM", "plt"), ("PUNCHNM", "punch")];
    command.envs(files.map(|(variable, name)| (variable, path(name))));
    command.envs((1..*UNITS.start()).map(|unit| (format!("SOF{unit}"), "none")));
    command.envs(UNITS.map(|unit| (format!("FTN{unit}"), path(&format!("ftn{unit}")))));
    own_group(&mut command);
    let child = command.spawn().map_err(FileError::of_file(&program, "run"))?;
    let status = wait(solver, child, &program)?;
    let printed = read(&path("printed"))?;
    if let Some(message) = fatal_message(&printed) {
        return Err(FileError::SolverFatal { message });
    }
    if !status.success() {
        let message = last_lines(&format!("{printed}\n{}", read(&path("errors"))?));
        return Err(FileError::SolverCrashed { status: status.to_string(), message });
    }
    let unit_15 = path(ANSWER).is_file().then(|| read(&path(ANSWER))).transpose()?;
    Ok(Answer { printed, unit_15 })
}

/// Waits for the end of the program, but not for ever.
fn wait(solver: &Nastran95, child: Child, program: &Path) -> Result<ExitStatus, FileError> {
    let mut running = Running(child);
    let start = Instant::now();
    loop {
        if let Some(status) = running.0.try_wait().map_err(FileError::of_file(program, "run"))? {
            return Ok(status);
        }
        if solver.stop.load(Ordering::Relaxed) {
            return Err(FileError::SolverInterrupted);
        }
        if start.elapsed() >= solver.time_limit {
            return Err(FileError::SolverTimeLimit { seconds: solver.time_limit.as_secs_f64() });
        }
        std::thread::sleep(POLL);
    }
}

/// A child that does not outlive the wait for it.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        if matches!(self.0.try_wait(), Ok(None)) {
            kill(&mut self.0);
            // Reaped here, so that nothing of it writes into the folder that is removed next.
            let _ = self.0.wait();
        }
    }
}

/// Puts the program and what it may start into a process group of their own, to be stopped together.
#[cfg(unix)]
fn own_group(command: &mut Command) {
    std::os::unix::process::CommandExt::process_group(command, 0);
}

#[cfg(unix)]
fn kill(child: &mut Child) {
    let group = rustix::process::Pid::from_child(child);
    let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
}

#[cfg(not(unix))]
fn own_group(_: &mut Command) {}

#[cfg(not(unix))]
fn kill(child: &mut Child) {
    let _ = child.kill();
}

/// The first fatal message in what NASTRAN prints, its lines joined.
fn fatal_message(printed: &str) -> Option<String> {
    let mut lines = printed.lines().skip_while(|line| !line.contains("FATAL"));
    let first = lines.next()?;
    // A message ends with a blank line, or where the next one begins.
    let rest = lines.take(MESSAGE_LINES - 1).take_while(|line| !line.trim().is_empty() && !line.contains("***"));
    let words: Vec<&str> = std::iter::once(first).chain(rest).flat_map(str::split_whitespace).collect();
    // The first column is the printer's carriage control.
    Some(words.join(" ").trim_start_matches(['0', '1', '*', ' ']).to_owned())
}

/// The last lines that are not blank.
pub(super) fn last_lines(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    match &lines[lines.len().saturating_sub(MESSAGE_LINES)..] {
        [] => "nothing printed".to_owned(),
        last => last.join(" / "),
    }
}

/// A file's text; NASTRAN prints bytes that are no text.
fn read(path: &Path) -> Result<String, FileError> {
    let bytes = std::fs::read(path).map_err(FileError::of_file(path, "read"))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
