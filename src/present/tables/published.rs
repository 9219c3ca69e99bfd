//! The paper's own tables, with nothing computed beside them.

use super::stages::stage_title;
use super::{in_words, remarks};
use crate::cases::published::PublishedTable;
use crate::present::PresentError;
use crate::present::table::{Cell, Table};

/// Ends of column headings, and the units that they stand for.
const UNITS: [(&str, &str); 4] = [("_hz", "Hz"), ("_in", "in"), ("_percent", "%"), ("_seconds", "s")];

/// A table from 2 to 13 as printed, with what is wrong in the print; Table 13 has the CPU seconds of the paper's runs.
///
/// # Errors
/// Those of [`PublishedTable::number`].
pub fn published_table(number: usize) -> Result<Table, PresentError> {
    let paper = PublishedTable::number(number)?;
    let labels = paper.labels.iter();
    let mut table = Table::new(format!("published_{number}"), &paper.title, "Row")
        .labels(labels.clone().map(|label| in_words(label)));
    for heading in &paper.headings {
        let unit = UNITS.iter().find(|(end, _)| heading.ends_with(end)).map_or("", |(_, unit)| unit);
        let cells = labels.clone().map(|label| paper.text(label, heading));
        let cells = cells.map(|text| text.map_or(Cell::Blank, |text| Cell::Printed(text.to_owned())));
        table = table.column(stage_title(heading), unit, cells);
    }
    Ok(table.notes(remarks(Some(&paper))))
}
