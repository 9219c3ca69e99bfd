//! Settings of the loops from the command line: what is typed is what is run, and is said in the report.

use crate::prelude::*;
use crate::presentation::program::cli::{corfem, parsed, text};

fn settings(arguments: &[&str]) -> Value {
    let arguments = [
        &["cases", "1", "--quiet", "--format", "json", "--passes", "1"],
        arguments,
    ]
    .concat();
    parsed(&arguments)["cases"][0]["settings"].clone()
}

#[test]
fn every_setting_reaches_the_loops() {
    let plain = settings(&[]);
    assert_eq!(plain["inner"]["step"], "own");
    assert_eq!(plain["inner"]["accumulation"], "sum");
    for (arguments, key, value) in [
        (["--rule", "matrix"], "step", json!("matrix")),
        (["--rule", "relative"], "step", json!("relative")),
        (
            ["--accumulation", "product"],
            "accumulation",
            json!("product"),
        ),
        (
            ["--limits", "0.6,1.4"],
            "factor_range",
            json!({"lower": 0.6, "upper": 1.4}),
        ),
        (["--iterations", "3"], "iterations", json!(3)),
    ] {
        let found = settings(&arguments);
        assert_eq!(found["inner"][key], value);
        let mut others = found.clone();
        others["inner"][key] = plain["inner"][key].clone();
        assert_eq!(others, plain, "{key} alone changes");
    }
    let found = settings(&["--relaxation", "0.5,0.9", "--tolerance", "0.03,0.02"]);
    assert_eq!(found["inner"]["first_relaxation"], 0.5);
    assert_eq!(found["inner"]["relaxation"], 0.9);
    assert_eq!(
        (
            &found["inner"]["tolerance"],
            &found["later_inner_tolerance"]
        ),
        (&json!(0.03), &json!(0.02))
    );
    assert_eq!(found["most_passes"], 1);
}

#[test]
fn another_reading_gives_other_gages_and_the_report_says_which() {
    let report = |rule: &str| {
        text(&corfem(&["cases", "2", "--quiet", "--passes", "1", "--rule", rule]).stdout)
    };
    let (relative, matrix) = (report("relative"), report("matrix"));
    assert_ne!(relative, matrix);
    let line = |report: &str, word: &str| {
        report
            .lines()
            .any(|line| line.starts_with("2 ") && line.contains(word))
    };
    assert!(line(&relative, "relative") && line(&matrix, "matrix"));
}

#[test]
fn fewer_modes_takes_them_too() {
    let runs = parsed(&["fewer-modes", "--format", "json", "--rule", "own"]);
    let counts = runs["runs"]
        .as_array()
        .expect("runs")
        .iter()
        .map(|run| run["iterations"].as_u64());
    assert!(counts.max() < Some(Some(30)));
}

#[test]
fn settings_out_of_range_are_refused_by_their_names() {
    for (arguments, said) in [
        (["--rule", "best"], "unknown variant `best`"),
        (
            ["--rule", "sum"],
            "the step rule sum is gone; choose matrix, own, relative or gage",
        ),
        (["--limits", "1.5,0.5"], "--limits"),
        (["--limits", "0.5"], "--limits: 1 x 1 instead of 2 x 1"),
        (
            ["--relaxation", "0,1"],
            "first_relaxation of the inner loop is 0; it must be positive and finite",
        ),
        (
            ["--tolerance", "nan,1"],
            "tolerance of the inner loop is NaN; it must be positive and finite",
        ),
        (["--iterations", "0"], "--iterations"),
    ] {
        let output = corfem(&[&["cases", "1", "--quiet"], &arguments[..]].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(
            text(&output.stderr).contains(said),
            "{}",
            text(&output.stderr)
        );
    }
}
