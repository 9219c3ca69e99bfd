//! From cards to the model they describe.

use super::card::Card;
use super::constraints::Constraints;
use super::continuation::{Cards, cut};
use super::elements::{ElementCards, point_mass};
use super::model::{BulkData, PointMass};
use super::numbered::Numbered;
use crate::files::error::FileError;
use crate::method::structure::Grid;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// A deck as it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Deck {
    /// The model.
    pub model: BulkData,
    /// Cards that are not part of it, in the order of the file.
    pub unread: Vec<Unread>,
}

/// A card that was not read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unread {
    /// Its name.
    pub card: String,
    /// Its line, from one.
    pub line: usize,
    /// Why.
    pub reason: Reason,
}

/// Why a card was not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// The crate does not know it.
    Unknown,
    /// It belongs to a set of constraints that case control does not select.
    NotSelected,
}

/// Reads a deck; `file` is its name in messages.
///
/// It may have executive and case control in front of `BEGIN BULK`, or be bulk data alone. Read are GRID, GRDSET,
/// CROD, PROD, CONROD, CSHEAR, PSHEAR, CQDMEM, PQDMEM, CTRMEM, PTRMEM, MAT1, SPC1, MPC, CMASS2 and CONM2, in any order.
/// Every other card is listed in [`Deck::unread`], except EIGR and EIGRL: they say how to look for eigenvalues, not
/// what the structure is.
///
/// # Errors
/// [`FileError::DeckLine`] and [`FileError::DeckField`] name file, line, card and field.
pub fn read(file: &str, text: &str) -> Result<Deck, FileError> {
    let Cards { cards, selected } = cut(file, text)?;
    let mut unread = Vec::new();
    let mut default: Option<Card> = None;
    let mut grids = Numbered::new();
    let mut elements = ElementCards::new();
    let mut masses = Numbered::new();
    let mut constraints = Constraints::new(selected);
    for card in cards {
        let (name, line) = (card.name.clone(), card.line);
        let reason = match name.as_str() {
            "GRID" => {
                grids.insert(&card, 2, ())?;
                continue;
            }
            "GRDSET" if default.is_some() => {
                return Err(FileError::DeckLine {
                    file: file.to_owned(),
                    line,
                    expected: "one GRDSET card at most",
                    found: "another".into(),
                });
            }
            "GRDSET" => {
                default = Some(card);
                continue;
            }
            "CMASS2" | "CONM2" => {
                masses.insert(&card, 2, point_mass(&card)?)?;
                continue;
            }
            "EIGR" | "EIGRL" => continue,
            "SPC1" | "MPC" if constraints.take(card.clone())? => continue,
            "SPC1" | "MPC" => Reason::NotSelected,
            _ if elements.take(&card)? => continue,
            _ => Reason::Unknown,
        };
        let card = name;
        unread.push(Unread { card, line, reason });
    }
    let mut grids: BTreeMap<usize, Grid> = grids
        .iter()
        .map(|(label, kept)| Ok((label, grid(label, &kept.card, default.as_ref())?)))
        .collect::<Result<_, FileError>>()?;
    constraints.hold(&mut grids)?;
    let known = |card: &Card, field: usize| {
        let label = card.label(field)?;
        match grids.contains_key(&label) {
            true => Ok(label),
            false => Err(card.error(field, "the number of a GRID card")),
        }
    };
    let masses = masses
        .iter()
        .map(|(_, kept)| {
            known(&kept.card, if kept.card.name == "CMASS2" { 4 } else { 3 })?;
            Ok(kept.value.clone())
        })
        .collect::<Result<Vec<PointMass>, FileError>>()?;
    let model = BulkData {
        elements: elements.elements(known)?,
        ties: constraints.ties(&grids)?,
        masses,
        grids: grids.into_values().collect(),
    };
    Ok(Deck { model, unread })
}

/// A grid; what GRDSET says counts where its own card has blanks.
fn grid(label: usize, card: &Card, default: Option<&Card>) -> Result<Grid, FileError> {
    let chosen = |field: usize| match default {
        Some(default) if card.text(field).is_empty() => default,
        _ => card,
    };
    for field in [3, 7] {
        chosen(field).absent(field, "coordinate systems but the basic one")?;
    }
    Ok(Grid {
        label,
        position: Vector3::new(card.real(4)?, card.real(5)?, card.real(6)?),
        constrained: chosen(8).directions(8)?,
    })
}
