//! The external solver's process, played by small shell scripts: however a run ends, the error says so and nothing is left.

#![cfg(unix)]

use crate::common::fake_solver::fake;
use crate::common::outer_loop::program::status;
use crate::prelude::*;
use std::process::Output;

fn entries(folder: &Path) -> usize {
    fs::read_dir(folder).unwrap().count()
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
