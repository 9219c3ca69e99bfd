//! Why elements and not matrices, as tables.

use super::correlation_tables::{HERTZ, PERCENT, RMS_PERCENT, column, kind_letter, number};
use super::table::{Cell, Digits, Row, Table};
use crate::cases::Case;
use crate::studies::matrix_comparison::{COVER_DOUBLER, MatrixComparison, Prediction, TRUTH};

const FACTOR: Digits = Digits::Fixed(3);

/// All tables of a comparison: frequencies, what is left of the error, the stiffness entry by entry, the factors.
pub fn matrix_tables(case: &Case, comparison: &MatrixComparison) -> Vec<Table> {
    let as_tested = &comparison.as_tested_hz;
    let after_change = &comparison.after_change_hz;
    let mut changed = frequency_table(comparison, "after a change", after_change, |p| &p.after_change);
    changed.notes.push(format!(
        "The change: every cover thicker by {COVER_DOUBLER:.3} in, which no test has seen. The model corrected by elements is analyzed anew; to the corrected matrices the change of the uncorrected model's stiffness is added."
    ));
    let mut tables = vec![
        frequency_table(comparison, "as tested", as_tested, |p| &p.as_tested),
        changed,
        distance_table(comparison),
    ];
    for prediction in comparison.predictions.iter().skip(1) {
        tables.push(entry_table(comparison, prediction, "stiffness", &prediction.stiffness_change));
    }
    if let Some(last) = comparison.predictions.last() {
        tables.push(entry_table(comparison, last, "mass", &last.mass_change));
    }
    tables.push(factor_table(case, comparison));
    tables
}

/// A number that the paper does not print.
fn plain(value: f64, digits: Digits) -> Cell {
    number(value, digits, None, "", "")
}

/// Who predicts: everything but the truth.
fn predictors(comparison: &MatrixComparison) -> impl Iterator<Item = &Prediction> {
    let is_predictor = |prediction: &&Prediction| prediction.model != TRUTH;
    comparison.predictions.iter().filter(is_predictor)
}

/// True frequencies in one state of the box, and every model's errors.
fn frequency_table(
    comparison: &MatrixComparison,
    state: &str,
    truth: &[f64],
    errors: fn(&Prediction) -> &[f64],
) -> Table {
    let row = |label: &str, truth: Cell, value: &dyn Fn(&Prediction) -> f64, digits| {
        let percents = predictors(comparison).map(|p| plain(100.0 * value(p), digits));
        Row { label: label.to_owned(), cells: std::iter::once(truth).chain(percents).collect() }
    };
    let mut rows: Vec<Row> = truth
        .iter()
        .enumerate()
        .map(|(mode, &frequency)| {
            let label = (mode + 1).to_string();
            row(&label, plain(frequency, HERTZ), &|p| errors(p)[mode], PERCENT)
        })
        .collect();
    let fitted = comparison.test_modes;
    for (label, modes) in [("RMS test modes", 0..fitted), ("RMS others", fitted..truth.len())] {
        if !modes.is_empty() {
            let value = |p: &Prediction| rms(&errors(p)[modes.clone()]);
            rows.push(row(label, Cell::Blank, &value, RMS_PERCENT));
        }
    }
    let names = predictors(comparison).map(|p| column(p.model, "%"));
    Table {
        name: format!("matrix_frequencies_{}", state.replace(' ', "_")),
        title: format!("Case {}, {fitted} test modes: errors of the models' frequencies, {state}", comparison.case),
        label_heading: "Mode",
        columns: std::iter::once(column("Truth", "Hz")).chain(names).collect(),
        rows,
        notes: Vec::new(),
    }
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

fn distance_table(comparison: &MatrixComparison) -> Table {
    let row = |prediction: &Prediction| {
        let mut coupling = 0.0_f64;
        for (i, entries) in prediction.mass_change.iter().enumerate() {
            for (j, entry) in entries.iter().enumerate() {
                if i != j {
                    coupling = coupling.max(entry.abs());
                }
            }
        }
        let percents = [prediction.distance_left, prediction.beyond_elements, coupling];
        Row {
            label: prediction.model.to_owned(),
            cells: percents.map(|value| plain(100.0 * value, RMS_PERCENT)).to_vec(),
        }
    };
    Table {
        name: "matrix_distance".to_owned(),
        title: format!("Case {}: distance of the stiffness from the true one", comparison.case),
        label_heading: "Model",
        columns: vec![
            column("Left", "%"),
            column("Beyond elements", "%"),
            column("Mass coupling", "%"),
        ],
        rows: comparison.predictions.iter().map(row).collect(),
        notes: vec![
            "Left: what separates the stiffness from the true one, in the norm that the matrix corrections make smallest, of what did at the start. Beyond elements: the part of the change that no factors on the elements could make. Mass coupling: largest mass put between two points that had none between them.".to_owned(),
        ],
    }
}

fn entry_table(comparison: &MatrixComparison, prediction: &Prediction, what: &str, change: &[Vec<f64>]) -> Table {
    let row = |(i, entries): (usize, &Vec<f64>)| Row {
        label: (i + 1).to_string(),
        cells: entries.iter().map(|entry| plain(100.0 * entry, RMS_PERCENT)).collect(),
    };
    let model = prediction.model;
    Table {
        name: format!("{what}_change_{}", model.replace(' ', "_").to_lowercase()),
        title: format!("Case {}: change of the {what} entry by entry, {model}", comparison.case),
        label_heading: "DOF",
        columns: (1..=change.len()).map(|j| column(&j.to_string(), "%")).collect(),
        rows: change.iter().enumerate().map(row).collect(),
        notes: Vec::new(),
    }
}

fn factor_table(case: &Case, comparison: &MatrixComparison) -> Table {
    let rows = comparison.factors.iter().zip(&case.panels).map(|(factor, panel)| Row {
        label: factor.element.to_string(),
        cells: std::iter::once(Cell::Text(kind_letter(panel.kind).to_owned()))
            .chain([factor.truth, factor.found, factor.nearest_to_baruch].map(|value| plain(value, FACTOR)))
            .collect(),
    });
    Table {
        name: "matrix_factors".to_owned(),
        title: format!("Case {}: factors on the elements", comparison.case),
        label_heading: "Element",
        columns: vec![column("Type", ""), column("True", ""), column("Found", ""), column("Nearest to Baruch", "")],
        rows: rows.collect(),
        notes: vec!["Nearest to Baruch: the factors whose change of stiffness comes nearest to Baruch's.".to_owned()],
    }
}
