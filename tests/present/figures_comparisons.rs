//! The data of the figures of fewer modes and of matrix corrections are what their tables say.

use crate::common::tolerances::ROUND_OFF;
use crate::present::figures::{comparison, fewer_modes_runs};
use approx::assert_relative_eq;
use corfem::present::figures::comparisons::{predictions, stiffness_changes, truncation};
use corfem::present::table::{Cell, Table};
use corfem::present::tables::fewer_modes::truncation_tables;
use corfem::present::tables::matrices::matrix_tables;
use corfem::studies::matrix_comparison::{MatrixComparison, USUAL_CASE, USUAL_TEST_MODES};
use corfem::torque_box::Case;
use corfem::torque_box::fewer_modes::FewerModesRun;

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
        Cell::Text(text) | Cell::Printed(text) => panic!("no number: {text}"),
    }
}

#[test]
fn stiffness_changes_are_those_of_the_tables() {
    let maps = stiffness_changes(comparison());
    let names: Vec<&str> = maps.iter().map(|map| map.title.as_str()).collect();
    assert_eq!(
        names,
        ["Truth", "Element factors", "Baruch", "Berman and Nagy"]
    );
    let tables = matrix_tables(&Case::new(USUAL_CASE).expect("a case"), comparison());
    for map in &maps {
        let name = map.title.to_lowercase().replace(' ', "_");
        let table = named(&tables, &format!("stiffness_change_{name}"));
        assert_eq!((map.values.shape(), map.full), ((9, 9), maps[0].full));
        for (i, row) in table.rows.iter().enumerate() {
            for (j, cell) in row.cells.iter().enumerate() {
                let percent = number(cell).expect("all cells are full");
                let drawn = 100.0 * map.values[(i, j)].expect("a cell");
                assert_relative_eq!(drawn, percent, max_relative = ROUND_OFF);
            }
        }
    }
    // What the figure is there for: the right change is large on the whole diagonal, and one of the two finds it.
    let entry = |model: usize, i: usize| maps[model].values[(i, i)].expect("a cell");
    let apart = |model: usize| {
        let each = (0..9).map(|i| (entry(model, i) - entry(0, i)).abs());
        each.fold(0.0, f64::max)
    };
    assert!(apart(1) < 0.03);
    assert!(apart(2) > 0.29);
}

#[test]
fn predictions_are_the_frequency_errors_of_the_tables() {
    let figure = predictions(comparison());
    let tables = matrix_tables(&Case::new(USUAL_CASE).expect("a case"), comparison());
    for (chart, name) in figure.charts.iter().zip([
        "matrix_frequencies_as_tested",
        "matrix_frequencies_after_a_change",
    ]) {
        let table = named(&tables, name);
        let names: Vec<&str> = chart.series.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(
            names,
            ["Initial", "Element factors", "Baruch", "Berman and Nagy"]
        );
        assert_eq!(
            (chart.groups.len(), chart.divided.map(|d| d.0)),
            (9, Some(USUAL_TEST_MODES))
        );
        for series in &chart.series {
            let at = table.columns.iter().position(|c| c.name == series.name);
            let at = at.expect("the model's column");
            assert_eq!(series.values.len(), 9);
            for ((drawn, published), row) in series.values.iter().zip(&table.rows) {
                let percent = number(&row.cells[at]).expect("all modes are there");
                assert_relative_eq!(*drawn, percent, max_relative = ROUND_OFF);
                assert_eq!(*published, None);
            }
        }
    }
}

#[test]
fn predictions_are_drawn_for_errors_of_any_size_and_for_no_others() {
    let drawn = |comparison: &MatrixComparison| {
        let figure = predictions(comparison);
        figure.draw("errors", "errors").expect("drawn")
    };
    let words = |svg: &str| -> Vec<String> {
        let written = crate::common::drawings::written(svg);
        written.into_iter().map(|word| word.text).collect()
    };
    // Numbers of the vertical axis stand left of the charts; each of the two has the same.
    let ticks = |svg: &str| -> Vec<f64> {
        let written = crate::common::drawings::written(svg).into_iter();
        let left = written.filter(|word| word.bounds[2] < 66.0);
        let numbers: Vec<f64> = left
            .filter_map(|word| word.text.replace('−', "-").parse().ok())
            .collect();
        let (one, other) = numbers.split_at(numbers.len() / 2);
        assert_eq!(one, other);
        one.to_vec()
    };
    // Two tenths of a percent down to two up, all modes shown: no line between shown and not shown.
    let mut small: MatrixComparison = comparison().clone();
    small.test_modes = 9;
    for prediction in &mut small.predictions {
        prediction.as_tested = vec![-0.002; 9];
        prediction.after_change = vec![0.02; 9];
    }
    let svg = drawn(&small);
    let found = ticks(&svg);
    assert!((3..=8).contains(&found.len()), "{found:?}");
    assert!(found.iter().all(|tick| (-0.4..2.2).contains(tick)) && found.contains(&0.0));
    assert!(
        !words(&svg)
            .iter()
            .any(|word| word == "not shown to any model")
    );
    assert!(
        words(&drawn(comparison()))
            .iter()
            .any(|word| word == "not shown to any model")
    );
    // As far down as up.
    for prediction in &mut small.predictions {
        prediction.as_tested.fill(-0.02);
    }
    let found = ticks(&drawn(&small));
    assert!(found.iter().any(|tick| *tick <= -1.0) && found.iter().any(|tick| *tick >= 1.0));
    // Errors of zero still have an axis.
    for prediction in &mut small.predictions {
        prediction.as_tested.fill(0.0);
        prediction.after_change.fill(0.0);
    }
    let svg = drawn(&small);
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    assert!(!ticks(&svg).is_empty());
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
    let runs: Vec<FewerModesRun> = fewer_modes_runs()
        .iter()
        .filter(|run| (run.test_modes, run.analysis_modes) != (2, 3))
        .cloned()
        .collect();
    assert_eq!(truncation(&runs)[0].values[(1, 2)], None);
    assert!(truncation(&[])[0].values.is_empty());
}
