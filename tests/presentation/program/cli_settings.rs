//! Settings of the loops from the command line: what is typed is what is run, and is said in the report.

use crate::prelude::*;
use crate::presentation::program::cli::parsed;

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
fn fewer_modes_takes_them_too() {
    let runs = parsed(&["fewer-modes", "--format", "json", "--rule", "own"]);
    let counts = runs["runs"]
        .as_array()
        .expect("runs")
        .iter()
        .map(|run| run["iterations"].as_u64());
    assert!(counts.max() < Some(Some(30)));
}
