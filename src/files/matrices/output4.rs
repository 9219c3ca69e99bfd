//! The text that NASTRAN's module OUTPUT4 writes, dense or sparse.

use super::{Digits, FoundMatrices, LabeledMatrix, is_wanted, mirrored};
use crate::files::deck::number::parse_reals;
use crate::files::error::{FileError, ensure};
use crate::sparse::SparseMatrix;
use std::str::FromStr;

/// Widths of the integers of headers.
const INTEGERS: [usize; 2] = [8, 16];
/// Characters of a matrix's name.
const NAME: usize = 8;
/// A string's header holds its words and its first row together, the words above this.
const ROWS_IN_HEADER: usize = 65536;

/// The lines of a file, and what the matrix at hand has so far.
struct Lines<'a> {
    file: &'a str,
    lines: Vec<&'a str>,
    /// Place of the line at hand.
    at: usize,
    /// Width of the integers of this matrix's headers.
    integer: usize,
    entries: Vec<(usize, usize, f64)>,
    digits: Digits,
}

/// Reads the matrices of this name, or all.
///
/// A matrix has a header, a record for every column that is not zero, and a record of a column too many. A record begins
/// with its column, its first row and its words. Where the first row is zero, strings follow: each begins with its words and
/// first row as one number, or as two in a matrix of more than 65535 rows or of a negative number of them.
///
/// NASTRAN gives both triangles of a symmetric matrix (form 6). Where no entry has its opposite, they are mirrored.
pub fn read(file: &str, text: &str, wanted: Option<&str>) -> Result<FoundMatrices, FileError> {
    let mut lines = Lines {
        file,
        lines: text.lines().map(str::trim_end).collect(),
        at: 0,
        integer: INTEGERS[0],
        entries: Vec::new(),
        digits: Digits::default(),
    };
    let (mut names, mut matrices) = (Vec::new(), Vec::new());
    while let Some(&header) = lines.lines.get(lines.at) {
        if header.is_empty() {
            lines.at += 1;
            continue;
        }
        // Four integers, of which eight columns of the wider ones hold blanks.
        let is_of = |width: &usize| {
            let columns = (0..4).map(|place| header.get(place * width..(place + 1) * width));
            let number = |own: Option<&str>| own?.trim().parse::<i64>().ok();
            columns.map(number).all(|own| own.is_some())
        };
        lines.integer = INTEGERS.into_iter().find(is_of).unwrap_or(INTEGERS[0]);
        let heads = 4 * lines.integer;
        let name = header
            .get(heads..)
            .ok_or_else(|| lines.wrong("the header of a matrix"))?;
        let name = name.get(..NAME).unwrap_or(name).trim().to_owned();
        if is_wanted(&name, wanted) {
            matrices.push(LabeledMatrix {
                rows: None,
                columns: None,
                matrix: lines.matrix()?,
                dmig: None,
            });
        } else {
            // Only a header has a name behind four integers.
            let is_header =
                |line: &&str| line.len() > heads && !line.as_bytes()[..heads].contains(&b'.');
            let next = lines.lines[lines.at + 1..].iter().position(is_header);
            lines.at = next.map_or(lines.lines.len(), |next| lines.at + 1 + next);
        }
        names.push(name);
    }
    Ok((names, matrices))
}

