//! Cards by the number they give a grid, an element, a property or a material.

use super::card::Card;
use crate::files::error::FileError;
use std::collections::BTreeMap;

/// What a card says, with the card for messages.
#[derive(Debug)]
pub(super) struct Kept<T> {
    /// What it says.
    pub value: T,
    /// The card.
    pub card: Card,
    /// Where its entry begins: field 2, or field 6 for the second of two on a card.
    pub start: usize,
}

/// Entries by number, each number once.
#[derive(Debug)]
pub(super) struct Numbered<T>(BTreeMap<usize, Kept<T>>);

impl<T> Numbered<T> {
    /// None yet.
    pub fn new() -> Self {
        Self(BTreeMap::new())
    }

    /// Adds the entry whose number stands in field `start`.
    ///
    /// # Errors
    /// [`FileError::DeckField`] for a bad number or one that another card has.
    pub fn insert(&mut self, card: &Card, start: usize, value: T) -> Result<(), FileError> {
        let label = card.label(start)?;
        if let Some(first) = self.0.get(&label) {
            let line = first.card.line;
            return Err(card.error(
                start,
                format!("a number other than that of the card in line {line}"),
            ));
        }
        let card = card.clone();
        self.0.insert(label, Kept { value, card, start });
        Ok(())
    }

    /// The entry that a field of another card refers to.
    ///
    /// # Errors
    /// [`FileError::DeckField`] about that field when there is none; `what` is the card looked for.
    pub fn referred(&self, card: &Card, field: usize, what: &str) -> Result<&Kept<T>, FileError> {
        self.0
            .get(&card.label(field)?)
            .ok_or_else(|| card.error(field, format!("the number of a {what} card")))
    }

    /// All entries, by number.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &Kept<T>)> {
        self.0.iter().map(|(label, kept)| (*label, kept))
    }
}
