//! The report as one web page that needs nothing beside it: the story, then tables, figures, assumptions, and what made it.
//!
//! Texts on the box and on the differences from the published results are those of `paper/`, so that they are written
//! once.

pub mod html;

use super::figures::{Figure, report_figures};
use super::report::Report;
use super::table::Table;
use super::tables::job::trust_table;
use super::tables::report::{derivative_table, factor_table, history_table, paired_table};
use crate::present::PresentError;
use html::{escaped, figure, figures, section, table};

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A section: its id, the words of a link to it, its heading, its HTML.
pub type Part = (String, String, String, String);

pub fn named(id: &str, link: &str, heading: &str, body: String) -> Part {
    (id.to_owned(), link.to_owned(), heading.to_owned(), body)
}

/// A whole page: its answer, then sections.
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
         <style>\n{}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n<p>{}</p>\n{answer}</header>\n\
         <nav aria-label=\"Contents\">\n{links}</nav>\n<main>\n{sections}</main>\n</body>\n</html>\n",
        include_str!("report.css"),
        escaped(lead),
    )
}

/// The report on one correlation: its outcome, modes, factors, structure and history, with other tables at its end; `command` makes
/// it again from the job's `text`.
///
/// # Errors
/// A figure that cannot be drawn; the errors of [`Report::agreement`], as in [`report_figures`].
pub fn report_page(
    report: &Report,
    extra: &[Table],
    command: &str,
    text: &str,
) -> Result<String, PresentError> {
    let figures = report_figures(report)?;
    let of = |tables: &[Table], whats: &[&str]| {
        part(
            tables,
            &figures,
            &whats
                .iter()
                .map(|what| format!("{}_{what}", report.name))
                .collect::<Vec<_>>(),
        )
    };
    let class = if report.converged() {
        ""
    } else {
        " class=\"finding\""
    };
    let words = format!("<p{class}>{}</p>\n", escaped(&report.words()));
    let shown = ["frequencies", "factors"].map(|what| of(&[], &[what]));
    let answer = words + &format!("<div class=\"answer\">\n{}</div>\n", shown.concat());
    let trust = report.trust.as_ref().map(trust_table);
    let trust: String = trust.iter().map(table).collect();
    let summary = trust + &table(&paired_table(report)?);
    let derivatives: Vec<Table> = derivative_table(report).into_iter().collect();
    let parts = [
        ("summary", "Summary", summary),
        ("factors", "Factors", of(&[factor_table(report)], &[])),
        ("structure", "Structure", of(&[], &["structure"])),
        (
            "modes",
            "Mode shapes",
            of(&[], &["mode_shapes", "agreement"]),
        ),
        (
            "history",
            "History",
            of(&[history_table(report)], &["errors"]),
        ),
        (
            "derivatives",
            "Derivatives",
            of(&derivatives, &["derivatives"]),
        ),
        ("others", "Further results", of(extra, &[])),
        (
            "made",
            "How it was made",
            made("Units are the model's own", command)
                + &format!(
                    "<p>The job:</p>\n<pre><code>{}</code></pre>\n",
                    escaped(text)
                ),
        ),
    ];
    let parts = parts.into_iter().filter(|(.., body)| !body.is_empty());
    let parts =
        parts.map(|(id, heading, body)| named(&format!("{id}-section"), heading, heading, body));
    let lead = "A finite element model, corrected until its natural frequencies and mode shapes agree with measured ones.";
    Ok(document(
        &report.title,
        lead,
        &answer,
        &parts.collect::<Vec<_>>(),
    ))
}

/// Tables, then the figures whose names begin with one of the prefixes.
pub fn part(tables: &[Table], drawn: &[Figure], prefixes: &[impl AsRef<str>]) -> String {
    let starts = |figure: &&Figure| {
        prefixes
            .iter()
            .any(|prefix| figure.name.starts_with(prefix.as_ref()))
    };
    let drawn = drawn.iter().filter(starts).map(|drawn| figure(drawn, ""));
    tables.iter().map(table).collect::<String>() + &figures("figures", drawn)
}

/// The command and version that made a page, with words about its units.
pub fn made(units: &str, command: &str) -> String {
    format!(
        "<p>corfem {VERSION}, by the command</p>\n<pre><code>{}</code></pre>\n<p>{units}; frequency in hertz. The same command \
         gives the same page.</p>\n",
        escaped(command)
    )
}
