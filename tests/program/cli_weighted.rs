//! `corfem localize`, `corfem weighted`, and the suspects of a job, from outside.

use assert_cmd::Command;
use serde_json::Value;
use std::path::Path;

fn corfem(arguments: &[&str]) -> String {
    let done = Command::cargo_bin("corfem").expect("the program is built").args(arguments).output().expect("it starts");
    assert!(done.status.success() && done.stderr.is_empty(), "{arguments:?}");
    String::from_utf8(done.stdout).expect("UTF-8")
}

#[test]
fn culprits_in_every_format() {
    let run = |format: &str| corfem(&["localize", "--tests", "1", "--format", format]);
    assert!(run("text").starts_with("One panel 0.01 times as thick"));
    assert!(run("markdown").contains("| Panel | Factor, no noise | Factor first |"));
    assert!(run("csv").contains("\nlocalization_0.5,all,Fit first,,15,\n"));
    let json: Value = serde_json::from_str(&run("json")).expect("JSON");
    let located = json["located"].as_array().expect("a list");
    assert_eq!(located.len(), 60);
    assert_eq!((&located[0]["panel"], &located[0]["by_single_fit"][0]), (&1.into(), &1.into()));
}

#[test]
fn two_rules_and_intervals_in_every_format() {
    let run = |format: &str| corfem(&["weighted", "--tests", "1", "--format", format]);
    let text = run("text");
    assert!(text.starts_with("The paper's rule") && text.contains("over 1 noisy tests"));
    assert!(run("markdown").contains("| Structure | Steps | Analyses | Factor RMS, % |"));
    assert!(run("csv").contains("\ncoverage,Delta wing,Parameters,,21,\n"));
    let json: Value = serde_json::from_str(&run("json")).expect("JSON");
    assert_eq!(json["structures"].as_array().map(Vec::len), Some(4));
    assert_eq!(json["structures"][3][2]["rule"], "gauss_newton");
    assert_eq!(json["coverage"][0]["parameters"].as_array().map(Vec::len), Some(15));
}

#[test]
fn no_tests_are_refused() {
    for command in ["localize", "weighted"] {
        let mut program = Command::cargo_bin("corfem").expect("the program is built");
        let done = program.args([command, "--tests", "0"]).output().expect("it starts");
        assert_eq!((done.status.code(), done.stdout.len()), (Some(2), 0));
    }
}

#[test]
fn a_check_of_a_job_ranks_its_parameters() {
    let job = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/jobs/building/job.toml");
    let job = job.to_str().expect("a name");
    let text = corfem(&["check", job]);
    let suspects = text.split("Suspects: ").nth(1).expect("the table");
    assert!((1..=10).all(|story| suspects.contains(&format!("story {story} "))), "{suspects}");
    let json: Value = serde_json::from_str(&corfem(&["check", job, "--format", "json"])).expect("JSON");
    assert_eq!(
        (&json["tables"][3]["name"], &json["tables"][3]["rows"][0]["label"]),
        (&"suspects".into(), &"story 6".into())
    );
}
