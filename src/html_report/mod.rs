//! The report as one web page that needs nothing beside it: tables, figures, assumptions, fit, and what made it.
//!
//! `report.html` beside this file is the page; here is what fills it. Texts on the box and on the differences from the published
//! results are those of `paper/`, so that they are written once.

mod text;

use crate::cases::CaseResult;
use crate::error::Error;
use crate::figures::Figure;
use crate::fit::Fit;
use crate::report::correlation_tables::frequency_table;
use crate::report::run_tables::all_tables;
use crate::report::table::{Cell, Column, Digits, Row, Table};
use askama::Template;
use text::section;

/// The page.
#[derive(Debug, Template)]
#[template(path = "report.html", config = "src/html_report/askama.toml")]
struct Page<'a> {
    version: &'static str,
    command: &'a str,
    summary: Table,
    anomalies: Vec<String>,
    all_succeeded: bool,
    cases: Vec<CaseSection>,
    box_figures: Vec<&'a Figure>,
    assumptions: String,
    differences: String,
    fit: Table,
    iterations: Table,
    fit_rms_percent: String,
    fit_largest_percent: String,
}

/// What the page shows of one case.
#[derive(Debug)]
struct CaseSection {
    number: usize,
    title: String,
    tables: Vec<Table>,
    figures: Vec<FigureOf>,
}

/// A figure of a case.
#[derive(Debug)]
struct FigureOf {
    name: String,
    caption: String,
    svg: String,
}

/// The page of a run; `command` is the one that makes it again.
///
/// # Errors
/// [`Error::Table`] for damaged published tables; [`Error::Page`] when the page cannot be put together.
pub fn page(
    results: &[CaseResult],
    fit: &Fit,
    figures: &[Figure],
    command: &str,
) -> Result<String, Error> {
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
                tables: take(&|table| table.title.starts_with(&heading)),
                figures: figures
                    .iter()
                    .filter(|figure| figure.name.starts_with(&prefix))
                    .map(|figure| FigureOf {
                        name: figure.name.clone(),
                        caption: figure.caption.clone(),
                        svg: figure.svg.clone(),
                    })
                    .collect(),
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
        box_figures: figures
            .iter()
            .filter(|figure| !figure.name.starts_with("case_"))
            .collect(),
        assumptions: section(
            include_str!("../../paper/reconstruction.md"),
            "Assumed beyond the paper",
        ),
        differences: section(include_str!("../../paper/results.md"), ""),
        fit: fit_table,
        iterations,
        fit_rms_percent: Digits::Fixed(3).write(100.0 * fit.rms),
        fit_largest_percent: Digits::Fixed(2).write(100.0 * fit.largest),
    };
    page.render().map_err(|source| Error::Page { source })
}

fn only(mut tables: Vec<Table>, name: &str) -> Result<Table, Error> {
    tables.pop().ok_or_else(|| Error::Table {
        name: name.to_owned(),
        expected: "one such table in the report".into(),
        found: "none".into(),
    })
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
/// [`Error::Table`] for damaged published tables.
pub fn summary(results: &[CaseResult]) -> Result<Table, Error> {
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
        let counts: Vec<String> = passes
            .iter()
            .map(|pass| pass.inner.iterations.len().to_string())
            .collect();
        cells.push(Cell::Text(counts.join(", ")));
        cells.push(Cell::Text(outcome(result)));
        rows.push(Row {
            label: result.case.number.to_string(),
            cells,
        });
    }
    let percent = |name: &str| Column {
        name: name.to_owned(),
        unit: "%",
    };
    let text = |name: &str| Column {
        name: name.to_owned(),
        unit: "",
    };
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
        Cell::Number {
            computed,
            published,
            digits,
        } => (
            digits.write(*computed),
            published.map(|paper| digits.write(paper)),
        ),
    }
}
