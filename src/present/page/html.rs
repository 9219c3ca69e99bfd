//! Texts, sections and tables as HTML.

use crate::present::table::{Cell, Table};

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
pub fn scrolling(label: &str, body: &str) -> String {
    let label = escaped(label);
    format!(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{label}\">\n{body}\n</div>\n"
    )
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
