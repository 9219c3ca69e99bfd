//! The program's comparison from outside: fewer modes.

use crate::presentation::program::cli::{corfem, text};
use serde_json::Value;

#[test]
fn fewer_modes_in_every_format() {
    let plain = corfem(&["fewer-modes"]);
    assert_eq!(plain.status.code(), Some(0));
    assert!(plain.stderr.is_empty());
    let report = text(&plain.stdout);
    assert!(report.starts_with("Computed values; the paper's are"));
    for table in [9, 10, 11, 12] {
        assert!(
            report.contains(&format!("(Table {table})")),
            "Table {table}"
        );
    }
    let markdown = text(&corfem(&["fewer-modes", "--format", "markdown"]).stdout);
    assert!(markdown.contains("## Case 2, pass 1, 7 test modes: gages and errors (Table 10)"));
    let numbers = text(&corfem(&["fewer-modes", "--format", "csv"]).stdout);
    assert!(numbers.lines().all(|line| line.split(',').count() == 6));
    assert!(numbers.contains("table_11,shear RMS,FEM 7 error,%,"));
    let json: Value =
        serde_json::from_slice(&corfem(&["fewer-modes", "--format", "json"]).stdout).expect("JSON");
    assert_eq!(
        (&json["program"], &json["version"]),
        (&"corfem".into(), &env!("CARGO_PKG_VERSION").into())
    );
    assert!(json["units"].as_str().expect("units").contains("inch"));
    let runs = json["runs"].as_array().expect("a list");
    assert_eq!(runs.len(), 45);
    for run in runs {
        let iterations = run["iterations"].as_u64().expect("a count") as usize;
        assert_eq!(
            run["inner_error_sums"].as_array().map(Vec::len),
            Some(iterations)
        );
        assert!(
            ["tolerance", "iterations", "local_minimum"]
                .map(Value::from)
                .contains(&run["stop"])
        );
        assert_eq!(run["gages_in"].as_array().map(Vec::len), Some(15));
    }
}

#[test]
fn it_goes_to_a_file_when_asked() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("fewer-modes");
    let done = corfem(&["fewer-modes", "--output", file.to_str().expect("a name")]);
    assert!(done.status.success() && done.stdout.is_empty());
    let written = std::fs::read(&file).expect("written");
    assert_eq!(written, corfem(&["fewer-modes"]).stdout);
}
