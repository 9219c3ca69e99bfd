//! The page's words before its tables, from `paper/report.md`: every case with its figure, then the method.

use super::super::words::case_in_words;
use super::Contents;
use corfem::present::page::html::{figure, figures, prose};
use corfem::present::page::{Part, named};
use corfem::torque_box::CaseResult;

/// A part for every section of the words whose case there is.
pub fn story(contents: &Contents) -> Vec<Part> {
    let sections = include_str!("../../report.md").split("\n## ").skip(1);
    sections.filter_map(|text| part(text, contents)).collect()
}

/// A section: its heading, its text, and a line for every figure, the figure's name before the words.
fn part(text: &str, contents: &Contents) -> Option<Part> {
    let (heading, body) = text.split_once('\n')?;
    let short = heading.split(':').next()?;
    let mut pieces = body.split("\n- `");
    let mut body = prose(pieces.next()?);
    if let Some(number) = short.strip_prefix("Case ") {
        body += &outcome(
            contents
                .results
                .iter()
                .find(|result| result.case.number.to_string() == number)?,
        );
    }
    let seen = pieces.filter_map(|piece| {
        let (name, words) = piece.split_once("`: ")?;
        let drawn = contents.figures.iter().find(|figure| figure.name == name)?;
        Some(figure(drawn, words.trim()))
    });
    body += &figures("told", seen);
    Some(named(
        &format!("story-{}", short.to_lowercase().replace(' ', "-")),
        short,
        heading,
        body,
    ))
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
