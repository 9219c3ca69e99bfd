//! A set of figures in a folder, wherever the program is stopped: a reader finds the old set or the new one.
//!
//! A few random stops are always made. `CORFEM_STOPS=200 cargo test stops` makes that many, and stops the program at
//! every single system call that changes the folder, where `strace` is installed.

#![cfg(unix)]

use crate::common::signals::{SIGNALS, send, undisturbed};
use crate::present::figures::figures;
use rustix::process::Signal;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

const STAGE: &str = ".corfem-set";
/// A figure's file from before.
const OLD: &str = "old";
/// Stops that are always made.
const FEW: u64 = 4;

fn asked_for() -> Option<u64> {
    std::env::var("CORFEM_STOPS")
        .ok()
        .map(|count| count.parse().expect("CORFEM_STOPS is a number"))
}

/// What a reader finds in a folder.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Set {
    Nothing,
    Old,
    New,
}

fn found(folder: &Path) -> Set {
    let read = |name: &str| std::fs::read_to_string(folder.join(format!("{name}.svg"))).ok();
    let of = |figure: &corfem::present::figures::Figure| match read(&figure.name) {
        None => Set::Nothing,
        Some(text) if text == OLD => Set::Old,
        Some(text) => {
            assert_eq!(text, figure.svg, "{} is whole", figure.name);
            Set::New
        }
    };
    let all: Vec<Set> = figures().iter().map(of).collect();
    assert!(
        all.iter().all(|one| *one == all[0]),
        "old and new figures are mixed: {all:?}"
    );
    all[0]
}

fn old_set(folder: &Path) {
    for figure in figures() {
        std::fs::write(folder.join(format!("{}.svg", figure.name)), OLD).expect("written");
    }
    std::fs::write(folder.join("notes.txt"), "mine").expect("written");
    std::fs::create_dir_all(folder.join("drafts")).expect("made");
}

/// The program writing figures into a folder, perhaps run by another one.
fn start(run_by: &[&str], folder: &Path) -> Child {
    let program = assert_cmd::cargo::cargo_bin("corfem");
    let words = run_by
        .iter()
        .map(Path::new)
        .chain([program.as_path()])
        .collect::<Vec<_>>();
    let mut command = Command::new(words[0]);
    command
        .args(&words[1..])
        .args(["figures", "-q", "-o"])
        .arg(folder);
    command
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("it starts")
}

/// Sends a signal some time after the program has begun to write.
fn stopped(signal: Signal, folder: &Path, after: Duration) -> ExitStatus {
    let mut child = start(undisturbed(), folder);
    while !folder.join(STAGE).exists() && child.try_wait().expect("a state").is_none() {
        std::hint::spin_loop();
    }
    let until = Instant::now() + after;
    while Instant::now() < until {
        std::hint::spin_loop();
    }
    send(&child, signal);
    child.wait().expect("an end")
}

/// The next run puts everything in order.
fn next_run(folder: &Path) {
    assert!(start(&[], folder).wait().expect("an end").success());
    assert_eq!(found(folder), Set::New);
    let own = figures().len();
    let names = std::fs::read_dir(folder)
        .expect("a folder")
        .flatten()
        .map(|entry| entry.file_name());
    let others: Vec<_> = names
        .filter(|name| !name.to_string_lossy().ends_with(".svg"))
        .collect();
    assert!(!others.iter().any(|name| name == STAGE), "{others:?}");
    let links = figures()
        .iter()
        .filter(|figure| folder.join(format!("{}.svg", figure.name)).is_symlink())
        .count();
    assert_eq!(
        (links, std::fs::read_dir(folder).expect("a folder").count()),
        (0, own + others.len())
    );
}

/// Random delays, the same ones every time; the machine adds its own.
fn delays(count: u64) -> impl Iterator<Item = Duration> {
    let random = |at: u64| at.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
    (1..=count).map(move |at| Duration::from_micros(random(at) % 8000))
}

#[test]
fn a_kill_at_any_moment_leaves_the_old_set_or_the_new_one() {
    let mut left = [0; 2];
    for (at, after) in delays(asked_for().unwrap_or(FEW)).enumerate() {
        let folder = tempfile::tempdir().expect("a folder");
        let out = folder.path().join("out");
        // A folder with an old set, and one that is new.
        if at % 2 == 0 {
            std::fs::create_dir(&out).expect("made");
            old_set(&out);
        }
        let ended = stopped(Signal::KILL, &out, after);
        let set = found(&out);
        assert!(set != if at % 2 == 0 { Set::Nothing } else { Set::Old });
        assert!(ended.signal() == Some(9) || set == Set::New);
        left[usize::from(set == Set::New)] += 1;
        if at % 2 == 0 {
            assert_eq!(
                std::fs::read_to_string(out.join("notes.txt")).expect("it reads"),
                "mine"
            );
        }
        if at % 10 == 0 {
            next_run(&out);
        }
    }
    println!(
        "kills: {} left the old set, {} the new one",
        left[0], left[1]
    );
}

