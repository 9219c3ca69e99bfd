//! Figures in a folder, wherever the program is stopped: a reader finds each file old or new, and whole.
//!
//! A few random stops are always made. `CORFEM_STOPS=200 cargo test stops` makes that many, and `cargo test stops -- --ignored`
//! stops the program at every single system call that writes, for which it needs `strace`.

#![cfg(unix)]

use crate::common::signals::{SIGNALS, corfem_run_by, send, undisturbed};
use crate::prelude::*;
use crate::presentation::figures::figures;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, ExitStatus};

/// A figure's file from before.
const OLD: &str = "old";
/// Stops that are always made.
const FEW: u64 = 4;

fn asked_for() -> Option<u64> {
    std::env::var("CORFEM_STOPS")
        .ok()
        .map(|count| count.parse().unwrap())
}

/// How many files are new; the others are old, or not there where there was none before.
fn new_files(folder: &Path, had_old: bool) -> usize {
    let is_new = |figure: &&crate::paper::figures::Figure| {
        let text = fs::read_to_string(folder.join(format!("{}.svg", figure.name))).ok();
        match text.as_deref() {
            None => assert!(!had_old, "{} is gone", figure.name),
            Some(OLD) => assert!(had_old, "{} was never old", figure.name),
            Some(text) => assert_eq!(text, figure.svg, "{} is whole", figure.name),
        }
        text.is_some_and(|text| text != OLD)
    };
    figures().iter().filter(is_new).count()
}

/// What stands in the folder beside figures, and what a killed run may leave: a file of its own that it had not named yet.
fn others(folder: &Path) -> (Vec<String>, usize) {
    let names = fs::read_dir(folder).unwrap().flatten();
    let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let (left, mut others): (Vec<String>, Vec<String>) = names
        .filter(|name| !name.ends_with(".svg"))
        .partition(|name| name.starts_with(".corfem-"));
    others.sort();
    (others, left.len())
}

fn old_set(folder: &Path) {
    for figure in figures() {
        fs::write(folder.join(format!("{}.svg", figure.name)), OLD).unwrap();
    }
    fs::write(folder.join("notes.txt"), "mine").unwrap();
}

/// The program writing figures into a folder, perhaps run by another one.
fn start(run_by: &[&str], folder: &Path) -> Child {
    corfem_run_by(run_by)
        .args(["figures", "-q", "--folder"])
        .arg(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Waits until the program has written its first file, or has ended.
fn begun(child: &mut Child, folder: &Path) {
    let first = folder.join(format!("{}.svg", figures()[0].name));
    let is_written = || fs::read(&first).is_ok_and(|bytes| bytes != OLD.as_bytes());
    while !is_written() && child.try_wait().unwrap().is_none() {
        std::hint::spin_loop();
    }
}

/// Sends a signal some time after the program has begun to write.
fn stopped(signal: Signal, folder: &Path, after: Duration) -> ExitStatus {
    let mut child = start(undisturbed(), folder);
    begun(&mut child, folder);
    let until = Instant::now() + after;
    while Instant::now() < until {
        std::hint::spin_loop();
    }
    send(&child, signal);
    child.wait().unwrap()
}

/// Random delays, the same ones every time; the machine adds its own.
fn delays(count: u64) -> impl Iterator<Item = Duration> {
    let random = |at: u64| at.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
    (1..=count).map(move |at| Duration::from_micros(random(at) % 8000))
}

#[test]
fn a_kill_at_any_moment_leaves_each_file_old_or_new_and_whole() {
    let signals = [
        SIGNALS.map(|(signal, _)| signal).as_slice(),
        &[Signal::KILL],
    ]
    .concat();
    for (at, after) in delays(asked_for().unwrap_or(FEW)).enumerate() {
        let folder = new_folder();
        let out = folder.path().join("out");
        // A folder with old files, and one that is new.
        let had_old = at % 2 == 0;
        if had_old {
            fs::create_dir(&out).unwrap();
            old_set(&out);
        }
        let signal = signals[at % signals.len()];
        let ended = stopped(signal, &out, after);
        let new = new_files(&out, had_old);
        assert!(new > 0, "it had begun");
        assert!(ended.signal() == Some(signal.as_raw()) || new == figures().len());
        let (beside, left) = others(&out);
        assert!(left <= 1, "{left} files without a name");
        assert_eq!(beside, if had_old { vec!["notes.txt"] } else { vec![] });
        // The next run writes what was not written.
        assert!(start(&[], &out).wait().unwrap().success());
        assert_eq!(new_files(&out, had_old), figures().len());
        assert_eq!(others(&out), (beside, left));
    }
}

/// As `nohup` starts a program.
#[test]
fn a_signal_that_it_was_started_to_ignore_does_not_end_it() {
    for (signal, name) in SIGNALS {
        let folder = new_folder();
        let ignoring = format!("trap '' {name}; exec \"$@\"");
        let mut child = start(&["sh", "-c", &ignoring, "sh"], folder.path());
        begun(&mut child, folder.path());
        send(&child, signal);
        assert!(child.wait().unwrap().success(), "{name}");
        assert_eq!(new_files(folder.path(), false), figures().len());
    }
}

#[test]
#[ignore = "minutes, and needs strace: a kill at every system call"]
fn a_kill_at_every_call_that_writes_leaves_each_file_old_or_new_and_whole() {
    let mut kills = 0;
    for call in ["write", "fsync", "rename", "renameat", "renameat2"] {
        for at in 1.. {
            let folder = new_folder();
            old_set(folder.path());
            let inject = format!("inject=?{call}:signal=KILL:when={at}");
            let trace = format!("trace=?{call}");
            let run_by = [
                "strace",
                "-f",
                "-qq",
                "-o",
                "/dev/null",
                "-e",
                &trace,
                "-e",
                &inject,
            ];
            let ended = start(&run_by, folder.path()).wait().unwrap();
            new_files(folder.path(), true);
            if ended.success() {
                break;
            }
            kills += 1;
        }
    }
    assert!(kills > 2 * figures().len(), "only {kills} kills");
    println!("kills at a system call: {kills}");
}
