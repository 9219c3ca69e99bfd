//! The geometry of an element: its kind, and corners that have a length or an area between them.
//! Tour: [chapter 7](crate::tour::chapter_07_box).

use crate::method::error::Error;
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};

/// Length of a rod over the distance of its ends from the origin below which it is round-off of their coordinates.
const SMALLEST_LENGTH_RATIO: f64 = 1e-12;
/// Area over the square of the longest side or diagonal below which a triangle or panel is degenerate.
const SMALLEST_AREA_RATIO: f64 = 1e-10;
/// Doubled area of a corner's triangle over the panel's doubled area below which the corner is straight.
const SMALLEST_CORNER_RATIO: f64 = 1e-10;

/// What an element is made of and what it resists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ElementKind {
    /// Axial member between two grids; its size is a cross section (area), in².
    Rod,
    /// Garvey shear panel between four grids; its size is a gage (thickness), in.
    ShearPanel,
    /// Membrane panel of four overlapping triangles between four grids; its size is a gage, in.
    Membrane,
    /// Constant-strain triangle between three grids; its size is a gage, in.
    Triangle,
}

impl ElementKind {
    /// How many grid points the element joins.
    pub fn corner_count(self) -> usize {
        match self {
            Self::Rod => 2,
            Self::Triangle => 3,
            Self::ShearPanel | Self::Membrane => 4,
        }
    }
}

/// Where an element lies in space, in inches. [`Self::new`] refuses what has no length or area.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// The two ends of a rod.
    Rod([Vector3<f64>; 2]),
    /// The three corners of a triangle.
    Triangle([Vector3<f64>; 3]),
    /// A shear panel.
    ShearPanel(MeanPlane),
    /// A membrane panel.
    Membrane(MeanPlane),
}

impl Geometry {
    /// The geometry of an element of some kind from its corners, in order around the perimeter of a panel.
    ///
    /// # Errors
    /// [`Error::WrongCornerCount`]; [`Error::ZeroLength`] for a rod whose ends coincide to working precision;
    /// [`Error::ZeroArea`] for a triangle whose corners lie on a line; those of [`mean_plane`].
    pub fn new(kind: ElementKind, corners: &[Vector3<f64>]) -> Result<Self, Error> {
        match (kind, corners) {
            (ElementKind::Rod, &[a, b]) => {
                let length = (b - a).norm();
                if length > SMALLEST_LENGTH_RATIO * (a.norm() + b.norm()) {
                    Ok(Self::Rod([a, b]))
                } else {
                    Err(Error::ZeroLength(length))
                }
            }
            (ElementKind::Triangle, &[a, b, c]) => {
                let longest = (b - a).norm().max((c - a).norm()).max((c - b).norm());
                require_area((b - a).cross(&(c - a)), longest)?;
                Ok(Self::Triangle([a, b, c]))
            }
            (ElementKind::ShearPanel, &[a, b, c, d]) => {
                mean_plane(&[a, b, c, d]).map(Self::ShearPanel)
            }
            (ElementKind::Membrane, &[a, b, c, d]) => mean_plane(&[a, b, c, d]).map(Self::Membrane),
            _ => Err(Error::WrongCornerCount {
                expected: kind.corner_count(),
                found: corners.len(),
            }),
        }
    }
}

/// A panel seen in its mean plane, the plane to which both diagonals are parallel. It is convex and has an area:
///
/// ```compile_fail,E0451
/// # use corfem::method::geometry::MeanPlane;
/// # use nalgebra::{Vector2, Vector3};
/// let point = MeanPlane { corners: [Vector2::zeros(); 4], corners_in_space: [Vector3::zeros(); 4], area: 0.0 };
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MeanPlane {
    corners: [Vector2<f64>; 4],
    corners_in_space: [Vector3<f64>; 4],
    area: f64,
}

impl MeanPlane {
    /// Corner positions in the plane, in; the first at the origin, the second on the first axis.
    pub fn corners(&self) -> [Vector2<f64>; 4] {
        self.corners
    }

    /// The true corners in space, in.
    pub fn corners_in_space(&self) -> [Vector3<f64>; 4] {
        self.corners_in_space
    }

    /// The true diagonals in space, from corner 1 to 3 and from 2 to 4, in.
    pub fn diagonals(&self) -> [Vector3<f64>; 2] {
        let [a, b, c, d] = self.corners_in_space;
        [c - a, d - b]
    }

    /// Area of the projection on the mean plane, in².
    pub fn area(&self) -> f64 {
        self.area
    }
}

/// Projects the corners of a (possibly warped) panel on its mean plane and checks that it is convex.
///
/// With diagonals $d_{13}$ and $d_{24}$ the unit normal is $k = d_{13} \times d_{24} / 2A$ with $A = |d_{13} \times
/// d_{24}|/2$; axis $i$ is side 1-2 projected on the plane, $j = k \times i$. Source: geometry of the NASTRAN shear
/// panel, NASA SP-222 and SP-223.
///
/// # Errors
/// [`Error::ZeroArea`] when the diagonals are parallel or one has no length;
/// [`Error::NotConvex`] naming the first corner with an interior angle of 180° or more or at the place of a neighbor.
pub fn mean_plane(corners: &[Vector3<f64>; 4]) -> Result<MeanPlane, Error> {
    let d13 = corners[2] - corners[0];
    let d24 = corners[3] - corners[1];
    let (k, area) = require_area(d13.cross(&d24), d13.norm().max(d24.norm()))?;
    for corner in 0..4 {
        let forward = corners[(corner + 1) % 4] - corners[corner];
        let back = corners[(corner + 3) % 4] - corners[corner];
        if forward.cross(&back).dot(&k) <= SMALLEST_CORNER_RATIO * 2.0 * area {
            return Err(Error::NotConvex(corner + 1));
        }
    }
    let side = corners[1] - corners[0];
    let i = (side - side.dot(&k) * k).normalize();
    let j = k.cross(&i);
    // Corners 1 and 3 lie on one side of the plane by the warp, 2 and 4 on the other: only i and j count.
    let flat = corners.map(|corner| {
        let from_first = corner - corners[0];
        Vector2::new(from_first.dot(&i), from_first.dot(&j))
    });
    Ok(MeanPlane {
        corners: flat,
        corners_in_space: *corners,
        area,
    })
}

/// Unit normal and area of a triangle or panel from a normal of twice its area's length, unless the area vanishes beside the square
/// of `longest`, its longest side or diagonal.
fn require_area(normal: Vector3<f64>, longest: f64) -> Result<(Vector3<f64>, f64), Error> {
    let area = 0.5 * normal.norm();
    let ratio = area / (longest * longest);
    if ratio > SMALLEST_AREA_RATIO {
        return Ok((normal / (2.0 * area), area));
    }
    // Not a number when all corners coincide: no area then.
    Err(Error::ZeroArea(ratio.max(0.0)))
}
