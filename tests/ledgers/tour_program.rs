//! A program in another language, written from the text of the tour alone, against the cases.

use crate::common::dump::dump;
use crate::prelude::*;
use std::io::Write;

fn python() -> Command {
    let mut command = Command::new("python3");
    command
        .arg("golden/tour/method.py")
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")));
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// What the program says of a document; an error where it does not agree with it.
fn compared(document: &str) -> Result<String, String> {
    let mut child = python().spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    // It may end before it has read everything.
    let _ = input.write_all(document.as_bytes());
    drop(input);
    let done = child.wait_with_output().unwrap();
    let words = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    match done.status.success() {
        true => Ok(words(&done.stdout)),
        false => Err(words(&done.stderr)),
    }
}

#[test]
#[ignore = "needs python3 with numpy"]
fn a_program_written_from_the_tour_matches_every_case() {
    for number in 1..=3 {
        let document = dump(&case_of(number)).unwrap();
        let said = compared(&document).unwrap_or_else(|error| panic!("case {number}: {error}"));
        assert!(said.starts_with(&format!("case {number}: ")), "{said}");
        // Another number in the first iteration is noticed.
        let mut other: Value = serde_json::from_str(&document).unwrap();
        let gage = &mut other["passes"][0]["iterations"][0]["factors"][7];
        *gage = (gage.as_f64().unwrap() * (1.0 + 1e-8)).into();
        let said = compared(&other.to_string()).expect_err("a difference");
        assert!(said.contains("pass 1, iteration 1, factors"), "{said}");
    }
}
