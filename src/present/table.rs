//! A table as data: numbers with their published counterparts, before any layout.

use crate::files::test_data::quoted;
use serde::Serialize;
use serde_json::{Map, Value};

/// Digits of a frequency.
pub const HERTZ: Digits = Digits::Significant(4);
/// Digits of root mean squares in percent.
pub const RMS_PERCENT: Digits = Digits::Fixed(2);

/// Form in which a number is written for a reader.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Digits {
    /// This many digits after the point.
    Fixed(usize),
    /// This many significant digits, without an exponent unless more than four zeros would stand before or behind them.
    Significant(usize),
    /// This many digits after the point of the mantissa, with an exponent.
    Scientific(usize),
}

/// One cell.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// An empty cell.
    Blank,
    /// Words.
    Text(String),
    /// A sentence, too long for a column.
    Sentence(String),
    /// The paper's own text, with nothing computed for it.
    Printed(String),
    /// A number, and the one printed elsewhere for it if there is any.
    Number {
        /// Computed here.
        computed: f64,
        /// Printed in the paper.
        published: Option<f64>,
        /// Form in which it is written.
        #[serde(skip)]
        digits: Digits,
    },
}

/// A column's heading.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Column {
    /// Name, unique in the table.
    pub name: String,
    /// Unit of its numbers: `Hz`, `in`, `%` or empty.
    pub unit: &'static str,
}

/// One row: its label, then a cell per column.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The subject of the row, for example mode 3.
    pub label: String,
    /// Cells, as many as the table has columns.
    pub cells: Vec<Cell>,
}

/// A table.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Table {
    /// Short name for files and for CSV, such as `table_3`.
    pub name: String,
    /// Title for readers.
    pub title: String,
    /// Heading of the row labels.
    pub label_heading: String,
    /// Columns after the label.
    pub columns: Vec<Column>,
    /// Rows.
    pub rows: Vec<Row>,
    /// Sentences under the table.
    pub notes: Vec<String>,
}

impl Cell {
    /// A number, or nothing, with the published one if there is any.
    pub fn beside(
        computed: impl Into<Option<f64>>,
        digits: Digits,
        published: Option<f64>,
    ) -> Self {
        computed
            .into()
            .map_or(Self::Blank, |computed| Self::Number {
                computed,
                published,
                digits,
            })
    }

    /// A number, or nothing, with nothing published for it.
    pub fn number(computed: impl Into<Option<f64>>, digits: Digits) -> Self {
        Self::beside(computed, digits, None)
    }

    /// A count.
    pub fn count(count: usize) -> Self {
        Self::number(count as f64, Digits::Fixed(0))
    }

    /// Words.
    pub fn text(words: impl Into<String>) -> Self {
        Self::Text(words.into())
    }

    /// The published number for it.
    pub fn published(&self) -> Option<String> {
        match self {
            Self::Number {
                published, digits, ..
            } => published.map(|value| digits.write(value)),
            _ => None,
        }
    }

    /// The computed number with the published one in parentheses behind it, if there is one.
    pub fn both(&self) -> String {
        match self.published() {
            Some(published) => format!("{} ({published})", self.computed()),
            None => self.computed(),
        }
    }

    /// The computed number, or the words, or the paper's own text, as a reader sees them.
    pub fn computed(&self) -> String {
        match self {
            Self::Blank => String::new(),
            Self::Text(words) | Self::Sentence(words) | Self::Printed(words) => words.clone(),
            Self::Number {
                computed, digits, ..
            } => digits.write(*computed),
        }
    }
}

impl Table {
    /// True if the table has nothing to show.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty() && self.notes.is_empty()
    }
}

impl Row {
    /// True if any number has a published one behind it.
    pub(crate) fn is_published(&self) -> bool {
        self.cells.iter().any(|cell| cell.published().is_some())
    }
}

impl Table {
    /// A table without columns and rows.
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        label: impl Into<String>,
    ) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            label_heading: label.into(),
            ..Self::default()
        }
    }

    /// Rows as a table, of all their fields or of those that are chosen, as far as one of the rows has them. A field is a column by its
    /// name in words; the end of the name is its unit, and the first is the label.
    pub fn of(
        name: impl Into<String>,
        title: impl Into<String>,
        rows: &[impl Serialize],
        chosen: &[&str],
    ) -> Self {
        let rows = objects(rows);
        let is_there = |key: &&str| rows.iter().any(|row| cell(key, &row[*key]) != Cell::Blank);
        let keys: Vec<&str> = match (chosen, rows.first()) {
            ([], Some(row)) => row.keys().map(String::as_str).collect(),
            (_, row) => row.map_or(&[][..], |_| chosen).to_vec(),
        };
        let mut keys = keys.into_iter().filter(is_there);
        let Some(label) = keys.next() else {
            return Self::new(name, title, "");
        };
        let words = |row: &Map<String, Value>| cell(label, &row[label]).computed();
        let table = Self::new(name, title, heading(label).0).labels(rows.iter().map(words));
        keys.fold(table, |table, key| {
            let (words, unit) = heading(key);
            table.column(words, unit, rows.iter().map(|row| cell(key, &row[key])))
        })
    }

    /// The table with empty rows of these labels, for columns to fill.
    pub fn labels<L: ToString>(mut self, labels: impl IntoIterator<Item = L>) -> Self {
        labels.into_iter().for_each(|label| self.row(label, []));
        self
    }

    /// The table with one more column, its cells from the first row down; rows beyond the last stay blank.
    pub fn column(
        mut self,
        name: impl Into<String>,
        unit: &'static str,
        cells: impl IntoIterator<Item = Cell>,
    ) -> Self {
        self.columns.push(Column {
            name: name.into(),
            unit,
        });
        let cells = cells.into_iter().chain(std::iter::repeat(Cell::Blank));
        self.rows
            .iter_mut()
            .zip(cells)
            .for_each(|(row, cell)| row.cells.push(cell));
        self
    }

    /// The table with the headings of more columns of one unit, for rows to fill.
    pub fn headings<N: Into<String>>(
        self,
        names: impl IntoIterator<Item = N>,
        unit: &'static str,
    ) -> Self {
        names
            .into_iter()
            .fold(self, |table, name| table.column(name, unit, []))
    }

    /// Adds a row; columns beyond the last cell stay blank.
    pub fn row(&mut self, label: impl ToString, cells: impl IntoIterator<Item = Cell>) {
        let mut cells: Vec<Cell> = cells.into_iter().collect();
        cells.resize(self.columns.len(), Cell::Blank);
        self.rows.push(Row {
            label: label.to_string(),
            cells,
        });
    }

    /// The table with more sentences under it.
    pub fn notes<S: Into<String>>(mut self, sentences: impl IntoIterator<Item = S>) -> Self {
        self.notes.extend(sentences.into_iter().map(Into::into));
        self
    }
}

