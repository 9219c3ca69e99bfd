//! Coordinate systems of a deck: they say where its grids are, and along which directions these move.

use super::card::{Card, Numbered};
use crate::files::error::FileError;
use crate::method::structure::Grid;
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;

/// Reason against a single direction of a grid that lies along none of the basic axes.
pub(super) const OBLIQUE: &str = "a direction that the coordinate system turns off the axes x, y and z: corfem has no oblique supports, masses \
                                  and dependent degrees of freedom; let the program that the deck is for write matrices \
                                  (paper/matrices.md)";
/// Part of a unit vector below which it is the round-off of the digits of a card.
const ROUND_OFF: f64 = 1e-6;

/// A direction of a grid as one of the basic ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    /// 0, 1, 2 for x, y, z.
    pub direction: usize,
    /// 1, or -1 where it points against it.
    pub sign: f64,
}

/// Unit vectors along the directions in which grids move, in columns, of those that have a coordinate system for it; none where one has
/// no motion, as in a fluid.
#[derive(Debug, Default)]
pub(super) struct Motions(BTreeMap<usize, Matrix3<f64>>);

impl Motions {
    /// The basic direction along which one of a grid lies; none where it is oblique.
    pub fn axis(&self, grid: usize, direction: usize) -> Option<Axis> {
        let Some(own) = self.0.get(&grid).map(|axes| axes.column(direction)) else {
            return Some(Axis {
                direction,
                sign: 1.0,
            });
        };
        let direction = own.iamax();
        let is_along = (own[direction].abs() - 1.0).abs() < ROUND_OFF;
        is_along.then(|| Axis {
            direction,
            sign: own[direction].signum(),
        })
    }

    /// A direction of a grid as a sum of the basic ones: each with its part.
    pub fn parts(&self, grid: usize, direction: usize) -> Vec<(usize, f64)> {
        match (self.axis(grid, direction), self.0.get(&grid)) {
            (None, Some(axes)) => {
                let parts = axes.column(direction).into_iter().copied().enumerate();
                parts.filter(|(_, part)| *part != 0.0).collect()
            }
            (axis, _) => axis
                .map(|own| (own.direction, own.sign))
                .into_iter()
                .collect(),
        }
    }

    /// The basic directions that are held where some of a grid's own are; none where these are oblique.
    pub fn held(&self, grid: usize, directions: [bool; 3]) -> Option<[bool; 3]> {
        let mut held = [false; 3];
        if directions == [true; 3] {
            return Some(directions);
        }
        for direction in (0..3).filter(|direction| directions[*direction]) {
            held[self.axis(grid, direction)?.direction] = true;
        }
        Some(held)
    }
}

/// A coordinate system: origin, axes in columns, and its kind.
#[derive(Debug, Clone, Copy)]
struct System {
    origin: Vector3<f64>,
    axes: Matrix3<f64>,
    /// The last letter of its card: R, C or S.
    kind: char,
}

impl System {
    const BASIC: Self = Self {
        origin: Vector3::new(0.0, 0.0, 0.0),
        axes: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        kind: 'R',
    };

    /// The basic place of coordinates: x, y, z, or radius, angle in degrees and height, or radius and two angles in degrees.
    fn place(&self, at: Vector3<f64>) -> Vector3<f64> {
        let (sine, cosine) = at.y.to_radians().sin_cos();
        let local = match self.kind {
            'C' => Vector3::new(at.x * cosine, at.x * sine, at.z),
            'S' => {
                let (across, along) = at.z.to_radians().sin_cos();
                at.x * Vector3::new(sine * along, sine * across, cosine)
            }
            _ => at,
        };
        self.origin + self.axes * local
    }

    /// Unit vectors along its directions at a basic place, in columns; those of the axes where the place is on the axis of a cylindrical or
    /// spherical one, as NASTRAN has it.
    fn directions(&self, place: Vector3<f64>) -> Matrix3<f64> {
        let local = self.axes.tr_mul(&(place - self.origin));
        let around = local.xy().norm();
        if self.kind == 'R' || around <= ROUND_OFF * local.norm() {
            return self.axes;
        }
        let [x, y] = [local.x / around, local.y / around];
        let outward = Matrix3::new(x, -y, 0.0, y, x, 0.0, 0.0, 0.0, 1.0);
        let own = match self.kind {
            'C' => outward,
            _ => {
                let size = local.norm();
                let [s, c] = [around / size, local.z / size];
                Matrix3::new(x * s, x * c, -y, y * s, y * c, x, c, -s, 0.0)
            }
        };
        self.axes * own
    }
}

