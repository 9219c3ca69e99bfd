//! One bulk data card: a name and its fields, with where they came from.

use super::number::{LARGE_FIELD, SMALL_FIELD, exact_real, large_real, parse_real};
use crate::files::error::FileError;
use crate::method::error::Error;
use std::fmt::Write;
use std::sync::Arc;

/// Data fields of a line in the small format, numbered 2 to 9; field 1 is the name, field 10 the continuation.
pub const FIELDS_PER_LINE: usize = 8;
/// Data fields of a line in the large format.
pub const LARGE_FIELDS_PER_LINE: usize = 4;
/// Largest number of a grid, an element and so on.
const LARGEST_LABEL: usize = 99_999_999;

/// A field as it was read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Field {
    /// Its text without blanks at either end.
    pub text: String,
    /// The line it stands in, from one.
    pub line: usize,
}

/// A card as it was read, its continuations joined to it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Card {
    /// The file, for messages.
    pub file: Arc<str>,
    /// The line of its name, from one.
    pub line: usize,
    /// Its name, such as `GRID`, in capitals and without the asterisk of the large format.
    pub name: String,
    /// Data fields, eight for every line of the small format or two lines of the large.
    pub fields: Vec<Field>,
}

impl Card {
    /// Text of a field by its NASTRAN number: 2 to 9 on the first line, 12 to 19 on the first continuation and so on.
    /// Empty if there is none.
    pub fn text(&self, field: usize) -> &str {
        self.fields
            .get(index(field))
            .map_or("", |field| field.text.as_str())
    }

    /// NASTRAN number of the last field that is not blank; 1 if all are.
    pub fn last_field(&self) -> usize {
        match self.fields.iter().rposition(|f| !f.text.is_empty()) {
            Some(index) => 10 * (index / FIELDS_PER_LINE) + index % FIELDS_PER_LINE + 2,
            None => 1,
        }
    }

    /// An error about a field.
    pub fn error(&self, field: usize, expected: impl Into<String>) -> FileError {
        let found = match self.text(field) {
            "" => "a blank".to_owned(),
            text => text.to_owned(),
        };
        FileError::DeckField {
            file: self.file.to_string(),
            line: self.fields.get(index(field)).map_or(self.line, |f| f.line),
            card: self.name.clone(),
            field,
            expected: expected.into(),
            found,
        }
    }

    /// A positive integer of at most eight digits.
    ///
    /// # Errors
    /// [`FileError::DeckField`] for anything else.
    pub fn label(&self, field: usize) -> Result<usize, FileError> {
        match self.text(field).parse() {
            Ok(label) if (1..=LARGEST_LABEL).contains(&label) => Ok(label),
            _ => Err(self.error(field, "a positive integer of at most eight digits")),
        }
    }

    /// A real number; `None` for a blank.
    ///
    /// # Errors
    /// [`FileError::DeckField`] for anything else.
    pub fn optional_real(&self, field: usize) -> Result<Option<f64>, FileError> {
        match self.text(field) {
            "" => Ok(None),
            text => parse_real(text)
                .map(Some)
                .ok_or_else(|| self.error(field, "a real number with a decimal point")),
        }
    }

    /// A real number; a blank is zero, as NASTRAN reads it.
    ///
    /// # Errors
    /// As [`Self::optional_real`].
    pub fn real(&self, field: usize) -> Result<f64, FileError> {
        Ok(self.optional_real(field)?.unwrap_or(0.0))
    }

    /// A positive real number.
    ///
    /// # Errors
    /// [`FileError::DeckField`] for anything else.
    pub fn positive(&self, field: usize) -> Result<f64, FileError> {
        match self.optional_real(field)? {
            Some(value) if value > 0.0 => Ok(value),
            _ => Err(self.error(field, "a positive real number")),
        }
    }

    /// Refuses what the crate's elements do not have: the field must be blank or zero.
    ///
    /// # Errors
    /// [`FileError::DeckField`] saying what `meaning` is not supported.
    pub fn absent(&self, field: usize, meaning: &str) -> Result<(), FileError> {
        let text = self.text(field);
        if text.is_empty() || text.parse() == Ok(0) || parse_real(text) == Some(0.0) {
            return Ok(());
        }
        Err(self.error(
            field,
            format!("a blank or zero, for the crate has no {meaning}"),
        ))
    }

