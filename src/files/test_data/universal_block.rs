//! The lines of one dataset of a Universal File, in columns.

use super::real;
use crate::files::error::{FileError, is_not};

/// Columns of a record of node numbers or codes, of one of values, of a line of these.
pub const INTEGER: usize = 10;
pub const REAL: usize = 13;
pub const LONG_REAL: usize = 25;
pub const VALUES: [usize; 6] = [REAL; 6];

/// The lines of one dataset that are still to be read.
pub struct Block<'a> {
    file: &'a str,
    lines: &'a [&'a str],
    /// Number of the next line in the file, from one.
    number: usize,
}

impl<'a> Block<'a> {
    /// The lines of a dataset of which the first has this number in the file.
    pub fn new(file: &'a str, lines: &'a [&'a str], number: usize) -> Self {
        Self {
            file,
            lines,
            number,
        }
    }

    pub fn is_done(&self) -> bool {
        self.lines.iter().all(|line| line.trim().is_empty())
    }

    pub fn line(&mut self, what: &str) -> Result<&'a str, FileError> {
        let reason = || format!("the dataset ends before {what}");
        let end = || FileError::line(self.file, self.number, reason());
        let (first, rest) = self.lines.split_first().ok_or_else(end)?;
        (self.lines, self.number) = (rest, self.number + 1);
        Ok(first)
    }

    /// The number in the file of the line read last.
    pub fn last_number(&self) -> usize {
        self.number - 1
    }

    /// An error about the line read last.
    pub fn wrong(&self, reason: impl Into<String>) -> FileError {
        FileError::line(self.file, self.last_number(), reason)
    }

    pub fn is_not(&self, found: impl ToString, what: &str) -> FileError {
        self.wrong(is_not(&found.to_string(), what))
    }

    /// The numbers of the next line in columns of the given widths, or between blanks; the rest of the line is ignored. A line that gives
    /// other numbers by columns than by blanks is refused, as is one whose columns cut a number that blanks do not give.
    pub fn reals(&mut self, what: &str, widths: &[usize]) -> Result<Vec<f64>, FileError> {
        let line = self.line(what)?;
        let (mut start, mut is_number_cut) = (0, false);
        let column = |&width: &usize| {
            let end = line.len().min(start + width);
            let text = line.get(start..end)?;
            is_number_cut |= is_cut(text, &line[end..]);
            start += width;
            real(text.trim())
        };
        let by_columns: Option<Vec<f64>> = widths.iter().map(column).collect();
        let by_blanks = || {
            line.split_whitespace()
                .take(widths.len())
                .map(real)
                .collect::<Option<Vec<f64>>>()
        };
        let by_blanks = by_blanks().filter(|numbers| numbers.len() == widths.len());
        match (by_columns, by_blanks) {
            (Some(one), Some(other)) if one != other => Err(self.wrong(format!(
                "\"{}\" is {what} in columns of {} and other numbers between blanks; write it in columns that do not touch",
                line.trim(),
                widths[0]
            ))),
            (Some(_), None) if is_number_cut => Err(self.is_not(line.trim(), what)),
            (by_columns, by_blanks) => by_columns
                .or(by_blanks)
                .ok_or_else(|| self.is_not(line.trim(), what)),
        }
    }

    pub fn integers(&mut self, what: &str, count: usize) -> Result<Vec<usize>, FileError> {
        self.reals(what, &[INTEGER].repeat(count))?
            .into_iter()
            .map(|number| integer(number).ok_or_else(|| self.is_not(number, what)))
            .collect()
    }
}

/// True if a column ends within a number: between two digits of which the first ends no exponent of two.
fn is_cut(column: &str, rest: &str) -> bool {
    let is_digit = |own: char| own.is_ascii_digit();
    let mantissa = column.trim_end_matches(is_digit);
    let unsigned = mantissa.trim_end_matches(['+', '-']);
    let is_exponent = if unsigned.len() < mantissa.len() {
        unsigned.ends_with(|own: char| is_digit(own) || "eEdD.".contains(own))
    } else {
        unsigned.ends_with(['e', 'E', 'd', 'D'])
    };
    let digits = column.len() - mantissa.len();
    digits > 0 && rest.starts_with(is_digit) && !(is_exponent && digits > 1)
}

/// A whole number from zero up.
pub fn integer(number: f64) -> Option<usize> {
    ((0.0..1e15).contains(&number) && number.fract() == 0.0).then_some(number as usize)
}
