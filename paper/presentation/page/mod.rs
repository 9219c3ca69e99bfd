//! The report on the cases as one web page: the story, then tables, figures, assumptions, and what made it.
//!
//! Texts on the box and on the differences from the published results are those of `paper/`, so that they are written
//! once.

mod html;
mod story;

use super::figures::{Figure, SHOWN};
use super::report::CaseReport;
use super::tables::cases::{iteration_table, outcome_table, settings_table, summary, tables_of};
use super::tables::{fewer_modes, paper_tables};
use corfem::present::PresentError;
use corfem::present::page::{document, in_script, made, named, table};
use corfem::present::table::Cell;
use corfem::torque_box::fewer_modes::{FewerModesRun, PUBLISHED_CASE};
use corfem::torque_box::{Case, CaseResult};
use html::{figure, figures, section_of};
use story::story;

/// The content of the page.
#[derive(Debug, Clone, Copy)]
pub struct Contents<'a> {
    /// The cases.
    pub results: &'a [CaseResult],
    /// The paper's runs with fewer modes.
    pub fewer_modes: &'a [FewerModesRun],
    /// The figures of all these.
    pub figures: &'a [Figure],
    /// The command that makes the page again.
    pub command: &'a str,
}

/// Text on the box and on the differences from the published results.
const PRINT_AND_BOX: &str = include_str!("../../print_and_box.md");
const TITLE: &str = "The wing torque box, correlated";
const LEAD: &str = "Element stiffnesses of a finite element model, corrected until its natural frequencies and mode shapes agree with \
    those of a ground vibration test.";
/// The page.
///
/// # Errors
/// [`PresentError::Case`] for damaged published tables.
pub fn page(contents: &Contents) -> Result<String, PresentError> {
    let answer = answer(contents)?;
    let mut parts = story(contents)?;
    let appendix = parts.len();
    parts.push(named("box", "The box", "The box", box_section(contents)));
    for result in contents.results {
        let number = result.case.number;
        let charts = if result.is_detection() {
            String::new()
        } else {
            CaseReport::new(result).charts()?
        };
        let body = tables_of(result)?.iter().map(table).collect::<String>() + &charts;
        let heading = format!("Tables of Case {number}");
        parts.push(named(&format!("case-{number}"), &heading, &heading, body));
    }
    let differences = section_of(PRINT_AND_BOX, "The results");
    let why = "Where the results differ from the published ones, and why";
    let cost = table(&outcome_table(contents.results))
        + &table(&iteration_table(contents.results)?)
        + &table(&settings_table(contents.results));
    parts.extend([
        named(
            "fewer-modes",
            "Fewer modes",
            "With fewer modes",
            fewer_modes_section(contents)?,
        ),
        named("cost", "Outcomes", "Outcomes and iterations", cost),
        named("differences", "Differences", why, differences),
        named(
            "made",
            "How it was made",
            "How it was made",
            made("Units: inch, pound-force, second", contents.command),
        ),
    ]);
    let bodies = parts.iter().map(|(.., body)| body.as_str());
    let tables = std::iter::once(answer.as_str())
        .chain(bodies)
        .flat_map(|body| body.split("<table id=\"").skip(1))
        .filter_map(|rest| rest.split('"').next());
    let note = format!(
        "<p>Every computed number has the published one behind it in parentheses. {}</p>\n",
        paper_tables(tables)
    );
    parts.insert(
        appendix,
        named(
            "appendix",
            "Appendix",
            "Appendix: the tables, and the other figures",
            note,
        ),
    );
    Ok(document(TITLE, LEAD, &answer, &parts))
}

/// The outcome of all cases, before anything else: a sentence, the summary, and one case's gages and frequencies before and after.
fn answer(contents: &Contents) -> Result<String, PresentError> {
    let results = contents.results;
    let summary = summary(results)?;
    let corrected = || {
        let rows = results.iter().zip(&summary.rows);
        rows.filter(|(result, _)| !result.is_detection())
            .map(|(_, row)| row)
    };
    let all = |cell: usize| {
        let numbers = corrected().filter_map(|row| row.cells.get(cell));
        numbers.map(Cell::computed).collect::<Vec<_>>().join(", ")
    };
    let mut body = format!(
        "<p>Frequency errors of {} % RMS fall to {} % in the cases that are corrected.{}</p>\n",
        all(0),
        all(1),
        if results.iter().all(CaseResult::succeeded) {
            " Every case did what was asked of it: correlated within the tolerances, or named its modeling error."
        } else {
            " <strong>At least one case did not converge within its limits; the best found is shown.</strong>"
        }
    );
    if let Some(shown) = results.iter().find(|result| result.case.number == SHOWN) {
        let report = CaseReport::new(shown);
        body += &format!(
            "<div class=\"first\">\n{}<script>bars({})</script>\n</div>\n",
            report.moving()?,
            in_script(&report.parameters())?
        );
    }
    body += &format!(
        "<div class=\"answer\">\n<div>\n{}</div>\n{}</div>\n",
        table(&summary),
        drawn(contents, &["box_gages"])
    );
    Ok(body)
}

/// The figures whose names begin with one of the prefixes.
fn drawn(contents: &Contents, prefixes: &[&str]) -> String {
    let is_it = |figure: &&Figure| {
        prefixes
            .iter()
            .any(|prefix| figure.name.starts_with(prefix))
    };
    let drawn = contents.figures.iter().filter(is_it);
    figures("figures", drawn.map(|drawn| figure(drawn, "")))
}

fn box_section(contents: &Contents) -> String {
    section_of(PRINT_AND_BOX, "The box")
        + &drawn(contents, &["box_points", "box_elements", "cover_gages"])
}

/// Tables 9 to 12.
fn fewer_modes_section(contents: &Contents) -> Result<String, PresentError> {
    let tables = fewer_modes::published_tables(&Case::new(PUBLISHED_CASE)?, contents.fewer_modes)?;
    let lead = "<p>Case 2 again, one pass from its first gages, with its lowest test modes alone and its lowest \
    analysis modes.</p>\n";
    Ok(lead.to_owned() + &tables.iter().map(table).collect::<String>())
}
