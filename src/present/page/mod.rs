//! The report as one web page that needs nothing beside it: tables, figures, assumptions, fit, and what made it.
//!
//! `report.html` beside this file is the page; here is what fills it. Texts on the box and on the differences from the published
//! results are those of `paper/`, so that they are written once.

mod text;

use crate::cases::error::CaseError;
use crate::cases::fewer_modes::{FewerModesRun, PUBLISHED_CASE, PUBLISHED_RUNS};
use crate::cases::fit::Fit;
use crate::cases::{Case, CaseResult};
use crate::present::error::PresentError;
use crate::present::figures::Figure;
use crate::present::report::correlation_tables::frequency_table;
use crate::present::report::fewer_modes_tables::fewer_modes_tables;
use crate::present::report::matrix_tables::matrix_tables;
use crate::present::report::run_tables::all_tables;
use crate::present::report::table::{Cell, Column, Digits, Row, Table};
use crate::studies::matrix_comparison::MatrixComparison;
use askama::Template;
use text::section;

/// What the page tells.
#[derive(Debug, Clone, Copy)]
pub struct Contents<'a> {
    /// The cases.
    pub results: &'a [CaseResult],
    /// The fit of the box.
    pub fit: &'a Fit,
    /// Runs with fewer modes, all pairs.
    pub fewer_modes: &'a [FewerModesRun],
    /// Corrections by elements and by matrices.
    pub matrices: &'a MatrixComparison,
    /// The figures of all these.
    pub figures: &'a [Figure],
    /// The command that makes the page again.
    pub command: &'a str,
}

/// The page.
#[derive(Debug, Template)]
#[template(path = "report.html", config = "src/present/page/askama.toml")]
struct Page<'a> {
    version: &'static str,
    command: &'a str,
    summary: Table,
    anomalies: Vec<String>,
    all_succeeded: bool,
    cases: Vec<CaseSection<'a>>,
    box_figures: Vec<&'a Figure>,
    fewer_modes: Part<'a>,
    matrices: Part<'a>,
    assumptions: String,
    differences: String,
    fit: Table,
    iterations: Table,
    fit_rms_percent: String,
    fit_largest_percent: String,
}

/// What the page shows of one case.
#[derive(Debug)]
struct CaseSection<'a> {
    number: usize,
    title: String,
    part: Part<'a>,
}

/// Tables and the figures that belong to them.
#[derive(Debug)]
struct Part<'a> {
    tables: Vec<Table>,
    figures: Vec<&'a Figure>,
}

/// The page.
///
/// # Errors
/// [`CaseError::Table`] for damaged published tables; [`PresentError::Page`] when the page cannot be put together.
pub fn page(contents: &Contents) -> Result<String, PresentError> {
    let &Contents { results, fit, figures, command, .. } = contents;
    let mut tables = all_tables(results, fit)?;
    let mut take = |wanted: &dyn Fn(&Table) -> bool| -> Vec<Table> {
        let (taken, rest) = std::mem::take(&mut tables).into_iter().partition(wanted);
        tables = rest;
        taken
    };
    let fit_table = only(take(&|table| table.name == "fit"), "fit")?;
    let iterations = only(take(&|table| table.name == "table_13"), "table_13")?;
    let cases = results
        .iter()
        .map(|result| {
            let number = result.case.number;
            let (heading, prefix) = (format!("Case {number}:"), format!("case_{number}_"));
            CaseSection {
                number,
                title: about(number).to_owned(),
                part: Part {
                    tables: take(&|table| table.title.starts_with(&heading)),
                    figures: named(figures, &prefix),
                },
            }
        })
        .collect();
    let page = Page {
        version: env!("CARGO_PKG_VERSION"),
        command,
        summary: summary(results)?,
        anomalies: anomalies(results),
        all_succeeded: results.iter().all(CaseResult::succeeded),
        cases,
        box_figures: [named(figures, "box_"), named(figures, "cover_")].concat(),
        fewer_modes: Part { tables: published_tables(contents.fewer_modes)?, figures: named(figures, "truncation") },
        matrices: Part { tables: whole_tables(contents.matrices)?, figures: named(figures, "matrices_") },
        assumptions: section(include_str!("../../../paper/reconstruction.md"), "Assumed beyond the paper"),
        differences: section(include_str!("../../../paper/results.md"), ""),
        fit: fit_table,
        iterations,
        fit_rms_percent: Digits::Fixed(3).write(100.0 * fit.rms),
        fit_largest_percent: Digits::Fixed(2).write(100.0 * fit.largest),
    };
    page.render().map_err(|source| PresentError::Page { source })
}

