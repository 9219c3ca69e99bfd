//! Rendering of tables: text for a terminal, Markdown, CSV.

use super::table::{Cell, Table};
use comfy_table::presets::ASCII_MARKDOWN;
use comfy_table::{CellAlignment, ContentArrangement, LineStyle, TableStyle};

/// Lines under the headings and under the table alone.
const PLAIN: TableStyle = TableStyle::new()
    .header_separator(LineStyle::none().fill('─').junction('─'))
    .bottom_border(LineStyle::none().fill('─').junction('─'));

/// How a report is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Format {
    /// Tables for a terminal.
    #[default]
    Text,
    /// Tables in Markdown.
    Markdown,
    /// The whole history as JSON.
    Json,
    /// One number a line: table, row, column, unit, computed, published.
    Csv,
}

/// Tables as text or Markdown; each computed number has the published one behind it in parentheses.
pub fn render(tables: &[Table], markdown: bool) -> String {
    let lead = "Computed numbers, the published ones behind them in parentheses.\n\n";
    lead.to_owned() + &render_tables(tables, markdown)
}

/// Tables as text or Markdown, nothing before them.
pub fn render_tables(tables: &[Table], markdown: bool) -> String {
    let mut out = String::new();
    for table in tables {
        let heading = if markdown { "## " } else { "" };
        out.push_str(&format!("{heading}{}\n\n", table.title));
        out.push_str(&grid(table, markdown));
        out.push_str("\n\n");
        for note in &table.notes {
            out.push_str(&format!("{note}\n\n"));
        }
    }
    while out.ends_with("\n\n") {
        out.pop();
    }
    out
}

fn grid(table: &Table, markdown: bool) -> String {
    let mut grid = comfy_table::Table::new();
    grid.load_style(if markdown { ASCII_MARKDOWN } else { PLAIN });
    grid.set_content_arrangement(ContentArrangement::Disabled);
    // A terminal is narrow: there the unit stands on a line of its own.
    let separator = if markdown { ", " } else { "\n" };
    let headings = table.columns.iter().map(|column| match column.unit {
        "" => column.name.clone(),
        unit => format!("{}{separator}{unit}", column.name),
    });
    grid.set_header(std::iter::once(table.label_heading.to_owned()).chain(headings));
    for row in &table.rows {
        let cells = row.cells.iter().map(write_cell);
        grid.add_row(std::iter::once(row.label.clone()).chain(cells));
    }
    for column in grid.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    // The library pads every line to the table's width; a report has no use for spaces at line ends.
    let text = grid.to_string();
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    lines.join("\n")
}

fn write_cell(cell: &Cell) -> String {
    match cell {
        Cell::Blank => String::new(),
        Cell::Text(text) => text.clone(),
        Cell::Number {
            computed,
            published,
            digits,
        } => match published {
            Some(paper) => format!("{} ({})", digits.write(*computed), digits.write(*paper)),
            None => digits.write(*computed),
        },
    }
}

/// Tables as CSV, one number a line: `table,row,column,unit,computed,published`; ten significant digits computed,
/// and the published one as printed.
///
/// # Errors
/// [`crate::cases::error::CaseError::Table`] when the writer fails, which memory alone could make it do.
pub fn csv(tables: &[Table]) -> Result<String, crate::present::error::PresentError> {
    let failed = |found: String| crate::cases::error::CaseError::Table {
        name: "CSV output".into(),
        expected: "room for the tables".into(),
        found,
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut write = |fields: [&str; 6]| {
        writer
            .write_record(fields)
            .map_err(|error| failed(error.to_string()))
    };
    write(["table", "row", "column", "unit", "computed", "published"])?;
    for table in tables {
        for row in &table.rows {
            for (column, cell) in table.columns.iter().zip(&row.cells) {
                let (computed, published) = match cell {
                    Cell::Blank => continue,
                    Cell::Text(text) => (text.clone(), String::new()),
                    Cell::Number {
                        computed,
                        published,
                        ..
                    } => (
                        ten_digits(*computed),
                        published.map_or_else(String::new, |value| value.to_string()),
                    ),
                };
                write([
                    &table.name,
                    &row.label,
                    &column.name,
                    column.unit,
                    &computed,
                    &published,
                ])?;
            }
        }
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| failed(error.to_string()))?;
    Ok(String::from_utf8(bytes).map_err(|error| failed(error.to_string()))?)
}

/// Ten significant digits in the shortest form that keeps them.
fn ten_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    rounded.to_string()
}
