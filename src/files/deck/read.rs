//! The reader, from cards to the model that they describe: the cards that are read, those that do not matter to the model, and
//! those that may matter but are unknown.

use super::card::{Card, Kept, Numbered};
use super::constraints::Constraints;
use super::coordinates;
use super::elements::{ElementCards, Members};
use super::lines::{INCLUDES, Selected, join, sections};
use super::model::{BulkData, PointMass};
use super::number::nearest_in_field;
use crate::files::error::FileError;
use crate::files::text::readable;
use std::collections::BTreeMap;

/// A deck as it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Deck {
    /// The model.
    pub model: BulkData,
    pub(crate) members: Members,
    /// Cards that are not part of it, by name in the order of the file.
    pub unread: Vec<Unread>,
}

/// Reads a deck in UTF-8 or Latin-1, without cards of the names `ignored` that are not understood; `file` is its name in messages.
///
/// It may have executive and case control in front of `BEGIN BULK`, or be bulk data alone. Read are GRID, GRDSET,
/// CORD2R, CORD2C, CROD, PROD, CONROD, CSHEAR, PSHEAR, CQDMEM, PQDMEM, CTRMEM, PTRMEM, MAT1,
/// SPC, SPC1, SPCADD, MPC, MPCADD, CMASS1, PMASS, CMASS2, CONM2 and `PARAM,WTMASS`, which multiplies every mass and density,
/// in any order. Cards that say nothing of stiffness, mass,
/// supports or coordinates, such as loads, or properties and points to which no card refers, are listed in [`Deck::unread`], and so are
/// those ignored, except EIGR and EIGRL: they say how to look for eigenvalues. Every other card is an error.
///
/// # Errors
/// [`FileError::DeckCards`] lists all cards that are not read, if one of them is not understood; [`FileError::DeckLine`]
/// names file, line, card and field; [`FileError::Refused`] if a name to be ignored is that of a card that is read.
pub fn read(file: &str, text: &[u8], ignored: &[String]) -> Result<Deck, FileError> {
    let ignored: Vec<String> = ignored
        .iter()
        .map(|card| card.trim().to_ascii_uppercase())
        .collect();
    if let Some(card) = ignored.iter().find(|name| kind(name) == Some(READ)) {
        return Err(FileError::refused(
            "--ignore",
            format!("corfem reads {card}; only cards that it does not read can be left out"),
        ));
    }
    if text.starts_with(&[0xff, 0xfe]) || text.starts_with(&[0xfe, 0xff]) {
        return Err(FileError::refused(file, "is in UTF-16; save it in UTF-8"));
    }
    let (selected, lines) = sections(&file.into(), &readable(file, text)?)?;
    let (cards, others): (Vec<Card>, Vec<Card>) = join(lines)?
        .into_iter()
        .partition(|card| kind(&name(card)) == Some(READ));
    let why = |card: &Card| {
        let name = name(card);
        match kind(&name) {
            Some("without part") => Reason::WithoutPart,
            _ if ignored.contains(&name) => Reason::Ignored,
            Some(_) => Reason::Lacking,
            None if INCLUDES.contains(&name.as_str()) => Reason::Elsewhere,
            None => Reason::Unknown,
        }
    };
    let mut unread: Vec<Unread> = others
        .iter()
        .map(|card| one_unread(card, why(card)))
        .collect();
    let refused = [Reason::Lacking, Reason::Elsewhere, Reason::Unknown];
    let is_refused = |card: &&mut Unread| refused.contains(&card.reason);
    let mut left = unread.iter_mut().filter(is_refused);
    if left.any(|card| kind(&card.card) != Some(BY_REFERENCE)) {
        let (file, cards) = (file.to_owned(), counted(&unread));
        return Err(FileError::DeckCards { file, cards });
    }
    // Nothing refers to these cards: what is read refers to cards that are read, or is refused.
    for card in unread.iter_mut().filter(is_refused) {
        card.reason = Reason::WithoutPart;
    }
    let mut found = Found::default();
    for card in cards {
        found.take(card.sound()?)?;
    }
    found.deck(file, selected, unread)
}

/// The cards of a deck that are read, by what they are.
#[derive(Default)]
struct Found {
    grid_default: Option<Card>,
    weight: Option<Card>,
    grids: Numbered<()>,
    elements: ElementCards,
    systems: Numbered<()>,
    constraints: Constraints,
}

impl Found {
    fn take(&mut self, card: Card) -> Result<(), FileError> {
        let once = |slot: &mut Option<Card>, card: Card, what: &str| {
            let reason = format!("this is the second {what}; a deck may have one");
            let again = FileError::line(&card.file, card.line, reason);
            slot.replace(card).map_or(Ok(()), |_| Err(again))
        };
        match card.name.as_str() {
            "GRID" => card.keep(2, (), &mut self.grids),
            "GRDSET" => once(&mut self.grid_default, card, "GRDSET card"),
            "PARAM" => once(&mut self.weight, card, "PARAM,WTMASS"),
            "CORD2R" | "CORD2C" => card.keep(2, (), &mut self.systems),
            "SPC" | "SPC1" | "SPCADD" | "MPC" | "MPCADD" => self.constraints.take(card),
            _ => self.elements.take(&card),
        }
    }

