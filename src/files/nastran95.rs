//! The formatted file of NASTRAN's module OUTPUT5.

use super::escaped;
use crate::files::deck::number::parse_reals;
use crate::files::error::{FileError, is_not};
use nalgebra::DMatrix;
use std::collections::HashMap;

/// Matrices by name, such as `KGG`.
pub type Matrices = HashMap<String, DMatrix<f64>>;

/// Widths of the integers of a record and of its reals, format D26.17.
const INTEGER: usize = 8;
const REAL: usize = 26;
/// Columns where a matrix's header begins its sizes and, after them, its name.
const HEADER_SIZES: usize = 26;
const HEADER_NAME: usize = 74;

/// Reads matrices that OUTPUT5 wrote with formatted records.
///
/// After a title line every matrix has a header (number of columns, of rows, form, type, name), then a record for every
/// nonzero column: its number, its first and last nonzero row, and the entries between them; column number zero begins the
/// next matrix. Together they have at most `numbers` entries: a damaged header must not ask for all memory.
///
/// # Errors
/// [`FileError::SolverAnswer`] naming a line that is not in this format.
pub fn read_output5(text: &str, numbers: usize) -> Result<Matrices, FileError> {
    let lines: Vec<&str> = text.lines().collect();
    let wrong = |line: usize, what: &str| {
        let end = || format!("the file ends before {what}");
        let reason = lines
            .get(line)
            .map_or_else(end, |l| is_not(&shown(l.trim()), what));
        FileError::answer(format!("OUTPUT5 file, line {}: {reason}", line + 1))
    };
    let integer = |line: usize, start: usize| -> Result<usize, FileError> {
        let field = lines.get(line).and_then(|l| l.get(start..start + INTEGER));
        let value = field.and_then(|text| text.trim().parse().ok());
        value.ok_or_else(|| wrong(line, "a line of integers"))
    };
    let mut matrices = Matrices::new();
    let (mut name, mut left, mut at) = ("", numbers, 1);
    while at < lines.len() {
        let number = |place: usize| integer(at, place * INTEGER);
        let (column, first, last) = (number(0)?, number(1)?, number(2)?);
        at += 1;
        if column == 0 {
            let size = |place: usize| integer(at, HEADER_SIZES + place * INTEGER);
            let (columns, rows, kind) = (size(0)?, size(1)?, size(3)?);
            if kind != 2 {
                return Err(wrong(at, "the header of a real double precision matrix"));
            }
            let fewer = columns
                .checked_mul(rows)
                .and_then(|entries| left.checked_sub(entries));
            left = fewer.ok_or_else(|| {
                wrong(
                    at,
                    &format!("the header of a matrix within the {numbers} entries of all"),
                )
            })?;
            name = lines[at].get(HEADER_NAME..).unwrap_or_default().trim();
            matrices.insert(name.to_owned(), DMatrix::zeros(rows, columns));
            at += 1;
            continue;
        }
        let matrix = matrices.get_mut(name);
        let matrix =
            matrix.ok_or_else(|| wrong(at - 1, "the header that precedes a matrix's columns"))?;
        if column > matrix.ncols() || first == 0 || last > matrix.nrows() || last < first {
            return Err(wrong(at - 1, "a column and rows within the matrix"));
        }
        let mut row = first - 1;
        while row < last {
            let line = lines
                .get(at)
                .map(|line| line.trim_end())
                .filter(|line| !line.is_empty());
            let reals = line
                .and_then(|line| parse_reals(line, REAL))
                .filter(|reals| reals.len() <= last - row)
                .ok_or_else(|| wrong(at, "a line of the column's reals in format D26.17"))?;
            matrix
                .column_mut(column - 1)
                .rows_mut(row, reals.len())
                .copy_from_slice(&reals);
            (at, row) = (at + 1, row + reals.len());
        }
    }
    Ok(matrices)
}

/// Most characters of the program's words in an error.
const MESSAGE_LENGTH: usize = 300;

/// The beginning of another program's words, for an error, with control characters escaped.
pub(crate) fn shown(words: &str) -> String {
    let start: String = words.chars().take(MESSAGE_LENGTH).collect();
    escaped(&start) + if start.len() < words.len() { "..." } else { "" }
}