/// The cards of coordinate systems, by number.
#[derive(Debug, Default)]
pub(super) struct CoordinateSystems {
    cards: Numbered<()>,
}

impl CoordinateSystems {
    /// Takes a card CORD1R, CORD1C or CORD1S of up to two systems by three grids, or CORD2R, CORD2C or CORD2S by three points.
    pub fn take(&mut self, card: Card) -> Result<(), FileError> {
        let is_double = card.name.starts_with("CORD1") && !card.text(6).is_empty();
        let starts = if is_double { &[2, 6][..] } else { &[2] };
        starts
            .iter()
            .try_for_each(|&start| card.keep(start, (), &mut self.cards))
    }

    /// The grids at their basic places, with what their own cards hold, and the directions in which they move. GRDSET fills blanks.
    pub fn grids(
        &self,
        cards: &Numbered<()>,
        default: Option<&Card>,
    ) -> Result<(BTreeMap<usize, Grid>, Motions), FileError> {
        let (mut grids, mut motions) = (BTreeMap::new(), Motions::default());
        for (&label, kept) in cards {
            let card = &kept.card;
            let position = self.place(card, cards, default, 0)?;
            let moves = chosen(card, default, 7);
            let is_fluid = moves.text(7) == "-1";
            if !is_fluid {
                let system = self.system(moves, 7, cards, default, 0)?;
                if system.kind != 'R' || system.axes != System::BASIC.axes {
                    motions.0.insert(label, system.directions(position));
                }
            }
            let held = chosen(card, default, 8);
            let constrained = match is_fluid {
                true => [true; 3],
                false => motions
                    .held(label, held.directions(8)?)
                    .ok_or_else(|| held.error(8, OBLIQUE))?,
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

    /// The basic place of a grid. `depth` counts the systems that wait for it: more than there are wait for each other.
    fn place(
        &self,
        card: &Card,
        grids: &Numbered<()>,
        default: Option<&Card>,
        depth: usize,
    ) -> Result<Vector3<f64>, FileError> {
        let given = chosen(card, default, 3);
        let system = self.system(given, 3, grids, default, depth)?;
        Ok(system.place(Vector3::new(card.real(4)?, card.real(5)?, card.real(6)?)))
    }

    /// The system that a field refers to: zero or blank is the basic one.
    fn system(
        &self,
        by: &Card,
        field: usize,
        grids: &Numbered<()>,
        default: Option<&Card>,
        depth: usize,
    ) -> Result<System, FileError> {
        if ["", "0"].contains(&by.text(field)) {
            return Ok(System::BASIC);
        }
        let kept = by.referred(field, &self.cards, "coordinate system's")?;
        let card = &kept.card;
        if depth > self.cards.len() {
            return Err(card.error(kept.start, "this coordinate system is defined by itself"));
        }
        let points = if card.name.starts_with("CORD1") {
            let grid = |field| {
                let grid = card.referred(field, grids, "GRID")?;
                self.place(&grid.card, grids, default, depth + 1)
            };
            [1, 2, 3].map(|more| grid(kept.start + more))
        } else {
            let base = self.system(card, 3, grids, default, depth + 1)?;
            let point = |fields: [usize; 3]| {
                let [x, y, z] = fields.map(|field| card.real(field));
                Ok(base.place(Vector3::new(x?, y?, z?)))
            };
            [[4, 5, 6], [7, 8, 9], [12, 13, 14]].map(point)
        };
        let [origin, along, across] = points;
        let (origin, along, across) = (origin?, along?, across?);
        let degenerate = || {
            card.error(
                kept.start,
                "the three points of this coordinate system lie on a line",
            )
        };
        let z = (along - origin).try_normalize(0.0).ok_or_else(degenerate)?;
        let y = z.cross(&(across - origin));
        let y = y
            .try_normalize(ROUND_OFF * (across - origin).norm())
            .ok_or_else(degenerate)?;
        Ok(System {
            origin,
            axes: Matrix3::from_columns(&[y.cross(&z), y, z]),
            kind: card.name.chars().last().unwrap_or('R'),
        })
    }
}

/// The card that has a field of a grid: its own, or GRDSET's where that is blank.
fn chosen<'a>(card: &'a Card, default: Option<&'a Card>, field: usize) -> &'a Card {
    default
        .filter(|_| card.text(field).is_empty())
        .unwrap_or(card)
}
