//! The delta wing's report: tables, goldens, and the command from outside.

use crate::common::golden::{Numbers, assert_golden};
use crate::common::tolerances::ROUND_OFF;
use approx::assert_relative_eq;
use assert_cmd::Command;
use corfem::method::inner_loop::Stop;
use corfem::method::model::Check;
use corfem::present::render::{csv, markdown, text};
use corfem::present::table::{Cell, Table};
use corfem::present::tables::delta_wing::delta_wing_tables;
use corfem::studies::delta_wing::correlation::{
    GROUPS, TEST_MODES, WingCorrelation, correlate_wing,
};
use corfem::studies::delta_wing::{DeltaWing, TipLoad};
use serde_json::Value;
use std::sync::LazyLock;

static RUN: LazyLock<WingCorrelation> =
    LazyLock::new(|| correlate_wing(&wing(), |_, _| {}).expect("it runs"));

fn wing() -> DeltaWing {
    DeltaWing::embedded().expect("the wing")
}

fn tables() -> Vec<Table> {
    delta_wing_tables(&wing(), &RUN).expect("tables")
}

#[test]
fn wing_as_tables() {
    let tables = tables();
    let names: Vec<(&str, usize, usize)> = tables
        .iter()
        .map(|table| (table.name.as_str(), table.rows.len(), table.columns.len()))
        .collect();
    assert_eq!(
        names,
        [
            ("delta_wing_deflections_te", 9, 7),
            ("delta_wing_deflections_le", 9, 5),
            ("delta_wing_frequencies", 3, 5),
            ("delta_wing_groups", 21, 5),
            ("delta_wing_modes", 12, 12),
            ("delta_wing_passes", 3, 4),
        ]
    );
    let numbers = Numbers::BY_UNIT;
    let rounded = Numbers::AS_WRITTEN;
    assert_golden("delta_wing", &csv(&tables), numbers);
    assert_golden("delta_wing_text", &text(&tables), rounded);
}

fn corfem(arguments: &[&str]) -> Vec<u8> {
    let done = Command::cargo_bin("corfem")
        .expect("the program is built")
        .arg("delta-wing")
        .args(arguments)
        .output()
        .expect("it starts");
    assert_eq!(done.status.code(), Some(0));
    assert!(done.stderr.is_empty());
    done.stdout
}

#[test]
fn command_writes_every_format() {
    let expect = |text: String| text.into_bytes();
    assert_eq!(corfem(&[]), expect(text(&tables())));
    assert_eq!(
        corfem(&["--format", "markdown"]),
        expect(markdown(&tables()))
    );
    let numbers = csv(&tables());
    assert_eq!(corfem(&["--format", "csv"]), expect(numbers.clone()));
    assert!(numbers.lines().all(|line| line.split(',').count() == 6));
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("wing.json");
    let name = file.to_str().expect("a name");
    assert!(corfem(&["--format", "json", "--output", name]).is_empty());
    let json: Value =
        serde_json::from_slice(&std::fs::read(&file).expect("written")).expect("JSON");
    let correlation = &json["correlation"];
    assert_eq!(
        (
            &json["program"],
            &json["version"],
            &correlation["converged"]
        ),
        (
            &"corfem".into(),
            &env!("CARGO_PKG_VERSION").into(),
            &true.into()
        )
    );
    for (key, count) in [
        ("measured_grids", 9),
        ("trailing_edge_load_deflections_in", 9),
        ("leading_edge_load_deflections_in", 9),
        ("frequencies_hz", 86),
        ("groups", 21),
        ("test_modes", 10),
    ] {
        assert_eq!(json[key].as_array().map(Vec::len), Some(count), "{key}");
    }
    for (key, count) in [
        ("parameters", 21),
        ("test_frequencies_hz", 10),
        ("passes", 3),
    ] {
        assert_eq!(
            correlation[key].as_array().map(Vec::len),
            Some(count),
            "{key}"
        );
    }
    for (key, load) in [
        ("trailing_edge_load_deflections_in", TipLoad::TrailingEdge),
        ("leading_edge_load_deflections_in", TipLoad::LeadingEdge),
    ] {
        assert_numbers(&json[key], &wing().deflections(load).expect("deflections"));
    }
    let run = &*RUN;
    let whole = wing().modes().expect("modes").modes;
    assert_numbers(&json["frequencies_hz"], &whole.frequencies_hz());
    assert_numbers(
        &correlation["test_frequencies_hz"],
        &run.test.frequencies_hz(),
    );
    assert_eq!(json["test_modes"], Value::from(TEST_MODES.to_vec()));
    let documents = json["groups"].as_array().expect("a list");
    let factors = &run.correlation.best_factors;
    for (((document, group), factor), share) in
        documents.iter().zip(GROUPS).zip(factors).zip(&run.shares)
    {
        assert_eq!(document["name"], group.name);
        assert_eq!(document["elements"], Value::from(group.elements.to_vec()));
        for (key, value) in [
            ("true_factor", group.true_factor()),
            ("factor", *factor),
            ("largest_share", *share),
        ] {
            assert_numbers(&Value::from(vec![document[key].clone()]), &[value]);
        }
    }
    assert_check(&correlation["initial"], &run.correlation.initial);
    let documents = correlation["passes"].as_array().expect("a list");
    for (document, pass) in documents.iter().zip(&run.correlation.passes) {
        let iterations = &pass.inner.iterations;
        let sums: Vec<f64> = iterations.iter().map(|step| step.errors.sum()).collect();
        assert_eq!(document["iterations"], iterations.len());
        assert_eq!(document["stop"], "tolerance");
        let history = document["history"].as_array().expect("a list");
        let written = history.iter().map(|step| step["error_sum"].clone());
        assert_numbers(&written.collect(), &sums);
        assert_numbers(&document["factors"], &pass.factors);
        assert_check(&document["exact"], &pass.check);
    }
}

/// Reading a number from JSON may cost its last bit.
fn assert_numbers(document: &Value, expected: &[f64]) {
    let found = document.as_array().expect("a list").iter();
    let found: Vec<f64> = found.map(|n| n.as_f64().expect("a number")).collect();
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_relative_eq!(*found, *expected, max_relative = ROUND_OFF);
    }
}

fn assert_check(document: &Value, check: &Check) {
    assert_numbers(&document["frequencies_hz"], &check.frequencies_hz);
    let rms = ["frequency_rms", "shape_rms"].map(|key| document[key].clone());
    let expected = [check.errors.frequency_rms(), check.errors.shape_rms()];
    assert_numbers(&Value::from(rms.to_vec()), &expected);
}

#[test]
fn why_a_pass_stopped_is_said_in_words() {
    let mut run = RUN.clone();
    run.correlation.passes[0].inner.stop = Stop::LocalMinimum;
    run.correlation.passes[1].inner.stop = Stop::Iterations;
    let tables = delta_wing_tables(&wing(), &run).expect("tables");
    let passes = tables.iter().find(|table| table.name.contains("passes"));
    let said: Vec<&Cell> = passes
        .expect("a table of passes")
        .rows
        .iter()
        .map(|row| &row.cells[1])
        .collect();
    let word = |word: &str| Cell::Text(word.to_owned());
    assert_eq!(
        said,
        [
            &word("local minimum"),
            &word("iterations"),
            &word("tolerance")
        ]
    );
}
