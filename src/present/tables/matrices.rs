//! Why elements and not matrices, as tables.

use super::{Cell, Digits, HERTZ, PERCENT, RMS_PERCENT, Table, kind_letter, rms};
use crate::cases::Case;
use crate::studies::matrix_comparison::{COVER_DOUBLER, MatrixComparison, Prediction, TRUTH};

/// All tables of a comparison: what the models know, the factors they stand for, and the changes entry by entry.
pub fn matrix_tables(case: &Case, comparison: &MatrixComparison) -> Vec<Table> {
    let mut tables = knowledge_tables(comparison);
    let (models, last) = (comparison.predictions.iter().skip(1), comparison.predictions.last());
    tables.extend(models.map(|p| entry_table(comparison, p, "stiffness", &p.stiffness_change)));
    tables.extend(last.map(|p| entry_table(comparison, p, "mass", &p.mass_change)));
    tables.push(factor_table(case, comparison));
    tables
}

/// Frequencies as tested and after a change, and what is left of the error.
pub fn knowledge_tables(comparison: &MatrixComparison) -> Vec<Table> {
    let (tested, changed) = (&comparison.as_tested_hz, &comparison.after_change_hz);
    vec![
        frequency_table(comparison, "as tested", tested, |p| &p.as_tested),
        frequency_table(comparison, "after a change", changed, |p| &p.after_change).note(format!(
            "The change: every cover thicker by {COVER_DOUBLER:.3} in, which no test has seen. The model corrected by \
            elements is analyzed anew; to the corrected matrices the change of the uncorrected model's stiffness is \
            added."
        )),
        distance_table(comparison),
    ]
}

/// True frequencies in one state of the box, and every model's errors.
fn frequency_table(
    comparison: &MatrixComparison,
    state: &str,
    truth: &[f64],
    errors: fn(&Prediction) -> &[f64],
) -> Table {
    let (case, fitted) = (comparison.case, comparison.test_modes);
    let name = format!("matrix_frequencies_{}", state.replace(' ', "_"));
    let title = format!("Case {case}, {fitted} test modes: errors of the models' frequencies, {state}");
    let predictors: Vec<&Prediction> = comparison.predictions.iter().filter(|p| p.model != TRUTH).collect();
    let mut table =
        Table::new(name, title, "Mode").column("Truth", "Hz").columns(predictors.iter().map(|p| p.model), "%");
    for (mode, &frequency) in truth.iter().enumerate() {
        let percents = predictors.iter().map(|p| Cell::percent(errors(p)[mode], PERCENT));
        table.row(mode + 1, std::iter::once(Cell::number(frequency, HERTZ)).chain(percents));
    }
    for (label, modes) in [("RMS test modes", 0..fitted), ("RMS others", fitted..truth.len())] {
        if !modes.is_empty() {
            let percents = predictors.iter().map(|p| Cell::percent(rms(&errors(p)[modes.clone()]), RMS_PERCENT));
            table.row(label, std::iter::once(Cell::Blank).chain(percents));
        }
    }
    table
}

fn distance_table(comparison: &MatrixComparison) -> Table {
    let title = format!("Case {}: distance of the stiffness from the true one", comparison.case);
    let mut table =
        Table::new("matrix_distance", title, "Model").columns(["Left", "Beyond elements", "Mass coupling"], "%").note(
            "Left: what separates the stiffness from the true one, in the norm that the matrix corrections make \
        smallest, of what did at the start. Beyond elements: the part of the change that no factors on the elements \
        could make. Mass coupling: largest mass put between two points that had none between them.",
        );
    for prediction in &comparison.predictions {
        let change = &prediction.mass_change;
        let below = (0..change.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let coupling = below.map(|(i, j)| change[i][j].abs().max(change[j][i].abs())).fold(0.0, f64::max);
        let percents = [prediction.distance_left, prediction.beyond_elements, coupling];
        table.row(prediction.model, percents.map(|value| Cell::percent(value, RMS_PERCENT)));
    }
    table
}

fn entry_table(comparison: &MatrixComparison, prediction: &Prediction, what: &str, change: &[Vec<f64>]) -> Table {
    let (case, model) = (comparison.case, prediction.model);
    let name = format!("{what}_change_{}", model.replace(' ', "_").to_lowercase());
    let title = format!("Case {case}: change of the {what} entry by entry, {model}");
    let numbers = (1..=change.len()).map(|j| j.to_string());
    let mut table = Table::new(name, title, "DOF").columns(numbers, "%");
    for (i, entries) in change.iter().enumerate() {
        table.row(i + 1, entries.iter().map(|&entry| Cell::percent(entry, RMS_PERCENT)));
    }
    table
}

/// The factors on the elements: true, found, and those nearest to a corrected matrix.
pub fn factor_table(case: &Case, comparison: &MatrixComparison) -> Table {
    let title = format!("Case {}: factors on the elements", comparison.case);
    let mut table = Table::new("matrix_factors", title, "Element")
        .columns(["Type", "True", "Found", "Nearest to Baruch"], "")
        .note("Nearest to Baruch: the factors whose change of stiffness comes nearest to Baruch's.");
    for (factor, panel) in comparison.factors.iter().zip(&case.panels) {
        let factors = [factor.truth, factor.found, factor.nearest_to_baruch];
        let factors = factors.map(|value| Cell::number(value, Digits::Fixed(3)));
        let kind = Cell::text(kind_letter(panel.kind));
        table.row(factor.element, [kind].into_iter().chain(factors));
    }
    table
}
