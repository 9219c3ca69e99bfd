//! Tables 9 to 12, one pass with fewer modes beside the published numbers, and the cost of truncation over all pairs.

use super::stages::{self, ErrorStage};
use super::{MODE_ERRORS, PERCENT, RMS_PERCENT};
use corfem::present::PresentError;
use corfem::present::table::{Cell, Digits, Table};
use corfem::torque_box::Case;
use corfem::torque_box::fewer_modes::{Agreement, FewerModesRun};
use corfem::torque_box::published::PublishedTable;
use std::collections::BTreeSet;

/// The paper's frequencies with fewer modes are those of five test modes.
const TABLE_9_TEST_MODES: usize = 5;
/// The paper's tables of gages: number, and test modes.
const GAGE_TABLES: [(usize, usize); 3] = [(10, 7), (11, 5), (12, 3)];
/// Errors under the gages, with their digits.
const GAGE_ERRORS: [(&str, Digits); 6] = [
    ("shear RMS", PERCENT),
    ("membrane RMS", PERCENT),
    ("inner frequency RMS", RMS_PERCENT),
    ("exact frequency RMS", RMS_PERCENT),
    ("inner shape RMS", RMS_PERCENT),
    ("exact shape RMS", RMS_PERCENT),
];

/// Tables 9 to 12 and the iterations, from the paper's runs.
///
/// # Errors
/// [`PresentError::Case`] if published tables were damaged.
pub fn published_tables(case: &Case, runs: &[FewerModesRun]) -> Result<Vec<Table>, PresentError> {
    let with = |modes: usize| -> Vec<&FewerModesRun> {
        runs.iter().filter(|run| run.test_modes == modes).collect()
    };
    let five = with(TABLE_9_TEST_MODES);
    let empty = |name: &str, what: &str| {
        let title = format!(
            "Case 2, pass 1, {TABLE_9_TEST_MODES} test modes: frequencies and errors by {what}"
        );
        Table::new(name, title, "Mode")
    };
    let note = "The inner loop's own modes: by perturbation of the analysis modes it was given, with the transformation B it \
        began with. What the paper prints is read as these.";
    let table_9 = empty("table_9", "the inner loop (Table 9)").notes([note]);
    let mut tables = vec![
        frequency_table(table_9, &five, Some(&PublishedTable::number(9)?), |run| {
            &run.inner
        }),
        frequency_table(
            empty("table_9_exact", "eigensolution at the gages found"),
            &five,
            None,
            |run| &run.exact,
        ),
    ];
    for (paper, test_modes) in GAGE_TABLES {
        tables.push(gage_table(case, paper, test_modes, &with(test_modes))?);
    }
    tables.push(iteration_table(runs)?);
    Ok(tables)
}

/// Frequencies and their errors at the start and at the end of every run.
fn frequency_table(
    table: Table,
    runs: &[&FewerModesRun],
    paper: Option<&PublishedTable>,
    end: fn(&FewerModesRun) -> &Agreement,
) -> Table {
    // The run with the most analysis modes knows the most initial frequencies.
    let most = runs.iter().max_by_key(|run| run.analysis_modes);
    let test = most.map_or(&[][..], |run| &run.test_frequencies_hz);
    let start = most.map(|run| (0, &run.initial)).into_iter();
    let found = start.chain(runs.iter().map(|&run| (run.analysis_modes, end(run))));
    let stage = |(modes, at): (_, &Agreement)| {
        ErrorStage::new(
            "fem",
            modes,
            &at.frequencies_hz,
            &[at.frequency_rms, at.shape_rms],
        )
    };
    stages::fill(
        table,
        &[],
        test,
        &found.map(stage).collect::<Vec<_>>(),
        &MODE_ERRORS,
        paper,
    )
}

