//! Tables, figures and the project's Markdown texts as HTML.

use crate::present::figures::Figure;
use crate::present::table::{Cell, Table};
use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};

/// A text as it stands in HTML.
pub(super) fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

pub(super) fn section(id: &str, heading: &str, body: &str) -> String {
    format!("<section id=\"{id}\">\n<h2>{heading}</h2>\n{body}</section>\n")
}

/// What is wider than the page and scrolls inside it.
fn scrolling(label: &str, body: &str) -> String {
    let label = escaped(label);
    format!("<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{label}\">\n{body}\n</div>\n")
}

pub(super) fn figure(figure: &Figure) -> String {
    let Figure { name, caption, svg } = figure;
    let (drawing, caption) = (scrolling(caption, svg), escaped(caption));
    let name = escaped(name);
    format!("<figure id=\"{name}\">\n{drawing}<figcaption>{caption}</figcaption>\n</figure>\n")
}

pub(super) fn table(table: &Table) -> String {
    let title = escaped(&table.title);
    let mut body = format!("<table id=\"{}\">\n<caption>{title}</caption>\n", escaped(&table.name));
    body += &format!("<thead><tr><th scope=\"col\">{}</th>", table.label_heading);
    for column in &table.columns {
        let unit = match column.unit {
            "" => String::new(),
            unit => format!("<br><span class=\"unit\">{unit}</span>"),
        };
        body += &format!("<th scope=\"col\">{}{unit}</th>", escaped(&column.name));
    }
    body += "</tr></thead>\n<tbody>\n";
    for row in &table.rows {
        let cells: String = row.cells.iter().map(cell).collect();
        body += &format!("<tr><th scope=\"row\">{}</th>{cells}</tr>\n", escaped(&row.label));
    }
    let mut out = scrolling(&table.title, &(body + "</tbody>\n</table>"));
    for note in &table.notes {
        out += &format!("<p class=\"note\">{}</p>\n", escaped(note));
    }
    out
}

fn cell(cell: &Cell) -> String {
    let published = cell.published().map(|it| format!(" <span class=\"published\">({it})</span>")).unwrap_or_default();
    format!("<td>{}{published}</td>", escaped(&cell.computed()))
}

/// A Markdown document without its title, or one of its sections without its heading, as HTML; headings that are left
/// stand one level lower.
pub(super) fn section_of(markdown: &str, heading: &str) -> String {
    let body = if heading.is_empty() {
        markdown.split_once('\n').map_or("", |(_, body)| body)
    } else {
        let start = format!("## {heading}\n");
        let after = markdown.split_once(&start).map_or("", |(_, after)| after);
        after.split("\n## ").next().unwrap_or_default()
    };
    let events = Parser::new_ext(body, Options::ENABLE_TABLES).flat_map(|event| match event {
        Event::Start(Tag::Table(alignment)) => {
            vec![Event::Html("<div class=\"scroll prose\" tabindex=\"0\">".into()), Event::Start(Tag::Table(alignment))]
        }
        Event::End(TagEnd::Table) => vec![Event::End(TagEnd::Table), Event::Html("</div>".into())],
        Event::Start(Tag::Heading { id, classes, attrs, .. }) => {
            vec![Event::Start(Tag::Heading { level: HeadingLevel::H3, id, classes, attrs })]
        }
        // Comments mark computed tables in the source.
        Event::Html(_) => Vec::new(),
        Event::End(TagEnd::Heading(_)) => vec![Event::End(TagEnd::Heading(HeadingLevel::H3))],
        other => vec![other],
    });
    let mut out = String::new();
    html::push_html(&mut out, events);
    out
}
