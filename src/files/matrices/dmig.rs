//! DMIG cards of bulk data: matrices at grids and components, as NASTRAN takes and punches them.

use super::{Digits, FoundMatrices, Label, LabeledMatrix, is_wanted};
use crate::files::deck::{Card, Cards, cards};
use crate::files::error::FileError;
use crate::sparse::SparseMatrix;
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// Reads the matrices of this name, or all. A header (field 3 is 0) has the form in field 4, 1 square, 2 or 9 rectangular, 6
/// symmetric, and in field 5 the type, 1 or 2 for real; the other cards are columns, and their entries are four fields each.
///
/// Rows and columns of a square or symmetric matrix have one list of labels; those that no card names are not in it. A
/// symmetric matrix has every pair of places on one card alone, in either triangle.
pub(super) fn read(
    file: &str,
    text: &str,
    wanted: Option<&str>,
) -> Result<FoundMatrices, FileError> {
    let cards = cards(file, &own_lines(text))?;
    let (headers, others): (Vec<&Card>, Vec<&Card>) =
        cards.iter().partition(|card| card.text(3) == "0");
    let mut columns: BTreeMap<&str, Vec<&Card>> = headers
        .iter()
        .map(|header| (header.text(2), Vec::new()))
        .collect();
    for card in others {
        let own = columns
            .get_mut(card.text(2))
            .ok_or_else(|| card.wrong(2, "the name of a matrix with a header"))?;
        own.push(card);
    }
    let names = headers
        .iter()
        .map(|header| header.text(2).to_owned())
        .collect();
    let chosen = headers
        .iter()
        .filter(|header| is_wanted(header.text(2), wanted));
    let matrices = chosen
        .map(|header| matrix(header, &columns[header.text(2)]))
        .collect::<Result<_, _>>()?;
    Ok((names, matrices))
}

/// The text with the lines of DMIG cards alone, the others empty: whatever else a file has, before and behind its bulk data.
fn own_lines(text: &str) -> String {
    let mut is_own = false;
    let own = text.lines().map(|line| {
        let continues = line.starts_with(['+', '*', ' ', '\t', ',']) && !line.trim().is_empty();
        is_own = super::begins(line.trim_start(), "DMIG") || is_own && continues;
        if is_own { line } else { "" }
    });
    own.collect::<Vec<_>>().join("\n")
}

fn matrix(header: &Card, cards: &[&Card]) -> Result<LabeledMatrix, FileError> {
    let is_symmetric = header.text(4) == "6";
    let is_square = is_symmetric || header.text(4) == "1";
    let is_of = |field, texts: [&str; 2]| texts.contains(&header.text(field));
    let is_form = is_square || is_of(4, ["2", "9"]);
    header.require(is_form, 4, "a form (1, 2, 6 or 9)")?;
    header.require(
        is_of(5, ["1", "2"]),
        5,
        "the type of a real matrix (1 or 2)",
    )?;
    let (mut entries, mut places, mut digits) = (Vec::new(), HashSet::new(), Digits::default());
    let [mut rows, mut columns] = [BTreeSet::new(), BTreeSet::new()];
    for card in cards {
        let column = label(card, 3)?;
        let last = card.filled().pop().unwrap_or(0);
        let starts =
            std::iter::once(6).chain((10..).step_by(10).flat_map(|line| [line + 2, line + 6]));
        for start in starts.take_while(|&start| start <= last) {
            if (start..start + 4).all(|field| card.text(field).is_empty()) {
                continue;
            }
            let row = label(card, start)?;
            let value = card
                .optional_real(start + 2)?
                .ok_or_else(|| card.wrong(start + 2, "a real number"))?;
            card.absent(start + 3, "complex matrices")?;
            digits.add(card.text(start + 2));
            let is_again = is_symmetric && places.contains(&(column, row));
            if !places.insert((row, column)) || is_again {
                return Err(card.error(start, "another entry has this place of the matrix"));
            }
            rows.insert(row);
            columns.insert(column);
            entries.push((row, column, value));
            if is_symmetric && row != column {
                entries.push((column, row, value));
            }
        }
    }
    if is_square {
        rows.append(&mut columns);
        columns.clone_from(&rows);
    }
    let [rows, columns] = [rows, columns].map(|labels| labels.into_iter().collect::<Vec<Label>>());
    // Every label was put in its list above.
    let place = |labels: &[Label], label| labels.partition_point(|other| *other < label);
    let entries = entries
        .iter()
        .map(|&(row, column, value)| (place(&rows, row), place(&columns, column), value));
    let matrix = SparseMatrix::new("DMIG matrix", rows.len(), columns.len(), entries.collect())?;
    Ok(LabeledMatrix {
        rows: Some(rows),
        columns: Some(columns),
        matrix: matrix.with_half_unit(digits.half_unit()),
        dmig: Some(header.text(2).to_owned()),
    })
}

/// A matrix as DMIG cards with these labels of its rows and columns, every number by the nearest of a field; of a symmetric one the lower
/// triangle.
///
/// # Errors
/// [`Error::Value`](crate::method::error::Error::Value) and [`Error::Count`](crate::method::error::Error::Count) for numbers that no card
/// can hold.
pub(crate) fn write_dmig(
    name: &str,
    labels: &[Label],
    matrix: &SparseMatrix,
) -> Result<String, FileError> {
    let form = if matrix.is_symmetric() { 6 } else { 1 };
    let at = |row: usize| format!("{},{}", labels[row].grid, labels[row].component);
    let mut columns = BTreeMap::new();
    for (row, column, value) in matrix.entries() {
        if value != 0.0 && (form == 1 || row >= column) {
            let own = columns.entry(column);
            let entries: &mut String = own.or_insert_with(|| format!("{name},{}", at(column)));
            *entries += &format!(",,{},{value:?}", at(row));
        }
    }
    let mut cards = Cards::default();
    cards.push("DMIG", &format!("{name},0,{form},2,0"))?;
    let mut columns = columns.values();
    columns.try_for_each(|entries| cards.push("DMIG", entries))?;
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
