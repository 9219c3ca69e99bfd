//! Matrices as other programs write them: Matrix Market, DMIG cards of NASTRAN, the text of its module OUTPUT4, and Abaqus's by labels.
//!
//! Memory is bounded by a file's own size: no room is reserved for what a header promises.

mod abaqus;
mod digits;
mod dmig;
mod matrix_market;
mod output4;

pub(crate) use digits::Digits;
pub(crate) use dmig::write_dmig;
#[doc(hidden)]
pub use matrix_market::write_matrix_market;

use crate::files::deck::number::real;
use crate::files::error::FileError;
use crate::files::text::readable;
use crate::sparse::SparseMatrix;
use std::collections::{BTreeMap, BTreeSet};

/// A grid and its component, 1 to 6, or 0 for a scalar point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label {
    /// Number of the grid.
    pub grid: usize,
    /// The component.
    pub component: usize,
}

/// A matrix of a file, with the labels of its rows and columns where the file has them.
#[derive(Debug, Clone, PartialEq)]
pub struct LabeledMatrix {
    /// Labels of the rows, ascending. DMIG and Abaqus have them.
    pub rows: Option<Vec<Label>>,
    /// Labels of the columns; a square or symmetric matrix has one list for both, of all labels in either.
    pub columns: Option<Vec<Label>>,
    /// The matrix, a symmetric one with both triangles.
    pub matrix: SparseMatrix,
    /// Its name, if it came as DMIG.
    pub dmig: Option<String>,
}

/// Reads a real matrix from a file, `name` in messages: in Matrix Market's format if it begins with `%%MatrixMarket`, as
/// bulk data if a line begins with `DMIG`, by Abaqus's labels if its first line is five numbers with commas, and otherwise in that of
/// OUTPUT4. `wanted` is the matrix's name in capitals or not, which may be left out where the file has one alone. Matrix Market and Abaqus have no names. Matrices of other names may be complex.
///
/// # Errors
/// [`FileError::DeckLine`] names the line of what is damaged, complex or cut off, line 1 without such a
/// matrix; the errors of [`SparseMatrix::new`].
pub fn read(name: &str, bytes: &[u8], wanted: Option<&str>) -> Result<LabeledMatrix, FileError> {
    let text = readable(name, bytes)?;
    check_end(name, &text)?;
    if let Some(matrix) = abaqus::read(name, &text) {
        return matrix;
    }
    if begins(text.trim_start(), "%%MatrixMarket") {
        let matrix = matrix_market::read(name, &text)?;
        return Ok(LabeledMatrix {
            rows: None,
            columns: None,
            matrix,
            dmig: None,
        });
    }
    let is_dmig = text.lines().any(|line| begins(line.trim_start(), "DMIG"));
    if let Some(reason) = other_format(&text).filter(|_| !is_dmig) {
        return Err(FileError::refused(name, reason));
    }
    let read = if is_dmig { dmig::read } else { output4::read };
    let (names, mut found) = read(name, &text, wanted)?;
    let count = found.len();
    found.pop().filter(|_| count == 1).ok_or_else(|| {
        let asked = match wanted {
            Some(name) => format!("there is not one matrix {name}"),
            None => "name one matrix".to_owned(),
        };
        let names = match &names[..] {
            [] => "none".to_owned(),
            names => names.join(", "),
        };
        FileError::line(name, 1, format!("{asked}; the file has {names}"))
    })
}

/// First letters of the third line of a Harwell-Boeing file: real or pattern, symmetric or not, assembled or of elements.
const HARWELL_BOEING: [&str; 4] = ["RSA", "RUA", "PSA", "RSE"];

/// The format that a text without names of matrices seems to have, and what to do with it.
fn other_format(text: &str) -> Option<&'static str> {
    let lines = || text.lines().filter(|line| !line.trim().is_empty());
    let third = lines().nth(2).unwrap_or_default();
    if HARWELL_BOEING.iter().any(|kind| begins(third, kind)) {
        return Some(
            "is in the Harwell-Boeing format, which corfem does not read; write Matrix Market",
        );
    }
    let numbers = |line: &str| -> Option<Vec<f64>> {
        line.split([' ', '\t', ',', ';'])
            .filter(|word| !word.is_empty())
            .map(real)
            .collect()
    };
    let is_place = |number: &f64| *number >= 1.0 && number.fract() == 0.0;
    let is_entry = |line: &str| {
        numbers(line).is_some_and(|own| own.len() == 3 && own[..2].iter().all(is_place))
    };
    numbers(lines().next()?)?;
    Some(match lines().all(is_entry) {
        true => {
            "has rows, columns and values without a header, as CalculiX's .sti and .mas; put the banner %%MatrixMarket matrix \
                 coordinate real symmetric and a line with the numbers of rows, columns and entries before them"
        }
        false => "is a plain array of numbers, which corfem does not read; write Matrix Market",
    })
}

