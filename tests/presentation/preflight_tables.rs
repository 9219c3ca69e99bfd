//! The pre-flight as tables, number by number.

use crate::common::golden::{Numbers, assert_golden};
use crate::evidence::claims::preflight_rates::study;
use crate::evidence::rates::rate_tables;
use corfem::job::preflight::Finding;
use corfem::present::json;
use corfem::present::render::csv;
use corfem::present::table::{Cell, Table};
use corfem::present::tables::preflight::findings_table;

#[test]
fn rates_as_numbers() {
    let tables = rate_tables(study());
    let names: Vec<&str> = tables.iter().map(|table| table.name.as_str()).collect();
    assert_eq!(
        names,
        ["preflight_named", "preflight_told", "preflight_said"]
    );
    for table in &tables {
        assert!(
            table
                .rows
                .iter()
                .all(|row| row.cells.len() == 4 && table.columns.len() == 4),
            "{}",
            table.name
        );
    }
    assert_golden("preflight", &csv(&tables), Numbers::COUNTED);
}

#[test]
fn every_rate_stands_in_its_own_table() {
    let tables = rate_tables(study());
    let cell = |table: &Table, row: &str, column: usize| {
        table
            .rows
            .iter()
            .find(|found| found.label == row)
            .expect("the row")
            .cells[column]
            .clone()
    };
    let two_columns = study()[3]
        .rates
        .iter()
        .find(|rate| rate.named != rate.told)
        .expect("columns like sensors");
    assert_eq!(
        cell(&tables[0], "two columns of T exchanged", 3),
        Cell::count(two_columns.named)
    );
    assert_eq!(
        cell(&tables[1], "two columns of T exchanged", 3),
        Cell::count(two_columns.told)
    );
    assert_eq!(
        cell(&tables[2], "two columns of T exchanged", 3),
        Cell::count(two_columns.said)
    );
    assert_eq!(
        cell(&tables[0], "shapes transposed", 2),
        Cell::Blank,
        "the wing has ten modes at 19 points"
    );
    assert_eq!(
        cell(&tables[0], "none: false alarms", 0),
        Cell::count(study()[0].false_alarms)
    );
    assert_eq!(
        cell(&tables[0], "none: a low pair by noise", 0),
        Cell::count(study()[0].low_pairs)
    );
    assert!(
        tables[0].title.ends_with("of 100 seeds")
            && tables[0].notes[0].contains("1.0 % of its shape's largest")
    );
}

#[test]
fn findings_stand_under_their_structure() {
    let low = |test| Finding::LowPair {
        test,
        analysis: 0,
        cross: 0.5,
    };
    let table = findings_table(&[
        ("a".to_owned(), vec![]),
        ("b".to_owned(), vec![low(0)]),
        ("c".to_owned(), vec![low(1), low(2)]),
    ]);
    let rows: Vec<(&str, String)> = table
        .rows
        .iter()
        .map(|row| (row.label.as_str(), row.cells[0].computed()))
        .collect();
    assert_eq!(rows[0], ("a", "nothing".to_owned()));
    assert_eq!(
        rows[1..].iter().map(|row| row.0).collect::<Vec<_>>(),
        ["b", "c, 1", "c, 2"]
    );
    assert!(rows[3].1.starts_with("Test mode 3 and analysis mode 1"));
}

#[test]
fn findings_as_json_are_those_given() {
    let low = Finding::LowPair {
        test: 1,
        analysis: 0,
        cross: 0.5,
    };
    let found = [
        ("a".to_owned(), vec![]),
        ("b".to_owned(), vec![low.clone()]),
    ];
    let value: serde_json::Value =
        serde_json::from_str(&json::preflight(&found).expect("written")).expect("JSON");
    assert_eq!(
        (
            &value["structures"][0]["name"],
            &value["structures"][1]["name"]
        ),
        (&"a".into(), &"b".into())
    );
    assert_eq!(value["structures"][0]["findings"], serde_json::json!([]));
    assert_eq!(value["structures"][1]["findings"], serde_json::json!([low]));
}
