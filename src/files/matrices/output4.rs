//! The text that NASTRAN's module OUTPUT4 writes, dense or sparse.

use super::{Digits, FoundMatrices, LabeledMatrix, is_wanted};
use crate::files::deck::number::parse_reals;
use crate::files::error::FileError;
use crate::sparse::SparseMatrix;

/// Widths of the integers of headers.
const INTEGERS: [usize; 2] = [8, 16];
/// Characters of a matrix's name.
const NAME: usize = 8;
/// A string's header holds its words and its first row together, the words above this.
const ROWS_IN_HEADER: usize = 65536;

/// The lines of a file.
struct Lines<'a> {
    file: &'a str,
    lines: Vec<&'a str>,
    /// Width of the integers of this matrix's headers.
    integer: usize,
}

/// Reads the matrices of this name, or all.
///
/// A matrix has a header, a record for every column that is not zero, and a record of a column too many. A record begins
/// with its column, its first row and its words. Where the first row is zero, strings follow: each begins with its words and
/// first row as one number, or as two in a matrix of more than 65535 rows or of a negative number of them.
///
/// NASTRAN gives both triangles of a symmetric matrix (form 6). Where all entries stand in one, it is mirrored.
pub(super) fn read(
    file: &str,
    text: &str,
    wanted: Option<&str>,
) -> Result<FoundMatrices, FileError> {
    let mut lines = Lines {
        file,
        lines: text.lines().map(str::trim_end).collect(),
        integer: INTEGERS[0],
    };
    let (mut names, mut matrices, mut at) = (Vec::new(), Vec::new(), 0);
    while let Some(&header) = lines.lines.get(at) {
        if header.is_empty() {
            at += 1;
            continue;
        }
        // Four integers, of which eight columns of the wider ones hold blanks.
        let is_of = |width: &&usize| {
            let columns = (0..4).map(|place| header.get(place * **width..(place + 1) * **width));
            columns
                .flatten()
                .filter(|own| own.trim().parse::<i64>().is_ok())
                .count()
                == 4
        };
        lines.integer = *INTEGERS.iter().find(is_of).unwrap_or(&INTEGERS[0]);
        let heads = 4 * lines.integer;
        let name = header
            .get(heads..)
            .map(|rest| rest.get(..NAME).unwrap_or(rest).trim().to_owned());
        let name = name.ok_or_else(|| lines.wrong(at, "the header of a matrix"))?;
        if is_wanted(&name, wanted) {
            let matrix = lines.matrix(&mut at)?;
            matrices.push(LabeledMatrix {
                rows: None,
                columns: None,
                matrix,
                dmig: None,
            });
        } else {
            // Only a header has a name behind four integers.
            let goes_on =
                |line: &&str| line.len() <= heads || line.as_bytes()[..heads].contains(&b'.');
            at += 1 + lines.lines[at + 1..]
                .iter()
                .take_while(|line| goes_on(line))
                .count();
        }
        names.push(name);
    }
    Ok((names, matrices))
}

