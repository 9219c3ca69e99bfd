//! Tables as text for a terminal, as Markdown and as CSV.

use super::table::{Cell, Row, Table};

/// No line of text is longer, characters.
pub const WIDTH: usize = 100;
/// Blanks between two columns of text.
const GAP: usize = 2;
/// Least width of a column whose heading has several words: room for `Pass 1` in one line.
const LEAST: usize = 6;
/// Label of a row of published numbers in text.
const PUBLISHED: &str = "  published";

/// Tables as text, no line of it longer than [`WIDTH`].
///
/// Published numbers stand in a row of their own below the computed ones. A table that is too wide continues below
/// itself with the columns that are left. (One label or cell wider than the page alone is left whole.)
pub fn text(tables: &[Table]) -> String {
    let head = "Computed numbers, the published ones in rows of their own below them.";
    paragraphs(tables, head, |table| {
        let notes = table.notes.iter().map(|note| wrapped(note));
        std::iter::once(wrapped(&table.title)).chain(grids(table)).chain(notes).collect()
    })
}

/// Tables as Markdown; each computed number has the published one behind it in parentheses.
pub fn markdown(tables: &[Table]) -> String {
    let head = "Computed numbers, the published ones behind them in parentheses.";
    paragraphs(tables, head, |table| {
        let headings = table.columns.iter().map(|column| match column.unit {
            "" => column.name.clone(),
            unit => format!("{}, {unit}", column.name),
        });
        let line = |label: &str, cells: Vec<String>| format!("| {label} | {} |", cells.join(" | "));
        let rule = vec!["---:".to_owned(); table.columns.len()];
        let mut lines = vec![line(table.label_heading, headings.collect()), line("---", rule)];
        for row in &table.rows {
            let cells = row.cells.iter().map(|cell| match cell.published() {
                Some(published) => format!("{} ({published})", cell.computed()),
                None => cell.computed(),
            });
            lines.push(line(&row.label, cells.collect()));
        }
        let notes = table.notes.iter().cloned();
        [format!("## {}", table.title), lines.join("\n")].into_iter().chain(notes).collect()
    })
}

/// Paragraphs of every table, below a line about published numbers where there are any.
fn paragraphs(tables: &[Table], head: &str, of: impl Fn(&Table) -> Vec<String>) -> String {
    let head = tables.iter().any(Table::is_published).then(|| head.to_owned());
    let paragraphs: Vec<String> = head.into_iter().chain(tables.iter().flat_map(of)).collect();
    paragraphs.join("\n\n") + "\n"
}

/// Tables as CSV, one number a line: `table,row,column,unit,computed,published`; ten significant digits computed,
/// and the published one as printed.
pub fn csv(tables: &[Table]) -> String {
    let mut out = "table,row,column,unit,computed,published\n".to_owned();
    for table in tables {
        for row in &table.rows {
            for (column, cell) in table.columns.iter().zip(&row.cells) {
                let (computed, published) = match cell {
                    Cell::Blank => continue,
                    Cell::Text(words) => (words.clone(), String::new()),
                    Cell::Printed(words) => (String::new(), words.clone()),
                    Cell::Number { computed, published, .. } => {
                        (ten_digits(*computed), published.map_or_else(String::new, |value| value.to_string()))
                    }
                };
                let fields = [&table.name, &row.label, &column.name, column.unit, &computed, &published];
                out += &(fields.map(quoted).join(",") + "\n");
            }
        }
    }
    out
}

/// A field of CSV, in quotes if it holds what would end it.
fn quoted(field: &str) -> String {
    let ends = field.contains([',', '"', '\n', '\r']);
    if ends { format!("\"{}\"", field.replace('"', "\"\"")) } else { field.to_owned() }
}

/// Ten significant digits in the shortest form that keeps them.
fn ten_digits(value: f64) -> String {
    format!("{value:.9e}").parse().unwrap_or(value).to_string()
}

/// A column of text: lines of its heading, and its cells with the published ones between them where a row has any.
struct TextColumn {
    heading: Vec<String>,
    cells: Vec<String>,
    width: usize,
}

impl TextColumn {
    fn new(name: &str, unit: &str, cells: Vec<String>) -> Self {
        let least = if name.contains(' ') { LEAST } else { 0 };
        let words = cells.iter().map(String::as_str).chain(name.split(' ')).chain([unit]);
        let width = words.map(|word| word.chars().count()).fold(least, usize::max);
        let mut heading = lines(name, width);
        heading.extend((!unit.is_empty()).then(|| unit.to_owned()));
        Self { heading, cells, width }
    }
}

/// The table, in as many parts side by side as its width asks for.
fn grids(table: &Table) -> Vec<String> {
    let has_published = |row: &Row| row.cells.iter().any(|cell| cell.published().is_some());
    let mut labels = Vec::new();
    for row in &table.rows {
        labels.push(row.label.clone());
        labels.extend(has_published(row).then(|| PUBLISHED.to_owned()));
    }
    let label = TextColumn::new(table.label_heading, "", labels);
    let mut parts: Vec<Vec<TextColumn>> = vec![Vec::new()];
    let mut used = label.width;
    for (at, column) in table.columns.iter().enumerate() {
        let mut cells = Vec::new();
        for row in &table.rows {
            let cell = row.cells.get(at).unwrap_or(&Cell::Blank);
            cells.push(cell.computed());
            cells.extend(has_published(row).then(|| cell.published().unwrap_or_default()));
        }
        let column = TextColumn::new(&column.name, column.unit, cells);
        if used + GAP + column.width > WIDTH && used > label.width {
            parts.push(Vec::new());
            used = label.width;
        }
        used += GAP + column.width;
        if let Some(part) = parts.last_mut() {
            part.push(column);
        }
    }
    parts.iter().map(|part| grid(&label, part)).collect()
}

/// One part: headings, rows, and a rule below each.
fn grid(label: &TextColumn, columns: &[TextColumn]) -> String {
    let line = |first: &str, cell: &dyn Fn(&TextColumn) -> String| {
        let mut line = format!("{first:<width$}", width = label.width);
        for column in columns {
            line += &format!("{:>width$}", cell(column), width = GAP + column.width);
        }
        line.trim_end().to_owned()
    };
    let all = || columns.iter().chain([label]);
    let high = all().map(|column| column.heading.len()).max().unwrap_or(0);
    // Headings stand on the rule: the shorter ones begin lower.
    let heading = |column: &TextColumn, at: usize| {
        (at + column.heading.len()).checked_sub(high).map_or_else(String::new, |row| column.heading[row].clone())
    };
    let mut lines: Vec<String> = (0..high).map(|at| line(&heading(label, at), &|column| heading(column, at))).collect();
    let rule = "─".repeat(label.width + columns.iter().map(|column| GAP + column.width).sum::<usize>());
    lines.push(rule.clone());
    lines.extend((0..label.cells.len()).map(|row| line(&label.cells[row], &|column| column.cells[row].clone())));
    lines.push(rule);
    lines.join("\n")
}

/// A paragraph in lines of at most [`WIDTH`].
fn wrapped(paragraph: &str) -> String {
    lines(paragraph, WIDTH).join("\n")
}

/// Words in lines of at most a width, but for a single word that is longer.
fn lines(words: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => *line += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
