//! The external solver's process, played by small shell scripts: however a run ends, the error says so and nothing is left.

#![cfg(unix)]

use crate::common::fake_solver::{fake, solver};
use crate::common::outer_loop::program::status;
use crate::common::signals::send;
use crate::prelude::*;
use std::process::Output;

fn entries(folder: &Path) -> usize {
    fs::read_dir(folder).unwrap().count()
}

#[test]
fn a_run_gets_its_deck_and_its_files_and_gives_back_what_it_wrote() {
    let home = fake(
        "cat\necho \"memory $DBMEM $OCMEM formats $RFDIR $OPTPNM $SOF1 $SOF10\"\ntest \"$PWD\" = \"$DIRCTY\" && echo at home\n\
         for file in \"$LOGNM\" \"$NPTPNM\" \"$DICTNM\" \"$PLTNM\" \"$PUNCHNM\" \"$FTN11\" \"$FTN23\"; do echo x > \"$file\"; done; ls | wc -l\n\
         printf 'matrices' > \"$FTN15\"",
    );
    let answer = solver(&home).run("BEGIN BULK\n").unwrap();
    assert_eq!(answer.unit_15.as_deref(), Some("matrices"));
    let formats = home.path().canonicalize().unwrap().join("rf");
    let lines = answer.printed.lines().map(str::trim).collect_vec();
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
fn a_crash_gives_its_status_and_last_words() {
    let home = fake("echo reading bulk data; echo Segmentation fault >&2; exit 3");
    let error = solver(&home).run("").expect_err("a crash");
    assert_eq!(
        error.to_string(),
        "NASTRAN-95 ended with exit status: 3: reading bulk data / Segmentation fault"
    );
    let killed = solver(&fake("kill -SEGV $$"))
        .run("")
        .expect_err("a signal");
    let killed = killed.to_string();
    assert!(
        killed.starts_with("NASTRAN-95 ended with signal: 11"),
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
        assert_eq!(
            error.to_string(),
            "NASTRAN-95 refused its input: USER FATAL MESSAGE 2025, UNDEFINED GRID POINT 77 ON ELEMENT 3"
        );
    }
    // Two messages in a row: the first counts. NASTRAN prints bytes that are no text.
    let home =
        fake("printf '\\377\\0\\n0*** SYSTEM FATAL MESSAGE 1\\n0*** USER FATAL MESSAGE 2\\n'");
    let error = solver(&home).run("").expect_err("fatal messages");
    assert_eq!(
        error.to_string(),
        "NASTRAN-95 refused its input: SYSTEM FATAL MESSAGE 1"
    );
    let long = fake("printf 'FATAL a\\nb\\nc\\nd\\n'");
    let error = solver(&long).run("").expect_err("a long message");
    assert_eq!(
        error.to_string(),
        "NASTRAN-95 refused its input: FATAL a b c"
    );
}

#[test]
fn a_hang_is_stopped_with_everything_it_started() {
    let outside = new_folder();
    let marker = outside.path().join("alive");
    let home = fake(&format!(
        "(sleep 2; touch {}) &\nsleep 60",
        marker.display()
    ));
    let mut solver = solver(&home);
    solver.time_limit = Duration::from_millis(300);
    let start = Instant::now();
    let error = solver.run("").expect_err("a hang");
    assert_eq!(
        error.to_string(),
        "NASTRAN-95 was stopped: it was still running after 0.3 s"
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
    assert_eq!(error.to_string(), "NASTRAN-95 was stopped by request");
}

#[test]
#[ignore = "needs NASTRAN-95"]
fn the_program_prints_a_case() {
    assert_eq!(status(once("4".to_owned())), 0);
}

/// The program asked for Case 4 as a process of its own, with a fake solver and its temporary files in a folder.
fn program(home: &TempDir, temporary: &Path) -> Command {
    let mut command = Command::new(std::env::current_exe().unwrap());
    let itself = "readers::nastran95_process::the_program_prints_a_case";
    command
        .args(["--ignored", "--exact", "--nocapture", itself])
        .env("NASTRAN95", home.path())
        .env("TMPDIR", temporary)
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    command
}

/// The error that a program ended with, whose status was 2.
fn error_of(output: Output) -> String {
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        !output.status.success() && stderr.contains("left: 2"),
        "{stderr}"
    );
    let line = stderr
        .lines()
        .find_map(|line| line.strip_prefix("nastran95: "));
    line.unwrap_or_else(|| panic!("{stderr}")).to_owned()
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
    ] {
        let temporary = new_folder();
        let output = program(&fake(script), temporary.path()).output();
        let output = output.unwrap();
        let error = error_of(output);
        assert!(
            error.starts_with("NASTRAN-95") && error.contains(message),
            "{script}: {error}"
        );
        assert_eq!(entries(temporary.path()), 0, "{script}");
    }
}

#[test]
fn a_signal_ends_the_solver_and_then_the_program_and_leaves_nothing() {
    for signal in [Signal::INT, Signal::TERM] {
        let temporary = new_folder();
        let home = fake("touch started; sleep 60");
        let mut child = program(&home, temporary.path());
        let child = child.spawn().unwrap();
        let started = || {
            let folders = fs::read_dir(temporary.path()).unwrap();
            let mut folders = folders.flatten();
            folders.any(|folder| folder.path().join("started").exists())
        };
        let limit = Instant::now() + Duration::from_secs(20);
        while !started() && Instant::now() < limit {
            std::thread::sleep(Duration::from_millis(20));
        }
        send(&child, signal);
        let ended = child.wait_with_output().unwrap();
        assert_eq!(error_of(ended), "NASTRAN-95 was stopped by request");
        assert_eq!(entries(temporary.path()), 0, "{signal:?}");
    }
}