impl Lines<'_> {
    fn wrong(&self, at: usize, what: &str) -> FileError {
        FileError::at(self.file, &self.lines, at, what)
    }

    fn require(&self, is_met: bool, at: usize, what: &str) -> Result<(), FileError> {
        if is_met {
            Ok(())
        } else {
            Err(self.wrong(at, what))
        }
    }

    /// One of the integers of a header.
    fn integer(&self, at: usize, place: usize) -> Result<usize, FileError> {
        let field = self.lines.get(at).and_then(|line| {
            let rest = line.get(place * self.integer..)?;
            rest.get(..self.integer).unwrap_or(rest).trim().parse().ok()
        });
        field.ok_or_else(|| self.wrong(at, "a line of integers of eight characters, or of sixteen"))
    }

    fn is_string(&self, at: usize) -> bool {
        self.lines
            .get(at)
            .is_some_and(|line| !line.contains('.') && line.len() <= 2 * self.integer)
    }

    /// The matrix with its header at this line, which then is the next matrix's.
    fn matrix(&self, at: &mut usize) -> Result<SparseMatrix, FileError> {
        let header = self.lines.get(*at).copied().unwrap_or_default();
        let (columns, form, kind) = (
            self.integer(*at, 0)?,
            self.integer(*at, 2)?,
            self.integer(*at, 3)?,
        );
        let rows: Option<i64> = header
            .get(self.integer..2 * self.integer)
            .and_then(|text| text.trim().parse().ok());
        let rows = rows
            .filter(|rows| *rows != 0)
            .ok_or_else(|| self.wrong(*at, "a header with a number of rows"))?;
        let is_large = !(0..ROWS_IN_HEADER as i64).contains(&rows);
        let rows = rows.unsigned_abs() as usize;
        let has_form = [1, 2, 6, 9].contains(&form) && (form != 6 || rows == columns);
        self.require(
            has_form,
            *at,
            "the header of a matrix of form 1, 2 or 9, or 6 if it is square",
        )?;
        self.require(
            [1, 2].contains(&kind),
            *at,
            "the header of a real matrix (type 1 or 2)",
        )?;
        let format = header
            .get(4 * self.integer + NAME..)
            .and_then(|format| format.split_once(['E', 'D', 'e', 'd']));
        let width = format
            .and_then(|(_, width)| width.split('.').next()?.parse().ok())
            .filter(|width| *width > 0);
        let width =
            width.ok_or_else(|| self.wrong(*at, "a header with a format such as 1P,5E16.9"))?;
        let (mut entries, mut last_column, mut digits) = (Vec::new(), 0, Digits::default());
        loop {
            *at += 1;
            let [column, first, words] = [0, 1, 2].map(|place| self.integer(*at, place));
            let (column, first, words) = (column?, first?, words?);
            if column > columns {
                *at += 2; // The last record has one number, which says nothing.
                break;
            }
            self.require(
                column > last_column,
                *at,
                "the header of a column after the last one",
            )?;
            last_column = column;
            let (head, before, mut next_row, mut strings) = (*at, entries.len(), 1, Vec::new());
            if first > 0 {
                self.numbers(
                    at,
                    width,
                    (first, rows, column),
                    (&mut entries, &mut digits),
                )?;
            }
            while first == 0 && self.is_string(*at + 1) {
                *at += 1;
                let (string, line) = (*at, self.lines.get(*at).copied().unwrap_or_default());
                let (words, row) = if is_large {
                    (self.integer(string, 0)?, self.integer(string, 1)?)
                } else {
                    let both = line.trim().parse::<usize>().ok();
                    let both = both.ok_or_else(|| {
                        self.wrong(string, "the one integer of a string's header")
                    })?;
                    (both / ROWS_IN_HEADER, both % ROWS_IN_HEADER)
                };
                self.require(
                    row >= next_row,
                    string,
                    "the header of a string below the last one",
                )?;
                let count =
                    self.numbers(at, width, (row, rows, column), (&mut entries, &mut digits))?;
                next_row = row + count;
                strings.push((string, words, count));
            }
            let all = entries.len() - before;
            let is_whole = if first > 0 {
                all == words
            } else {
                !strings.is_empty()
            };
            self.require(is_whole, head, "a header that counts the numbers below it")?;
            // A number has one word or two. Some programs count one in any case, or all of the column for every string.
            let counts = |count: usize| [count, 2 * count, 2 * all].map(|words| words + 1);
            if let Some((string, ..)) = strings
                .iter()
                .find(|(_, words, count)| !counts(*count).contains(words))
            {
                return Err(self.wrong(*string, "a header that counts the numbers below it"));
            }
        }
        let mirrored = entries
            .iter()
            .map(|&(row, column, value)| (column, row, value));
        let mirrored: Vec<_> = mirrored
            .filter(|entry| form == 6 && entry.0 != entry.1)
            .collect();
        if mirrored.iter().all(|entry| entry.0 < entry.1)
            || mirrored.iter().all(|entry| entry.0 > entry.1)
        {
            entries.extend(mirrored);
        }
        let matrix = SparseMatrix::new("matrix of OUTPUT4", rows, columns, entries)?;
        Ok(matrix.with_half_unit(digits.half_unit()))
    }

    /// Takes the numbers after this line from a row of a column on, and returns how many there are.
    fn numbers(
        &self,
        at: &mut usize,
        width: usize,
        (first, rows, column): (usize, usize, usize),
        (entries, digits): (&mut Vec<(usize, usize, f64)>, &mut Digits),
    ) -> Result<usize, FileError> {
        let mut row = first;
        while let Some(line) = self.lines.get(*at + 1).filter(|line| line.contains('.')) {
            *at += 1;
            let reals = parse_reals(line, width);
            let columns = line.as_bytes().chunks(width);
            columns.for_each(|column| digits.add(&String::from_utf8_lossy(column)));
            for value in reals
                .ok_or_else(|| self.wrong(*at, "a line of real numbers in the header's format"))?
            {
                self.require(
                    row <= rows,
                    *at,
                    "a line of numbers that ends within the column",
                )?;
                entries.push((row - 1, column - 1, value));
                row += 1;
            }
        }
        Ok(row - first)
    }
}