#[test]
fn a_signal_leaves_a_whole_set_and_nothing_beside_it() {
    for (signal, name) in SIGNALS {
        let folder = tempfile::tempdir().expect("a folder");
        old_set(folder.path());
        let ended = stopped(signal, folder.path(), Duration::ZERO);
        assert!(
            ended.signal() == Some(signal.as_raw()) || ended.success(),
            "{name}: {ended}"
        );
        assert_eq!(found(folder.path()), Set::New, "what was begun is ended");
        let count = std::fs::read_dir(folder.path()).expect("a folder").count();
        assert_eq!(
            count,
            figures().len() + 2,
            "notes and drafts are there, and no other file"
        );
    }
}

/// As `nohup` starts a program.
#[test]
fn a_signal_that_it_was_started_to_ignore_does_not_end_it() {
    for (signal, name) in SIGNALS {
        let folder = tempfile::tempdir().expect("a folder");
        let ignoring = format!("trap '' {name}; exec \"$@\"");
        let mut child = start(&["sh", "-c", &ignoring, "sh"], folder.path());
        while !folder.path().join(STAGE).exists() && child.try_wait().expect("a state").is_none() {
            std::hint::spin_loop();
        }
        send(&child, signal);
        assert!(child.wait().expect("an end").success(), "{name}");
        assert_eq!(found(folder.path()), Set::New);
    }
}

/// What a run leaves that is stopped between its links: one over nothing, and one over an old file.
#[test]
fn what_a_stopped_run_leaves_is_settled_by_the_next() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let link =
        |target: &str, name: &str| std::os::unix::fs::symlink(target, at(name)).expect("linked");
    let leave = || {
        std::fs::create_dir_all(at(".corfem-set/old")).expect("made");
        link("old", ".corfem-set/current");
        std::fs::write(at(".corfem-set/old/kept.svg"), OLD).expect("written");
        link(".corfem-set/current/kept.svg", "kept.svg");
        link(".corfem-set/current/new.svg", "new.svg");
    };
    leave();
    assert!(start(&[], folder.path()).wait().expect("an end").success());
    assert!(!at("new.svg").is_symlink() && !at("kept.svg").is_symlink() && !at(STAGE).exists());
    assert_eq!(
        std::fs::read_to_string(at("kept.svg")).expect("it reads"),
        OLD
    );
    // What cannot be put back is left as it is: no file can take a folder's place.
    std::fs::remove_file(at("kept.svg")).expect("removed");
    leave();
    std::fs::create_dir(at(".corfem-set/old/new.svg")).expect("made");
    assert_eq!(
        start(&[], folder.path()).wait().expect("an end").code(),
        Some(2)
    );
    assert!(at("new.svg").is_symlink() && at(".corfem-set/old/new.svg").is_dir());
}

#[test]
fn a_kill_at_every_change_of_the_folder_leaves_the_old_set_or_the_new_one() {
    let has_strace = Command::new("strace")
        .arg("-V")
        .stdout(Stdio::null())
        .status()
        .is_ok_and(|status| status.success());
    if asked_for().is_none() || !has_strace {
        println!("NOT RUN: kills at every system call. It needs CORFEM_STOPS and strace.");
        return;
    }
    let (mut kills, mut new) = (0, 0);
    for call in [
        "rename",
        "renameat",
        "symlink",
        "symlinkat",
        "link",
        "linkat",
        "unlink",
        "unlinkat",
        "mkdir",
        "rmdir",
    ] {
        for at in 1.. {
            let folder = tempfile::tempdir().expect("a folder");
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
            let ended = start(&run_by, folder.path()).wait().expect("an end");
            let set = found(folder.path());
            assert_ne!(set, Set::Nothing);
            if ended.success() {
                break;
            }
            kills += 1;
            new += usize::from(set == Set::New);
            if at % 10 == 1 {
                next_run(folder.path());
            }
        }
    }
    assert!(kills > 2 * figures().len(), "only {kills} kills");
    println!("kills at a system call: {kills}, of which {new} left the new set");
}
