//! Rewrites a deck with other sizes and densities of its elements and other point masses; every other card stays, byte by byte.

use super::card::{Card, Kept};
use super::elements::ElementCards;
use super::lines::cards;
use super::number::written_real;
use super::write::Cards;
use crate::files::error::FileError;
use crate::files::text::{decoded, encoded};
use crate::method::structure::Material;
use std::collections::{BTreeMap, BTreeSet};

/// The changes of a deck.
#[derive(Default)]
struct Changes {
    /// Largest number of a property or a material so far.
    last: usize,
    /// New materials by the line of those they replace and the factor on their density.
    materials: BTreeMap<(usize, u64), String>,
    /// Cards with other fields, by their first lines.
    edited: BTreeMap<usize, Card>,
    /// Text in front of a line.
    added: BTreeMap<usize, String>,
    writer: Cards,
}

/// The deck `bytes`, `file` in messages, with factors on the size and the density of elements and on point masses, by their numbers; those
/// of numbers that it does not have change nothing.
///
/// A number is written as the nearest of a field of 8 characters, or of 16 where that is farther off than a millionth. A changed card is
/// written anew, behind the comments of its lines. Where elements of one property need different factors, those that change get properties
/// of their own in front of it, and a new density gets a new MAT1 card. Every other byte stays.
///
/// # Errors
/// [`FileError::DeckLine`] where the deck does not read, or masses of one PMASS have different factors;
/// [`Error::Value`](crate::method::error::Error::Value) and [`Error::Count`](crate::method::error::Error::Count) for numbers that no card
/// can hold.
pub fn rewrite(
    file: &str,
    bytes: &[u8],
    elements: &BTreeMap<usize, [f64; 2]>,
    masses: &BTreeMap<usize, f64>,
) -> Result<Vec<u8>, FileError> {
    let text = decoded(bytes);
    let cards = cards(file, &text)?;
    let mut known = ElementCards::default();
    cards.iter().try_for_each(|card| known.take(card))?;
    let numbers = cards
        .iter()
        .filter(|card| card.name.starts_with(['P', 'M']))
        .flat_map(|card| [2, 6].map(|field| card.label(field).unwrap_or(0)));
    let mut changes = Changes {
        last: numbers.max().unwrap_or(0),
        writer: Cards::beside(&text),
        ..Changes::default()
    };
    changes.scale_elements(&known, elements)?;
    changes.scale_masses(&known, masses)?;
    let edited = std::mem::take(&mut changes.edited);
    for card in edited.values() {
        changes.add(card, &card.texts())?;
    }
    let replaced: BTreeSet<usize> = edited
        .values()
        .flat_map(|card| &card.fields)
        .map(|field| field.line)
        .collect();
    let mut written = String::with_capacity(text.len());
    for (number, line) in (1..).zip(text.split_inclusive('\n')) {
        let (comment, body) = if replaced.contains(&number) {
            (&line[line.find('$').unwrap_or(line.len())..], "")
        } else {
            ("", line)
        };
        let end = if line.ends_with("\r\n") { "\r\n" } else { "\n" };
        let added = changes.added.remove(&number).unwrap_or_default();
        written.extend([comment, &added.replace('\n', end), body]);
    }
    Ok(encoded(written, bytes))
}

impl Changes {
    fn scale_elements(
        &mut self,
        known: &ElementCards,
        factors: &BTreeMap<usize, [f64; 2]>,
    ) -> Result<(), FileError> {
        // The elements of every property, or a CONROD alone, by their factors.
        let mut users = BTreeMap::new();
        for (label, kept) in &known.connections {
            let holder = known.holder(kept)?;
            let own = factors.get(label).unwrap_or(&[1.0; 2]).map(f64::to_bits);
            let (_, groups) = users
                .entry((holder.card.line, holder.size_field))
                .or_insert((holder, BTreeMap::<_, Vec<_>>::new()));
            groups.entry(own).or_default().push(kept);
        }
        for (holder, groups) in users.into_values() {
            let (card, first) = (holder.card, holder.size_field - 2);
            let is_alike = groups.len() == 1;
            for (factors, members) in groups {
                let [size, density] = factors.map(f64::from_bits);
                if [size, density] == [1.0; 2] {
                    continue;
                }
                let texts = (first..=holder.mass_field).map(|field| card.text(field).to_owned());
                let mut texts: Vec<String> = texts.collect();
                texts[1] = self.material(holder.material(&known.materials)?, density)?;
                texts[2] = written_real(holder.size * size);
                if holder.mass > 0.0 {
                    texts[holder.mass_field - first] = written_real(holder.mass * size * density);
                }
                if is_alike {
                    for (field, text) in (first..).zip(texts) {
                        self.set(card, field, text);
                    }
                } else {
                    texts[0] = self.next_number();
                    for member in members {
                        self.set(&member.card, 3, texts[0].clone());
                    }
                    self.add(card, &texts)?;
                }
            }
        }
        Ok(())
    }

    fn scale_masses(
        &mut self,
        known: &ElementCards,
        factors: &BTreeMap<usize, f64>,
    ) -> Result<(), FileError> {
        let mut shared = BTreeMap::new();
        for (label, Kept { card, .. }) in &known.points {
            let (holder, field) = known.mass(card)?;
            let factor = *factors.get(label).unwrap_or(&1.0);
            if *shared.entry((holder.line, field)).or_insert(factor) != factor {
                return Err(card.error(3, "masses of one PMASS card change by different factors; give each a card of its own"));
            }
            if factor != 1.0 {
                self.set(holder, field, written_real(holder.real(field)? * factor));
            }
        }
        Ok(())
    }

    /// The number of a material with this factor on its density: its own where that changes nothing.
    fn material(&mut self, own: &Kept<Material>, factor: f64) -> Result<String, FileError> {
        let (card, density) = (&own.card, own.value.density * factor);
        let mut texts = card.texts();
        if density != own.value.density {
            let key = (card.line, factor.to_bits());
            if let Some(label) = self.materials.get(&key) {
                return Ok(label.clone());
            }
            (texts[0], texts[4]) = (self.next_number(), written_real(density));
            self.materials.insert(key, texts[0].clone());
            self.add(card, &texts)?;
        }
        Ok(texts.swap_remove(0))
    }

    fn next_number(&mut self) -> String {
        self.last += 1;
        self.last.to_string()
    }

    /// Adds a card of the same name in front of another.
    fn add(&mut self, card: &Card, texts: &[String]) -> Result<(), FileError> {
        self.writer.push(&card.name, &texts.join(","))?;
        let text = std::mem::take(&mut self.writer.text);
        *self.added.entry(card.line).or_default() += &text;
        Ok(())
    }

    /// Writes a field of a card anew.
    fn set(&mut self, card: &Card, field: usize, text: String) {
        self.edited
            .entry(card.line)
            .or_insert_with(|| card.clone())
            .set(field, text);
    }
}
