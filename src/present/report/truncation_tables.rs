//! Tables over numbers of modes, test modes down and analysis modes across: iterations, and what truncation costs.

use super::correlation_tables::{PERCENT, RMS_PERCENT, number};
use super::fewer_modes_tables::GAGE_TABLES;
use super::table::{Cell, Column, Digits, Row, Table};
use crate::cases::fewer_modes::{FewerModesRun, ITERATIONS};
use crate::cases::published::PublishedTable;
use crate::present::error::PresentError;

const COUNT: Digits = Digits::Fixed(0);

/// Iterations of the paper's runs, as in Tables 10 to 12.
///
/// # Errors
/// [`Error::Table`] if published tables were damaged.
pub fn iteration_table(runs: &[FewerModesRun]) -> Result<Table, PresentError> {
    let papers = GAGE_TABLES
        .map(|(paper, test_modes)| Ok((test_modes, PublishedTable::number(paper)?)))
        .into_iter()
        .collect::<Result<Vec<_>, PresentError>>()?;
    let cell = |run: &FewerModesRun| {
        let paper = papers
            .iter()
            .find(|(test_modes, _)| *test_modes == run.test_modes);
        let heading = format!("fem_{}_percent", run.analysis_modes);
        let printed = paper.map(|(_, table)| table);
        number(
            run.iterations as f64,
            COUNT,
            printed,
            "iterations",
            &heading,
        )
    };
    let title = "Case 2, pass 1: iterations with fewer modes (Tables 10 to 12)";
    let mut table = pairs_table("fewer_modes_iterations", title, "", runs, cell);
    table.notes.push(format!(
        "At most {ITERATIONS}: where the paper has as many, its error sum had not met the tolerance."
    ));
    Ok(table)
}

/// One quantity of a run: name, title, unit, digits, value.
type Quantity = (
    &'static str,
    &'static str,
    &'static str,
    Digits,
    fn(&FewerModesRun) -> f64,
);

const QUANTITIES: [Quantity; 5] = [
    ("iterations", "iterations", "", COUNT, |run| {
        run.iterations as f64
    }),
    (
        "shear",
        "gage RMS of the shear panels",
        "%",
        PERCENT,
        |run| 100.0 * run.shear_gage_rms,
    ),
    (
        "membrane",
        "gage RMS of the membranes",
        "%",
        PERCENT,
        |run| 100.0 * run.membrane_gage_rms,
    ),
    (
        "frequency",
        "exact frequency RMS over all test modes",
        "%",
        RMS_PERCENT,
        |run| 100.0 * run.exact_all_modes.frequency_rms,
    ),
    (
        "shape",
        "exact shape RMS over all test modes",
        "%",
        RMS_PERCENT,
        |run| 100.0 * run.exact_all_modes.shape_rms,
    ),
];

/// What truncation costs over all pairs of numbers of modes, one table a quantity.
pub fn truncation_tables(runs: &[FewerModesRun]) -> Vec<Table> {
    let table = |(name, title, unit, digits, value): Quantity| {
        pairs_table(
            &format!("truncation_{name}"),
            &format!("Cost of truncation, Case 2, pass 1: {title}"),
            unit,
            runs,
            |run| number(value(run), digits, None, "", ""),
        )
    };
    QUANTITIES.into_iter().map(table).collect()
}

fn pairs_table(
    name: &str,
    title: &str,
    unit: &'static str,
    runs: &[FewerModesRun],
    cell: impl Fn(&FewerModesRun) -> Cell,
) -> Table {
    let counts = |of: fn(&FewerModesRun) -> usize| {
        let mut counts: Vec<usize> = runs.iter().map(of).collect();
        counts.sort_unstable();
        counts.dedup();
        counts
    };
    let (tests, analyses) = (
        counts(|run| run.test_modes),
        counts(|run| run.analysis_modes),
    );
    let row = |&test: &usize| {
        let found = |&analysis: &usize| {
            let like =
                |run: &&FewerModesRun| run.test_modes == test && run.analysis_modes == analysis;
            runs.iter().find(like).map_or(Cell::Blank, &cell)
        };
        Row {
            label: test.to_string(),
            cells: analyses.iter().map(found).collect(),
        }
    };
    let heading = |analysis: &usize| Column {
        name: format!("FEM {analysis}"),
        unit,
    };
    Table {
        name: name.to_owned(),
        title: title.to_owned(),
        label_heading: "Test modes",
        columns: analyses.iter().map(heading).collect(),
        rows: tests.iter().map(row).collect(),
        notes: Vec::new(),
    }
}
