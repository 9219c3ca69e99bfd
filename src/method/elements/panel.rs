//! The mean plane of a quadrilateral panel and the test that it is a panel at all.

use crate::method::error::Error;
use nalgebra::{Vector2, Vector3};

/// Area over the square of the longest side or diagonal below which a triangle or panel is degenerate.
const SMALLEST_AREA_RATIO: f64 = 1e-10;
/// Doubled area of a corner's triangle over the panel's doubled area below which the corner is straight.
const SMALLEST_CORNER_RATIO: f64 = 1e-10;

/// A panel seen in its mean plane, the plane to which both diagonals are parallel.
#[derive(Debug, Clone)]
pub struct MeanPlane {
    /// Corner positions in the plane, in; the first at the origin, the second on the first axis.
    pub corners: [Vector2<f64>; 4],
    /// The true diagonals in space, from corner 1 to 3 and from 2 to 4, in.
    pub diagonals: [Vector3<f64>; 2],
    /// Area of the projection on the mean plane, in².
    pub area: f64,
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
    let (k, area) = normal_and_area(d13.cross(&d24), d13.norm().max(d24.norm()))?;
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
        diagonals: [d13, d24],
        area,
    })
}

/// Unit normal and area of a triangle or panel from a normal of twice its area's length, unless the area vanishes beside the square
/// of `longest`, its longest side or diagonal.
pub(crate) fn normal_and_area(
    normal: Vector3<f64>,
    longest: f64,
) -> Result<(Vector3<f64>, f64), Error> {
    let area = 0.5 * normal.norm();
    let ratio = area / (longest * longest);
    if ratio > SMALLEST_AREA_RATIO {
        return Ok((normal / (2.0 * area), area));
    }
    // Not a number when all corners coincide: no area then.
    Err(Error::ZeroArea(ratio.max(0.0)))
}
