//! The exchange format of the Matrix Market (Boisvert, Pozo, Remington, NISTIR 5935, 1996).

use super::{Digits, mirrored};
use crate::files::deck::number::real;
use crate::files::error::{FileError, is_not};
use crate::sparse::SparseMatrix;
use std::fmt::Write;

/// Contents of the banner and of the line of sizes.
struct Heading {
    is_array: bool,
    is_complex: bool,
    is_symmetric: bool,
    rows: usize,
    columns: usize,
    /// Number of entries of the coordinate format.
    count: usize,
}

/// Reads a matrix; entries of one place in the coordinate format add up. A symmetric one may have both triangles where they agree, or
/// the upper one, and complex numbers may have imaginary parts of zero.
pub fn read(file: &str, text: &str) -> Result<SparseMatrix, FileError> {
    let end = text.lines().count() + 1;
    let mut lines = (1..)
        .zip(text.lines().map(str::trim))
        .filter(|(_, line)| !line.is_empty());
    let (first, banner) = lines.next().unwrap_or((1, ""));
    let mut lines = lines.filter(|(_, line)| !line.starts_with('%'));
    let own = heading(file, (first, banner), lines.next(), end)?;
    // The array of a symmetric one holds the lower triangle.
    let mut places = (0..own.columns).flat_map(|column| {
        let first = if own.is_symmetric { column } else { 0 };
        (first..own.rows).map(move |row| (row, column))
    });
    let (mut entries, mut read, mut digits) = (Vec::new(), 0, Digits::default());
    for (number, line) in lines {
        let wrong = |what: &str| FileError::line(file, number, is_not(line, what));
        let mut words: Vec<&str> = line.split_whitespace().collect();
        if own.is_complex && words.pop().and_then(real) != Some(0.0) {
            return Err(wrong("a number with an imaginary part of zero"));
        }
        let given = match words[..] {
            [_] if own.is_array => places.next(),
            [row, column, _] if !own.is_array && read < own.count => {
                let place = |word: &str, most| word.parse().ok().filter(|n| (1..=most).contains(n));
                let place = place(row, own.rows)
                    .zip(place(column, own.columns))
                    .map(|(row, column): (usize, usize)| (row - 1, column - 1));
                Some(place.ok_or_else(|| wrong("an entry within the matrix"))?)
            }
            [_, _, _] if !own.is_array => None,
            _ if own.is_array => return Err(wrong("a value")),
            _ => return Err(wrong("a row, a column and a value")),
        };
        let (row, column) = given.ok_or_else(|| {
            FileError::line(
                file,
                number,
                "there are more entries than the line of sizes says",
            )
        })?;
        let word = words.last().copied().unwrap_or_default();
        let value = real(word);
        let value =
            value.ok_or_else(|| FileError::line(file, number, is_not(word, "a real number")))?;
        digits.add(word);
        entries.push((row, column, value));
        read += 1;
    }
    if places.next().is_some() && own.is_array || !own.is_array && read < own.count {
        let reason = format!("the file ends after entry {read}; the line of sizes promises more");
        return Err(FileError::line(file, end, reason));
    }
    if own.is_symmetric {
        entries = mirrored(entries).map_err(|both| {
            let [row, column] = both.map(|place| place + 1);
            let reason = format!(
                "entries ({row}, {column}) and ({column}, {row}) of a symmetric matrix differ, or one of them is missing"
            );
            FileError::line(file, first, reason)
        })?;
    }
    Ok(
        SparseMatrix::new("matrix of a file", own.rows, own.columns, entries)?
            .with_half_unit(digits.half_unit()),
    )
}

/// Reads the banner and the line of sizes, each with its number; the file ends in line `end`.
fn heading(
    file: &str,
    (first, banner): (usize, &str),
    sizes: Option<(usize, &str)>,
    end: usize,
) -> Result<Heading, FileError> {
    let wrong =
        |line: usize, found: &str, what: &str| FileError::line(file, line, is_not(found, what));
    let words = banner.to_ascii_lowercase();
    let words: Vec<&str> = words.split_whitespace().collect();
    let [
        _,
        "matrix",
        format @ ("array" | "coordinate"),
        numbers @ ("real" | "double" | "integer" | "unsigned-integer" | "complex"),
        symmetry,
    ] = words[..]
    else {
        return Err(wrong(
            first,
            banner,
            "the banner of a matrix: array or coordinate, real, integer or complex, and its symmetry",
        ));
    };
    let is_symmetric = match symmetry {
        "general" => false,
        "symmetric" | "hermitian" => true,
        _ => {
            let what = "general, symmetric or hermitian, as a stiffness or a mass is";
            return Err(wrong(first, symmetry, what));
        }
    };
    let (at, sizes) = sizes
        .ok_or_else(|| FileError::line(file, end, "the file ends before the line of sizes"))?;
    let is_array = format == "array";
    let read: Option<Vec<usize>> = sizes
        .split_whitespace()
        .map(|word| word.parse().ok())
        .collect();
    let (rows, columns, count) = match read.as_deref() {
        Some(&[rows, columns]) if is_array => (rows, columns, 0),
        Some(&[rows, columns, count]) if !is_array => (rows, columns, count),
        _ => (0, 0, 0),
    };
    if rows == 0 || columns == 0 {
        return Err(wrong(
            at,
            sizes,
            "a line of sizes: rows, columns and, in the coordinate format, the number of entries",
        ));
    }
    if is_symmetric && rows != columns {
        return Err(wrong(
            at,
            sizes,
            "the size of a symmetric matrix, which is square",
        ));
    }
    let is_complex = numbers == "complex";
    Ok(Heading {
        is_array,
        is_complex,
        is_symmetric,
        rows,
        columns,
        count,
    })
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
