//! The paper's own tables, with nothing computed beside them.

use super::stages::stage_title;
use super::{Cell, PresentError, Table, in_words, remarks};
use crate::cases::published::PublishedTable;

/// Ends of column headings, and the units that they stand for.
const UNITS: [(&str, &str); 4] = [("_hz", "Hz"), ("_in", "in"), ("_percent", "%"), ("_seconds", "s")];

/// A table from 2 to 13 as printed, with what is wrong in the print; Table 13 has the CPU seconds of the paper's runs.
///
/// # Errors
/// Those of [`PublishedTable::number`].
pub fn published_table(number: usize) -> Result<Table, PresentError> {
    let paper = PublishedTable::number(number)?;
    let mut table = Table::new(format!("published_{number}"), &paper.title, "Row");
    for heading in &paper.headings {
        let unit = UNITS.iter().find(|(end, _)| heading.ends_with(end));
        table = table.column(stage_title(heading), unit.map_or("", |(_, unit)| unit));
    }
    for label in &paper.labels {
        let cell = |heading| paper.text(label, heading).map_or(Cell::Blank, |text| Cell::Printed(text.to_owned()));
        table.row(in_words(label), paper.headings.iter().map(|heading| cell(heading)));
    }
    table.notes = remarks(Some(&paper));
    Ok(table)
}
