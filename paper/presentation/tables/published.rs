//! The paper's own tables, with nothing computed beside them, and Table 1 computed anew, whose numbers are lost.

use super::stages::stage_title;
use super::{in_words, remarks};
use corfem::present::PresentError;
use corfem::present::table::{Cell, Digits, Table, numbers, percents};
use corfem::torque_box::published::PublishedTable;
use corfem::torque_box::table_1::{Formula, TwoMasses, formulae, problems};

/// Ends of column headings, and the units that they stand for.
const UNITS: [(&str, &str); 4] = [
    ("_hz", "Hz"),
    ("_in", "in"),
    ("_percent", "%"),
    ("_seconds", "s"),
];

/// A table from 2 to 13 as printed, with the misprints; Table 13 has the CPU seconds of the paper's runs.
///
/// # Errors
/// A number for which the paper has no table, as in [`PublishedTable::number`].
pub fn published_table(number: usize) -> Result<Table, PresentError> {
    let paper = PublishedTable::number(number)?;
    let labels = paper.labels.iter();
    let mut table = Table::new(format!("published_{number}"), &paper.title, "Row")
        .labels(labels.clone().map(|label| in_words(label)));
    for heading in &paper.headings {
        let unit = UNITS
            .iter()
            .find(|(end, _)| heading.ends_with(end))
            .map_or("", |(_, unit)| unit);
        let cells = labels.clone().map(|label| paper.text(label, heading));
        let cells =
            cells.map(|text| text.map_or(Cell::Blank, |text| Cell::Printed(text.to_owned())));
        table = table.column(stage_title(heading), unit, cells);
    }
    Ok(table.notes(remarks(Some(&paper))))
}

/// Orders of Table 1 that are shown.
const ORDERS: usize = 6;

/// The larger error of the two roots of every problem, in percent, by rule and order.
///
/// The paper's own numbers, and its problems, are lost in the scan, so these have no published numbers.
///
/// # Errors
/// The errors of [`TwoMasses::root_errors`].
pub fn root_error_table() -> Result<Table, PresentError> {
    let problems = problems();
    let title = "Largest root error of two-degree-of-freedom problems (Table 1, computed anew)";
    let note = "Two unit masses on unit springs to the ground, joined by the coupling spring; the first ground spring is changed. \
        Exact roots in closed form. The paper's own numbers are lost in the scan.";
    let springs = |of: fn(&TwoMasses) -> f64| numbers(problems.iter().map(of), Digits::Fixed(2));
    let mut table = Table::new("table_1", title, "Problem")
        .labels(1..=problems.len())
        .column("Coupling", "", springs(|problem| problem.coupling))
        .column("Change", "", springs(|problem| problem.change))
        .notes([note]);
    for rule in formulae(ORDERS) {
        let largest = |problem: &TwoMasses| {
            Ok(problem
                .root_errors(rule)?
                .map(f64::abs)
                .into_iter()
                .fold(0.0, f64::max))
        };
        let errors: Vec<f64> = problems
            .iter()
            .map(largest)
            .collect::<Result<_, PresentError>>()?;
        table = table.column(
            rule_name(rule),
            "%",
            percents(errors, Digits::Scientific(1)),
        );
    }
    Ok(table)
}

fn rule_name(rule: Formula) -> String {
    match rule {
        Formula::FirstOrder => "First order".to_owned(),
        Formula::Original => "Original".to_owned(),
        Formula::Recursive1 { order } => format!("Recursive 1, order {order}"),
        Formula::Recursive2 { order } => format!("Recursive 2, order {order}"),
    }
}
