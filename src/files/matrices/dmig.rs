//! DMIG cards of bulk data: matrices at grids and components, as NASTRAN takes and punches them.

use super::{Digits, FoundMatrices, Label, LabeledMatrix, is_wanted, labeled};
use crate::files::deck::{Card, Cards, cards};
use crate::files::error::{FileError, ensure};
use crate::sparse::SparseMatrix;
use std::collections::{BTreeMap, HashSet};

/// Reads the matrices of this name, or all. A header (field 3 is 0) has the form in field 4, 1 square, 2 or 9 rectangular, 6
/// symmetric, and in field 5 the type, 1 or 2 for real; the other cards are columns, and their entries are four fields each.
///
/// Rows and columns of a square or symmetric matrix have one list of labels; those that no card names are not in it. A
/// symmetric matrix has every pair of places on one card alone, in either triangle.
pub fn read(file: &str, text: &str, wanted: Option<&str>) -> Result<FoundMatrices, FileError> {
    let cards = cards(file, &own_lines(text))?;
    let (headers, others): (Vec<&Card>, Vec<&Card>) =
        cards.iter().partition(|card| card.text(3) == "0");
    let names: Vec<String> = headers.iter().map(|own| own.text(2).to_owned()).collect();
    for card in &others {
        ensure(names.iter().any(|name| name == card.text(2)), || {
            card.wrong(2, "the name of a matrix with a header")
        })?;
    }
    let matrices = headers
        .into_iter()
        .filter(|header| is_wanted(header.text(2), wanted))
        .map(|header| {
            let own = others.iter().filter(|card| card.text(2) == header.text(2));
            matrix(header, own.copied())
        });
    Ok((names, matrices.collect::<Result<_, _>>()?))
}

/// The text with the lines of DMIG cards alone, the others empty: whatever else a file has, before and behind its bulk data.
fn own_lines(text: &str) -> String {
    let mut is_own = false;
    text.lines()
        .map(|line| {
            let continues = line.starts_with(['+', '*', ' ', '\t', ',']) && !line.trim().is_empty();
            is_own = super::begins(line.trim_start(), "DMIG") || is_own && continues;
            if is_own { line } else { "" }
        })
        .collect::<Vec<_>>()
        .join("\n")
}

fn matrix<'a>(
    header: &Card,
    cards: impl Iterator<Item = &'a Card>,
) -> Result<LabeledMatrix, FileError> {
    let form = header.text(4);
    let is_symmetric = form == "6";
    ensure(["1", "2", "6", "9"].contains(&form), || {
        header.wrong(4, "a form (1, 2, 6 or 9)")
    })?;
    ensure(["1", "2"].contains(&header.text(5)), || {
        header.wrong(5, "the type of a real matrix (1 or 2)")
    })?;
    let (mut entries, mut places, mut digits) = (Vec::new(), HashSet::new(), Digits::default());
    for card in cards {
        let column = label(card, 3)?;
        // Two entries to a line, in fields 2 and 6, but one to the first.
        for entry in 1..card.fields.len() / 4 {
            let start = 10 * (entry / 2) + [2, 6][entry % 2];
            if (start..start + 4).all(|field| card.text(field).is_empty()) {
                continue;
            }
            let (row, value) = (label(card, start)?, card.optional_real(start + 2)?);
            let value = value.ok_or_else(|| card.wrong(start + 2, "a real number"))?;
            card.absent(start + 3, "complex matrices")?;
            digits.add(card.text(start + 2));
            let is_first = !(is_symmetric && places.contains(&(column, row)));
            ensure(places.insert((row, column)) && is_first, || {
                card.error(start, "another entry has this place of the matrix")
            })?;
            entries.push((row, column, value));
            if is_symmetric && row != column {
                entries.push((column, row, value));
            }
        }
    }
    let is_square = is_symmetric || form == "1";
    labeled(entries, is_square, digits, Some(header.text(2).to_owned()))
}

/// A matrix as DMIG cards with these labels of its rows and columns, every number by the nearest of a field; of a symmetric one the lower
/// triangle.
///
/// # Errors
/// [`Error::Value`](crate::method::error::Error::Value) and [`Error::Count`](crate::method::error::Error::Count) for numbers that no card
/// can hold.
pub fn write_dmig(
    name: &str,
    labels: &[Label],
    matrix: &SparseMatrix,
) -> Result<String, FileError> {
    let form = if matrix.is_symmetric() { 6 } else { 1 };
    let at = |row: usize| format!("{},{}", labels[row].grid, labels[row].component);
    let mut columns = BTreeMap::new();
    for (row, column, value) in matrix.entries() {
        if value != 0.0 && (form == 1 || row >= column) {
            let entries: &mut String = columns
                .entry(column)
                .or_insert_with(|| format!("{name},{}", at(column)));
            *entries += &format!(",,{},{value:?}", at(row));
        }
    }
    let mut cards = Cards::default();
    cards.push("DMIG", &format!("{name},0,{form},2,0"))?;
    columns
        .values()
        .try_for_each(|entries| cards.push("DMIG", entries))?;
    Ok(cards.text)
}

/// A grid in a field and its component, blank or 0 for a scalar point, in the next.
fn label(card: &Card, field: usize) -> Result<Label, FileError> {
    let component = match card.text(field + 1) {
        "" => Some(0),
        text => text.parse().ok().filter(|component| *component <= 6),
    };
    Ok(Label {
        grid: card.label(field)?,
        component: component.ok_or_else(|| card.wrong(field + 1, "a component from 0 to 6"))?,
    })
}
