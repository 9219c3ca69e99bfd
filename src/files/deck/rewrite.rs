//! A deck with other sizes and densities of its elements, and all else of it byte by byte as it was.

use super::card::{Card, FIELDS_PER_LINE, Kept};
use super::continuation::cards;
use super::elements::{ELEMENT_CARDS, ElementCards, Size};
use super::known;
use super::lines::{LARGE_FIELDS_PER_LINE, decoded, expand_tabs, is_large};
use super::number::{LARGE_FIELD, SMALL_FIELD, large_real, nearest_in_field};
use super::write::{Cards, Entry};
use crate::files::error::FileError;
use crate::method::error::Error;
use crate::method::structure::{Element, Material};
use std::collections::{BTreeMap, HashMap};

/// Size and density of an element by their bits, so that they can be told apart and sorted.
type Target = (u64, u64);

/// What is to change: fields by line and place, counted from the line's last field, and cards behind a line.
struct Changes<'a> {
    fields: BTreeMap<usize, BTreeMap<usize, String>>,
    added: BTreeMap<usize, String>,
    writer: Cards,
    /// New materials by number and density of those they replace.
    materials: HashMap<(usize, u64), usize>,
    known: &'a ElementCards,
    weight: Option<f64>,
    next_property: usize,
    next_material: usize,
}

/// The deck `bytes`, `name` in messages, with the sizes and densities of these elements, found by their numbers; nothing else
/// of them counts. What [`BulkData::of`](super::BulkData::of) says of a model's elements gives the deck the model's modes.
///
/// Where elements of one property need different sizes, those without a change keep it, or else the most; the others refer
/// to new cards behind it, and a new density to a new MAT1 card. A number that does not fit in its field turns its line into
/// two of the large format. All else stays, byte by byte.
///
/// # Errors
/// [`FileError::DeckLine`] and [`FileError::DeckField`] where the deck does not read or would not hold a number,
/// [`Error::Unknown`] for an element that it does not have, [`Error::TooMany`] without a free number.
pub fn rewrite(name: &str, bytes: &[u8], elements: &[Element]) -> Result<Vec<u8>, FileError> {
    let text = decoded(bytes);
    let cards = cards(name, &text)?;
    let (mut known, mut weight) = (ElementCards::default(), None);
    for card in &cards {
        known.take(card)?;
        if known::name(card) == "PARAM WTMASS" {
            weight = Some(card.positive(3)?);
        }
    }
    // No name of a continuation, and no remark in field 10, begins with letters that the deck has nowhere.
    let capitals = text.to_ascii_uppercase();
    let prefix = (1..).map(|count| "Z".repeat(count)).find(|prefix| !capitals.contains(prefix)).unwrap_or_default();
    let mut changes = Changes {
        fields: BTreeMap::new(),
        added: BTreeMap::new(),
        writer: Cards { prefix, ..Cards::default() },
        materials: HashMap::new(),
        known: &known,
        weight,
        next_property: next_number(&cards, "P"),
        next_material: next_number(&cards, "MAT"),
    };
    changes.find(name, elements)?;
    if changes.fields.is_empty() {
        return Ok(bytes.to_vec());
    }
    let mut written = String::with_capacity(text.len());
    for (number, line) in (1..).zip(text.split_inclusive('\n')) {
        let end = if line.ends_with("\r\n") { "\r\n" } else { "\n" };
        match changes.fields.get(&number) {
            Some(fields) => written.push_str(&changed(line, fields, &mut changes.writer)),
            None => written.push_str(line),
        }
        if let Some(cards) = changes.added.get(&number) {
            written.push_str(if line.ends_with('\n') { "" } else { end });
            written.push_str(&cards.replace('\n', end));
        }
    }
    // Text that is not in UTF-8 was read as Latin-1, which has no character above 255.
    let is_utf_8 = std::str::from_utf8(bytes).is_ok();
    let written = if is_utf_8 { written.into_bytes() } else { written.chars().map(|c| u32::from(c) as u8).collect() };
    let mark = bytes.len() - bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes).len();
    Ok([&bytes[..mark], &written].concat())
}

