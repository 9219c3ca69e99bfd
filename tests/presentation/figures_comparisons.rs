//! The data of the figure of fewer modes are what its tables say.

use crate::paper::figures::comparisons::truncation;
use crate::paper::tables::fewer_modes::truncation_tables;
use crate::prelude::*;
use crate::presentation::figures::fewer_modes_runs;

fn named<'a>(tables: &'a [Table], name: &str) -> &'a Table {
    tables
        .iter()
        .find(|table| table.name == name)
        .expect("the table")
}

/// A table's number; nothing for a blank cell.
fn number(cell: &Cell) -> Option<f64> {
    match cell {
        Cell::Number { computed, .. } => Some(*computed),
        Cell::Blank => None,
        Cell::Text(text) | Cell::Sentence(text) | Cell::Printed(text) => {
            panic!("no number: {text}")
        }
    }
}

#[test]
fn truncation_costs_are_those_of_the_tables() {
    let maps = truncation(fewer_modes_runs());
    assert_eq!(maps.len(), 4);
    let tables = truncation_tables(fewer_modes_runs());
    for (cost, name) in maps.iter().zip(["shear", "membrane", "frequency", "shape"]) {
        let table = named(&tables, &format!("truncation_{name}"));
        assert_eq!(cost.values.shape(), (9, 9));
        for (test, row) in table.rows.iter().enumerate() {
            for (analysis, cell) in row.cells.iter().enumerate() {
                let drawn = cost.values[(test, analysis)];
                assert_eq!(drawn.is_some(), analysis >= test);
                let percent = drawn.map(|value| 100.0 * value);
                assert_eq!(percent, number(cell), "{}", cost.title);
            }
        }
    }
    // A pair that was not run has no cell.
    let runs = fewer_modes_runs()
        .iter()
        .filter(|run| (run.test_modes, run.analysis_modes) != (2, 3))
        .cloned()
        .collect_vec();
    assert_eq!(truncation(&runs)[0].values[(1, 2)], None);
    assert!(truncation(&[])[0].values.is_empty());
}
