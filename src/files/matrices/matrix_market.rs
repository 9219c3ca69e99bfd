//! The exchange format of the Matrix Market (Boisvert, Pozo, Remington, NISTIR 5935, 1996).

use super::{Digits, mirrored};
use crate::files::error::{FileError, is_not};
use crate::sparse::SparseMatrix;
use std::fmt::Write;

/// Reads a matrix; entries of one place in the coordinate format add up. A symmetric one may have both triangles where they agree, or
/// the upper one, and complex numbers may have imaginary parts of zero.
pub(super) fn read(file: &str, text: &str) -> Result<SparseMatrix, FileError> {
    let wrong =
        |line: usize, what: &str, found: &str| FileError::line(file, line, is_not(found, what));
    let end = text.lines().count() + 1;
    let mut lines = (1..)
        .zip(text.lines().map(str::trim))
        .filter(|(_, line)| !line.is_empty());
    let (first, banner) = lines.next().unwrap_or((1, ""));
    let words = banner.to_ascii_lowercase();
    // The factor on the triangle that the file has gives the other one.
    let (is_array, is_complex, mirror): (bool, bool, Option<f64>) = match words
        .split_whitespace()
        .collect::<Vec<_>>()[..]
    {
        [
            _,
            "matrix",
            format @ ("array" | "coordinate"),
            numbers @ ("real" | "double" | "integer" | "unsigned-integer" | "complex"),
            symmetry,
        ] => {
            let mirror = match symmetry {
                "general" => None,
                "symmetric" | "hermitian" => Some(1.0),
                "skew-symmetric" => Some(-1.0),
                _ => {
                    let what = "general, symmetric, hermitian or skew-symmetric";
                    return Err(wrong(first, what, symmetry));
                }
            };
            (format == "array", numbers == "complex", mirror)
        }
        _ => {
            let what = "the banner of a matrix: array or coordinate, real, integer or complex, and its symmetry";
            return Err(wrong(first, what, banner));
        }
    };
    let mut lines = lines.filter(|(_, line)| !line.starts_with('%'));
    let (at, sizes) = lines
        .next()
        .ok_or_else(|| FileError::line(file, end, "the file ends before the line of sizes"))?;
    let numbers: Option<Vec<usize>> = sizes
        .split_whitespace()
        .map(|word| word.parse().ok())
        .collect();
    let (rows, columns, count) = match numbers.as_deref() {
        Some(&[rows, columns]) if is_array && rows > 0 && columns > 0 => {
            (rows, columns, usize::MAX)
        }
        Some(&[rows, columns, count]) if !is_array && rows > 0 && columns > 0 => {
            (rows, columns, count)
        }
        _ => {
            return Err(wrong(
                at,
                "a line of sizes: rows, columns and, in the coordinate format, the number of entries",
                sizes,
            ));
        }
    };
    let too_many = |number| {
        FileError::line(
            file,
            number,
            "there are more entries than the line of sizes says",
        )
    };
    if mirror.is_some() && rows != columns {
        return Err(wrong(
            at,
            "the size of a symmetric matrix, which is square",
            sizes,
        ));
    }
    // The first row of a column that the file holds.
    let first_row = |column: usize| mirror.map_or(0, |factor| column + usize::from(factor == -1.0));
    let mut places =
        (0..columns).flat_map(|column| (first_row(column)..rows).map(move |row| (row, column)));
    let (mut entries, mut read, mut digits) = (Vec::new(), 0, Digits::default());
    for (number, line) in lines {
        let mut words: Vec<&str> = line.split_whitespace().collect();
        if is_complex {
            let imaginary = words
                .pop()
                .and_then(|word| word.replace(['d', 'D'], "e").parse().ok());
            if imaginary != Some(0.0) {
                return Err(wrong(
                    number,
                    "a number with an imaginary part of zero",
                    line,
                ));
            }
        }
        let (row, column, word) = match words[..] {
            [value] if is_array => {
                let place = places.next().ok_or_else(|| too_many(number))?;
                (place.0, place.1, value)
            }
            [row, column, value] if !is_array && read < count => {
                let place = |word: &str, most| {
                    word.parse::<usize>()
                        .ok()
                        .filter(|n| (1..=most).contains(n))
                };
                let is_stored = |row, column| mirror == Some(1.0) || row > first_row(column - 1);
                match (place(row, rows), place(column, columns)) {
                    (Some(row), Some(column)) if is_stored(row, column) => {
                        (row - 1, column - 1, value)
                    }
                    _ => {
                        return Err(wrong(
                            number,
                            "an entry within the part of the matrix that is stored",
                            line,
                        ));
                    }
                }
            }
            [_, _, _] if !is_array => {
                return Err(too_many(number));
            }
            _ if is_array => return Err(wrong(number, "a value", line)),
            _ => return Err(wrong(number, "a row, a column and a value", line)),
        };
        let value: Option<f64> = word.replace(['d', 'D'], "e").parse().ok();
        let value = value
            .filter(|value| value.is_finite())
            .ok_or_else(|| wrong(number, "a real number", word))?;
        digits.add(word);
        entries.push((row, column, value));
        if mirror == Some(-1.0) {
            entries.push((column, row, -value));
        }
        read += 1;
    }
    let is_cut_off = if is_array {
        places.next().is_some()
    } else {
        read < count
    };
    if is_cut_off {
        let reason = format!("the file ends after entry {read}; the line of sizes promises more");
        return Err(FileError::line(file, end, reason));
    }
    if mirror == Some(1.0) {
        entries = mirrored(entries).map_err(|(row, column)| {
            let reason = format!(
                "entries ({0}, {1}) and ({1}, {0}) of a symmetric matrix differ, or one of them is missing",
                row + 1,
                column + 1
            );
            FileError::line(file, first, reason)
        })?;
    }
    let matrix = SparseMatrix::new("matrix of a file", rows, columns, entries)?;
    Ok(matrix.with_rounding(digits.rounding()))
}

/// A matrix in the coordinate format, every number by the fewest digits that read back as exactly that number; of a
/// symmetric one the lower triangle.
pub fn write_matrix_market(matrix: &SparseMatrix) -> String {
    let is_symmetric = matrix.is_symmetric();
    let stored = |entry: &(usize, usize, f64)| !is_symmetric || entry.0 >= entry.1;
    let entries: Vec<_> = matrix.entries().filter(stored).collect();
    let symmetry = if is_symmetric { "symmetric" } else { "general" };
    let (rows, columns, count) = (matrix.rows(), matrix.columns(), entries.len());
    let mut text =
        format!("%%MatrixMarket matrix coordinate real {symmetry}\n{rows} {columns} {count}\n");
    for (row, column, value) in entries {
        let _ = writeln!(text, "{} {} {value:e}", row + 1, column + 1);
    }
    text
}
