//! Cards of elements, properties, materials and masses.

use super::card::{Card, Kept, Numbered};
use super::model::PointMass;
use super::number::nearest_in_field;
use crate::files::error::FileError;
use crate::method::error::Error;
use crate::method::structure::{Element, ElementKind, Grid, Material};
use std::collections::BTreeMap;

/// Connection card, property card and kind of the elements that have a property of their own.
pub(super) const ELEMENT_CARDS: [(&str, &str, ElementKind); 4] = [
    ("CROD", "PROD", ElementKind::Rod),
    ("CSHEAR", "PSHEAR", ElementKind::ShearPanel),
    ("CQDMEM", "PQDMEM", ElementKind::Membrane),
    ("CTRMEM", "PTRMEM", ElementKind::Triangle),
];
/// Cards that may hold two entries, the second from field 6 on.
const TWO_TO_A_CARD: [&str; 4] = ["CROD", "PSHEAR", "PQDMEM", "PTRMEM"];

/// What the cards say of elements before they are put together.
#[derive(Debug, Default)]
pub(super) struct ElementCards {
    pub connections: Numbered<(ElementKind, Size)>,
    pub properties: [Numbered<f64>; 4],
    pub materials: Numbered<Material>,
}

/// The cards that an element refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Membership {
    /// Its property's number; none for a CONROD.
    pub property: Option<usize>,
    /// Its material's number.
    pub material: usize,
}

/// Where an element's size and material are found.
#[derive(Debug)]
pub(super) enum Size {
    /// On a property card of the kind with this place in [`ELEMENT_CARDS`].
    Property(usize),
    /// On the element's own card (CONROD).
    Own(f64),
}

impl ElementCards {
    /// Takes a card of an element, a property or a material.
    pub fn take(&mut self, card: &Card) -> Result<(), FileError> {
        let name = card.name.as_str();
        let is_double = TWO_TO_A_CARD.contains(&name) && card.filled().last().is_some_and(|&last| last > 5);
        let starts = if is_double { &[2, 6][..] } else { &[2] };
        for (row, &(connection, property, kind)) in ELEMENT_CARDS.iter().enumerate() {
            for &start in starts {
                if name == connection {
                    card.keep(start, (kind, Size::Property(row)), &mut self.connections)?;
                } else if name == property {
                    let size = card.positive(start + 2)?;
                    let is_rod = kind == ElementKind::Rod;
                    if is_rod {
                        card.absent(start + 3, "torsion of rods")?;
                    }
                    card.absent(start + if is_rod { 5 } else { 3 }, "nonstructural mass")?;
                    card.keep(start, size, &mut self.properties[row])?;
                }
            }
        }
        match name {
            "CONROD" => {
                let rod = (ElementKind::Rod, Size::Own(card.positive(6)?));
                card.absent(7, "torsion of rods")?;
                card.absent(9, "nonstructural mass")?;
                card.keep(2, rod, &mut self.connections)?;
            }
            "MAT1" => card.keep(2, material(card)?, &mut self.materials)?,
            _ => {}
        }
        Ok(())
    }

    /// The property, if it has one, and the material of every element, by their numbers.
    ///
    /// # Errors
    /// Those of a number that is none.
    pub fn members(&self) -> Result<BTreeMap<usize, Membership>, FileError> {
        let of = |(&label, kept): (&usize, &Kept<(ElementKind, Size)>)| {
            let Kept { card, start, value: (_, size) } = kept;
            let membership = match size {
                Size::Own(_) => Membership { property: None, material: card.label(5)? },
                Size::Property(row) => {
                    let property = card.referred(start + 1, &self.properties[*row], ELEMENT_CARDS[*row].1)?;
                    let number = if card.text(start + 1).is_empty() { label } else { card.label(start + 1)? };
                    Membership { property: Some(number), material: property.card.label(property.start + 1)? }
                }
            };
            Ok((label, membership))
        };
        self.connections.iter().map(of).collect()
    }

    /// The elements by number; property, material and grids must exist.
    pub fn elements(&self, grids: &BTreeMap<usize, Grid>) -> Result<Vec<Element>, FileError> {
        let put_together = |(&label, kept): (&usize, &Kept<(ElementKind, Size)>)| {
            let Kept { card, start, value: (kind, size) } = kept;
            let (size, material, first_grid) = match size {
                Size::Own(size) => (*size, card.referred(5, &self.materials, "MAT1")?, 3),
                Size::Property(row) => {
                    let property = card.referred(start + 1, &self.properties[*row], ELEMENT_CARDS[*row].1)?;
                    let material = property.card.referred(property.start + 1, &self.materials, "MAT1")?;
                    (property.value, material, start + 2)
                }
            };
            let corners = (first_grid..).take(kind.corner_count());
            let grids = corners.map(|field| Ok(card.referred(field, grids, "GRID")?.label));
            let grids = grids.collect::<Result<_, FileError>>()?;
            Ok(Element { label, kind: *kind, grids, size, material: material.value })
        };
        self.connections.iter().map(put_together).collect()
    }
}

/// MAT1: of E, G and NU two give the third, $G = E/\big(2(1+\nu)\big)$; all three are taken as they are.
fn material(card: &Card) -> Result<Material, FileError> {
    let [e, g, nu] = [3, 4, 5].map(|field| card.optional_real(field));
    let (e, g, nu) = (e?, g?, nu?);
    // A number that is worked out is rounded to what a deck can hold, so that writing it loses nothing.
    let (e, nu) = match (e, g, nu) {
        (Some(e), _, Some(nu)) => (e, nu),
        (Some(e), Some(g), None) => (e, nearest_in_field(e / (2.0 * g) - 1.0)),
        (None, Some(g), Some(nu)) => (nearest_in_field(2.0 * g * (1.0 + nu)), nu),
        _ => return Err(card.error(3, "two of E, G and NU")),
    };
    let derived = Material::isotropic(e, nu).map_err(|error| match error {
        Error::Setting { .. } => card.error(5, "Poisson's ratio above -1 and at most 0.5"),
        _ => card.error(3, "a positive Young's modulus"),
    })?;
    let shear_modulus = if g.is_some() { card.positive(4)? } else { derived.shear_modulus };
    let density = card.real(6)?;
    card.require(density >= 0.0, 6, "a density that is not negative")?;
    Ok(Material { shear_modulus, density, ..derived })
}

/// CMASS2 on one direction of a grid, or CONM2 on all three.
pub(super) fn point_mass(card: &Card) -> Result<PointMass, FileError> {
    let label = card.label(2)?;
    if card.name == "CMASS2" {
        card.absent(6, "masses between two degrees of freedom")?;
        let (grid, direction) = (card.label(4)?, Some(card.direction(5)?));
        return Ok(PointMass { label, grid, direction, mass: card.positive(3)? });
    }
    card.absent(4, "coordinate systems but the basic one")?;
    for field in 6..=8 {
        card.absent(field, "offsets of masses")?;
    }
    for field in 12..=17 {
        card.absent(field, "rotary inertia")?;
    }
    Ok(PointMass { label, grid: card.label(3)?, direction: None, mass: card.positive(5)? })
}
