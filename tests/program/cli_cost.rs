//! `corfem cost`, from outside.

use assert_cmd::Command;
use serde_json::Value;

fn corfem(arguments: &[&str]) -> (Option<i32>, String) {
    let mut program = Command::cargo_bin("corfem").expect("the program is built");
    let done = program.arg("cost").args(arguments).output().expect("it starts");
    (done.status.code(), String::from_utf8(done.stdout).expect("UTF-8"))
}

#[test]
fn eigensolutions_to_one_error_and_steps_by_formula() {
    let (code, json) = corfem(&["--error", "5", "--format", "json"]);
    assert_eq!(code, Some(0));
    let json: Value = serde_json::from_str(&json).expect("JSON");
    let tables = json["tables"].as_array().expect("tables");
    let names: Vec<&Value> = tables.iter().map(|table| &table["name"]).collect();
    assert_eq!(names, ["eigensolutions", "linearization", "linearization_new"]);
    let labels = tables[0]["rows"].as_array().expect("rows").iter().map(|row| row["label"].as_str().expect("a label"));
    assert_eq!(
        labels.collect::<Vec<_>>(),
        ["Case 1, 5 %", "Case 2, 5 %", "Case 3, 5 %", "Delta wing, 5 %", "Wing, 5 %"]
    );
}

#[test]
fn an_error_of_nothing_is_refused() {
    for error in ["0", "nan", "five"] {
        assert_eq!(corfem(&["--error", error]), (Some(2), String::new()), "{error}");
    }
}
