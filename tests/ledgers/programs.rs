//! Programs of `golden/` that check by themselves, run where their language is.

use crate::common::dump::dump;
use crate::prelude::*;
use std::io::Write;

/// What a program in Python says, given words on its standard input; an error where it refuses them.
fn python(arguments: &[&str], input: &str) -> Result<String, String> {
    let mut command = Command::new("python3");
    command.args(arguments).current_dir(in_root(""));
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // It may end before it has read everything.
    _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    let done = child.wait_with_output().unwrap();
    let words = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    match done.status.success() {
        true => Ok(words(&done.stdout)),
        false => Err(words(&done.stderr)),
    }
}

const PROGRAM: &str = env!("CARGO_BIN_EXE_corfem");

#[test]
#[ignore = "needs python3"]
fn answers_are_marked_by_mistake_and_chapter() {
    python(&["golden/mark_check.py", PROGRAM], "").unwrap();
}

#[test]
#[ignore = "needs python3, and a C compiler of Linux"]
fn cases_and_jobs_are_the_same_under_other_rounding() {
    python(&["golden/rounding/check.py", PROGRAM], "").unwrap();
}

/// It is in another language, and its author read the tour alone.
#[test]
#[ignore = "needs python3 with numpy"]
fn a_program_written_from_the_tour_matches_every_case() {
    for number in 1..=3 {
        let document = dump(&case_of(number)).unwrap();
        let compared = |document: &str| python(&["golden/tour/method.py"], document);
        let said = compared(&document).unwrap();
        assert!(said.starts_with(&format!("case {number}: ")), "{said}");
        // Another number in the first iteration is noticed.
        let mut other: Value = serde_json::from_str(&document).unwrap();
        let gage = &mut other["passes"][0]["iterations"][0]["factors"][7];
        *gage = (gage.as_f64().unwrap() * (1.0 + 1e-8)).into();
        let said = compared(&other.to_string()).expect_err("a difference");
        assert!(said.contains("pass 1, iteration 1, factors"), "{said}");
    }
}

/// The wrapper for Python corrects its own example: the second of two springs was built half as stiff again.
#[test]
#[ignore = "needs Python with numpy"]
fn the_wrapper_for_python_returns_what_the_program_finds() {
    let said = python(&["golden/python/corfem.py", PROGRAM], "").unwrap();
    let numbers = said.split_whitespace().map(|word| word.parse().unwrap());
    let numbers: Vec<f64> = numbers.collect();
    assert_within(numbers[0], 1.0, 1e-3);
    assert_within(numbers[1], 1.5, 1e-3);
    // Factors of drawn tests scatter by the deviations that are told.
    let mut scatter = numbers[3..].iter();
    assert!(scatter.all(|times| (0.5..2.0).contains(times)), "{said}");
}
