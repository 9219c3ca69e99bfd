//! Coordinate systems of a deck: they say where its grids are, and along which directions these move.

use super::card::{Card, Numbered};
use crate::files::axes::Axes;
use crate::files::error::FileError;
use crate::method::structure::Grid;
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;

/// Reason against a single direction of a grid that lies along none of the basic axes.
pub const OBLIQUE: &str = "a direction that the coordinate system turns off the axes x, y and z: corfem has no oblique supports, masses \
                                  and dependent degrees of freedom; let the program that the deck is for write matrices \
                                  (paper/matrices.md)";
/// Requirement of a reference to a coordinate system, with the way on from other systems.
const SYSTEMS: &str = "the number of a CORD2R or CORD2C card; write a system by grids (CORD1R, CORD1C) by its three points, and the \
                       grids of a spherical one (CORD1S, CORD2S) in a Cartesian one";
/// Part of a unit vector below which it is the round-off of the digits of a card.
const ROUND_OFF: f64 = 1e-6;

/// Unit vectors along the directions in which grids move, in columns; none of a grid that has no motion, as in a fluid.
#[derive(Debug, Default)]
pub struct Motions(BTreeMap<usize, Matrix3<f64>>);

impl Motions {
    /// The basic direction along which one of a grid lies; none where it is oblique.
    pub fn axis(&self, grid: usize, direction: usize) -> Option<usize> {
        match self.parts(grid, direction)[..] {
            [(along, _)] => Some(along),
            _ => None,
        }
    }

    /// A direction of a grid as a sum of the basic ones: each with its part.
    pub fn parts(&self, grid: usize, direction: usize) -> Vec<(usize, f64)> {
        let Some(own) = self.0.get(&grid).map(|axes| axes.column(direction)) else {
            return vec![(direction, 1.0)];
        };
        let along = own.iamax();
        if (own[along].abs() - 1.0).abs() < ROUND_OFF {
            return vec![(along, own[along].signum())];
        }
        own.iter()
            .copied()
            .enumerate()
            .filter(|(_, part)| *part != 0.0)
            .collect()
    }

    /// The basic directions that are held where some of a grid's own are; none where these are oblique.
    pub fn held(&self, grid: usize, directions: [bool; 3]) -> Option<[bool; 3]> {
        let mut held = [false; 3];
        if directions == [true; 3] {
            return Some(directions);
        }
        for direction in (0..3).filter(|direction| directions[*direction]) {
            held[self.axis(grid, direction)?] = true;
        }
        Some(held)
    }
}

/// The grids at their basic places, with what their own cards hold, and the directions in which they move, by the cards of grids and
/// of coordinate systems. GRDSET fills blanks.
pub fn grids(
    cards: &Numbered<()>,
    systems: &Numbered<()>,
    default: Option<&Card>,
) -> Result<(BTreeMap<usize, Grid>, Motions), FileError> {
    let (mut grids, mut motions) = (BTreeMap::new(), Motions::default());
    for (&label, kept) in cards {
        let card = &kept.card;
        let system = system(systems, chosen(card, default, 3), 3, 0)?;
        let position = system.place(point(card, [4, 5, 6])?);
        let moves = chosen(card, default, 7);
        let constrained = match moves.text(7) {
            "-1" => [true; 3],
            _ => {
                let system = self::system(systems, moves, 7, 0)?;
                // On the axis of a cylindrical one they are those of its axes, as NASTRAN has it.
                let own = system.directions(position, ROUND_OFF);
                motions.0.insert(label, own.unwrap_or(system.rotation));
                let held = chosen(card, default, 8);
                motions
                    .held(label, held.directions(8)?)
                    .ok_or_else(|| held.error(8, OBLIQUE))?
            }
        };
        grids.insert(
            label,
            Grid {
                label,
                position,
                constrained,
            },
        );
    }
    Ok((grids, motions))
}

/// The system that a field refers to: zero or blank is the basic one. `depth` counts the systems that wait for it: more than there are
/// wait for each other.
fn system(
    systems: &Numbered<()>,
    by: &Card,
    field: usize,
    depth: usize,
) -> Result<Axes, FileError> {
    if ["", "0"].contains(&by.text(field)) {
        return Ok(Axes::GLOBAL);
    }
    let kept = systems.get(&by.label(field)?);
    let card = &kept.ok_or_else(|| by.wrong(field, SYSTEMS))?.card;
    if depth > systems.len() {
        return Err(card.error(2, "this coordinate system is defined by itself"));
    }
    let base = system(systems, card, 3, depth + 1)?;
    let points = [
        point(card, [4, 5, 6])?,
        point(card, [7, 8, 9])?,
        point(card, [12, 13, 14])?,
    ];
    let kind = usize::from(card.name == "CORD2C");
    base.through(points, kind, 2, ROUND_OFF).ok_or_else(|| {
        card.error(
            2,
            "the three points of this coordinate system lie on a line",
        )
    })
}

/// Coordinates in three fields of a card.
fn point(card: &Card, fields: [usize; 3]) -> Result<Vector3<f64>, FileError> {
    let [x, y, z] = fields.map(|field| card.real(field));
    Ok(Vector3::new(x?, y?, z?))
}

/// The card that has a field of a grid: its own, or GRDSET's where that is blank.
fn chosen<'a>(card: &'a Card, default: Option<&'a Card>, field: usize) -> &'a Card {
    default
        .filter(|_| card.text(field).is_empty())
        .unwrap_or(card)
}