impl Digits {
    /// Writes a number.
    ///
    /// A value that rounds to zero is written without a sign, so that round-off cannot show.
    pub fn write(self, value: f64) -> String {
        let text = match self {
            Self::Fixed(decimals) => format!("{value:.decimals$}"),
            Self::Scientific(decimals) => return format!("{value:.decimals$e}"),
            Self::Significant(digits) => {
                // Rounded first: 99.996 has five digits before the point's second place once it is 100.00.
                let rounded = format!("{value:.*e}", digits.saturating_sub(1));
                let magnitude = rounded.split_once('e').and_then(|(_, e)| e.parse().ok());
                let decimals = digits as i64 - 1 - magnitude.unwrap_or(0);
                if value != 0.0 && !(-4..digits as i64 + 5).contains(&decimals) {
                    return rounded;
                }
                format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))
            }
        };
        let is_zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
        if is_zero {
            text.trim_start_matches('-').to_owned()
        } else {
            text
        }
    }
}

/// Rows as objects.
fn objects(rows: &[impl Serialize]) -> Vec<Map<String, Value>> {
    let rows = rows
        .iter()
        .filter_map(|row| match serde_json::to_value(row) {
            Ok(Value::Object(row)) => Some(row),
            _ => None,
        });
    rows.collect()
}

/// A field's name in words, and the unit that it ends with.
fn heading(key: &str) -> (String, &'static str) {
    let (name, unit) = match key.rsplit_once('_') {
        Some((name, "hz")) => (name, "Hz"),
        Some((name, "percent")) => (name, "%"),
        _ => (key, ""),
    };
    let name = name.replace('_', " ").replace("mac", "MAC");
    (name[..1].to_uppercase() + &name[1..], unit)
}

/// A field as a cell: a number by its unit, of any other unit with five digits and at most four behind the point.
fn cell(key: &str, value: &Value) -> Cell {
    match value {
        Value::Number(number) => match (number.as_f64(), heading(key).1) {
            (Some(own), "Hz") => Cell::number(own, HERTZ),
            (Some(own), "%") => Cell::number(own, Digits::Fixed(2)),
            (Some(own), _) if number.is_f64() => {
                let tens = own.abs().max(1.0).log10() as usize;
                Cell::number(own, Digits::Fixed(4_usize.saturating_sub(tens)))
            }
            (own, _) => Cell::number(own, Digits::Fixed(0)),
        },
        Value::Array(all) if !all.is_empty() && all.iter().all(Value::is_number) => {
            let all = all.iter().map(|own| cell(key, own).computed());
            Cell::text(all.collect::<Vec<_>>().join(", "))
        }
        _ => match words(value) {
            words if words.is_empty() => Cell::Blank,
            words if key == "words" => Cell::Sentence(words),
            words => Cell::text(words),
        },
    }
}

/// A value in words.
fn words(value: &Value) -> String {
    match value {
        Value::Null | Value::Bool(false) => String::new(),
        Value::Bool(true) => "yes".to_owned(),
        Value::String(words) => words.clone(),
        Value::Array(all) => all.iter().map(words).collect::<Vec<_>>().join(", "),
        other => other.to_string(),
    }
}

/// Rows as CSV for a script, under the names of their fields, every number with all its digits.
pub fn separated<R: Serialize + Default>(rows: &[R]) -> String {
    let line = |fields: Vec<String>| fields.join(",") + "\n";
    let field = |value: &Value| match value {
        Value::String(_) | Value::Array(_) => quoted(&words(value)),
        other => words(other),
    };
    let names = objects(&[R::default()]).into_iter();
    let names = names.map(|row| line(row.keys().cloned().collect()));
    let rows = objects(rows).into_iter();
    names
        .chain(rows.map(|row| line(row.values().map(field).collect())))
        .collect()
}

/// Numbers, or nothing, as cells.
pub fn numbers<N: Into<Option<f64>>>(
    values: impl IntoIterator<Item = N>,
    digits: Digits,
) -> impl Iterator<Item = Cell> {
    values
        .into_iter()
        .map(move |value| Cell::number(value, digits))
}

/// Fractions, or nothing, as cells in percent.
pub fn percents<N: Into<Option<f64>>>(
    fractions: impl IntoIterator<Item = N>,
    digits: Digits,
) -> impl Iterator<Item = Cell> {
    numbers(
        fractions
            .into_iter()
            .map(|fraction| fraction.into().map(|fraction| 100.0 * fraction)),
        digits,
    )
}

/// A number of things in words: `1 iteration`, `2 iterations`.
pub fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
