//! From cards to the model they describe.

use super::card::{Card, Numbered};
use super::constraints::Constraints;
use super::continuation::join;
use super::elements::{ElementCards, point_mass};
use super::lines::sections;
use super::model::{BulkData, PointMass};
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
    let (selected, lines) = sections(file, text)?;
    let mut unread = Vec::new();
    let mut skip = |card: &Card, reason| unread.push(Unread { card: card.name.clone(), line: card.line, reason });
    let mut default: Option<Card> = None;
    let mut grids = Numbered::new();
    let mut elements = ElementCards::default();
    let mut masses = Numbered::new();
    let mut constraints = Constraints::new(selected);
    for card in join(&file.into(), lines)? {
        match card.name.as_str() {
            "GRID" => card.keep(2, (), &mut grids)?,
            "GRDSET" if default.is_none() => default = Some(card),
            "GRDSET" => return Err(FileError::line(file, card.line, "one GRDSET card at most", "another")),
            "CMASS2" | "CONM2" => card.keep(2, point_mass(&card)?, &mut masses)?,
            "EIGR" | "EIGRL" => {}
            "SPC1" | "MPC" if constraints.take(&card)? => {}
            "SPC1" | "MPC" => skip(&card, Reason::NotSelected),
            _ if elements.take(&card)? => {}
            _ => skip(&card, Reason::Unknown),
        }
    }
    let grids = grids.iter().map(|(&label, kept)| Ok((label, grid(label, &kept.card, default.as_ref())?)));
    let mut grids = grids.collect::<Result<BTreeMap<usize, Grid>, FileError>>()?;
    constraints.constrain(&mut grids)?;
    let masses = masses.into_values().map(|kept| {
        kept.card.referred(if kept.card.name == "CMASS2" { 4 } else { 3 }, &grids, "GRID")?;
        Ok(kept.value)
    });
    let masses = masses.collect::<Result<Vec<PointMass>, FileError>>()?;
    let (elements, ties) = (elements.elements(&grids)?, constraints.ties(&grids)?);
    Ok(Deck { model: BulkData { grids: grids.into_values().collect(), elements, ties, masses }, unread })
}

/// A grid; what GRDSET says counts where its own card has blanks.
fn grid(label: usize, card: &Card, default: Option<&Card>) -> Result<Grid, FileError> {
    let chosen = |field: usize| default.filter(|_| card.text(field).is_empty()).unwrap_or(card);
    for field in [3, 7] {
        chosen(field).absent(field, "coordinate systems but the basic one")?;
    }
    let position = Vector3::new(card.real(4)?, card.real(5)?, card.real(6)?);
    Ok(Grid { label, position, constrained: chosen(8).directions(8)? })
}
