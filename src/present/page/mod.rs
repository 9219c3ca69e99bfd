//! The report as one web page that needs nothing beside it: the answer, the structure moving and the factors on its first screen, then
//! tables, and what made it.

pub mod charts;
pub mod html;
pub mod moving;

use super::report::Report;
use super::table::Table;
use super::tables::job::trust_table;
use super::tables::report::{
    derivative_table, factor_table, history_table, minima_table, paired_table,
};
use crate::present::PresentError;
use charts::{assurance_maps, derivative_map, factor_bars, pairing_plot, residual_map};
use html::{escaped, section, table};
use moving::moving;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A section: its id, the words of a link to it, its heading, its HTML.
pub type Part = (String, String, String, String);

/// A section of these parts.
pub fn named(id: &str, link: &str, heading: &str, body: String) -> Part {
    (id.to_owned(), link.to_owned(), heading.to_owned(), body)
}

/// A whole page: its answer, then sections. It has the script of [`moving()`](moving::moving).
pub fn document(title: &str, lead: &str, answer: &str, parts: &[Part]) -> String {
    let links: String = parts
        .iter()
        .map(|(id, link, ..)| format!("<a href=\"#{id}\">{link}</a>\n"))
        .collect();
    let sections: String = parts
        .iter()
        .map(|(id, _, heading, body)| section(id, heading, body))
        .collect();
    let title = escaped(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"generator\" content=\"corfem {VERSION}\">\n<title>corfem: {title}</title>\n\
         <style>\n{}</style>\n<script>\n{}</script>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n<p>{}</p>\n{answer}</header>\n\
         <nav aria-label=\"Contents\">\n{links}</nav>\n<main>\n{sections}</main>\n</body>\n</html>\n",
        include_str!("report.css"),
        moving::SCRIPT,
        lead,
    )
}

/// The report on one correlation: its answer, the structure moving, factors and pairs; then doubts, modes, factors, residuals and history,
/// with other tables at its end; `command` makes it again from the job's `text`.
///
/// # Errors
/// The errors of [`moving()`](moving::moving) and of [`Report::agreement`].
pub fn report_page(
    report: &Report,
    extra: &[Table],
    command: &str,
    text: &str,
) -> Result<String, PresentError> {
    let class = if report.converged() {
        ""
    } else {
        " class=\"finding\""
    };
    let lead = format!("<strong>{}</strong>", escaped(&report.answer()));
    let answer = format!(
        "<p{class}>{}</p>\n<div class=\"first\">\n{}{}<div class=\"pairs\">\n{}{}</div>\n</div>\n",
        escaped(&report.words()),
        moving(report)?,
        factor_bars(report),
        pairing_plot(report),
        assurance_maps(report)?,
    );
    let all = |tables: &[Table]| tables.iter().map(table).collect::<String>();
    let optional = |found: Option<Table>| found.iter().map(table).collect::<String>();
    let job = format!(
        "<p>The job:</p>\n<pre><code>{}</code></pre>\n",
        escaped(text)
    );
    let trust = report.trust.as_ref().map(trust_table);
    let parts = [
        ("trust", "What to know", optional(trust)),
        ("modes", "Modes", table(&paired_table(report)?)),
        ("residuals", "Residuals", residual_map(report)),
        (
            "factors",
            "Factors",
            table(&factor_table(report)) + &optional(minima_table(report)),
        ),
        ("history", "History", table(&history_table(report))),
        (
            "derivatives",
            "Derivatives",
            derivative_map(report) + &optional(derivative_table(report)),
        ),
        ("others", "Further results", all(extra)),
        (
            "made",
            "How it was made",
            made("Units are the model's own", command) + &job,
        ),
    ];
    let parts = parts.into_iter().filter(|(.., body)| !body.is_empty());
    let parts =
        parts.map(|(id, heading, body)| named(&format!("{id}-section"), heading, heading, body));
    Ok(document(
        &report.title,
        &lead,
        &answer,
        &parts.collect::<Vec<_>>(),
    ))
}

/// The command and version that made a page, with words about its units.
pub fn made(units: &str, command: &str) -> String {
    format!(
        "<p>corfem {VERSION}, by the command</p>\n<pre><code>{}</code></pre>\n<p>{units}; frequency in hertz. The same command \
         gives the same page.</p>\n",
        escaped(command)
    )
}