/// The number after the largest of the cards whose names begin alike; parameters have none.
fn next_number(cards: &[Card], start: &str) -> usize {
    let alike = cards.iter().filter(|card| card.name.starts_with(start));
    alike.flat_map(|card| [2, 6].map(|field| card.label(field).unwrap_or(0))).max().unwrap_or(0) + 1
}

impl Changes<'_> {
    /// Compares the elements with the deck's.
    fn find(&mut self, name: &str, elements: &[Element]) -> Result<(), FileError> {
        let known = self.known;
        let mut wanted: HashMap<usize, Target> = HashMap::new();
        for element in elements {
            if !known.connections.contains_key(&element.label) {
                return Err(Error::Unknown { owner: name.to_owned(), what: "element", label: element.label }.into());
            }
            wanted.insert(element.label, (element.size.to_bits(), element.material.density.to_bits()));
        }
        let mut users: BTreeMap<(usize, usize), BTreeMap<Target, Vec<&Kept<_>>>> = BTreeMap::new();
        for (label, kept) in &known.connections {
            let wanted = wanted.get(label).copied();
            match kept.value.1 {
                Size::Own(size) => {
                    let own = (size.to_bits(), self.density(&kept.card, 5)?.to_bits());
                    self.change(&kept.card, [6, 5], own, wanted.unwrap_or(own))?;
                }
                Size::Property(row) => {
                    let number = kept.card.label(kept.start + 1)?;
                    let of = kept.card.referred(kept.start + 1, &known.properties[row], ELEMENT_CARDS[row].1)?;
                    let own = (of.value.to_bits(), self.density(&of.card, of.start + 1)?.to_bits());
                    let groups = users.entry((row, number)).or_default();
                    groups.entry(wanted.unwrap_or(own)).or_default().push(kept);
                }
            }
        }
        for ((row, number), groups) in users {
            let Some(Kept { value, card, start }) = known.properties[row].get(&number) else { continue };
            let own = (value.to_bits(), self.density(card, start + 1)?.to_bits());
            let most = groups.iter().max_by_key(|(target, members)| (**target == own, members.len()));
            let stays = most.map_or(own, |(target, _)| *target);
            self.change(card, [start + 2, start + 1], own, stays)?;
            for (target, members) in groups.into_iter().filter(|(target, _)| *target != stays) {
                let material = self.material(card, start + 1, own.1, target.1)?;
                let last = if card.name == "PROD" { 5 } else { 3 };
                let rest = (3..=last).map(|field| Entry::Word(card.text(start + field).to_owned()));
                let own = [self.next_property.into(), material, f64::from_bits(target.0).into()];
                self.add(card, own.into_iter().chain(rest).collect())?;
                for member in members {
                    self.set(&member.card, member.start + 1, self.next_property.to_string())?;
                }
                self.next_property += 1;
            }
        }
        Ok(())
    }

    /// The density of the material that a field refers to, as the reader gives it to elements.
    fn density(&self, card: &Card, field: usize) -> Result<f64, FileError> {
        let Material { density, .. } = card.referred(field, &self.known.materials, "MAT1")?.value;
        let weighted = |weight: f64| if density > 0.0 { nearest_in_field(weight * density) } else { density };
        Ok(self.weight.map_or(density, weighted))
    }

    /// Gives a card with its size and material in these fields another size and density.
    fn change(
        &mut self,
        card: &Card,
        [size, material]: [usize; 2],
        own: Target,
        target: Target,
    ) -> Result<(), FileError> {
        if own.0 != target.0 {
            let text = large_real(f64::from_bits(target.0)).ok_or_else(|| card.error(size, "a finite new number"))?;
            self.set(card, size, text)?;
        }
        if let Entry::Label(label) = self.material(card, material, own.1, target.1)? {
            self.set(card, material, label.to_string())?;
        }
        Ok(())
    }

    /// The material of a field for another density: a new one, or what the field says if the density is the same.
    fn material(&mut self, card: &Card, field: usize, own: u64, density: u64) -> Result<Entry, FileError> {
        if own == density {
            return Ok(Entry::Word(card.text(field).to_owned()));
        }
        let first = card.label(field)?;
        if let Some(label) = self.materials.get(&(first, density)) {
            return Ok(Entry::Label(*label));
        }
        let card = &card.referred(field, &self.known.materials, "MAT1")?.card;
        let mut entries: Vec<Entry> = card.fields.iter().map(|field| Entry::Word(field.text.clone())).collect();
        let label = self.next_material;
        entries[0] = label.into();
        entries[4] = (f64::from_bits(density) / self.weight.unwrap_or(1.0)).into();
        self.add(card, entries)?;
        self.next_material += 1;
        self.materials.insert((first, density), label);
        Ok(Entry::Label(label))
    }

    /// Puts a card of the same name behind another.
    fn add(&mut self, card: &Card, entries: Vec<Entry>) -> Result<(), FileError> {
        self.writer.text.clear();
        self.writer.put(&card.name, entries)?;
        let line = card.fields.iter().map(|field| field.line).max().unwrap_or(card.line);
        self.added.entry(line).or_default().push_str(&self.writer.text);
        Ok(())
    }

    /// Writes a field of a card anew.
    fn set(&mut self, card: &Card, field: usize, text: String) -> Result<(), FileError> {
        let place = FIELDS_PER_LINE * (field / 10) + field % 10 - 2;
        let own = card.fields.get(place..).unwrap_or_default();
        let line = own.first().ok_or_else(|| card.error(field, "a field to write in"))?.line;
        let from_last = own.iter().take_while(|other| other.line == line).count();
        self.fields.entry(line).or_default().insert(from_last, text);
        Ok(())
    }
}

