//! Tables as text for a terminal, as Markdown and as CSV.

use super::table::{Cell, Column, Row, Table};
use crate::files::test_data::quoted;
use crate::files::{inert, one_line};

/// Length of the longest line of text, characters.
pub const WIDTH: usize = 80;
/// Blanks between two columns of text.
const GAP: usize = 2;
/// Least width of a column whose heading has several words: room for `Pass 1` in one line.
const LEAST: usize = 6;
/// Label of a row of published numbers in text.
const PUBLISHED: &str = "  published";

/// Tables as text, no line of it longer than [`WIDTH`].
///
/// Published numbers stand in a row of their own below the computed ones. A table that is too wide continues below itself with the
/// other columns, and a cell that is too wide for its column continues on the next line.
pub fn text(tables: &[Table]) -> String {
    let head = "Computed values; the paper's are in the rows marked \"published\".";
    paragraphs(tables, head, |table| {
        let notes = table.notes.iter().map(|note| wrapped(&one_line(note)));
        let body = if table.rows.is_empty() {
            Vec::new()
        } else if table.has_sentences() {
            vec![list(table)]
        } else {
            grids(table)
        };
        std::iter::once(wrapped(&one_line(&table.title)))
            .chain(body)
            .chain(notes)
            .collect()
    })
}

/// Tables as Markdown; each computed number has the published one behind it in parentheses.
pub fn markdown(tables: &[Table]) -> String {
    let head = "Computed values; the paper's follow in parentheses.";
    paragraphs(tables, head, |table| {
        let headings = table.columns.iter().map(|column| match column.unit {
            "" => column.name.clone(),
            unit => format!("{}, {unit}", column.name),
        });
        let line = |label: &str, cells: Vec<String>| {
            let cells = [vec![label.to_owned()], cells].concat();
            let cells = cells.iter().map(|cell| one_line(cell).replace('|', "\\|"));
            format!("| {} |", cells.collect::<Vec<_>>().join(" | "))
        };
        let rule = vec!["---:".to_owned(); table.columns.len()];
        let mut lines = vec![
            line(table.label_heading, headings.collect()),
            line("---", rule),
        ];
        for row in &table.rows {
            let cells = row.cells.iter().map(|cell| match cell.published() {
                Some(published) => format!("{} ({published})", cell.computed()),
                None => cell.computed(),
            });
            lines.push(line(&row.label, cells.collect()));
        }
        let notes = table.notes.iter().map(|note| one_line(note));
        [format!("## {}", one_line(&table.title)), lines.join("\n")]
            .into_iter()
            .chain(notes)
            .collect()
    })
}

/// Paragraphs of every table, below a line about published numbers where there are any.
fn paragraphs(tables: &[Table], head: &str, of: impl Fn(&Table) -> Vec<String>) -> String {
    let head = tables
        .iter()
        .flat_map(|table| &table.rows)
        .any(Row::is_published)
        .then(|| head.to_owned());
    let shown = tables.iter().filter(|table| !table.is_empty());
    let paragraphs: Vec<String> = head.into_iter().chain(shown.flat_map(of)).collect();
    paragraphs.join("\n\n") + "\n"
}

/// Tables as CSV, one number a line: `table,row,column,unit,computed,published`; ten significant digits computed,
/// and the published one with the digits that a reader sees.
pub fn csv(tables: &[Table]) -> String {
    let mut out = "table,row,column,unit,computed,published\n".to_owned();
    for table in tables {
        for row in &table.rows {
            for (column, cell) in table.columns.iter().zip(&row.cells) {
                let (computed, published) = match cell {
                    Cell::Blank => continue,
                    Cell::Text(words) | Cell::Sentence(words) => (words.clone(), String::new()),
                    Cell::Printed(words) => (String::new(), words.clone()),
                    Cell::Number { computed, .. } => {
                        (ten_digits(*computed), cell.published().unwrap_or_default())
                    }
                };
                let fields = [
                    &table.name,
                    &row.label,
                    &column.name,
                    column.unit,
                    &computed,
                    &published,
                ];
                out += &(fields.map(field).join(",") + "\n");
            }
        }
    }
    out
}

/// A field of CSV that no spreadsheet takes for a formula, in quotes if it contains a separator or quote.
fn field(text: &str) -> String {
    if text.contains([',', '"']) {
        quoted(text)
    } else {
        inert(text)
    }
}

/// Ten significant digits in the shortest form that keeps them.
fn ten_digits(value: f64) -> String {
    format!("{value:.9e}").parse().unwrap_or(value).to_string()
}

/// A column of text: lines of its heading, and of its cells with the published ones between them where a row has any.
struct TextColumn {
    heading: Vec<String>,
    cells: Vec<Vec<String>>,
    width: usize,
}

