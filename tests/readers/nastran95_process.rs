//! The external solver's process, played by small shell scripts: however a run ends, the error says so and nothing is left.

#![cfg(unix)]

use crate::common::fake_solver::{fake, solver};
use crate::common::signals::{SIGNALS, corfem_run_by, send, undisturbed};
use corfem::files::error::FileError;
use corfem::job::nastran95::{Nastran95, default_folder};
use rustix::process::Signal;
use std::os::unix::{fs::PermissionsExt, process::ExitStatusExt};
use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};
use tempfile::TempDir;

fn entries(folder: &Path) -> usize {
    std::fs::read_dir(folder).expect("a folder").count()
}

#[test]
fn a_missing_solver_is_named() {
    let empty = tempfile::tempdir().expect("a folder");
    let no_formats = fake("exit 0");
    std::fs::remove_dir(no_formats.path().join("rf")).expect("removed");
    let no_program = fake("exit 0");
    std::fs::remove_file(no_program.path().join("bin/nastrn")).expect("removed");
    for folder in [
        empty.path(),
        no_formats.path(),
        no_program.path(),
        Path::new("no/such/folder"),
    ] {
        let error = Nastran95::in_folder(folder).expect_err("nothing there");
        assert!(
            matches!(&error, FileError::SolverMissing { path } if path == folder),
            "{error}"
        );
        assert!(
            error
                .to_string()
                .contains("--nastran or the environment variable NASTRAN95")
        );
    }
}

#[test]
fn a_program_that_cannot_start_is_named() {
    let home = fake("exit 0");
    let program = home.path().join("bin/nastrn");
    std::fs::set_permissions(&program, PermissionsExt::from_mode(0o644)).expect("not executable");
    let error = solver(&home).run("").expect_err("it cannot start");
    assert!(
        matches!(&error, FileError::File { path, action: "run", .. } if path.ends_with("bin/nastrn")),
        "{error}"
    );
}

#[test]
fn a_run_gets_its_deck_and_its_files_and_gives_back_what_it_wrote() {
    let home = fake(
        "cat\necho \"memory $DBMEM $OCMEM formats $RFDIR $OPTPNM $SOF1 $SOF10\"\ntest \"$PWD\" = \"$DIRCTY\" && echo at home\n\
         for file in \"$LOGNM\" \"$NPTPNM\" \"$DICTNM\" \"$PLTNM\" \"$PUNCHNM\" \"$FTN11\" \"$FTN23\"; do echo x > \"$file\"; done; ls | wc -l\n\
         printf 'matrices' > \"$FTN15\"",
    );
    let answer = solver(&home).run("BEGIN BULK\n").expect("a run");
    assert_eq!(answer.unit_15.as_deref(), Some("matrices"));
    let formats = home.path().canonicalize().expect("a path").join("rf");
    let lines: Vec<&str> = answer.printed.lines().map(str::trim).collect();
    assert_eq!(lines[0], "BEGIN BULK");
    assert_eq!(
        lines[1],
        format!(
            "memory 12000000 2000000 formats {} none none none",
            formats.display()
        )
    );
    assert_eq!(
        lines[2..],
        ["at home", "10"],
        "deck, two outputs and seven files"
    );
}

#[test]
fn a_run_without_an_answer_says_what_was_printed_last() {
    let home = fake("echo one; echo two; echo; echo three; echo four");
    let error = solver(&home)
        .matrices("", 0)
        .expect_err("nothing on unit 15");
    assert_eq!(
        error.to_string(),
        "NASTRAN-95: nothing was written on Fortran unit 15; printed last: two / three / four"
    );
    let silent = solver(&fake("exit 0"))
        .matrices("", 0)
        .expect_err("nothing at all");
    assert!(
        matches!(&silent, FileError::SolverAnswer { reason } if reason.ends_with("printed last: nothing printed")),
        "{silent}"
    );
}