impl Lines<'_> {
    fn wrong(&self, what: &str) -> FileError {
        FileError::at(self.file, &self.lines, self.at, what)
    }

    fn line(&self) -> &str {
        self.lines.get(self.at).copied().unwrap_or_default()
    }

    /// One of the integers of a header.
    fn number<T: FromStr>(&self, place: usize) -> Option<T> {
        let rest = self.line().get(place * self.integer..)?;
        rest.get(..self.integer).unwrap_or(rest).trim().parse().ok()
    }

    fn integer(&self, place: usize) -> Result<usize, FileError> {
        self.number(place)
            .ok_or_else(|| self.wrong("a line of integers of eight characters, or of sixteen"))
    }

    /// The matrix with its header at this line, which then is the next matrix's.
    fn matrix(&mut self) -> Result<SparseMatrix, FileError> {
        let (columns, form, kind) = (self.integer(0)?, self.integer(2)?, self.integer(3)?);
        let rows: Option<i64> = self.number(1).filter(|rows| *rows != 0);
        let rows = rows.ok_or_else(|| self.wrong("a header with a number of rows"))?;
        let is_large = !(0..ROWS_IN_HEADER as i64).contains(&rows);
        let rows = rows.unsigned_abs() as usize;
        ensure(
            [1, 2, 6, 9].contains(&form) && (form != 6 || rows == columns),
            || self.wrong("the header of a matrix of form 1, 2 or 9, or 6 if it is square"),
        )?;
        ensure([1, 2].contains(&kind), || {
            self.wrong("the header of a real matrix (type 1 or 2)")
        })?;
        let format = self.line().get(4 * self.integer + NAME..);
        let width = format.and_then(|format| {
            let (_, width) = format.split_once(['E', 'D', 'e', 'd'])?;
            width.split('.').next()?.parse().ok()
        });
        let width = width
            .filter(|width| *width > 0)
            .ok_or_else(|| self.wrong("a header with a format such as 1P,5E16.9"))?;
        let mut last = 0;
        loop {
            self.at += 1;
            let (column, first, words) = (self.integer(0)?, self.integer(1)?, self.integer(2)?);
            if column > columns {
                self.at += 2; // The last record has one number, which says nothing.
                break;
            }
            ensure(column > last, || {
                self.wrong("the header of a column after the last one")
            })?;
            last = column;
            self.column([rows, column, first, words], width, is_large)?;
        }
        let mut entries = std::mem::take(&mut self.entries);
        if form == 6 {
            // Both triangles may differ by round-off.
            entries = mirrored(entries.clone()).unwrap_or(entries);
        }
        let digits = std::mem::take(&mut self.digits);
        Ok(
            SparseMatrix::new("matrix of OUTPUT4", rows, columns, entries)?
                .with_half_unit(digits.half_unit()),
        )
    }

    /// Takes a column whose header is at this line: numbers from its first row on, or strings where that is zero.
    fn column(
        &mut self,
        [rows, column, first, words]: [usize; 4],
        width: usize,
        is_large: bool,
    ) -> Result<(), FileError> {
        let (head, before, mut next_row, mut strings) =
            (self.at, self.entries.len(), 1, Vec::new());
        if first > 0 {
            self.numbers(width, [first, rows, column])?;
        }
        let most = 2 * self.integer;
        let is_string = |line: &&str| !line.contains('.') && line.len() <= most;
        while first == 0 && self.lines.get(self.at + 1).is_some_and(is_string) {
            self.at += 1;
            let (words, row) = if is_large {
                (self.integer(0)?, self.integer(1)?)
            } else {
                let both = self.line().trim().parse::<usize>();
                let both = both.map_err(|_| self.wrong("the one integer of a string's header"))?;
                (both / ROWS_IN_HEADER, both % ROWS_IN_HEADER)
            };
            ensure(row >= next_row, || {
                self.wrong("the header of a string below the last one")
            })?;
            let string = self.at;
            let count = self.numbers(width, [row, rows, column])?;
            next_row = row + count;
            strings.push((string, words, count));
        }
        let all = self.entries.len() - before;
        let counts = |at, is_met| {
            ensure(is_met, || {
                FileError::at(
                    self.file,
                    &self.lines,
                    at,
                    "a header that counts the numbers below it",
                )
            })
        };
        counts(
            head,
            if first > 0 {
                all == words
            } else {
                !strings.is_empty()
            },
        )?;
        // A number has one word or two. Some programs count one in any case, or all of the column for every string.
        strings.into_iter().try_for_each(|(at, words, count)| {
            let all = [count, 2 * count, 2 * all];
            counts(at, all.iter().any(|own| own + 1 == words))
        })
    }

    /// Takes the numbers after this line from a row of a column on, and returns how many there are.
    fn numbers(
        &mut self,
        width: usize,
        [first, rows, column]: [usize; 3],
    ) -> Result<usize, FileError> {
        let mut row = first;
        while let Some(&line) = self
            .lines
            .get(self.at + 1)
            .filter(|line| line.contains('.'))
        {
            self.at += 1;
            line.as_bytes()
                .chunks(width)
                .for_each(|own| self.digits.add(&String::from_utf8_lossy(own)));
            for value in parse_reals(line, width)
                .ok_or_else(|| self.wrong("a line of real numbers in the header's format"))?
            {
                ensure(row <= rows, || {
                    self.wrong("a line of numbers that ends within the column")
                })?;
                self.entries.push((row - 1, column - 1, value));
                row += 1;
            }
        }
        Ok(row - first)
    }
}
