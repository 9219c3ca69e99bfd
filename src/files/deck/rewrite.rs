//! Rewrites a deck with other sizes and densities of its elements and other point masses; every other byte stays.

use super::card::{Card, FIELDS_PER_LINE, Kept, Numbered};
use super::elements::{ElementCards, Holder, take_masses};
use super::lines::{Cut, LARGE_FIELDS_PER_LINE, cards, cut};
use super::model::PointMass;
use super::number::{LARGE_FIELD, SMALL_FIELD, large_real, nearest_in_field};
use super::read::name;
use super::write::Cards;
use crate::files::error::FileError;
use crate::files::text::decoded;
use crate::method::error::Error;
use crate::method::structure::Element;
use std::collections::{BTreeMap, HashMap};

/// Size and density of an element by their bits, so that they can be told apart and sorted.
type SizeBits = (u64, u64);
/// Elements with one property, grouped by the size and density they need.
type Groups<'a> = BTreeMap<SizeBits, Vec<&'a Kept<Option<usize>>>>;

/// The changes: fields by line and place, counted from the line's last field, and cards to insert after a line.
struct Changes<'a> {
    fields: BTreeMap<usize, BTreeMap<usize, String>>,
    added: BTreeMap<usize, String>,
    writer: Cards,
    /// New materials by number and density of those they replace.
    materials: HashMap<(usize, u64), usize>,
    known: &'a ElementCards,
    weight: f64,
    next_property: usize,
    next_material: usize,
}

/// The deck `bytes`, `file` in messages, with the sizes and densities of these elements and these point masses, found by their
/// numbers; with the elements and masses of [`BulkData::from_model`](super::BulkData::from_model) the deck has a model's modes.
///
/// Where elements of one property need different sizes, the unchanged ones keep the card, or else the largest group does; the
/// others get new cards after it, and a new density gets a new MAT1 card. A number that does not fit in its field turns its line
/// into two of the large format. Every other byte stays.
///
/// # Errors
/// [`FileError::DeckLine`] and [`FileError::DeckField`] where the deck does not read or would not hold a number,
/// [`Error::Unknown`] for an element that it does not have, [`Error::Count`] without a free number.
pub fn rewrite(
    file: &str,
    bytes: &[u8],
    elements: &[Element],
    masses: &[PointMass],
) -> Result<Vec<u8>, FileError> {
    let text = decoded(bytes);
    let cards = cards(file, &text)?;
    let (mut known, mut weight) = (ElementCards::default(), 1.0);
    for card in &cards {
        known.take(card)?;
        if name(card) == "PARAM WTMASS" {
            weight = card.positive(3)?;
        }
    }
    // Letters that occur nowhere in the deck: no continuation's name and no remark in field 10 begins with them.
    let capitals = text.to_ascii_uppercase();
    let prefix = (1..)
        .map(|count| "Z".repeat(count))
        .find(|prefix| !capitals.contains(prefix))
        .unwrap_or_default();
    let mut changes = Changes {
        fields: BTreeMap::new(),
        added: BTreeMap::new(),
        writer: Cards {
            prefix,
            ..Cards::default()
        },
        materials: HashMap::new(),
        known: &known,
        weight,
        next_property: next_number(&cards, "P"),
        next_material: next_number(&cards, "MAT"),
    };
    changes.find(file, elements)?;
    changes.set_masses(&cards, masses)?;
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
    // Ends of lines stay where they are carriage returns alone.
    if !bytes.contains(&b'\n') {
        written = written.replace('\n', "\r");
    }
    // Text that is not in UTF-8 was read as Latin-1, which has no character above 255.
    let is_utf_8 = std::str::from_utf8(bytes).is_ok();
    let written = if is_utf_8 {
        written.into_bytes()
    } else {
        written.chars().map(|c| u32::from(c) as u8).collect()
    };
    let mark = bytes.len()
        - bytes
            .strip_prefix("\u{feff}".as_bytes())
            .unwrap_or(bytes)
            .len();
    Ok([&bytes[..mark], &written].concat())
}

/// The number after the largest of the cards whose names begin alike; parameters have none.
fn next_number(cards: &[Card], start: &str) -> usize {
    let alike = cards.iter().filter(|card| card.name.starts_with(start));
    alike
        .flat_map(|card| [2, 6].map(|field| card.label(field).unwrap_or(0)))
        .max()
        .unwrap_or(0)
        + 1
}

