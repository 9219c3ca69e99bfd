//! The page's words before its tables, from `report.md` beside it: every case with its figure, then the method.

use super::super::figures::SHOWN;
use super::super::report::CaseReport;
use super::super::words::case_in_words;
use super::Contents;
use super::html::{figure, figures, prose};
use corfem::present::PresentError;
use corfem::present::page::{Part, named};
use corfem::torque_box::CaseResult;

/// A part for every section of the words whose case there is.
pub fn story(contents: &Contents) -> Result<Vec<Part>, PresentError> {
    let sections = include_str!("report.md").split("\n## ").skip(1);
    let parts = sections.filter_map(|text| part(text, contents).transpose());
    parts.collect()
}

/// A section: its heading, its text, a line for every figure, the figure's name before the words, and the case moving.
fn part(text: &str, contents: &Contents) -> Result<Option<Part>, PresentError> {
    let (heading, body) = text.split_once('\n').unwrap_or((text, ""));
    let short = heading.split(':').next().unwrap_or(heading);
    let mut pieces = body.split("\n- `");
    let mut body = prose(pieces.next().unwrap_or_default());
    let mut moved = String::new();
    if let Some(number) = short.strip_prefix("Case ") {
        let is_it = |result: &&CaseResult| result.case.number.to_string() == number;
        let Some(result) = contents.results.iter().find(is_it) else {
            return Ok(None);
        };
        body += &outcome(result);
        // The first screen has that one.
        if result.case.number != SHOWN {
            moved = CaseReport::new(result).moving()?;
        }
    }
    let seen = pieces.filter_map(|piece| {
        let (name, words) = piece.split_once("`: ")?;
        let drawn = contents.figures.iter().find(|figure| figure.name == name)?;
        Some(figure(drawn, words.trim()))
    });
    body += &(figures("told", seen) + &moved);
    Ok(Some(named(
        &format!("story-{}", short.to_lowercase().replace(' ', "-")),
        short,
        heading,
        body,
    )))
}

/// The outcome of a case: its modeling error, or its verdict.
fn outcome(result: &CaseResult) -> String {
    let Some(anomaly) = &result.anomaly else {
        return format!("<p class=\"note\">{}</p>\n", case_in_words(result));
    };
    let (number, element, factor, ratio) = (
        result.case.number,
        &anomaly.parameter,
        anomaly.factor,
        anomaly.ratio,
    );
    format!(
        "<p class=\"finding\">Case {number}: element {element} asks for {factor:.1} times its stiffness in the first iteration. \
        By change of error per change of gage it asks for {ratio:.0} times as much as any other. Look for a modeling error there.</p>\n"
    )
}