#[test]
fn a_crash_gives_its_status_and_last_words() {
    let home = fake("echo reading bulk data; echo Segmentation fault >&2; exit 3");
    let error = solver(&home).run("").expect_err("a crash");
    assert!(
        matches!(&error, FileError::SolverCrashed { status, message } if status == "exit status: 3" && message == "reading bulk data / Segmentation fault"),
        "{error}"
    );
    let killed = solver(&fake("kill -SEGV $$"))
        .run("")
        .expect_err("a signal");
    assert!(
        matches!(&killed, FileError::SolverCrashed { status, .. } if status.contains("signal: 11")),
        "{killed}"
    );
}

#[test]
fn a_fatal_message_is_the_error_also_with_a_good_exit_status() {
    let message = "0*** USER FATAL MESSAGE 2025, UNDEFINED GRID POINT\\n     77 ON ELEMENT 3\\n\\n     NEXT PAGE";
    for status in [0, 1] {
        let home = fake(&format!(
            "printf ' HEADING\\n{message}\\n'; printf x > \"$FTN15\"; exit {status}"
        ));
        let error = solver(&home).run("").expect_err("a fatal message");
        assert!(
            matches!(&error, FileError::SolverFatal { message } if message == "USER FATAL MESSAGE 2025, UNDEFINED GRID POINT 77 ON ELEMENT 3"),
            "{error}"
        );
    }
    // Two messages in a row: the first counts. NASTRAN prints bytes that are no text.
    let home =
        fake("printf '\\377\\0\\n0*** SYSTEM FATAL MESSAGE 1\\n0*** USER FATAL MESSAGE 2\\n'");
    let error = solver(&home).run("").expect_err("fatal messages");
    assert!(
        matches!(&error, FileError::SolverFatal { message } if message == "SYSTEM FATAL MESSAGE 1"),
        "{error}"
    );
    let long = fake("printf 'FATAL a\\nb\\nc\\nd\\n'");
    let error = solver(&long).run("").expect_err("a long message");
    assert!(
        matches!(&error, FileError::SolverFatal { message } if message == "FATAL a b c"),
        "{error}"
    );
}

#[test]
fn a_hang_is_stopped_with_everything_it_started() {
    let outside = tempfile::tempdir().expect("a folder");
    let marker = outside.path().join("alive");
    let home = fake(&format!(
        "(sleep 2; touch {}) &\nsleep 60",
        marker.display()
    ));
    let mut solver = solver(&home);
    solver.time_limit = Duration::from_millis(300);
    let start = Instant::now();
    let error = solver.run("").expect_err("a hang");
    assert!(
        matches!(error, FileError::SolverTimeLimit { seconds } if seconds == 0.3),
        "{error}"
    );
    let took = start.elapsed();
    assert!(
        took >= solver.time_limit && took < Duration::from_secs(10),
        "{took:?}"
    );
    std::thread::sleep(Duration::from_millis(2500));
    assert!(
        !marker.exists(),
        "what the program started was stopped with it"
    );
}

#[test]
fn a_request_to_stop_ends_the_run() {
    let home = fake("sleep 60");
    let solver = solver(&home);
    solver.stop.store(true, Ordering::Relaxed);
    let error = solver.run("").expect_err("stopped");
    assert!(matches!(error, FileError::SolverInterrupted), "{error}");
}

/// Runs the program with a fake solver and its temporary files in a folder of their own; how many it left there.
fn through_the_command_line(home: &TempDir, extra: &[&str]) -> (std::process::Output, usize) {
    let temporary = tempfile::tempdir().expect("a folder");
    let output = assert_cmd::Command::cargo_bin("corfem")
        .expect("the program is built")
        .args(["cases", "4", "--solver", "nastran95", "--quiet"])
        .args(extra)
        .env("NASTRAN95", home.path())
        .env("TMPDIR", temporary.path())
        .output()
        .expect("it starts");
    let left = entries(temporary.path());
    (output, left)
}

