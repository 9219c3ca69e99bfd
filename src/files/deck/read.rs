//! From cards to the model they describe.

use super::card::{Card, Numbered};
use super::constraints::Constraints;
use super::continuation::join;
use super::elements::{ElementCards, Membership, point_mass};
use super::known::{Reason, Unread, counted, is_read, name, reason};
use super::lines::{decoded, sections};
use super::model::{BulkData, PointMass};
use super::number::nearest_in_field;
use crate::files::error::FileError;
use crate::method::structure::Grid;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// A deck as it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Deck {
    /// The model.
    pub model: BulkData,
    /// The property and the material of every element, by its number.
    pub members: BTreeMap<usize, Membership>,
    /// Cards that are not part of it, by name in the order of the file.
    pub unread: Vec<Unread>,
}

/// Reads a deck; `file` is its name in messages.
///
/// It may have executive and case control in front of `BEGIN BULK`, or be bulk data alone. Read are GRID, GRDSET,
/// CROD, PROD, CONROD, CSHEAR, PSHEAR, CQDMEM, PQDMEM, CTRMEM, PTRMEM, MAT1, SPC1, SPCADD, MPC, MPCADD, CMASS2, CONM2
/// and `PARAM,WTMASS`, which multiplies every mass and density, in any order. Cards that say nothing of stiffness, mass,
/// supports or coordinates, such as loads, are listed in [`Deck::unread`], except EIGR and EIGRL: they say how to look
/// for eigenvalues. Every other card is an error.
///
/// # Errors
/// [`FileError::DeckCards`] lists all cards that are not understood; [`FileError::DeckLine`] and
/// [`FileError::DeckField`] name file, line, card and field.
pub fn read(file: &str, text: &str) -> Result<Deck, FileError> {
    read_without(file, text.as_bytes(), &[])
}

/// Reads a deck in UTF-8 or Latin-1 as [`read`] does, but without cards of the names `ignored` that are not understood;
/// [`Deck::unread`] lists them.
///
/// # Errors
/// Those of [`read`]; [`FileError::IgnoredCard`] for the name of a card that is read.
pub fn read_without(file: &str, text: &[u8], ignored: &[String]) -> Result<Deck, FileError> {
    let ignored: Vec<String> = ignored.iter().map(|card| card.trim().to_ascii_uppercase()).collect();
    if let Some(card) = ignored.iter().find(|name| is_read(name)) {
        return Err(FileError::IgnoredCard { card: card.clone() });
    }
    let (selected, lines) = sections(file, &decoded(text))?;
    let (cards, others): (Vec<Card>, Vec<Card>) =
        join(&file.into(), lines)?.into_iter().partition(|card| is_read(&name(card)));
    let others = others.iter().map(|card| {
        let name = name(card);
        let reason = reason(&name, &ignored);
        (name, card.line, reason)
    });
    let mut unread: Vec<_> = others.collect();
    let unknown = unread.iter().filter(|card| card.2 == Reason::Unknown).cloned().collect::<Vec<_>>();
    if !unknown.is_empty() {
        return Err(FileError::DeckCards { file: file.to_owned(), cards: counted(unknown) });
    }
    let mut default: Option<Card> = None;
    let mut weight: Option<Card> = None;
    let mut grids = Numbered::new();
    let mut elements = ElementCards::default();
    let mut masses = Numbered::new();
    let mut constraints = Constraints::default();
    for card in cards {
        match card.name.as_str() {
            "GRID" => card.keep(2, (), &mut grids)?,
            "GRDSET" if default.is_none() => default = Some(card),
            "GRDSET" => return Err(FileError::line(file, card.line, "one GRDSET card at most", "another")),
            "PARAM" if weight.is_none() => weight = Some(card),
            "PARAM" => return Err(FileError::line(file, card.line, "one PARAM,WTMASS at most", "another")),
            "CMASS2" | "CONM2" => card.keep(2, point_mass(&card)?, &mut masses)?,
            "SPC1" | "SPCADD" | "MPC" | "MPCADD" => constraints.take(card)?,
            _ => elements.take(&card)?,
        }
    }
    let may_lack = unread.iter().any(|card| card.2 == Reason::Ignored);
    let left_out = constraints.select(file, selected, may_lack)?;
    unread.extend(left_out.into_iter().map(|card| (card.name, card.line, Reason::NotSelected)));
    let grids = grids.iter().map(|(&label, kept)| Ok((label, grid(label, &kept.card, default.as_ref())?)));
    let mut grids = grids.collect::<Result<BTreeMap<usize, Grid>, FileError>>()?;
    constraints.constrain(&mut grids)?;
    let masses = masses.into_values().map(|kept| {
        kept.card.referred(if kept.card.name == "CMASS2" { 4 } else { 3 }, &grids, "GRID")?;
        Ok(kept.value)
    });
    let mut masses = masses.collect::<Result<Vec<PointMass>, FileError>>()?;
    let members = elements.members()?;
    let (mut elements, ties) = (elements.elements(&grids)?, constraints.ties(&grids)?);
    if let Some(card) = weight {
        let densities = elements.iter_mut().map(|element| &mut element.material.density);
        scale(&card, densities.chain(masses.iter_mut().map(|point| &mut point.mass)))?;
    }
    let model = BulkData { grids: grids.into_values().collect(), elements, ties, masses };
    Ok(Deck { model, members, unread: counted(unread) })
}

/// Multiplies masses by `PARAM,WTMASS`, and rounds them to what a deck can hold, so that writing them loses nothing.
fn scale<'a>(card: &Card, masses: impl Iterator<Item = &'a mut f64>) -> Result<(), FileError> {
    let factor = card.positive(3)?;
    for mass in masses.filter(|mass| **mass > 0.0) {
        *mass = nearest_in_field(factor * *mass);
        card.require(mass.is_normal(), 3, "a factor that leaves every mass within the range of numbers")?;
    }
    Ok(())
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