impl Changes<'_> {
    /// Compares the elements with the deck's.
    fn find(&mut self, file: &str, elements: &[Element]) -> Result<(), FileError> {
        let known = self.known;
        let mut wanted: HashMap<usize, SizeBits> = HashMap::new();
        for element in elements {
            if !known.connections.contains_key(&element.label) {
                return Err(Error::Unknown {
                    owner: file.to_owned(),
                    what: "element",
                    label: element.label,
                }
                .into());
            }
            wanted.insert(
                element.label,
                (element.size.to_bits(), element.material.density.to_bits()),
            );
        }
        // By the place of the size.
        let mut users: BTreeMap<_, (Holder, SizeBits, Groups)> = BTreeMap::new();
        for (label, kept) in &known.connections {
            let holder = known.holder(kept)?;
            let own = (holder.size.to_bits(), self.density(&holder)?.to_bits());
            let (.., groups) = users
                .entry((holder.card.line, holder.size_field))
                .or_insert((holder, own, BTreeMap::new()));
            groups
                .entry(wanted.get(label).copied().unwrap_or(own))
                .or_default()
                .push(kept);
        }
        for (holder, own, groups) in users.into_values() {
            let Holder {
                card, size_field, ..
            } = holder;
            // Nonstructural mass keeps its part of an element's mass; without either it is zero and not 0/0.
            let mass_of = |bits: SizeBits| f64::from_bits(bits.0) * f64::from_bits(bits.1);
            let mass = |target| {
                nearest_in_field((holder.mass * (mass_of(target) / mass_of(own))).max(0.0))
            };
            let most = groups
                .iter()
                .max_by_key(|(target, members)| (**target == own, members.len()));
            let stays = most.map_or(own, |(target, _)| *target);
            if stays.0 != own.0 {
                self.set_number(card, size_field, f64::from_bits(stays.0))?;
            }
            if stays.1 != own.1 {
                let material = self.material(&holder, own.1, stays.1)?;
                self.set(card, size_field - 1, material)?;
            }
            if mass(stays) != holder.mass {
                self.set_number(card, holder.mass_field, mass(stays))?;
            }
            for (target, members) in groups.into_iter().filter(|(target, _)| *target != stays) {
                let (label, size) = (self.next_property, f64::from_bits(target.0));
                let material = self.material(&holder, own.1, target.1)?;
                let text = |field| match field == holder.mass_field && holder.mass > 0.0 {
                    true => format!(",{:?}", mass(target)),
                    false => format!(",{}", card.text(field)),
                };
                let rest: String = (size_field + 1..=holder.mass_field).map(text).collect();
                self.add(card, &format!("{label},{material},{size:?}{rest}"))?;
                for member in members {
                    self.set(&member.card, member.start + 1, label.to_string())?;
                }
                self.next_property += 1;
            }
        }
        Ok(())
    }

    /// Compares the point masses with the deck's.
    fn set_masses(&mut self, cards: &[Card], masses: &[PointMass]) -> Result<(), FileError> {
        let masses: HashMap<usize, f64> = masses
            .iter()
            .map(|point| (point.label, point.mass))
            .collect();
        let mut properties = Numbered::new();
        let mut of_masses = cards.iter().filter(|card| card.name == "PMASS");
        of_masses.try_for_each(|card| take_masses(card, &mut properties))?;
        let mut new_properties: BTreeMap<usize, f64> = BTreeMap::new();
        for card in cards {
            let (holder, field) = match card.name.as_str() {
                "CMASS1" => {
                    let property = card.referred(3, &properties, "PMASS")?;
                    (&property.card, property.start + 1)
                }
                "CMASS2" => (card, 3),
                "CONM2" => (card, 5),
                _ => continue,
            };
            let own = nearest_in_field(self.weight * holder.positive(field)?);
            let Some(&mass) = masses.get(&card.label(2)?) else {
                continue;
            };
            if card.name == "CMASS1"
                && *new_properties.entry(card.label(3)?).or_insert(mass) != mass
            {
                let reason = "masses of one PMASS card change by different factors; give each a card of its own";
                return Err(card.error(3, reason));
            }
            if mass != own {
                self.set_number(holder, field, mass / self.weight)?;
            }
        }
        Ok(())
    }

    /// The density of an element, as the reader gives it to elements.
    fn density(&self, holder: &Holder) -> Result<f64, FileError> {
        let material = holder.material(&self.known.materials)?.value;
        Ok(nearest_in_field(self.weight * holder.density(&material)))
    }

    /// The number of the material of an element for another density: of a new one, or its own if the density is the same.
    fn material(&mut self, holder: &Holder, own: u64, density: u64) -> Result<String, FileError> {
        let first = holder.card.label(holder.size_field - 1)?;
        let Kept { value, card, .. } = holder.material(&self.known.materials)?;
        // Of an element with nonstructural mass the material has its part of the new density.
        let of_material = match holder.mass > 0.0 {
            true => {
                nearest_in_field(value.density * (f64::from_bits(density) / f64::from_bits(own)))
            }
            false => f64::from_bits(density) / self.weight,
        };
        if own == density || of_material == value.density {
            return Ok(first.to_string());
        }
        let key = (first, of_material.to_bits());
        if let Some(label) = self.materials.get(&key) {
            return Ok(label.to_string());
        }
        let label = self.next_material;
        let mut entries: Vec<String> = card.fields.iter().map(|field| field.text.clone()).collect();
        entries[0] = label.to_string();
        entries[4] = format!("{of_material:?}");
        self.add(card, &entries.join(","))?;
        self.next_material += 1;
        self.materials.insert(key, label);
        Ok(label.to_string())
    }

    /// Inserts a card of the same name after another.
    fn add(&mut self, card: &Card, entries: &str) -> Result<(), FileError> {
        self.writer.text.clear();
        self.writer.push(&card.name, entries)?;
        let line = card.fields.last().map_or(card.line, |field| field.line);
        self.added
            .entry(line)
            .or_default()
            .push_str(&self.writer.text);
        Ok(())
    }

    /// Writes a number in a field of a card.
    fn set_number(&mut self, card: &Card, field: usize, value: f64) -> Result<(), FileError> {
        let none = || card.error(field, "the new number is not finite");
        self.set(card, field, large_real(value).ok_or_else(none)?)
    }

    /// Writes a field of a card anew.
    fn set(&mut self, card: &Card, field: usize, text: String) -> Result<(), FileError> {
        let place = FIELDS_PER_LINE * (field / 10) + field % 10 - 2;
        let own = card.fields.get(place..).unwrap_or_default();
        let line = own
            .first()
            .ok_or_else(|| card.error(field, "the card has no such field to write in"))?
            .line;
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
    let Cut {
        name,
        mut parts,
        places,
        is_free,
        count,
        width,
    } = cut(code);
    let given = parts.len();
    let fields = places.len().next_multiple_of(count);
    parts.resize(given.max(fields), String::new());
    for (from_last, text) in texts {
        let place = fields.checked_sub(*from_last);
        let place = place.map(|place| places.get(place).copied().unwrap_or(place));
        let Some(part) = place.and_then(|place| parts.get_mut(place)) else {
            continue;
        };
        let old = part.chars().count();
        // A number stays at the side of its field where it was.
        *part = match part.starts_with(' ') {
            _ if is_free => part.replacen(part.trim(), text, 1),
            true => format!("{text:>old$}"),
            false => format!("{text:old$}"),
        };
    }
    // What the large format could not hold stays in the free one.
    let is_large = |part: &String| part.trim().len() > LARGE_FIELD;
    let stays_free = is_free && (fields > count || parts.iter().any(is_large));
    if stays_free || texts.values().all(|text| text.len() <= width) {
        let separator = if is_free { "," } else { "" };
        return [
            &name,
            separator,
            &parts[..given].join(separator),
            comment,
            end,
        ]
        .concat();
    }
    writer.tag += 1;
    let tag = format!("*{}{}", writer.prefix, writer.tag);
    let last = parts
        .get(count)
        .map_or("", |rest| if is_free { rest.trim() } else { rest });
    let half = |parts: &[String]| {
        parts
            .iter()
            .map(|part| format!("{:LARGE_FIELD$}", part.trim()))
            .collect::<String>()
    };
    let name = format!("{}*", name.trim());
    let (first, second) = parts[..count].split_at(LARGE_FIELDS_PER_LINE);
    let first = format!(
        "{name:SMALL_FIELD$}{}{tag:SMALL_FIELD$}{comment}",
        half(first)
    );
    let second = format!("{tag:SMALL_FIELD$}{}{last}", half(second));
    [
        first.trim_end(),
        if end.is_empty() { "\n" } else { end },
        second.trim_end(),
        end,
    ]
    .concat()
}
