//! A table as data: numbers with their published counterparts, before any layout.

use serde::Serialize;

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
    pub label_heading: &'static str,
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

    /// True if a column has sentences.
    pub(crate) fn has_sentences(&self) -> bool {
        let mut cells = self.rows.iter().flat_map(|row| &row.cells);
        cells.any(|cell| matches!(cell, Cell::Sentence(_)))
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
    pub fn new(name: impl Into<String>, title: impl Into<String>, label: &'static str) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            label_heading: label,
            ..Self::default()
        }
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

    /// The table without its blank columns.
    pub fn filled(mut self) -> Self {
        for at in (0..self.columns.len()).rev() {
            let is_blank = |row: &Row| row.cells[at].computed().is_empty();
            if !self.rows.is_empty() && self.rows.iter().all(is_blank) {
                self.columns.remove(at);
                self.rows
                    .iter_mut()
                    .for_each(|row| drop(row.cells.remove(at)));
            }
        }
        self
    }

    /// The table with only the columns of these names, in their order.
    pub fn only(mut self, names: &[&str]) -> Self {
        let columns = &self.columns;
        let place = |name: &&str| columns.iter().position(|column| column.name == **name);
        let kept: Vec<usize> = names.iter().filter_map(place).collect();
        for row in &mut self.rows {
            row.cells = kept.iter().map(|&at| row.cells[at].clone()).collect();
        }
        self.columns = kept.iter().map(|&at| self.columns[at].clone()).collect();
        self
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
