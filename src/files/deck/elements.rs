//! Cards of elements, properties, materials and masses.

use super::card::{Card, Kept, Numbered};
use super::coordinates::{Motions, OBLIQUE};
use super::model::PointMass;
use super::number::nearest_in_field;
use crate::files::error::FileError;
use crate::method::error::Error;
use crate::method::structure::{Element, ElementKind, Grid, Material};
use std::collections::BTreeMap;

/// Connection card, property card and kind of the elements that have a property of their own.
pub const ELEMENT_CARDS: [(&str, &str, ElementKind); 4] = [
    ("CROD", "PROD", ElementKind::Rod),
    ("CSHEAR", "PSHEAR", ElementKind::ShearPanel),
    ("CQDMEM", "PQDMEM", ElementKind::Membrane),
    ("CTRMEM", "PTRMEM", ElementKind::Triangle),
];
/// Cards that in NASTRAN-95 may hold a second entry from field 6 on.
const ONE_TO_A_CARD: [&str; 4] = ["CROD", "PSHEAR", "PQDMEM", "PTRMEM"];

/// The property and the material that every element refers to, by the elements' numbers.
pub type Members = BTreeMap<usize, Membership>;

/// The cards of elements, properties and materials before they are joined to elements.
#[derive(Debug, Default)]
pub struct ElementCards {
    /// The place of every element's kind in [`ELEMENT_CARDS`]; none for a CONROD.
    pub connections: Numbered<Option<usize>>,
    pub properties: [Numbered<()>; 4],
    pub materials: Numbered<Material>,
    /// Point masses, and masses of PMASS cards.
    pub points: Numbered<()>,
    masses: Numbered<()>,
    /// Materials of which E alone is given: rods need no more.
    axial: Vec<usize>,
    /// Cards that give rods torsion, which no stiffness includes: grids have no rotations.
    pub torsion: Vec<Card>,
}

/// The card that has an element's material, size and nonstructural mass: the fields of the last two, the material's before them, and
/// what they say.
pub struct Holder<'a> {
    pub card: &'a Card,
    pub size_field: usize,
    pub size: f64,
    pub mass_field: usize,
    /// Mass beside that of the material, on a unit of a rod's length or a panel's area.
    pub mass: f64,
}

/// The cards that an element refers to: its property's number, none for a CONROD, and its material's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Membership {
    pub property: Option<usize>,
    pub material: usize,
}

impl<T> Kept<Option<T>> {
    /// The field with the number of an element's property: without one it is the element's own.
    pub fn property_field(&self) -> usize {
        2 + usize::from(!self.card.text(3).is_empty())
    }
}