/// Figures whose names begin alike.
fn named<'a>(figures: &'a [Figure], prefix: &str) -> Vec<&'a Figure> {
    let like = |figure: &&Figure| figure.name.starts_with(prefix);
    figures.iter().filter(like).collect()
}

/// Tables 9 to 12; what truncation costs is left to its figure, which has the numbers.
fn published_tables(runs: &[FewerModesRun]) -> Result<Vec<Table>, PresentError> {
    let is_published = |run: &&FewerModesRun| PUBLISHED_RUNS.contains(&(run.test_modes, run.analysis_modes));
    let published: Vec<FewerModesRun> = runs.iter().filter(is_published).cloned().collect();
    let mut tables = fewer_modes_tables(&Case::new(PUBLISHED_CASE)?, &published, &[])?;
    tables.retain(|table| !table.name.starts_with("truncation"));
    Ok(tables)
}

/// What the corrections know and the factors they stand for; entry by entry they are left to their figure.
fn whole_tables(comparison: &MatrixComparison) -> Result<Vec<Table>, PresentError> {
    let mut tables = matrix_tables(&Case::new(comparison.case)?, comparison);
    tables.retain(|table| table.name.starts_with("matrix_"));
    Ok(tables)
}

fn only(mut tables: Vec<Table>, name: &str) -> Result<Table, PresentError> {
    let missing = || CaseError::Table {
        name: name.to_owned(),
        expected: "one such table in the report".into(),
        found: "none".into(),
    };
    Ok(tables.pop().ok_or_else(missing)?)
}

/// What a case of the paper is about.
fn about(case: usize) -> &'static str {
    match case {
        1 => "every panel a shear panel, all half as thick again",
        2 => "membrane covers, all panels half as thick again",
        3 => "membrane covers, gages alternating 30 percent above and below",
        _ => "one cover a hundred times too thin by mistake",
    }
}

/// First and last RMS errors and the iterations of every case, with the published ones.
///
/// # Errors
/// [`CaseError::Table`] for damaged published tables.
pub fn summary(results: &[CaseResult]) -> Result<Table, PresentError> {
    let mut rows = Vec::new();
    for result in results {
        let table = frequency_table(result)?;
        let mut cells = Vec::new();
        for label in ["frequency RMS", "shape RMS"] {
            let row = table.rows.iter().find(|row| row.label == label);
            let numbers: Vec<&Cell> = row
                .map(|row| {
                    let number = |cell: &&Cell| matches!(cell, Cell::Number { .. });
                    row.cells.iter().filter(number).collect()
                })
                .unwrap_or_default();
            for cell in [numbers.first(), numbers.last()] {
                cells.push(cell.map_or(Cell::Blank, |&cell| cell.clone()));
            }
        }
        let passes = &result.correlation.passes;
        let counts: Vec<String> = passes.iter().map(|pass| pass.inner.iterations.len().to_string()).collect();
        cells.push(Cell::Text(counts.join(", ")));
        cells.push(Cell::Text(outcome(result)));
        rows.push(Row { label: result.case.number.to_string(), cells });
    }
    let percent = |name: &str| Column { name: name.to_owned(), unit: "%" };
    let text = |name: &str| Column { name: name.to_owned(), unit: "" };
    Ok(Table {
        name: "summary".to_owned(),
        title: "RMS errors over nine modes, first and last model".to_owned(),
        label_heading: "Case",
        columns: vec![
            percent("Frequency, first"),
            percent("Frequency, last"),
            percent("Shape, first"),
            percent("Shape, last"),
            text("Iterations by pass"),
            text("Outcome"),
        ],
        rows,
        notes: Vec::new(),
    })
}

/// What became of a case, in a few words.
fn outcome(result: &CaseResult) -> String {
    if result.correlation.converged {
        return "correlated".to_owned();
    }
    match result.anomalies.first() {
        Some(anomaly) => format!("modeling error in element {}", anomaly.parameter),
        None => "not converged".to_owned(),
    }
}

/// One sentence for every modeling error found.
fn anomalies(results: &[CaseResult]) -> Vec<String> {
    let mut sentences = Vec::new();
    for result in results {
        for anomaly in &result.anomalies {
            sentences.push(format!(
                "Case {}: element {} asks for {:.1} times its stiffness in the first iteration, far outside the limits. Look for a modeling error there.",
                result.case.number, anomaly.parameter, anomaly.factor
            ));
        }
    }
    sentences
}

/// How a cell is written, and the published number behind it.
fn written(cell: &Cell) -> (String, Option<String>) {
    match cell {
        Cell::Blank => (String::new(), None),
        Cell::Text(text) => (text.clone(), None),
        Cell::Number { computed, published, digits } => {
            (digits.write(*computed), published.map(|paper| digits.write(paper)))
        }
    }
}
