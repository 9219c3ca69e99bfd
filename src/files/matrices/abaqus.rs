//! Matrices as Abaqus writes them by labels (`MATRIX GENERATE` with `MATRIX OUTPUT, FORMAT=MATRIX INPUT`): a line
//! `node, component, node, component, value` for every entry.

use super::{Digits, Label, LabeledMatrix, labeled, mirrored};
use crate::files::deck::number::real;
use crate::files::error::{FileError, is_not};

const ENTRY: &str = "an entry of five cells: node, component, node, component, value";

/// Reads a matrix, symmetric by one triangle or both; none if the first line that no star begins is no such entry.
///
/// Nodes without a number of the user's own, of contact or of constraints, have none or a negative one: such a matrix is refused.
pub fn read(file: &str, text: &str) -> Option<Result<LabeledMatrix, FileError>> {
    let lines = (1..)
        .zip(text.lines().map(str::trim))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('*'));
    let (_, first) = lines.clone().next()?;
    let is_labeled = first.split(',').count() == 5 && !first.contains(char::is_alphabetic);
    (is_labeled || entry(first).is_some()).then(|| {
        let mut digits = Digits::default();
        let wrong = |number, line| FileError::line(file, number, is_not(line, ENTRY));
        let entries = lines.map(|(number, line)| {
            let (text, own) = entry(line).ok_or_else(|| wrong(number, line))?;
            digits.add(text);
            Ok(own)
        }).collect::<Result<Vec<_>, FileError>>()?;
        let entries = mirrored(entries).map_err(|both| {
            let [row, column] =
                both.map(|own: Label| format!("node {}, component {}", own.grid, own.component));
            let reason = format!(
                "the entries of {row} with {column} and the other way round differ, or one of them is missing"
            );
            FileError::refused(file, reason)
        })?;
        labeled(entries, true, digits, None)
    })
}

/// An entry by the labels of its row and column, behind its number as it is written.
fn entry(line: &str) -> Option<(&str, (Label, Label, f64))> {
    let mut cells = line.trim_end_matches(',').split(',').map(str::trim);
    let mut label = || {
        let grid = cells.next()?.parse().ok().filter(|grid| *grid > 0)?;
        let component = cells
            .next()?
            .parse()
            .ok()
            .filter(|own| (1..=6).contains(own))?;
        Some(Label { grid, component })
    };
    let (row, column) = (label()?, label()?);
    let text = cells.next()?;
    let own = (row, column, real(text)?);
    cells.next().is_none().then_some((text, own))
}