impl ElementCards {
    /// Takes a card of an element, a property, a material or a mass; any other has none.
    pub fn take(&mut self, card: &Card) -> Result<(), FileError> {
        let name = card.name.as_str();
        if ONE_TO_A_CARD.contains(&name) {
            (6..=9).try_for_each(|field| {
                card.absent(
                    field,
                    "second entries of a card and no factors of shear panels; give an entry a card of its own",
                )
            })?;
        }
        for (row, &(connection, property, kind)) in ELEMENT_CARDS.iter().enumerate() {
            if name == connection {
                card.keep(2, Some(row), &mut self.connections)?;
            } else if name == property {
                if kind == ElementKind::Rod {
                    self.note_torsion(card, 5)?;
                }
                Holder::new(card, 4)?;
                card.keep(2, (), &mut self.properties[row])?;
            }
        }
        match name {
            "CONROD" => {
                self.note_torsion(card, 7)?;
                Holder::new(card, 6)?;
                card.keep(2, None, &mut self.connections)?;
            }
            "MAT1" => {
                let is_axial = [4, 5].iter().all(|&field| card.text(field).is_empty());
                self.axial
                    .extend(is_axial.then(|| card.label(2)).transpose()?);
                card.keep(2, material(card)?, &mut self.materials)?;
            }
            "CMASS1" | "CMASS2" | "CONM2" => card.keep(2, (), &mut self.points)?,
            // Up to four masses, each behind its number.
            "PMASS" => {
                for start in [2, 4, 6, 8] {
                    if start == 2 || !card.text(start).is_empty() {
                        card.positive(start + 1)?;
                        card.keep(start, (), &mut self.masses)?;
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn note_torsion(&mut self, card: &Card, field: usize) -> Result<(), FileError> {
        if card.real(field)? != 0.0 {
            self.torsion.push(card.clone());
        }
        Ok(())
    }

    /// The card with the size and the material of an element: its property's, which must exist, or its own.
    pub fn holder<'a>(
        &'a self,
        connection: &'a Kept<Option<usize>>,
    ) -> Result<Holder<'a>, FileError> {
        let Kept { value, card, .. } = connection;
        let Some(row) = *value else {
            return Holder::new(card, 6);
        };
        let field = connection.property_field();
        let property = card.referred(field, &self.properties[row], ELEMENT_CARDS[row].1)?;
        Holder::new(&property.card, 4)
    }

    /// The card that has a point mass, its own or a PMASS, and the field.
    pub fn mass<'a>(&'a self, card: &'a Card) -> Result<(&'a Card, usize), FileError> {
        if card.name == "CMASS1" {
            let kept = card.referred(3, &self.masses, "PMASS")?;
            return Ok((&kept.card, kept.start + 1));
        }
        Ok((card, if card.name == "CMASS2" { 3 } else { 5 }))
    }

    /// A point mass: CMASS2, or CMASS1 with the mass of a PMASS card, on one direction of a grid, or CONM2 on all three.
    pub fn point_mass(&self, card: &Card, motions: &Motions) -> Result<PointMass, FileError> {
        let (label, mut grid, mut direction) = (card.label(2)?, 3, None);
        if card.name.starts_with("CMASS") {
            card.absent(6, "masses between two degrees of freedom")?;
            grid = 4;
            let axis = motions.axis(card.label(grid)?, card.direction(5)?);
            direction = Some(axis.ok_or_else(|| card.error(5, OBLIQUE))?);
        } else {
            // A mass that is the same in all directions has no axes: any system will do.
            (6..=8).try_for_each(|field| card.absent(field, "offsets of masses"))?;
            (12..=17).try_for_each(|field| card.absent(field, "rotary inertia"))?;
        }
        let (holder, field) = self.mass(card)?;
        Ok(PointMass {
            label,
            grid: card.label(grid)?,
            direction,
            mass: holder.positive(field)?,
        })
    }

    /// The elements by number, and the cards that they refer to; property, material and grids must exist.
    pub fn elements(
        &self,
        grids: &BTreeMap<usize, Grid>,
    ) -> Result<(Vec<Element>, Members), FileError> {
        let (mut elements, mut members) = (Vec::new(), Members::new());
        for (&label, connection) in &self.connections {
            let holder = self.holder(connection)?;
            let Kept { value, card, .. } = connection;
            let kind = value.map_or(ElementKind::Rod, |row| ELEMENT_CARDS[row].2);
            let first_grid = if value.is_some() { 4 } else { 3 };
            let corners = (first_grid..).take(kind.corner_count());
            let corners = corners.map(|field| Ok(card.referred(field, grids, "GRID")?.label));
            let mut material = holder.material(&self.materials)?.value;
            material.density = holder.density(&material);
            let number = holder.card.label(holder.size_field - 1)?;
            holder.card.require(
                kind == ElementKind::Rod || !self.axial.contains(&number),
                holder.size_field - 1,
                "a material with G or NU, which panels need",
            )?;
            let grids = corners.collect::<Result<_, FileError>>()?;
            elements.push(Element {
                label,
                kind,
                grids,
                size: holder.size,
                material,
            });
            let property = value
                .map(|_| card.label(connection.property_field()))
                .transpose()?;
            members.insert(
                label,
                Membership {
                    property,
                    material: number,
                },
            );
        }
        Ok((elements, members))
    }
}

impl<'a> Holder<'a> {
    /// The size and the mass of a card whose size is in this field: a rod's constants of torsion stand before its nonstructural mass.
    fn new(card: &'a Card, size_field: usize) -> Result<Self, FileError> {
        let is_rod = card.name.ends_with("ROD");
        if is_rod && card.optional_real(size_field)? == Some(0.0) {
            return Err(card.error(size_field, "a rod without area resists torsion alone, which corfem does not read; leave the rod out"));
        }
        let (size, mass_field) = (
            card.positive(size_field)?,
            size_field + if is_rod { 3 } else { 1 },
        );
        let mass = match card.text(mass_field) {
            "0" => 0.0,
            _ => card.real(mass_field)?,
        };
        card.require(
            mass >= 0.0,
            mass_field,
            "a nonstructural mass of zero or more",
        )?;
        Ok(Self {
            card,
            size_field,
            size,
            mass_field,
            mass,
        })
    }

    pub fn material<'b>(
        &self,
        all: &'b Numbered<Material>,
    ) -> Result<&'b Kept<Material>, FileError> {
        self.card.referred(self.size_field - 1, all, "MAT1")
    }

    /// The density that gives an element all its mass, rounded to what a deck can hold: nonstructural mass is lumped as the material's is,
    /// $\rho + m/s$ for size $s$.
    pub fn density(&self, material: &Material) -> f64 {
        nearest_in_field(material.density + self.mass / self.size)
    }
}

/// MAT1: of E, G and NU two give the third, $G = E/\big(2(1+\nu)\big)$; all three are taken as they are. E alone is that of rods.
fn material(card: &Card) -> Result<Material, FileError> {
    let [e, g, nu] = [3, 4, 5].map(|field| card.optional_real(field));
    let (e, g, nu) = (e?, g?, nu?);
    // A number that is worked out is rounded to what a deck can hold, so that writing it loses nothing.
    let (e, nu) = match (e, g, nu) {
        (Some(e), _, Some(nu)) => (e, nu),
        (Some(e), Some(g), None) => (e, nearest_in_field(e / (2.0 * g) - 1.0)),
        (Some(e), None, None) => (e, 0.0),
        (None, Some(g), Some(nu)) => (nearest_in_field(2.0 * g * (1.0 + nu)), nu),
        _ => return Err(card.error(3, "a material needs two of E, G and NU")),
    };
    let derived = Material::isotropic(e, nu).map_err(|error| match error {
        Error::Value {
            what: "Poisson's ratio",
            ..
        } => card.wrong(5, "a Poisson's ratio above -1 and at most 0.5"),
        _ => card.wrong(3, "a positive Young's modulus"),
    })?;
    let shear_modulus = if g.is_some() {
        card.positive(4)?
    } else {
        derived.shear_modulus
    };
    let density = card.real(6)?;
    card.require(density >= 0.0, 6, "a density of zero or more")?;
    Ok(Material {
        shear_modulus,
        density,
        ..derived
    })
}