    /// Directions x, y, z named by a list of components such as `123`; 4 to 6, the rotations, are allowed and have no place
    /// in the result.
    ///
    /// # Errors
    /// [`FileError::DeckField`] for other characters.
    pub fn directions(&self, field: usize) -> Result<[bool; 3], FileError> {
        let mut named = [false; 3];
        for component in self.text(field).chars() {
            match component {
                '1' => named[0] = true,
                '2' => named[1] = true,
                '3' => named[2] = true,
                '4'..='6' => {}
                _ => return Err(self.error(field, "components from 1 to 6")),
            }
        }
        Ok(named)
    }

    /// The one direction, 0 to 2, of a component 1, 2 or 3.
    ///
    /// # Errors
    /// [`FileError::DeckField`] for anything else.
    pub fn direction(&self, field: usize) -> Result<usize, FileError> {
        match self.text(field) {
            "1" => Ok(0),
            "2" => Ok(1),
            "3" => Ok(2),
            _ => Err(self.error(field, "component 1, 2 or 3")),
        }
    }
}

fn index(field: usize) -> usize {
    FIELDS_PER_LINE * (field / 10) + (field % 10).saturating_sub(2)
}

/// A field to be written.
#[derive(Debug, Clone, PartialEq)]
pub enum Entry {
    /// Nothing.
    Blank,
    /// A number of a grid, an element and so on.
    Label(usize),
    /// A word or a list of components.
    Word(String),
    /// A real number.
    Real(f64),
}

/// Writes a card: fields of 8 characters if they hold every number exactly and `large` is false, of 16 otherwise.
///
/// `tag` counts the continuations of the deck, so that each has a name of its own.
///
/// # Errors
/// [`Error::NotFinite`] for a number that is not; [`Error::TooMany`] for a label of more than eight digits.
pub fn write_card(
    name: &str,
    entries: &[Entry],
    large: bool,
    tag: &mut usize,
) -> Result<String, FileError> {
    let exact = |entry: &Entry| match entry {
        Entry::Real(value) => exact_real(*value, SMALL_FIELD).is_some(),
        _ => true,
    };
    let large = large || !entries.iter().all(exact);
    let (width, per_line, mark) = if large {
        (LARGE_FIELD, LARGE_FIELDS_PER_LINE, "*")
    } else {
        (SMALL_FIELD, FIELDS_PER_LINE, "")
    };
    let mut fields = Vec::with_capacity(entries.len());
    for (column, entry) in entries.iter().enumerate() {
        fields.push(match entry {
            Entry::Blank => String::new(),
            Entry::Label(label) if *label > LARGEST_LABEL => {
                return Err(Error::TooMany {
                    what: "number of a grid or element in a deck",
                    available: LARGEST_LABEL,
                    requested: *label,
                }
                .into());
            }
            Entry::Label(label) => label.to_string(),
            Entry::Word(word) => word.clone(),
            Entry::Real(value) => large_real(*value).ok_or(Error::NotFinite {
                what: "number on a bulk data card",
                row: 0,
                column,
                value: *value,
            })?,
        });
    }
    // NASTRAN-95 takes a line of the large format for half a card and wants the other half too.
    fields.resize(
        fields.len().next_multiple_of(FIELDS_PER_LINE),
        String::new(),
    );
    let lines: Vec<&[String]> = fields.chunks(per_line).collect();
    let mut text = String::new();
    let mut first = format!("{name}{mark}");
    for (row, line) in lines.iter().enumerate() {
        let mut written = format!("{first:SMALL_FIELD$}");
        for field in *line {
            let _ = write!(written, "{field:width$}");
        }
        if row + 1 < lines.len() {
            *tag += 1;
            first = format!("{}{tag}", if large { '*' } else { '+' });
            written.push_str(&first);
        }
        text.push_str(written.trim_end());
        text.push('\n');
    }
    Ok(text)
}
