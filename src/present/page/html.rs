//! Tables, figures and the project's Markdown texts as HTML.

use crate::present::figures::Figure;
use crate::present::table::{Cell, Table};
use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};

/// A text as it stands in HTML.
pub fn escaped(text: &str) -> String {
    let text = crate::files::escaped(text)
        .replace('&', "&amp;")
        .replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

pub fn section(id: &str, heading: &str, body: &str) -> String {
    format!("<section id=\"{id}\">\n<h2>{heading}</h2>\n{body}</section>\n")
}

/// A block that scrolls inside the page if it is wider.
fn scrolling(label: &str, body: &str) -> String {
    let label = escaped(label);
    format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{label}\">\n{body}\n</div>\n"
    )
}

/// A figure; `see` says before the caption what to look for.
pub fn figure(Figure { name, caption, svg }: &Figure, see: &str) -> String {
    let (drawing, caption, name) = (scrolling(caption, svg), escaped(caption), escaped(name));
    let see = if see.is_empty() {
        String::new()
    } else {
        format!("<strong>{}</strong> ", escaped(see))
    };
    format!("<figure id=\"{name}\">\n{drawing}<figcaption>{see}{caption}</figcaption>\n</figure>\n")
}

/// Figures side by side where there is room.
pub fn figures(class: &str, figures: impl Iterator<Item = String>) -> String {
    let figures: String = figures.collect();
    if figures.is_empty() {
        figures
    } else {
        format!("<div class=\"{class}\">\n{figures}</div>\n")
    }
}

pub fn table(table: &Table) -> String {
    if table.is_empty() {
        return String::new();
    }
    let title = escaped(&table.title);
    let mut body = format!(
        "<table id=\"{}\">\n<caption>{title}</caption>\n",
        escaped(&table.name)
    );
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
        body += &format!(
            "<tr><th scope=\"row\">{}</th>{cells}</tr>\n",
            escaped(&row.label)
        );
    }
    let mut out = scrolling(&table.title, &(body + "</tbody>\n</table>"));
    for note in &table.notes {
        out += &format!("<p class=\"note\">{}</p>\n", escaped(note));
    }
    out
}

fn cell(cell: &Cell) -> String {
    let published = cell
        .published()
        .map(|it| format!(" <span class=\"published\">({it})</span>"))
        .unwrap_or_default();
    let class = match cell {
        Cell::Sentence(_) => " class=\"sentence\"",
        _ => "",
    };
    format!("<td{class}>{}{published}</td>", escaped(&cell.computed()))
}

/// A section of a Markdown document without its heading, as HTML.
pub fn section_of(markdown: &str, heading: &str) -> String {
    let after = markdown
        .split_once(&format!("## {heading}\n"))
        .map_or("", |(_, after)| after);
    prose(after.split("\n## ").next().unwrap_or_default())
}

/// Markdown as HTML; headings stand one level lower.
pub fn prose(markdown: &str) -> String {
    let events = Parser::new_ext(markdown, Options::ENABLE_TABLES).flat_map(|event| match event {
        Event::Start(Tag::Table(alignment)) => {
            vec![
                Event::Html("<div class=\"scroll prose\" tabindex=\"0\">".into()),
                Event::Start(Tag::Table(alignment)),
            ]
        }
        Event::End(TagEnd::Table) => vec![Event::End(TagEnd::Table), Event::Html("</div>".into())],
        Event::Start(Tag::Heading {
            id, classes, attrs, ..
        }) => {
            vec![Event::Start(Tag::Heading {
                level: HeadingLevel::H3,
                id,
                classes,
                attrs,
            })]
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
