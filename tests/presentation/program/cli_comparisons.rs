//! The program's comparison from outside: fewer modes.

use crate::presentation::program::cli::corfem;
use serde_json::Value;

#[test]
fn every_run_with_fewer_modes_has_its_iterations() {
    let json: Value =
        serde_json::from_slice(&corfem(&["fewer-modes", "--format", "json"]).stdout).expect("JSON");
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