/// Tables 10, 11, 12: gages and their errors, and RMS errors of gages, frequencies and shapes, of which the start has none.
fn gage_table(
    case: &Case,
    number: usize,
    test_modes: usize,
    runs: &[&FewerModesRun],
) -> Result<Table, PresentError> {
    let paper = PublishedTable::number(number)?;
    let found = |&run: &&FewerModesRun| {
        let FewerModesRun {
            inner,
            exact,
            shear_gage_rms,
            membrane_gage_rms,
            ..
        } = run;
        let modes = [
            inner.frequency_rms,
            exact.frequency_rms,
            inner.shape_rms,
            exact.shape_rms,
        ];
        let errors = [&[*shear_gage_rms, *membrane_gage_rms], &modes[..]].concat();
        ErrorStage::new("fem", run.analysis_modes, &run.gages_in, &errors)
    };
    let start = ErrorStage::new("fem", 0, &case.first_gages(), &[]);
    let stages: Vec<ErrorStage> = std::iter::once(start)
        .chain(runs.iter().map(found))
        .collect();
    let title =
        format!("Case 2, pass 1, {test_modes} test modes: gages and errors (Table {number})");
    let table = Table::new(format!("table_{number}"), title, "Element");
    Ok(stages::fill(
        table,
        &case.panels,
        &[],
        &stages,
        &GAGE_ERRORS,
        Some(&paper),
    ))
}

/// Iterations of the paper's runs, as in Tables 10 to 12.
fn iteration_table(runs: &[FewerModesRun]) -> Result<Table, PresentError> {
    let papers =
        GAGE_TABLES.map(|(number, test_modes)| Ok((test_modes, PublishedTable::number(number)?)));
    let papers = papers
        .into_iter()
        .collect::<Result<Vec<_>, PresentError>>()?;
    let cell = |run: &FewerModesRun| {
        let paper = papers
            .iter()
            .find(|(test_modes, _)| *test_modes == run.test_modes);
        let heading = format!("fem_{}_percent", run.analysis_modes);
        let printed = paper.and_then(|(_, table)| table.value("iterations", &heading));
        Cell::beside(run.iterations as f64, Digits::Fixed(0), printed)
    };
    let title = "Case 2, pass 1: iterations with fewer modes (Tables 10 to 12)";
    let table = Table::new("fewer_modes_iterations", title, "Test modes");
    Ok(pairs_table(table, "", runs, &cell).notes([
        "At most 30: where the paper has as many, its error sum had not met the tolerance.",
    ]))
}

/// Cost of truncation over all pairs of numbers of modes, one table a quantity.
pub fn truncation_tables(runs: &[FewerModesRun]) -> Vec<Table> {
    let table = |name: &str, what: &str, unit, cell: &dyn Fn(&FewerModesRun) -> Cell| {
        let title = format!("Cost of truncation, Case 2, pass 1: {what}");
        pairs_table(
            Table::new(format!("truncation_{name}"), title, "Test modes"),
            unit,
            runs,
            cell,
        )
    };
    let iterations = table("iterations", "iterations", "", &|run| {
        Cell::count(run.iterations)
    });
    let costs = COSTS.map(|(name, what, digits, cost)| {
        table(name, what, "%", &|run| {
            Cell::number(100.0 * cost(run), digits)
        })
    });
    [vec![iterations], costs.to_vec()].concat()
}

/// An error that is left after a run: its name, its description, its digits in percent, and the fraction.
type Cost = (
    &'static str,
    &'static str,
    Digits,
    fn(&FewerModesRun) -> f64,
);

/// Costs of truncation: errors of the gages of shear panels and of membranes, and of frequencies and shapes beside all test modes.
pub const COSTS: [Cost; 4] = [
    ("shear", "gage RMS of the shear panels", PERCENT, |run| {
        run.shear_gage_rms
    }),
    ("membrane", "gage RMS of the membranes", PERCENT, |run| {
        run.membrane_gage_rms
    }),
    (
        "frequency",
        "exact frequency RMS over all test modes",
        RMS_PERCENT,
        |run| run.exact_all_modes.frequency_rms,
    ),
    (
        "shape",
        "exact shape RMS over all test modes",
        RMS_PERCENT,
        |run| run.exact_all_modes.shape_rms,
    ),
];

/// Test modes down, analysis modes across.
fn pairs_table(
    table: Table,
    unit: &'static str,
    runs: &[FewerModesRun],
    cell: &dyn Fn(&FewerModesRun) -> Cell,
) -> Table {
    let counts = |of: fn(&FewerModesRun) -> usize| runs.iter().map(of).collect::<BTreeSet<usize>>();
    let tests = counts(|run| run.test_modes);
    counts(|run| run.analysis_modes)
        .into_iter()
        .fold(table.labels(&tests), |table, analysis| {
            let run = |&test: &usize| {
                runs.iter()
                    .find(|run| (run.test_modes, run.analysis_modes) == (test, analysis))
            };
            table.column(
                format!("FEM {analysis}"),
                unit,
                tests.iter().map(|test| run(test).map_or(Cell::Blank, cell)),
            )
        })
}