#[test]
fn no_run_leaves_anything_behind() {
    for (script, message) in [
        ("exit 0", "nothing was written on Fortran unit 15"),
        (
            "touch a b; mkdir -p c/d; touch c/d/e; exit 9",
            "exit status: 9",
        ),
        (
            "echo ' *** USER FATAL MESSAGE 3'",
            "input: USER FATAL MESSAGE 3",
        ),
        (
            "echo rubbish > \"$FTN15\"; echo rubbish >> \"$FTN15\"",
            "OUTPUT5 file, line 2: \"rubbish\" is not a line of integers",
        ),
        ("touch big; sleep 60", "still running after 1 s"),
    ] {
        let home = fake(script);
        let (output, left) = through_the_command_line(&home, &["--time-limit", "1"]);
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{script}: {stderr}");
        assert!(
            stderr.starts_with("corfem: NASTRAN-95") && stderr.contains(message),
            "{script}: {stderr}"
        );
        assert!(output.stdout.is_empty());
        assert_eq!(left, 0, "{script}");
    }
    let home = fake("exit 0");
    let (refused, left) = through_the_command_line(&home, &["--time-limit", "0"]);
    assert_eq!((refused.status.code(), left), (Some(2), 0));
    let (missing, left) = through_the_command_line(&home, &["--nastran", "no/such/folder"]);
    assert_eq!((missing.status.code(), left), (Some(2), 0));
    assert!(
        String::from_utf8_lossy(&missing.stderr)
            .contains("no folder with bin/nastrn and rf/ at no/such/folder")
    );
}

/// Sends a signal to the program while its solver runs; how it ended, and how many files it left.
fn stopped_by(signal: Signal, run_by: &[&str]) -> (std::process::ExitStatus, usize) {
    let temporary = tempfile::tempdir().expect("a folder");
    let home = fake("touch started; sleep 3");
    let mut child = corfem_run_by(run_by)
        .args([
            "cases",
            "4",
            "--solver",
            "nastran95",
            "--quiet",
            "--nastran",
        ])
        .arg(home.path())
        .env("TMPDIR", temporary.path())
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .expect("it starts");
    let started = || {
        let mut folders = std::fs::read_dir(temporary.path())
            .expect("a folder")
            .flatten();
        folders.any(|folder| folder.path().join("started").exists())
    };
    let limit = Instant::now() + Duration::from_secs(20);
    while !started() && Instant::now() < limit {
        std::thread::sleep(Duration::from_millis(20));
    }
    send(&child, signal);
    (child.wait().expect("an end"), entries(temporary.path()))
}

#[test]
fn a_signal_ends_the_solver_and_then_the_program_and_leaves_nothing() {
    for (signal, name) in SIGNALS {
        let (ended, left) = stopped_by(signal, undisturbed());
        assert_eq!((ended.signal(), left), (Some(signal.as_raw()), 0), "{name}");
    }
    // Started to ignore it, as nohup does, the program goes on: it refuses what the solver did not write.
    let (ended, left) = stopped_by(Signal::HUP, &["nohup"]);
    assert_eq!((ended.code(), left), (Some(2), 0));
}

#[test]
fn a_temporary_folder_that_cannot_be_made_is_named() {
    let home = fake("exit 0");
    let output = assert_cmd::Command::cargo_bin("corfem")
        .expect("the program is built")
        .args(["cases", "4", "--solver", "nastran95"])
        .env("NASTRAN95", home.path())
        .env("TMPDIR", "/no/such/folder")
        .output()
        .expect("it starts");
    assert_eq!(output.status.code(), Some(2));
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        stderr.starts_with("corfem: cannot write /no/such/folder: "),
        "{stderr}"
    );
}

#[test]
fn the_wheels_folder_is_where_its_readme_unpacks_it() {
    let folder = default_folder();
    assert!(folder.ends_with(".cache/nastran95/nastran95/_data"));
    assert_eq!(folder.is_absolute(), std::env::home_dir().is_some());
}
