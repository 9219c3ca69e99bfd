//! Tables 9 to 12, one pass with fewer modes beside the published numbers, and what truncation costs over all pairs.

use super::stages::Stages;
use super::{Cell, Digits, KINDS, PERCENT, PresentError, RMS_PERCENT, Table, remarks};
use crate::cases::Case;
use crate::cases::fewer_modes::{Agreement, FewerModesRun};
use crate::cases::published::PublishedTable;
use std::collections::{BTreeMap, BTreeSet};

/// The paper's frequencies with fewer modes are those of five test modes.
const TABLE_9_TEST_MODES: usize = 5;
/// The paper's tables of gages: number, and test modes.
const GAGE_TABLES: [(usize, usize); 3] = [(10, 7), (11, 5), (12, 3)];

/// The label of a row, and what stands in it.
type RmsRow = (&'static str, fn(&Agreement) -> f64);

/// RMS errors with their labels.
const RMS_ROWS: [RmsRow; 2] = [("frequency RMS", |found| found.frequency_rms), ("shape RMS", |found| found.shape_rms)];

/// Tables 9 to 12 and the iterations from the paper's runs, then the truncation tables from all runs.
///
/// # Errors
/// [`PresentError::Case`] if published tables were damaged.
pub fn fewer_modes_tables(
    case: &Case,
    published: &[FewerModesRun],
    all: &[FewerModesRun],
) -> Result<Vec<Table>, PresentError> {
    let mut tables = published_tables(case, published)?;
    tables.extend(truncation_tables(all));
    Ok(tables)
}

/// Tables 9 to 12 and the iterations, from the paper's runs.
///
/// # Errors
/// [`PresentError::Case`] if published tables were damaged.
pub fn published_tables(case: &Case, runs: &[FewerModesRun]) -> Result<Vec<Table>, PresentError> {
    let with = |modes: usize| -> Vec<&FewerModesRun> { runs.iter().filter(|run| run.test_modes == modes).collect() };
    let five = with(TABLE_9_TEST_MODES);
    let paper = PublishedTable::number(9)?;
    let inner = "frequencies and errors by the inner loop (Table 9)";
    let exact = "frequencies and errors by eigensolution at the gages found";
    let mut table_9 = frequency_table("table_9", inner, &five, Some(&paper), |run| &run.inner).note(
        "The inner loop's \
    own modes: by perturbation of the analysis modes it was given, with the transformation B it began with. What the \
    paper prints is read as these.",
    );
    table_9.notes.extend(remarks(Some(&paper)));
    let mut tables = vec![table_9, frequency_table("table_9_exact", exact, &five, None, |run| &run.exact)];
    for (paper, test_modes) in GAGE_TABLES {
        tables.push(gage_table(case, paper, test_modes, &with(test_modes))?);
    }
    tables.push(iteration_table(runs)?);
    Ok(tables)
}

/// How the published columns of a run begin.
fn stage(run: &FewerModesRun) -> String {
    format!("fem_{}", run.analysis_modes)
}

/// Frequencies and their errors at the start and at the end of every run.
fn frequency_table(
    name: &str,
    what: &str,
    runs: &[&FewerModesRun],
    paper: Option<&PublishedTable>,
    end: fn(&FewerModesRun) -> &Agreement,
) -> Table {
    // The run with the most analysis modes knows the most initial frequencies.
    let most = runs.iter().max_by_key(|run| run.analysis_modes);
    let initial = most.map(|run| ("initial".to_owned(), &run.initial));
    let ends = runs.iter().map(|run| (stage(run), end(run)));
    let found: Vec<(String, &Agreement)> = initial.into_iter().chain(ends).collect();
    let modes = most.map_or(0, |run| run.initial.frequencies_hz.len());
    let test = most.map_or(&[][..], |run| &run.test_frequencies_hz);
    let values = found.iter().map(|(name, at)| (name.clone(), &at.frequencies_hz[..]));
    let mut stages = Stages::of_modes(modes, test, values.collect());
    stages.paper = paper;
    let title = format!("Case 2, pass 1, {TABLE_9_TEST_MODES} test modes: {what}");
    let mut table = stages.fill(Table::new(name, title, "Mode"));
    for (label, rms) in RMS_ROWS {
        stages.add_errors(&mut table, label, RMS_PERCENT, found.iter().map(|(_, at)| Some(rms(at))));
    }
    table
}

/// Tables 10, 11, 12: gages and their errors, and RMS errors of gages, frequencies and shapes.
fn gage_table(case: &Case, number: usize, test_modes: usize, runs: &[&FewerModesRun]) -> Result<Table, PresentError> {
    let paper = PublishedTable::number(number)?;
    let first = case.first_gages();
    let found = runs.iter().map(|run| (stage(run), &run.gages_in[..]));
    let values = std::iter::once(("initial".to_owned(), &first[..])).chain(found);
    let mut stages = Stages::of_gages(&case.panels, values.collect());
    stages.paper = Some(&paper);
    let title = format!("Case 2, pass 1, {test_modes} test modes: gages and errors (Table {number})");
    let mut table = stages.fill(Table::new(format!("table_{number}"), title, "Element"));
    // The start has none of these errors.
    let mut add = |label: &str, digits, error: &dyn Fn(&FewerModesRun) -> f64| {
        let errors = std::iter::once(None).chain(runs.iter().map(|run| Some(error(run))));
        stages.add_errors(&mut table, label, digits, errors);
    };
    add("shear RMS", PERCENT, &|run| run.shear_gage_rms);
    add("membrane RMS", PERCENT, &|run| run.membrane_gage_rms);
    for (label, rms) in RMS_ROWS {
        add(&format!("inner {label}"), RMS_PERCENT, &|run| rms(&run.inner));
        add(&format!("exact {label}"), RMS_PERCENT, &|run| rms(&run.exact));
    }
    table.notes.push(KINDS.to_owned());
    table.notes.extend(remarks(Some(&paper)));
    Ok(table)
}

/// Iterations of the paper's runs, as in Tables 10 to 12.
fn iteration_table(runs: &[FewerModesRun]) -> Result<Table, PresentError> {
    let mut papers = BTreeMap::new();
    for (number, test_modes) in GAGE_TABLES {
        papers.insert(test_modes, PublishedTable::number(number)?);
    }
    let cell = |run: &FewerModesRun| {
        let paper = papers.get(&run.test_modes);
        let printed = paper.and_then(|table| table.value("iterations", &format!("{}_percent", stage(run))));
        Cell::beside(run.iterations as f64, Digits::Fixed(0), printed)
    };
    let title = "Case 2, pass 1: iterations with fewer modes (Tables 10 to 12)";
    Ok(pairs_table("fewer_modes_iterations", title, "", runs, &cell)
        .note("At most 30: where the paper has as many, its error sum had not met the tolerance."))
}

/// What truncation costs over all pairs of numbers of modes, one table a quantity.
pub fn truncation_tables(runs: &[FewerModesRun]) -> Vec<Table> {
    let table = |name: &str, what: &str, unit, cell: &dyn Fn(&FewerModesRun) -> Cell| {
        let title = format!("Cost of truncation, Case 2, pass 1: {what}");
        pairs_table(&format!("truncation_{name}"), &title, unit, runs, cell)
    };
    let mut tables = vec![table("iterations", "iterations", "", &|run| Cell::count(run.iterations))];
    for (at, (name, what, digits)) in COSTS.into_iter().enumerate() {
        let cell = |run: &FewerModesRun| Cell::percent(costs(run)[at], digits);
        tables.push(table(name, what, "%", &cell));
    }
    tables
}

/// What is left of the errors after a run, fractions: of the gages of shear panels and of membranes, and of frequencies
/// and shapes beside all test modes.
pub(in crate::present) fn costs(run: &FewerModesRun) -> [f64; 4] {
    let exact = &run.exact_all_modes;
    [run.shear_gage_rms, run.membrane_gage_rms, exact.frequency_rms, exact.shape_rms]
}

/// Names, titles and digits of the [`costs`].
const COSTS: [(&str, &str, Digits); 4] = [
    ("shear", "gage RMS of the shear panels", PERCENT),
    ("membrane", "gage RMS of the membranes", PERCENT),
    ("frequency", "exact frequency RMS over all test modes", RMS_PERCENT),
    ("shape", "exact shape RMS over all test modes", RMS_PERCENT),
];

/// Test modes down, analysis modes across.
fn pairs_table(
    name: &str,
    title: &str,
    unit: &'static str,
    runs: &[FewerModesRun],
    cell: &dyn Fn(&FewerModesRun) -> Cell,
) -> Table {
    let counts = |of: fn(&FewerModesRun) -> usize| runs.iter().map(of).collect::<BTreeSet<usize>>();
    let analyses = counts(|run| run.analysis_modes);
    let headings = analyses.iter().map(|count| format!("FEM {count}"));
    let mut table = Table::new(name, title, "Test modes").columns(headings, unit);
    for test in counts(|run| run.test_modes) {
        let cells = analyses.iter().map(|&analysis| {
            let like = |run: &&FewerModesRun| (run.test_modes, run.analysis_modes) == (test, analysis);
            runs.iter().find(like).map_or(Cell::Blank, cell)
        });
        table.row(test, cells);
    }
    table
}