    /// The deck of these cards and of those that are not read.
    fn deck(
        mut self,
        file: &str,
        selected: Option<Selected>,
        mut unread: Vec<Unread>,
    ) -> Result<Deck, FileError> {
        let may_lack = unread.iter().any(|card| card.reason == Reason::Ignored);
        let left_out = self.constraints.select(file, selected, may_lack)?;
        unread.extend(
            left_out
                .iter()
                .map(|card| one_unread(card, Reason::NotSelected)),
        );
        unread.extend(self.elements.torsion.iter().map(|card| Unread {
            card: format!("{} J", card.name),
            ..one_unread(card, Reason::Torsion)
        }));
        let default = self.grid_default.as_ref();
        let (mut grids, motions) = coordinates::grids(&self.grids, &self.systems, default)?;
        self.constraints.constrain(&mut grids, &motions)?;
        let mut masses = self
            .elements
            .points
            .values()
            .map(|Kept { card, .. }| {
                let field = if card.name == "CONM2" { 3 } else { 4 };
                card.referred(field, &grids, "GRID")?;
                self.elements.point_mass(card, &motions)
            })
            .collect::<Result<Vec<PointMass>, FileError>>()?;
        let (mut elements, members) = self.elements.elements(&grids)?;
        let ties = self.constraints.ties(&grids, &motions)?;
        if let Some(card) = &self.weight {
            let densities = elements.iter_mut().map(|own| &mut own.material.density);
            let points = masses.iter_mut().map(|point| &mut point.mass);
            scale(card, densities.chain(points))?;
        }
        let grids = grids.into_values().collect();
        let model = BulkData {
            grids,
            elements,
            ties,
            masses,
        };
        let untouched = model.untouched().into_iter();
        unread.extend(untouched.map(|grid| one_unread(&self.grids[&grid].card, Reason::Untouched)));
        Ok(Deck {
            model,
            members,
            unread: counted(&unread),
        })
    }
}

/// Multiplies masses by `PARAM,WTMASS`, and rounds them to what a deck can hold, so that writing them loses nothing.
fn scale<'a>(card: &Card, masses: impl Iterator<Item = &'a mut f64>) -> Result<(), FileError> {
    let factor = card.positive(3)?;
    for mass in masses.filter(|mass| **mass > 0.0) {
        *mass = nearest_in_field(factor * *mass);
        card.require(
            mass.is_normal(),
            3,
            "a factor that keeps every mass within the range of numbers",
        )?;
    }
    Ok(())
}

/// Cards by what they are to the modes, kind by kind.
const CARDS: &str = include_str!("cards.txt");
/// Kind of the cards that are read.
const READ: &str = "read";
/// Kind of those that mean nothing where no card refers to them.
const BY_REFERENCE: &str = "by reference";

/// The kind that `cards.txt` gives to cards of a [`name`].
fn kind(name: &str) -> Option<&'static str> {
    let is_own = |own: &str| match own.strip_suffix('*') {
        Some(start) => name.starts_with(start),
        None => name == own,
    };
    CARDS
        .lines()
        .filter_map(|line| line.split_once(": "))
        .find(|(_, names)| names.split(", ").any(is_own))
        .map(|(kind, _)| kind)
}

/// Cards of one name that were not read, for one reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unread {
    /// Name of the cards; `PARAM COUPMASS` and its like for a parameter that changes stiffness or mass or may do so.
    pub card: String,
    /// The line of the first, from one.
    pub line: usize,
    /// Number of the cards.
    pub count: usize,
    /// Reason for which they were not read.
    pub reason: Reason,
}

/// Reason for which a card was not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// A card of an element, or of what only such elements have, that the crate lacks: the deck is refused.
    Lacking,
    /// A statement that names another file, which is not read: the deck is refused.
    Elsewhere,
    /// A card that the crate does not know: it may be part of the model, and the deck is refused.
    Unknown,
    /// An unknown card that whoever asked for the deck takes responsibility for leaving out.
    Ignored,
    /// A card that says nothing of stiffness, mass, supports or coordinates.
    WithoutPart,
    /// A card of a set of constraints that the first subcase of case control does not select.
    NotSelected,
    /// A card that gives rods torsion, which no stiffness includes.
    Torsion,
    /// A grid that no element, mass or equation touches: it is held.
    Untouched,
}

impl Unread {
    /// The name with first line and count: `CBAR (line 7, 2 cards)`.
    pub fn place(&self) -> String {
        let cards = if self.count == 1 { "card" } else { "cards" };
        format!("{} (line {}, {} {cards})", self.card, self.line, self.count)
    }
}

/// The name that decides about a card: its own, with the parameter behind it for one that changes the model or may do so.
pub(super) fn name(card: &Card) -> String {
    let with = |field| format!("{} {}", card.name, card.text(field));
    let value = card.text(3);
    let is_off = card.text(2) == "COUPMASS"
        && (value == "NO" || value.parse::<i64>().is_ok_and(|value| value <= 0));
    let changes = match card.name.as_str() {
        "PARAM" if !is_off => Some(with(2)).filter(|own| kind(own).is_some()),
        // Pairs of names and values: the names are in even fields.
        "MDLPRM" => card
            .filled()
            .into_iter()
            .filter(|field| field % 2 == 0)
            .map(with)
            .find(|own| kind(own).is_none()),
        _ => None,
    };
    changes.unwrap_or_else(|| card.name.clone())
}

fn one_unread(card: &Card, reason: Reason) -> Unread {
    Unread {
        card: name(card),
        line: card.line,
        count: 1,
        reason,
    }
}

/// Cards put together by name and reason, in the order of the file.
fn counted<'a>(cards: impl IntoIterator<Item = &'a Unread>) -> Vec<Unread> {
    let mut groups: BTreeMap<(&str, Reason), Unread> = BTreeMap::new();
    for card in cards {
        let group = groups.entry((&card.card, card.reason)).or_insert(Unread {
            count: 0,
            ..card.clone()
        });
        group.count += 1;
        group.line = group.line.min(card.line);
    }
    let mut groups: Vec<Unread> = groups.into_values().collect();
    groups.sort_by_key(|group| group.line);
    groups
}
