//! The report as one web page that needs nothing beside it: the answer, the structure moving and charts of the rows on its first screen,
//! then tables, and what made it. Charts are drawn by the page's script from the same JSON that scripts read.

use super::json::unturned;
use super::report::Report;
use super::table::{Cell, Column, Row, Table};
use crate::present::PresentError;
use serde::Serialize;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A section: its id, the words of a link to it, its heading, its HTML.
pub type Part = (String, String, String, String);

/// A section of these parts.
pub fn named(id: &str, link: &str, heading: &str, body: String) -> Part {
    (id.to_owned(), link.to_owned(), heading.to_owned(), body)
}

/// A template with every second piece between `@` replaced by what has its name.
pub fn filled(template: &str, values: &[(&str, &str)]) -> String {
    let value = |(at, piece): (usize, &str)| match at % 2 {
        0 => piece.to_owned(),
        _ => values
            .iter()
            .find(|own| own.0 == piece)
            .map_or("", |own| own.1)
            .to_owned(),
    };
    template.split('@').enumerate().map(value).collect()
}

/// A text as it stands in HTML.
pub fn escaped(text: &str) -> String {
    let text = crate::files::escaped(text)
        .replace('&', "&amp;")
        .replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

/// A value as a script reads it.
///
/// # Errors
/// [`PresentError::Json`].
pub fn in_script(value: &impl Serialize) -> Result<String, PresentError> {
    // A name may hold what ends a script.
    Ok(unturned(&serde_json::to_string(value)?).replace('<', "\\u003c"))
}

/// A whole page: its answer, then sections. It has the scripts of charts and of moving structures.
pub fn document(title: &str, lead: &str, answer: &str, parts: &[Part]) -> String {
    let link = |(id, link, ..): &Part| format!("<a href=\"#{id}\">{link}</a>\n");
    let section = |(id, _, heading, body): &Part| {
        format!("<section id=\"{id}\">\n<h2>{heading}</h2>\n{body}</section>\n")
    };
    filled(
        include_str!("page/page.html"),
        &[
            ("VERSION", VERSION),
            ("TITLE", &escaped(title)),
            ("STYLE", include_str!("page/report.css")),
            (
                "SCRIPT",
                concat!(
                    include_str!("page/report.js"),
                    include_str!("page/moving.js")
                ),
            ),
            ("LEAD", lead),
            ("ANSWER", answer),
            ("LINKS", &parts.iter().map(link).collect::<String>()),
            ("SECTIONS", &parts.iter().map(section).collect::<String>()),
        ],
    )
}

/// The structure moving in its modes: test, first and corrected model side by side, from the words of a script for the rows of a report and
/// its drawing.
pub fn moving(data: &str) -> String {
    filled(include_str!("page/moving.html"), &[("DATA", data)])
}

/// The report on one job.
///
/// # Errors
/// [`PresentError::Json`].
pub fn report_page(report: &Report) -> Result<String, PresentError> {
    let moving = match &report.drawing {
        Some(drawing) => moving(&format!("{{...report, drawing: {}}}", in_script(drawing)?)),
        None => String::new(),
    };
    let answer = filled(
        include_str!("page/job.html"),
        &[
            ("CLASS", if report.is_within { "" } else { "finding" }),
            ("VERDICT", &escaped(&report.verdict)),
            ("REPORT", &in_script(report)?),
            ("MOVING", &moving),
        ],
    );
    let tables: String = report.tables().iter().map(table).collect();
    let charts = "<script>deviations(report.modes, report.readings)</script>\n\
        <script>slopes(report.parameters, report.modes, report.derivatives)</script>\n";
    let job = format!(
        "<p>The job:</p>\n<pre><code>{}</code></pre>\n",
        escaped(&report.job)
    );
    let made = made("Units are the model's own", &report.command) + &job;
    let parts = [
        named(
            "tables-section",
            "Tables",
            "What to know, and all numbers",
            tables,
        ),
        named(
            "charts-section",
            "Charts",
            "Residuals and derivatives",
            charts.to_owned(),
        ),
        named("made-section", "How it was made", "How it was made", made),
    ];
    let lead = format!("<strong>{}</strong>", escaped(&report.answer));
    Ok(document(&report.title, &lead, &answer, &parts))
}

/// The command and version that made a page, with words about its units.
pub fn made(units: &str, command: &str) -> String {
    let values = [
        ("VERSION", VERSION),
        ("COMMAND", &escaped(command)),
        ("UNITS", units),
    ];
    filled(include_str!("page/made.html"), &values)
}

/// A table in a block that scrolls inside the page if it is wider.
pub fn table(table: &Table) -> String {
    if table.is_empty() {
        return String::new();
    }
    let heading = |column: &Column| {
        let unit = match column.unit {
            "" => String::new(),
            unit => format!("<br><span class=\"unit\">{unit}</span>"),
        };
        format!("<th scope=\"col\">{}{unit}</th>", escaped(&column.name))
    };
    let row = |row: &Row| {
        let cells: String = row.cells.iter().map(cell).collect();
        format!(
            "<tr><th scope=\"row\">{}</th>{cells}</tr>\n",
            escaped(&row.label)
        )
    };
    let note = |note: &String| format!("<p class=\"note\">{}</p>\n", escaped(note));
    filled(
        include_str!("page/table.html"),
        &[
            ("NAME", &escaped(&table.name)),
            ("TITLE", &escaped(&table.title)),
            ("LABEL", &table.label_heading),
            (
                "HEADINGS",
                &table.columns.iter().map(heading).collect::<String>(),
            ),
            ("ROWS", &table.rows.iter().map(row).collect::<String>()),
            ("NOTES", &table.notes.iter().map(note).collect::<String>()),
        ],
    )
}

fn cell(cell: &Cell) -> String {
    let published = cell.published();
    let published = published.map(|it| format!(" <span class=\"published\">({it})</span>"));
    let class = match cell {
        Cell::Sentence(_) => " class=\"sentence\"",
        _ => "",
    };
    format!(
        "<td{class}>{}{}</td>",
        escaped(&cell.computed()),
        published.unwrap_or_default()
    )
}
