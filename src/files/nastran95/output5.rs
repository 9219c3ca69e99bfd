//! The formatted file of NASTRAN's module OUTPUT5.

use super::process::shown;
use crate::files::deck::number::parse_real;
use crate::files::error::FileError;
use nalgebra::DMatrix;
use std::collections::HashMap;

/// Matrices by name, such as `KGG`.
pub type Matrices = HashMap<String, DMatrix<f64>>;

/// Widths of the integers of a record and of its reals, format D26.17.
const INTEGER: usize = 8;
const REAL: usize = 26;
/// Where a matrix's header has its sizes, and after them its name.
const HEADER_SIZES: usize = 26;
const HEADER_NAME: usize = 74;

/// Reads matrices that OUTPUT5 wrote with formatted records.
///
/// After a title line every matrix has a header (number of columns, of rows, form, type, name), then a record for every
/// column that is not zero: its number, its first and last row that are not, and what stands between them; a column of number
/// zero begins the next. Together they have at most `numbers` entries: a damaged header must not ask for all memory.
///
/// # Errors
/// [`FileError::SolverAnswer`] naming the line for anything else.
pub fn read_output5(text: &str, numbers: usize) -> Result<Matrices, FileError> {
    let lines: Vec<&str> = text.lines().collect();
    let wrong = |line: usize, expected: &str| {
        let expected = format!("{expected} in line {} of the OUTPUT5 file", line + 1);
        FileError::answer(expected, lines.get(line).map_or("its end".to_owned(), |l| shown(l.trim())))
    };
    let integer = |line: usize, start: usize| -> Result<usize, FileError> {
        let field = lines.get(line).and_then(|l| l.get(start..start + INTEGER));
        let value = field.and_then(|text| text.trim().parse().ok());
        value.ok_or_else(|| wrong(line, "an integer"))
    };
    let mut matrices = Matrices::new();
    let mut current: Option<(String, DMatrix<f64>)> = None;
    let mut left = numbers;
    let mut at = 1;
    while at < lines.len() {
        let number = |place: usize| integer(at, place * INTEGER);
        let (column, first, last) = (number(0)?, number(1)?, number(2)?);
        at += 1;
        if column == 0 {
            matrices.extend(current.take());
            let size = |place: usize| integer(at, HEADER_SIZES + place * INTEGER);
            let (columns, rows, kind) = (size(0)?, size(1)?, size(3)?);
            if kind != 2 {
                return Err(wrong(at, "the header of a real double precision matrix"));
            }
            let fewer = columns.checked_mul(rows).and_then(|entries| left.checked_sub(entries));
            left = fewer.ok_or_else(|| wrong(at, &format!("matrices of at most {numbers} entries in all")))?;
            let name = lines[at].get(HEADER_NAME..).unwrap_or_default().trim();
            current = Some((name.to_owned(), DMatrix::zeros(rows, columns)));
            at += 1;
            continue;
        }
        let Some((_, matrix)) = &mut current else {
            return Err(wrong(at - 1, "a matrix's header before its columns"));
        };
        if column > matrix.ncols() || first == 0 || last > matrix.nrows() || last < first {
            return Err(wrong(at - 1, "a column and rows within the matrix"));
        }
        let mut row = first - 1;
        while row < last {
            let line = lines.get(at).ok_or_else(|| wrong(at, "reals"))?;
            let bytes = line.trim_end().as_bytes();
            for field in bytes.chunks(REAL) {
                match std::str::from_utf8(field).ok().and_then(|text| parse_real(text.trim())) {
                    Some(value) if row < last => matrix[(row, column - 1)] = value,
                    _ => return Err(wrong(at, "reals of the format D26.17, as many as rows")),
                }
                row += 1;
            }
            if bytes.is_empty() {
                return Err(wrong(at, "reals"));
            }
            at += 1;
        }
    }
    matrices.extend(current);
    Ok(matrices)
}
