//! The paper's own tables, as printed, from `paper/tables/`.
//!
//! Reports show them next to the computed numbers, and tests compare with them. Only the definitions of the cases (Table 2)
//! are computed from them.

use crate::torque_box::error::CaseError;
use std::collections::HashMap;

macro_rules! tables {
    ($($number:literal)*) => {
        [$(($number, include_str!(concat!("../../paper/tables/table_", $number, ".csv")))),*]
    };
}
const TABLES: [(usize, &str); 12] = tables!(2 3 4 5 6 7 8 9 10 11 12 13);

/// The beginning of comments that note misprints.
const REMARKS: [&str; 3] = ["misprint:", "inconsistent:", "borderline:"];

/// One published table: text cells by row label and column heading.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedTable {
    /// Number in the paper; zero for a table that is not the paper's.
    pub number: usize,
    /// Name for messages, such as `paper/tables/table_3.csv`.
    pub name: String,
    /// Description of the contents, in our words; empty if the file has none.
    pub title: String,
    /// Column headings after the first.
    pub headings: Vec<String>,
    /// Row labels, in the order printed.
    pub labels: Vec<String>,
    /// The misprints and inconsistencies, one sentence each.
    pub remarks: Vec<String>,
    cells: HashMap<(String, String), String>,
}

impl PublishedTable {
    /// The published table of a number from 2 to 13.
    ///
    /// # Errors
    /// [`CaseError::Table`] for another number (Table 1's numbers are lost in the scan) or damaged data.
    pub fn number(number: usize) -> Result<Self, CaseError> {
        let name = format!("paper/tables/table_{number}.csv");
        match TABLES.iter().find(|(known, _)| *known == number) {
            Some((_, text)) => Self::parse(number, &name, text),
            None => Err(CaseError::table(
                &name,
                "a table from 2 to 13".into(),
                number.to_string(),
            )),
        }
    }

    /// Reads a table from CSV text with a heading line; lines that start with `#` are comments.
    ///
    /// # Errors
    /// [`CaseError::Table`] for rows of unequal length.
    pub fn parse(number: usize, name: &str, text: &str) -> Result<Self, CaseError> {
        // No cell of these tables holds a comma or a quote.
        let rows = text
            .lines()
            .filter(|line| !line.starts_with('#') && !line.is_empty());
        let mut rows = rows.map(|line| line.split(',').map(str::to_owned));
        let headings: Vec<String> = rows.next().into_iter().flatten().skip(1).collect();
        let (mut labels, mut cells) = (Vec::new(), HashMap::new());
        for mut row in rows {
            let label = row.next().unwrap_or_default();
            let row: Vec<String> = row.collect();
            if row.len() != headings.len() {
                let expected = format!("{} cells in row {label}", headings.len());
                return Err(CaseError::table(name, expected, row.len().to_string()));
            }
            let keys = headings
                .iter()
                .map(|heading| (label.clone(), heading.clone()));
            cells.extend(keys.zip(row));
            labels.push(label);
        }
        let title = text
            .lines()
            .next()
            .and_then(|line| line.strip_prefix("# "))
            .unwrap_or_default()
            .to_owned();
        let comments = text.lines().filter_map(|line| line.strip_prefix("# "));
        let remarks =
            comments.filter(|comment| REMARKS.iter().any(|kind| comment.starts_with(kind)));
        let remarks = remarks.map(str::to_owned).collect();
        Ok(Self {
            number,
            title,
            remarks,
            name: name.to_owned(),
            headings,
            labels,
            cells,
        })
    }

    /// A cell's text; `None` where the paper prints nothing or has no such row or column.
    pub fn text(&self, label: &str, heading: &str) -> Option<&str> {
        self.cells
            .get(&(label.to_owned(), heading.to_owned()))
            .map(String::as_str)
            .filter(|cell| !cell.is_empty())
    }

    /// A cell's number; `None` where there is none.
    pub fn value(&self, label: &str, heading: &str) -> Option<f64> {
        self.text(label, heading)?.parse().ok()
    }

    /// A cell's number, which must be there.
    ///
    /// # Errors
    /// [`CaseError::Table`] naming the cell.
    pub fn required(&self, label: &str, heading: &str) -> Result<f64, CaseError> {
        self.value(label, heading).ok_or_else(|| {
            let expected = format!("a number in row {label}, column {heading}");
            CaseError::table(
                &self.name,
                expected,
                self.text(label, heading).unwrap_or("nothing"),
            )
        })
    }
}