impl TextColumn {
    /// A column no wider than `most`.
    fn new(name: &str, unit: &str, cells: Vec<String>, most: usize) -> Self {
        let name = one_line(name);
        let cells: Vec<String> = cells.iter().map(|cell| one_line(cell)).collect();
        let least = if name.contains(' ') { LEAST } else { 0 };
        let words = cells
            .iter()
            .map(String::as_str)
            .chain(name.split(' '))
            .chain([unit]);
        let width = words
            .map(|word| word.chars().count())
            .fold(least, usize::max)
            .min(most);
        let mut heading = lines(name.split(' '), width);
        heading.extend((!unit.is_empty()).then(|| unit.to_owned()));
        // Most cells are one word that fits.
        let is_whole = |cell: &str| !cell.contains(' ') && cell.chars().count() <= width;
        let cells = cells.into_iter().map(|cell| match is_whole(&cell) {
            true => vec![cell],
            false => lines(cell.split(' '), width),
        });
        Self {
            heading,
            cells: cells.collect(),
            width,
        }
    }
}

/// The table, in as many parts side by side as its width asks for.
fn grids(table: &Table) -> Vec<String> {
    let column = |name: &str, unit: &str, most: usize, both: &dyn Fn(&Row) -> [String; 2]| {
        let cells = table.rows.iter().flat_map(|row| {
            both(row)
                .into_iter()
                .take(1 + usize::from(row.is_published()))
        });
        TextColumn::new(name, unit, cells.collect(), most)
    };
    let label = column(table.label_heading, "", WIDTH / 2, &|row| {
        [row.label.clone(), PUBLISHED.to_owned()]
    });
    let width = WIDTH - label.width;
    let (mut parts, mut room): (Vec<Vec<TextColumn>>, _) = (Vec::new(), 0);
    for (at, Column { name, unit }) in table.columns.iter().enumerate() {
        let both = |row: &Row| {
            row.cells
                .get(at)
                .map(|cell| [cell.computed(), cell.published().unwrap_or_default()])
                .unwrap_or_default()
        };
        let column = column(name, unit, width - GAP, &both);
        if GAP + column.width > room {
            parts.push(Vec::new());
            room = width;
        }
        room -= GAP + column.width;
        if let Some(part) = parts.last_mut() {
            part.push(column);
        }
    }
    parts.iter().map(|part| grid(&label, part)).collect()
}

/// The rows one below the other, where a cell is too long for a column: label, other cells, sentence.
fn list(table: &Table) -> String {
    let of_row = |row: &Row| {
        let (sentences, others): (Vec<&Cell>, Vec<&Cell>) = row
            .cells
            .iter()
            .partition(|cell| matches!(cell, Cell::Sentence(_)));
        let join = |cells: Vec<&Cell>, between| {
            let words: Vec<String> = cells.into_iter().map(Cell::computed).collect();
            words.join(between)
        };
        wrapped(&one_line(&format!(
            "{} {}: {}",
            join(others, ", "),
            row.label,
            join(sentences, " ")
        )))
    };
    table.rows.iter().map(of_row).collect::<Vec<_>>().join("\n")
}

/// One part: headings, rows, and a rule below each.
fn grid(label: &TextColumn, columns: &[TextColumn]) -> String {
    let line = |text: &dyn Fn(&TextColumn) -> &str| {
        let mut line = format!("{:<width$}", text(label), width = label.width);
        for column in columns {
            line += &format!("{:>width$}", text(column), width = GAP + column.width);
        }
        line.truncate(line.trim_end().len());
        line
    };
    let high = columns
        .iter()
        .chain([label])
        .map(|column| column.heading.len())
        .max()
        .unwrap_or(0);
    fn heading(column: &TextColumn, row: Option<usize>) -> &str {
        row.map_or("", |row| &column.heading[row])
    }
    let rule = "─".repeat(
        label.width
            + columns
                .iter()
                .map(|column| GAP + column.width)
                .sum::<usize>(),
    );
    // Headings are aligned to the rule below: shorter ones begin lower.
    let row = |column: &TextColumn, at: usize| (at + column.heading.len()).checked_sub(high);
    let headings = (0..high).map(|at| line(&|column| heading(column, row(column, at))));
    let rows = (0..label.cells.len()).flat_map(|row| {
        let cells = columns
            .iter()
            .chain([label])
            .map(|column| column.cells[row].len());
        let line = &line;
        (0..cells.max().unwrap_or(0))
            .map(move |at| line(&|column| column.cells[row].get(at).map_or("", String::as_str)))
    });
    headings
        .chain([rule.clone()])
        .chain(rows)
        .chain([rule.clone()])
        .collect::<Vec<_>>()
        .join("\n")
}

/// A paragraph in lines of at most [`WIDTH`].
fn wrapped(paragraph: &str) -> String {
    lines(paragraph.split(' '), WIDTH).join("\n")
}

/// Words in lines of at most a width; a word that is longer continues on the next line.
pub fn lines<'a>(words: impl IntoIterator<Item = &'a str>, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words {
        let letters: Vec<char> = word.chars().collect();
        let mut pieces: Vec<String> = letters
            .chunks(width.max(1))
            .map(String::from_iter)
            .collect();
        if pieces.is_empty() {
            pieces.push(String::new());
        }
        for piece in pieces {
            match lines.last_mut() {
                Some(line) if line.chars().count() + 1 + piece.chars().count() <= width => {
                    *line += &format!(" {piece}")
                }
                _ => lines.push(piece),
            }
        }
    }
    lines
}
