//! Matrices as Abaqus writes them by labels (`MATRIX GENERATE` with `MATRIX OUTPUT, FORMAT=MATRIX INPUT`): a line
//! `node, component, node, component, value` for every entry.

use super::{Digits, Label, LabeledMatrix, mirrored};
use crate::files::deck::number::real;
use crate::files::error::{FileError, is_not};
use crate::sparse::SparseMatrix;
use std::collections::BTreeSet;

const ENTRY: &str = "an entry of five cells: node, component, node, component, value";

/// An entry by the labels of its row and column.
struct Entry<'a> {
    labels: [Label; 2],
    text: &'a str,
    value: f64,
}

/// Reads a matrix, symmetric by one triangle or both; none if the first line that no star begins is no such entry.
///
/// Nodes without a number of the user's own, of contact or of constraints, have none or a negative one: such a matrix is refused.
pub(super) fn read(file: &str, text: &str) -> Option<Result<LabeledMatrix, FileError>> {
    let lines = || {
        let lines = (1..).zip(text.lines().map(str::trim));
        lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('*'))
    };
    let (_, first) = lines().next()?;
    let is_labeled = first.split(',').count() == 5 && !first.contains(char::is_alphabetic)
        || entry(first).is_some();
    is_labeled.then(|| {
        let wrong = |number, line| FileError::line(file, number, is_not(line, ENTRY));
        let entries = lines().map(|(number, line)| entry(line).ok_or_else(|| wrong(number, line)));
        of_entries(file, &entries.collect::<Result<Vec<_>, _>>()?)
    })
}

fn entry(line: &str) -> Option<Entry<'_>> {
    let cells: Vec<&str> = line
        .trim_end_matches(',')
        .split(',')
        .map(str::trim)
        .collect();
    let &[node, component, other_node, other_component, text] = cells.as_slice() else {
        return None;
    };
    let label = |grid: &str, component: &str| {
        let grid = grid.parse().ok().filter(|grid| *grid > 0)?;
        let component = component.parse().ok().filter(|own| (1..=6).contains(own))?;
        Some(Label { grid, component })
    };
    Some(Entry {
        labels: [label(node, component)?, label(other_node, other_component)?],
        text,
        value: real(text)?,
    })
}

fn of_entries(file: &str, entries: &[Entry]) -> Result<LabeledMatrix, FileError> {
    let labels: BTreeSet<Label> = entries.iter().flat_map(|entry| entry.labels).collect();
    let labels: Vec<Label> = labels.into_iter().collect();
    let place = |label: Label| labels.partition_point(|other| *other < label);
    let mut digits = Digits::default();
    let of_place = |entry: &Entry| {
        digits.add(entry.text);
        let [row, column] = entry.labels.map(place);
        (row, column, entry.value)
    };
    let placed = entries.iter().map(of_place).collect();
    let placed = mirrored(placed).map_err(|(row, column)| {
        let [row, column] = [labels[row], labels[column]];
        let name = |label: Label| format!("node {}, component {}", label.grid, label.component);
        let (row, column) = (name(row), name(column));
        FileError::refused(
            file,
            format!("the entries of {row} with {column} and the other way round differ, or one of them is missing"),
        )
    })?;
    let matrix = SparseMatrix::new("matrix of a file", labels.len(), labels.len(), placed)?;
    Ok(LabeledMatrix {
        rows: Some(labels.clone()),
        columns: Some(labels),
        matrix: matrix.with_half_unit(digits.half_unit()),
        dmig: None,
    })
}
