//! A table as data: numbers with their published counterparts, before any layout.

/// How a number is written for a reader.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Digits {
    /// This many digits after the point.
    Fixed(usize),
    /// This many significant digits, without an exponent.
    Significant(usize),
    /// This many digits after the point of the mantissa, with an exponent.
    Scientific(usize),
}

/// One cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Nothing.
    Blank,
    /// Words.
    Text(String),
    /// A number, and the one the paper prints for it if it prints any.
    Number {
        /// Computed here.
        computed: f64,
        /// Printed in the paper.
        published: Option<f64>,
        /// How it is written.
        digits: Digits,
    },
}

/// A column's heading.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name, unique in the table.
    pub name: String,
    /// Unit of its numbers: `Hz`, `in`, `%` or empty.
    pub unit: &'static str,
}

/// One row: its label, then a cell per column.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// What it is about, for example mode 3.
    pub label: String,
    /// Cells, as many as the table has columns.
    pub cells: Vec<Cell>,
}

/// A table.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Short name for files and for CSV, such as `table_3`.
    pub name: String,
    /// Title for readers.
    pub title: String,
    /// What the row labels are.
    pub label_heading: &'static str,
    /// Columns after the label.
    pub columns: Vec<Column>,
    /// Rows.
    pub rows: Vec<Row>,
    /// Sentences under the table.
    pub notes: Vec<String>,
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
                let magnitude = if value == 0.0 {
                    0
                } else {
                    // Rounded first: 99.996 has five digits before the point's second place once it is 100.00.
                    let rounded: f64 = format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value);
                    rounded.abs().log10().floor() as i64
                };
                let decimals = usize::try_from(digits as i64 - 1 - magnitude).unwrap_or(0);
                format!("{value:.decimals$}")
            }
        };
        let is_zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
        if is_zero { text.trim_start_matches('-').to_owned() } else { text }
    }
}
