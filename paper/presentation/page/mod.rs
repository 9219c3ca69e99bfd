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
use corfem::present::table::{Cell, Table};
use corfem::torque_box::fewer_modes::{FewerModesRun, PUBLISHED_CASE, PUBLISHED_RUNS};
use corfem::torque_box::{Case, CaseResult};
use html::{figure, figures, prose, section_of};
use story::story;

/// The content of the page.
#[derive(Debug, Clone, Copy)]
pub struct Contents<'a> {
    /// The cases.
    pub results: &'a [CaseResult],
    /// Runs with fewer modes, all pairs.
    pub fewer_modes: &'a [FewerModesRun],
    /// The figures of all these.
    pub figures: &'a [Figure],
    /// The command that makes the page again.
    pub command: &'a str,
}

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
    let (mut story_html, appendix): (String, usize) = (
        parts.iter().map(|(.., body)| body.as_str()).collect(),
        parts.len(),
    );
    story_html += &answer;
    let is_left =
        |figure: &&Figure| !story_html.contains(&format!("<figure id=\"{}\">", figure.name));
    let left: Vec<Figure> = contents.figures.iter().filter(is_left).cloned().collect();
    let contents = &Contents {
        figures: &left,
        ..*contents
    };
    parts.push(named("box", "The box", "The box", box_section(contents)));
    for result in contents.results {
        let number = result.case.number;
        let body = part(
            &tables_of(result)?,
            contents.figures,
            &[format!("case_{number}_")],
        );
        let heading = format!("Tables of Case {number}");
        parts.push(named(&format!("case-{number}"), &heading, &heading, body));
    }
    let differences =
        prose(include_str!("../../results.md").trim_start_matches(|letter| letter != '\n'));
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
    let shown = |what: &str| {
        let drawn = contents.figures.iter().find(|figure| figure.name == what);
        drawn.map_or_else(String::new, |drawn| figure(drawn, ""))
    };
    let frequencies = shown(&format!("case_{SHOWN}_frequencies"));
    body += &format!(
        "<div class=\"answer\">\n<div>\n{}{frequencies}</div>\n{}</div>\n",
        table(&summary),
        shown("box_gages")
    );
    Ok(body)
}

/// Tables, then the figures whose names begin with one of the prefixes.
fn part(tables: &[Table], drawn: &[Figure], prefixes: &[impl AsRef<str>]) -> String {
    let starts = |figure: &&Figure| {
        prefixes
            .iter()
            .any(|prefix| figure.name.starts_with(prefix.as_ref()))
    };
    let drawn = drawn.iter().filter(starts).map(|drawn| figure(drawn, ""));
    tables.iter().map(table).collect::<String>() + &figures("figures", drawn)
}

fn box_section(contents: &Contents) -> String {
    let assumed = section_of(
        include_str!("../../reconstruction.md"),
        "Assumed beyond the paper",
    );
    format!(
        "<p>The paper prints neither coordinates nor masses. The box here was reconstructed from its results and \
         reproduces its published frequencies to 1.106 % RMS, 5.20 % at worst. Agreement with those frequencies \
         is calibration; agreement with everything else is evidence.</p>\n{}<h3>Assumed beyond the paper</h3>\n\
         {assumed}",
        part(&[], contents.figures, &["box_", "cover_"]),
    )
}

/// Tables 9 to 12, and the figure of the cost of truncation, which has its numbers.
fn fewer_modes_section(contents: &Contents) -> Result<String, PresentError> {
    let is_published =
        |run: &&FewerModesRun| PUBLISHED_RUNS.contains(&(run.test_modes, run.analysis_modes));
    let runs: Vec<FewerModesRun> = contents
        .fewer_modes
        .iter()
        .filter(is_published)
        .cloned()
        .collect();
    let tables = fewer_modes::published_tables(&Case::new(PUBLISHED_CASE)?, &runs)?;
    let lead = "<p>Case 2 again, one pass from its first gages, with its lowest test modes alone and its lowest \
    analysis modes.</p>\n";
    Ok(lead.to_owned() + &part(&tables, contents.figures, &["truncation"]))
}
