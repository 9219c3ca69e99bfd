//! One bulk data card as it is read: a name and its fields, with where they came from.

use super::number::parse_real;
use crate::files::error::{FileError, ensure, is_not};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Data fields of a line in the small format, numbered 2 to 9; field 1 is the name, field 10 the continuation.
pub const FIELDS_PER_LINE: usize = 8;
/// Largest number of a grid, an element and so on.
pub const LARGEST_LABEL: usize = 99_999_999;

/// A field as it was read: its text without blanks at either end, and its line, from one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Field {
    pub text: String,
    pub line: usize,
}

impl Field {
    /// An empty field of a line.
    pub fn blank(line: usize) -> Self {
        let text = String::new();
        Self { text, line }
    }
}

/// A card as it was read, its continuations joined to it. Where a function refuses what a field says, its error is a
/// [`FileError::DeckLine`] about that field.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Card {
    pub file: Arc<str>,
    /// The line of its name, from one.
    pub line: usize,
    /// Name in capitals and without the asterisk of the large format.
    pub name: String,
    /// Eight for every line of the small format or two lines of the large.
    pub fields: Vec<Field>,
    /// A line that is none of a card, and why.
    pub fault: Option<(usize, String)>,
}

/// The value read from a card, and the field where its entry begins: 2, or 4, 6 and 8 for further masses of PMASS.
#[derive(Debug)]
pub struct Kept<T> {
    pub value: T,
    pub card: Card,
    pub start: usize,
}

/// The values of the cards of one kind, by number.
pub type Numbered<T> = BTreeMap<usize, Kept<T>>;

impl Card {
    /// The card, unless something is wrong with one of its lines.
    pub fn sound(self) -> Result<Self, FileError> {
        match self.fault {
            Some((line, reason)) => Err(FileError::line(&self.file, line, reason)),
            None => Ok(self),
        }
    }

    /// A field by its NASTRAN number: 2 to 9 on the first line, 12 to 19 on the first continuation and so on.
    fn field(&self, number: usize) -> Option<&Field> {
        self.fields.get(place(number))
    }

    /// Text of a field by its number; empty if there is none.
    pub fn text(&self, field: usize) -> &str {
        self.field(field).map_or("", |field| field.text.as_str())
    }

    /// Texts of all fields.
    pub fn texts(&self) -> Vec<String> {
        self.fields.iter().map(|field| field.text.clone()).collect()
    }

    /// Writes a field anew.
    pub fn set(&mut self, field: usize, text: String) {
        let whole = self.fields.len().max(place(field) + 1);
        self.fields.resize(whole, Field::blank(self.line));
        self.fields[place(field)].text = text;
    }

    /// Numbers of the fields that are not blank, in order.
    pub fn filled(&self) -> Vec<usize> {
        let filled = (0..self.fields.len()).filter(|&place| !self.fields[place].text.is_empty());
        filled
            .map(|place| 10 * (place / FIELDS_PER_LINE) + place % FIELDS_PER_LINE + 2)
            .collect()
    }

    /// An error about a field: 2 to 9 on the card's first line, 12 to 19 on its first continuation, and so on.
    pub fn error(&self, field: usize, reason: impl Into<String>) -> FileError {
        let line = self.field(field).map_or(self.line, |field| field.line);
        let reason = reason.into();
        let reason = format!("card {}, field {field}: {reason}", self.name);
        FileError::line(&self.file, line, reason)
    }

    /// An error about a field whose text is not what belongs there.
    pub fn wrong(&self, field: usize, what: &str) -> FileError {
        self.error(field, is_not(self.text(field), what))
    }

    /// Refuses a field unless its text is what belongs there.
    pub fn require(&self, is_met: bool, field: usize, what: &str) -> Result<(), FileError> {
        ensure(is_met, || self.wrong(field, what))
    }

    /// A positive integer of at most eight digits.
    pub fn label(&self, field: usize) -> Result<usize, FileError> {
        match self.text(field).parse() {
            Ok(label) if (1..=LARGEST_LABEL).contains(&label) => Ok(label),
            _ => Err(self.wrong(field, "a positive integer of at most eight digits")),
        }
    }

    /// A real number; `None` for a blank.
    pub fn optional_real(&self, field: usize) -> Result<Option<f64>, FileError> {
        match (self.text(field), parse_real(self.text(field))) {
            ("", _) => Ok(None),
            (_, Some(value)) => Ok(Some(value)),
            _ => Err(self.wrong(field, "a real number with a decimal point")),
        }
    }

    /// A real number; a blank is zero, as NASTRAN reads it.
    pub fn real(&self, field: usize) -> Result<f64, FileError> {
        Ok(self.optional_real(field)?.unwrap_or(0.0))
    }

    /// A positive real number.
    pub fn positive(&self, field: usize) -> Result<f64, FileError> {
        match self.optional_real(field)? {
            Some(value) if value > 0.0 => Ok(value),
            _ => Err(self.wrong(field, "a positive real number")),
        }
    }

    /// Requires a blank or zero where the crate has nothing for the field's `meaning`.
    pub fn absent(&self, field: usize, meaning: &str) -> Result<(), FileError> {
        let text = self.text(field);
        ensure(
            text.is_empty() || text.parse() == Ok(0) || parse_real(text) == Some(0.0),
            || {
                let reason = format!("\"{text}\" must be blank or zero: corfem has no {meaning}");
                self.error(field, reason)
            },
        )
    }

    /// Directions x, y, z among components such as `123`; the rotations, 4 to 6, are allowed and left out.
    pub fn directions(&self, field: usize) -> Result<[bool; 3], FileError> {
        let components = self.text(field);
        self.require(
            components.chars().all(|c| ('1'..='6').contains(&c)),
            field,
            "a list of components 1 to 6",
        )?;
        Ok(['1', '2', '3'].map(|component| components.contains(component)))
    }

    /// The one direction, 0 to 2, of a component 1, 2 or 3.
    pub fn direction(&self, field: usize) -> Result<usize, FileError> {
        ["1", "2", "3"]
            .iter()
            .position(|c| *c == self.text(field))
            .ok_or_else(|| self.wrong(field, "component 1, 2 or 3"))
    }

    /// Adds an entry to others by the number in its first field, which no other card may have.
    pub fn keep<T>(
        &self,
        start: usize,
        value: T,
        others: &mut Numbered<T>,
    ) -> Result<(), FileError> {
        let kept = Kept {
            value,
            card: self.clone(),
            start,
        };
        let first = others.insert(self.label(start)?, kept);
        first.map_or(Ok(()), |first| {
            let (line, number) = (first.card.line, self.text(start));
            let reason = format!("the card in line {line} has the number {number} already");
            Err(self.error(start, reason))
        })
    }

    /// The entry that a field refers to by its number, which must exist; `card` is the name of the card it is on.
    pub fn referred<'a, T>(
        &self,
        field: usize,
        all: &'a BTreeMap<usize, T>,
        card: &str,
    ) -> Result<&'a T, FileError> {
        all.get(&self.label(field)?)
            .ok_or_else(|| self.wrong(field, &format!("the number of a {card} card")))
    }
}

/// Place among the fields of one by its NASTRAN number, whose last digit is 2 to 9.
fn place(number: usize) -> usize {
    FIELDS_PER_LINE * (number / 10) + number % 10 - 2
}