/// Names of all matrices of a file, and those among them that are wanted.
type FoundMatrices = (Vec<String>, Vec<LabeledMatrix>);

/// A matrix of a file by labels of rows and columns; a square one has one list for both.
fn labeled(
    entries: Vec<(Label, Label, f64)>,
    is_square: bool,
    digits: Digits,
    dmig: Option<String>,
) -> Result<LabeledMatrix, FileError> {
    let mut rows: BTreeSet<Label> = entries.iter().map(|entry| entry.0).collect();
    let mut columns: BTreeSet<Label> = entries.iter().map(|entry| entry.1).collect();
    if is_square {
        rows.append(&mut columns);
        columns.clone_from(&rows);
    }
    let [rows, columns] = [rows, columns].map(|labels| labels.into_iter().collect::<Vec<Label>>());
    // Every label was put in its list above.
    let place = |labels: &[Label], label| labels.partition_point(|other| *other < label);
    let entries = entries
        .into_iter()
        .map(|own| (place(&rows, own.0), place(&columns, own.1), own.2));
    let what = dmig.as_ref().map_or("matrix of a file", |_| "DMIG matrix");
    let matrix = SparseMatrix::new(what, rows.len(), columns.len(), entries.collect())?;
    Ok(LabeledMatrix {
        rows: Some(rows),
        columns: Some(columns),
        matrix: matrix.with_half_unit(digits.half_unit()),
        dmig,
    })
}

/// Entries of a symmetric matrix, both triangles from one of them, or from both where they agree.
///
/// # Errors
/// A row and a column off the diagonal of which both triangles, where both have entries, do not say the same.
fn mirrored<T: Copy + Ord>(mut entries: Vec<(T, T, f64)>) -> Result<Vec<(T, T, f64)>, [T; 2]> {
    let others: Vec<_> = entries
        .iter()
        .filter(|entry| entry.0 != entry.1)
        .map(|own| (own.1, own.0, own.2))
        .collect();
    let mut sums: BTreeMap<[T; 2], f64> = BTreeMap::new();
    for &(column, row, value) in &others {
        *sums.entry([row, column]).or_default() += value;
    }
    let opposite = |&[row, column]: &[T; 2]| sums.get(&[column, row]);
    if sums.keys().all(|place| opposite(place).is_none()) {
        entries.extend(others);
        return Ok(entries);
    }
    sums.iter()
        .find(|own| opposite(own.0) != Some(own.1))
        .map_or(Ok(entries), |own| Err(*own.0))
}

/// Refuses a text that ends inside a number: no line end is behind it, and it lacks an exponent that all numbers before it have, or decimals
/// or a digit of the exponent where all of them have as many.
fn check_end(name: &str, text: &str) -> Result<(), FileError> {
    let mut numbers = text.split([' ', '\t', ',', '\r', '\n']).map(|word| {
        real(word)?;
        let end = word.find(['e', 'E', 'd', 'D']).unwrap_or(word.len());
        let point = word[..end].find('.').unwrap_or(end);
        Some([word.len() - end, end - point])
    });
    let Some(last) = numbers.next_back().flatten() else {
        return Ok(());
    };
    let before: BTreeSet<_> = numbers.flatten().filter(|own| own[1] > 0).collect();
    let is_cut = before.first().is_some_and(|least| {
        let is_shorter = last[0] < least[0] || last[1] < least[1];
        least[0] > 0 && last[0] == 0 || before.len() == 1 && is_shorter
    });
    if is_cut {
        return Err(FileError::line(
            name,
            text.lines().count(),
            "the file ends inside a number, which lacks what all before it have; write it again, or end its last line if it is whole",
        ));
    }
    Ok(())
}

fn is_wanted(name: &str, wanted: Option<&str>) -> bool {
    wanted.is_none_or(|wanted| wanted.eq_ignore_ascii_case(name))
}

fn begins(text: &str, word: &str) -> bool {
    text.get(..word.len())
        .is_some_and(|start| start.eq_ignore_ascii_case(word))
}
