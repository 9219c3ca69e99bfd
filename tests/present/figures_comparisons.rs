//! The data of the figures of fewer modes and of matrix corrections are what their tables say.

use crate::common::tolerances::ROUND_OFF;
use crate::present::figures::{comparison, fewer_modes_runs};
use approx::assert_relative_eq;
use corfem::cases::Case;
use corfem::cases::fewer_modes::{FewerModesRun, PUBLISHED_CASE};
use corfem::present::figures::predictions::predictions;
use corfem::present::figures::stiffness_change::stiffness_change;
use corfem::present::figures::truncation::truncation;
use corfem::present::report::matrix_tables::matrix_tables;
use corfem::present::report::table::{Cell, Table};
use corfem::present::report::truncation_tables::truncation_tables;
use corfem::studies::matrix_comparison::{MatrixComparison, USUAL_CASE, USUAL_TEST_MODES};

fn named<'a>(tables: &'a [Table], name: &str) -> &'a Table {
    tables.iter().find(|table| table.name == name).expect("the table")
}

/// A table's number; nothing for a blank cell.
fn number(cell: &Cell) -> Option<f64> {
    match cell {
        Cell::Number { computed, .. } => Some(*computed),
        Cell::Blank => None,
        Cell::Text(text) => panic!("no number: {text}"),
    }
}

#[test]
fn stiffness_changes_are_those_of_the_tables() {
    let data = stiffness_change(comparison());
    assert_eq!((data.case, data.test_modes), (USUAL_CASE, USUAL_TEST_MODES));
    let names: Vec<&str> = data.models.iter().map(|m| m.model.as_str()).collect();
    assert_eq!(names, ["Truth", "Element factors", "Baruch", "Berman and Nagy"]);
    let tables = matrix_tables(&Case::new(USUAL_CASE).expect("a case"), comparison());
    for model in &data.models {
        let name = model.model.to_lowercase().replace(' ', "_");
        let table = named(&tables, &format!("stiffness_change_{name}"));
        assert_eq!(model.entries.shape(), (9, 9));
        for (i, row) in table.rows.iter().enumerate() {
            for (j, cell) in row.cells.iter().enumerate() {
                let percent = number(cell).expect("all cells are full");
                let drawn = 100.0 * model.entries[(i, j)];
                assert_relative_eq!(drawn, percent, max_relative = ROUND_OFF);
            }
        }
    }
    // What the figure is there for: the right change is large on the whole diagonal, and one of the two finds it.
    let diagonal = |model: usize| data.models[model].entries.diagonal();
    assert!((diagonal(1) - diagonal(0)).amax() < 0.03);
    assert!((diagonal(2) - diagonal(0)).amax() > 0.29);
}

#[test]
fn predictions_are_the_frequency_errors_of_the_tables() {
    let data = predictions(comparison());
    assert_eq!((data.case, data.test_modes), (USUAL_CASE, USUAL_TEST_MODES));
    let tables = matrix_tables(&Case::new(USUAL_CASE).expect("a case"), comparison());
    let names: Vec<&str> = data.models.iter().map(|m| m.model.as_str()).collect();
    assert_eq!(names, ["Initial", "Element factors", "Baruch", "Berman and Nagy"]);
    for (state, name) in ["matrix_frequencies_as_tested", "matrix_frequencies_after_a_change"].into_iter().enumerate() {
        let table = named(&tables, name);
        for model in &data.models {
            let at = table.columns.iter().position(|c| c.name == model.model);
            let at = at.expect("the model's column");
            let errors = [&model.as_tested, &model.after_change][state];
            assert_eq!(errors.len(), 9);
            for (error, row) in errors.iter().zip(&table.rows) {
                let percent = number(&row.cells[at]).expect("all modes are there");
                assert_relative_eq!(100.0 * error, percent, max_relative = ROUND_OFF);
            }
        }
    }
}

#[test]
fn predictions_are_drawn_for_errors_of_any_size_and_for_no_others() {
    // Two tenths of a percent down to three up, all modes shown: steps of 0.5, no line between shown and not shown.
    let mut small: MatrixComparison = comparison().clone();
    small.test_modes = 9;
    for prediction in &mut small.predictions {
        prediction.as_tested = vec![-0.002; 9];
        prediction.after_change = vec![0.02; 9];
    }
    let drawn = predictions(&small).draw().expect("drawn");
    let words: Vec<String> = crate::common::drawings::written(&drawn).into_iter().map(|word| word.text).collect();
    let ticks: Vec<&str> = words
        .iter()
        .map(String::as_str)
        .filter(|word| word.replace('−', "-").parse::<f64>().is_ok() && word.contains('.'))
        .collect();
    assert_eq!(ticks, ["0.0", "0.5", "1.0", "1.5", "2.0"].repeat(2));
    assert!(!words.iter().any(|word| word == "not shown to any model"));
    // As far down as up, and no line beyond the bars.
    for prediction in &mut small.predictions {
        prediction.as_tested.fill(-0.02);
    }
    let drawn = predictions(&small).draw().expect("drawn");
    let words = crate::common::drawings::written(&drawn);
    let ticks: Vec<&str> =
        words.iter().map(|word| word.text.as_str()).filter(|word| word.contains('−') || *word == "0").collect();
    assert_eq!(ticks, ["−2", "−1", "0"].repeat(2));
    assert!(!words.iter().any(|word| word.text == "10"));
    // Errors of zero still have an axis.
    for prediction in &mut small.predictions {
        prediction.as_tested.fill(0.0);
        prediction.after_change.fill(0.0);
    }
    let drawn = predictions(&small).draw().expect("drawn");
    assert!(!drawn.contains("NaN") && !drawn.contains("inf"));
}

#[test]
fn truncation_costs_are_those_of_the_tables() {
    let data = truncation(PUBLISHED_CASE, fewer_modes_runs());
    assert_eq!((data.case, data.costs.len()), (2, 4));
    let tables = truncation_tables(fewer_modes_runs());
    for (cost, name) in data.costs.iter().zip(["shear", "membrane", "frequency", "shape"]) {
        let table = named(&tables, &format!("truncation_{name}"));
        assert_eq!(cost.values.shape(), (9, 9));
        for (test, row) in table.rows.iter().enumerate() {
            for (analysis, cell) in row.cells.iter().enumerate() {
                let drawn = cost.values[(test, analysis)];
                assert_eq!(drawn.is_some(), analysis >= test);
                let percent = drawn.map(|value| 100.0 * value);
                assert_eq!(percent, number(cell), "{}", cost.name);
            }
        }
    }
    // A pair that was not run has no cell.
    let runs: Vec<FewerModesRun> =
        fewer_modes_runs().iter().filter(|run| (run.test_modes, run.analysis_modes) != (2, 3)).cloned().collect();
    let data = truncation(PUBLISHED_CASE, &runs);
    assert_eq!(data.costs[0].values[(1, 2)], None);
    assert!(truncation(PUBLISHED_CASE, &[]).costs[0].values.is_empty());
}
