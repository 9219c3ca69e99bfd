//! Values beside their targets, from the first model to the last: frequencies or gages, pass by pass.

use super::{HERTZ, INCHES, PERCENT, in_words, kind_letter, remarks};
use corfem::present::table::{Cell, Digits, Table};
use corfem::torque_box::published::PublishedTable;
use corfem::torque_box::wing_box::{PANEL_COUNT, Panel, TEST_GAGE};

/// A state of a model: the beginning of its published columns' names (`initial`, `pass_1`, `fem_5`), its values in the order of the
/// rows, and its errors under these, fractions; those that it does not have are left out.
pub struct ErrorStage {
    pub name: String,
    pub values: Vec<f64>,
    pub errors: Vec<f64>,
}

impl ErrorStage {
    /// The first model, which has the number zero, or the end of a pass or a run.
    pub fn new(what: &str, number: usize, values: &[f64], errors: &[f64]) -> Self {
        let name = if number == 0 {
            "initial".to_owned()
        } else {
            format!("{what}_{number}")
        };
        Self {
            name,
            values: values.to_vec(),
            errors: errors.to_vec(),
        }
    }
}

/// Heading of a stage: `pass_1` is Pass 1.
pub fn stage_title(stage: &str) -> String {
    let words = in_words(stage);
    let (first, rest) = words.split_at(words.len().min(1));
    first.to_uppercase() + rest
}

/// An empty table filled with a column of targets, then two for each stage, its values and their errors, each beside the published
/// one; under these a row for each label of an error with its digits, and the misprints.
///
/// The values are frequencies beside those of a test, or the gages of panels beside those of the test configuration. Published
/// columns are named like the stages with `_hz`, `_in` or `_percent` behind, rows like their labels: `shape_rms`.
pub fn fill(
    table: Table,
    panels: &[Panel],
    test_hz: &[f64],
    stages: &[ErrorStage],
    errors: &[(&str, Digits)],
    paper: Option<&PublishedTable>,
) -> Table {
    let (unit, digits, targets) = match panels {
        [] => ("Hz", HERTZ, test_hz),
        _ => ("in", INCHES, &[TEST_GAGE; PANEL_COUNT][..]),
    };
    let lengths = stages.iter().map(|stage| stage.values.len());
    let count = lengths.max().unwrap_or(0);
    let labels = (0..count).map(|row| {
        panels
            .get(row)
            .map_or(row + 1, |panel| panel.label)
            .to_string()
    });
    let labels: Vec<String> = labels
        .chain(errors.iter().map(|(label, _)| label.to_string()))
        .collect();
    let column = |heading: String, numbers: &dyn Fn(usize) -> (Option<f64>, Digits)| {
        let cell = |(row, label): (usize, &String)| {
            let printed = label
                .trim_start_matches("inner ")
                .replace(' ', "_")
                .to_lowercase();
            let (number, digits) = numbers(row);
            Cell::beside(
                number,
                digits,
                paper.and_then(|paper| paper.value(&printed, &heading)),
            )
        };
        labels.iter().enumerate().map(cell).collect::<Vec<_>>()
    };
    let mut table = table.labels(&labels);
    if !panels.is_empty() {
        let kinds = panels
            .iter()
            .map(|panel| Cell::text(kind_letter(panel.kind)));
        table = table
            .column("Type", "", kinds)
            .notes(["S shear panel, M membrane."]);
    }
    let (target, suffix) = (|row: usize| targets.get(row).copied(), unit.to_lowercase());
    table = table.column(
        "GVT",
        unit,
        column(format!("gvt_{suffix}"), &|row| (target(row), digits)),
    );
    for stage in stages {
        let title = stage_title(&stage.name);
        let value = |row: usize| stage.values.get(row).copied();
        let percent = |row: usize| match row.checked_sub(count) {
            Some(under) => (
                stage.errors.get(under).map(|error| 100.0 * error),
                errors[under].1,
            ),
            None => (
                value(row)
                    .zip(target(row))
                    .map(|(value, target)| 100.0 * (value / target - 1.0)),
                PERCENT,
            ),
        };
        let values = column(format!("{}_{suffix}", stage.name), &|row| {
            (value(row), digits)
        });
        let percents = column(format!("{}_percent", stage.name), &percent);
        table = table
            .column(&title, unit, values)
            .column(title + " error", "%", percents);
    }
    table.notes(remarks(paper))
}