/// A line with other texts in some fields, counted from its last; as two lines of the large format if they need it.
fn changed(line: &str, texts: &BTreeMap<usize, String>, writer: &mut Cards) -> String {
    let body = line.trim_end_matches(['\r', '\n']);
    let end = &line[body.len()..];
    let (code, comment) = body.split_at(body.find('$').unwrap_or(body.len()));
    let is_free = code.contains(',');
    let columns = expand_tabs(code);
    let slice = |from: usize, to: usize| columns.iter().take(to).skip(from).collect::<String>();
    let name = if is_free { code.split(',').next().unwrap_or_default().to_owned() } else { slice(0, SMALL_FIELD) };
    let is_large = is_large(name.trim());
    let (width, count) = if is_large { (LARGE_FIELD, LARGE_FIELDS_PER_LINE) } else { (SMALL_FIELD, FIELDS_PER_LINE) };
    let field = |place: usize| SMALL_FIELD + width * place;
    // The fields, and what follows them in a part of its own.
    let mut parts: Vec<String> = match is_free {
        true => code.split(',').skip(1).map(str::to_owned).collect(),
        false => (0..count)
            .map(|place| slice(field(place), field(place + 1)))
            .chain([slice(field(count), usize::MAX)])
            .collect(),
    };
    let given = parts.len();
    parts.resize(given.max(count), String::new());
    for (from_last, text) in texts {
        let Some(part) = count.checked_sub(*from_last).and_then(|place| parts.get_mut(place)) else { continue };
        let old = part.chars().count();
        // A number stays at the side of its field where it was.
        *part = match () {
            () if is_free => part.replacen(&part.trim().to_owned(), text, 1),
            () if part.starts_with(' ') => format!("{text:>old$}"),
            () => format!("{text:old$}"),
        };
    }
    if texts.values().all(|text| text.len() <= width) {
        let separator = if is_free { "," } else { "" };
        return [&name, separator, &parts[..given].join(separator), comment, end].concat();
    }
    writer.tag += 1;
    let tag = format!("*{}{}", writer.prefix, writer.tag);
    let last = parts.get(count).map_or("", |rest| if is_free { rest.trim() } else { rest });
    let half = |first: &str, parts: &[String]| {
        parts.iter().fold(format!("{first:SMALL_FIELD$}"), |line, part| line + &format!("{:LARGE_FIELD$}", part.trim()))
    };
    let name = format!("{}*", name.trim());
    let first = format!("{}{tag:SMALL_FIELD$}{comment}", half(&name, &parts[..LARGE_FIELDS_PER_LINE]));
    let second = half(&tag, &parts[LARGE_FIELDS_PER_LINE..count]) + last;
    [first.trim_end(), if end.is_empty() { "\n" } else { end }, second.trim_end(), end].concat()
}
