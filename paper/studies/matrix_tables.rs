//! Why elements and not matrices, as tables.

use super::matrix_comparison::{COVER_DOUBLER, ElementFactor, MatrixComparison, Prediction, TRUTH};
use super::{HERTZ, PERCENT, RMS_PERCENT};
use crate::prelude::*;

/// All tables of a comparison: what the models know, the factors they stand for, and the changes entry by entry.
pub fn matrix_tables(case: &Case, comparison: &MatrixComparison) -> Vec<Table> {
    let mut tables = knowledge_tables(comparison);
    let (models, last) = (
        comparison.predictions.iter().skip(1),
        comparison.predictions.last(),
    );
    tables.extend(models.map(|p| entry_table(comparison, p, "stiffness", &p.stiffness_change)));
    tables.extend(last.map(|p| entry_table(comparison, p, "mass", &p.mass_change)));
    tables.push(factor_table(case, comparison));
    tables
}

/// Frequencies as tested and after a change, and what is left of the error.
pub fn knowledge_tables(comparison: &MatrixComparison) -> Vec<Table> {
    let note = format!(
        "The change: every cover thicker by {COVER_DOUBLER:.3} in, which no test has seen. The model corrected by elements is \
        analyzed anew; to the corrected matrices the change of the uncorrected model's stiffness is added."
    );
    vec![
        frequency_table(comparison, "as tested", &comparison.as_tested_hz, |p| {
            &p.as_tested
        }),
        frequency_table(
            comparison,
            "after a change",
            &comparison.after_change_hz,
            |p| &p.after_change,
        )
        .notes([note]),
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
    let title =
        format!("Case {case}, {fitted} test modes: errors of the models' frequencies, {state}");
    let rms_of = [
        ("RMS test modes", 0..fitted),
        ("RMS others", fitted..truth.len()),
    ];
    let rms_of = rms_of.iter().filter(|(_, modes)| !modes.is_empty());
    let mut table = Table::new(name, title, "Mode")
        .labels(1..=truth.len())
        .labels(rms_of.clone().map(|(label, _)| label))
        .column("Truth", "Hz", numbers(truth.iter().copied(), HERTZ));
    for prediction in comparison
        .predictions
        .iter()
        .filter(|prediction| prediction.model != TRUTH)
    {
        let errors = errors(prediction);
        let rms = rms_of.clone().map(|(_, modes)| rms(&errors[modes.clone()]));
        let cells = percents(errors.iter().copied(), PERCENT).chain(percents(rms, RMS_PERCENT));
        table = table.column(prediction.model, "%", cells);
    }
    table
}

fn distance_table(comparison: &MatrixComparison) -> Table {
    let title = format!(
        "Case {}: distance of the stiffness from the true one",
        comparison.case
    );
    let note = "Left: what separates the stiffness from the true one, in the norm that the matrix corrections make smallest, of \
        what did at the start. Beyond elements: the part of the change that no factors on the elements could make. Mass \
        coupling: largest mass put between two points that had none between them.";
    let mut table = Table::new("matrix_distance", title, "Model")
        .headings(["Left", "Beyond elements", "Mass coupling"], "%")
        .notes([note]);
    for prediction in &comparison.predictions {
        let change = &prediction.mass_change;
        let below = (0..change.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let coupling = below
            .map(|(i, j)| change[i][j].abs().max(change[j][i].abs()))
            .fold(0.0, f64::max);
        let distances = [
            prediction.distance_left,
            prediction.beyond_elements,
            coupling,
        ];
        table.row(prediction.model, percents(distances, RMS_PERCENT));
    }
    table
}

fn entry_table(
    comparison: &MatrixComparison,
    prediction: &Prediction,
    what: &str,
    change: &[Vec<f64>],
) -> Table {
    let (case, model) = (comparison.case, prediction.model);
    let name = format!("{what}_change_{}", model.replace(' ', "_").to_lowercase());
    let title = format!("Case {case}: change of the {what} entry by entry, {model}");
    let mut table =
        Table::new(name, title, "DOF").headings((1..=change.len()).map(|j| j.to_string()), "%");
    for (i, entries) in change.iter().enumerate() {
        table.row(i + 1, percents(entries.iter().copied(), RMS_PERCENT));
    }
    table
}

/// The factors on the elements: true, found, and those nearest to a corrected matrix.
pub fn factor_table(case: &Case, comparison: &MatrixComparison) -> Table {
    let title = format!("Case {}: factors on the elements", comparison.case);
    let factors = |of: fn(&ElementFactor) -> f64| {
        numbers(comparison.factors.iter().map(of), Digits::Fixed(3))
    };
    Table::new("matrix_factors", title, "Element")
        .labels(comparison.factors.iter().map(|factor| factor.element))
        .column(
            "Type",
            "",
            case.panels.iter().map(|panel| {
                Cell::text(if panel.kind == ElementKind::Membrane {
                    "M"
                } else {
                    "S"
                })
            }),
        )
        .column("True", "", factors(|factor| factor.truth))
        .column("Found", "", factors(|factor| factor.found))
        .column(
            "Nearest to Baruch",
            "",
            factors(|factor| factor.nearest_to_baruch),
        )
        .notes([
            "Nearest to Baruch: the factors whose change of stiffness comes nearest to Baruch's.",
        ])
}
