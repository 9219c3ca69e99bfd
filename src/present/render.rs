//! Tables as text for a terminal, as Markdown and as CSV.

use super::table::{Cell, Row, Table};
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
        let is_sentence = |cell: &Cell| matches!(cell, Cell::Sentence(_));
        let body = match &table.rows[..] {
            [] => Vec::new(),
            rows if rows.iter().any(|row| row.cells.iter().any(is_sentence)) => {
                vec![rows.iter().map(item).collect::<Vec<_>>().join("\n")]
            }
            _ => grids(table),
        };
        let notes = table.notes.iter().map(|note| wrapped(note));
        [wrapped(&table.title)]
            .into_iter()
            .chain(body)
            .chain(notes)
            .collect()
    })
}

/// Tables as Markdown; each computed number has the published one behind it in parentheses.
pub fn markdown(tables: &[Table]) -> String {
    let head = "Computed values; the paper's follow in parentheses.";
    paragraphs(tables, head, |table| {
        let line = |label: &str, cells: &mut dyn Iterator<Item = String>| {
            let cells = [label.to_owned()].into_iter().chain(cells);
            let cells = cells.map(|cell| one_line(&cell).replace('|', "\\|"));
            format!("| {} |", cells.collect::<Vec<_>>().join(" | "))
        };
        let mut headings = table.columns.iter().map(|column| match column.unit {
            "" => column.name.clone(),
            unit => format!("{}, {unit}", column.name),
        });
        let mut lines = vec![
            line(&table.label_heading, &mut headings),
            line("---", &mut table.columns.iter().map(|_| "---:".to_owned())),
        ];
        lines.extend(
            table
                .rows
                .iter()
                .map(|row| line(&row.label, &mut row.cells.iter().map(Cell::both))),
        );
        let notes = table.notes.iter().map(|note| one_line(note));
        let body = (!table.rows.is_empty()).then(|| lines.join("\n"));
        let title = format!("## {}", one_line(&table.title));
        [title].into_iter().chain(body).chain(notes).collect()
    })
}

/// Paragraphs of every table, below a line about published numbers where there are any.
fn paragraphs(tables: &[Table], head: &str, of: impl Fn(&Table) -> Vec<String>) -> String {
    let mut rows = tables.iter().flat_map(|table| &table.rows);
    let head = rows.any(Row::is_published).then(|| head.to_owned());
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

/// A column of text: the lines of its heading, then of every cell, with the published ones between them where a row has any.
struct TextColumn {
    cells: Vec<Vec<String>>,
    width: usize,
}

impl TextColumn {
    /// A column no wider than `most`.
    fn new(name: &str, unit: &str, cells: impl Iterator<Item = String>, most: usize) -> Self {
        let name = one_line(name);
        let cells: Vec<String> = cells.map(|cell| one_line(&cell)).collect();
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
        let cells = cells.iter().map(|cell| lines(cell.split(' '), width));
        Self {
            cells: [heading].into_iter().chain(cells).collect(),
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
        TextColumn::new(name, unit, cells, most)
    };
    let label = column(&table.label_heading, "", WIDTH / 2, &|row| {
        [row.label.clone(), PUBLISHED.to_owned()]
    });
    let width = WIDTH - label.width;
    let (mut parts, mut room): (Vec<Vec<TextColumn>>, _) = (Vec::new(), 0);
    for (at, own) in table.columns.iter().enumerate() {
        let both = |row: &Row| {
            let cell = &row.cells[at];
            [cell.computed(), cell.published().unwrap_or_default()]
        };
        let column = column(&own.name, own.unit, width - GAP, &both);
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

/// A row with a cell that is too long for a column: other cells, label, sentence.
fn item(row: &Row) -> String {
    let of = |is_sentence: bool, between| {
        let cells = row
            .cells
            .iter()
            .filter(|cell| matches!(cell, Cell::Sentence(_)) == is_sentence);
        cells.map(Cell::computed).collect::<Vec<_>>().join(between)
    };
    wrapped(&format!(
        "{} {}: {}",
        of(false, ", "),
        row.label,
        of(true, " ")
    ))
}

/// One part: headings, rows, and a rule below each.
fn grid(label: &TextColumn, columns: &[TextColumn]) -> String {
    let all = || columns.iter().chain([label]);
    let width = label.width
        + columns
            .iter()
            .map(|column| GAP + column.width)
            .sum::<usize>();
    let rule = "─".repeat(width);
    let mut out = Vec::new();
    for row in 0..label.cells.len() {
        let high = all()
            .map(|column| column.cells[row].len())
            .max()
            .unwrap_or(0);
        for at in 0..high {
            let text = |column: &TextColumn| {
                let lines = &column.cells[row];
                // Headings are aligned to the rule below: shorter ones begin lower.
                let at = if row == 0 {
                    (at + lines.len()).checked_sub(high)
                } else {
                    Some(at)
                };
                at.and_then(|at| lines.get(at)).cloned().unwrap_or_default()
            };
            let mut line = format!("{:<width$}", text(label), width = label.width);
            for column in columns {
                line += &format!("{:>width$}", text(column), width = GAP + column.width);
            }
            out.push(line.trim_end().to_owned());
        }
        if row == 0 {
            out.push(rule.clone());
        }
    }
    out.push(rule);
    out.join("\n")
}

/// A paragraph in lines of at most [`WIDTH`].
fn wrapped(paragraph: &str) -> String {
    lines(one_line(paragraph).split(' '), WIDTH).join("\n")
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
        pieces.extend(letters.is_empty().then(String::new));
        for piece in pieces {
            match lines.last_mut() {
                Some(line) if line.chars().count() + 1 + piece.chars().count() <= width => {
                    *line += &format!(" {piece}");
                }
                _ => lines.push(piece),
            }
        }
    }
    lines
}
