//! Lumped element masses.

use crate::method::error::Error;
use crate::method::linear_algebra::finite;
use crate::method::structure::ElementKind;
use nalgebra::{DMatrix, Vector3};

/// Volume an element of unit size lumps at each of its corners, in³ per in of gage or in² of area.
///
/// Times density (lbf·s²/in⁴) and size it is the mass that moves with the corner, alike in x, y and z:
///
/// $$ v_{rod} = \frac{L}{2}, \qquad v_{triangle} = \frac{A}{3}, \qquad v_{quadrilateral, i} = \frac{A + A_i}{6} $$
///
/// where $A_i$ is the area of the triangle of corner $i$ and its two neighbors and $A = |d_{13} \times d_{24}|/2$ the
/// quadrilateral's in its mean plane. As in NASTRAN, the four of a warped panel sum to slightly more than $A$.
///
/// # Errors
/// [`Error::WrongCornerCount`] when the corners do not fit the kind; [`Error::NotFinite`].
///
/// Source: the lumped masses of NASTRAN, NASA SP-222, and for warped quadrilaterals its routine EMADTQ.
pub fn corner_volumes(kind: ElementKind, corners: &[Vector3<f64>]) -> Result<Vec<f64>, Error> {
    let triangle = |a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>| 0.5 * (b - a).cross(&(c - a)).norm();
    let volumes = match (kind, corners) {
        (ElementKind::Rod, [a, b]) => vec![0.5 * (b - a).norm(); 2],
        (ElementKind::Triangle, [a, b, c]) => vec![triangle(a, b, c) / 3.0; 3],
        (ElementKind::ShearPanel | ElementKind::Membrane, [a, b, c, d]) => {
            let at_corner: [f64; 4] = [triangle(d, a, b), triangle(a, b, c), triangle(b, c, d), triangle(c, d, a)];
            let area = 0.5 * (c - a).cross(&(d - b)).norm();
            at_corner.iter().map(|corner| (area + corner) / 6.0).collect()
        }
        _ => return Err(Error::WrongCornerCount { expected: kind.corner_count(), found: corners.len() }),
    };
    finite("element volumes", DMatrix::from_vec(volumes.len(), 1, volumes)).map(|volumes| volumes.as_slice().to_vec())
}
