//! Element stiffness matrices in global axes, for unit gage or area, and lumped element masses.
//! Tour: [chapter 7](crate::tour::chapter_07_box).
//!
//! Each function takes corner positions in inches and a material, and returns the stiffness at the x, y, z translations
//! of the corners in the order given. Stiffness is proportional to gage or area.

pub mod membrane;
pub mod panel;
pub mod shear;

use crate::method::error::Error;
use crate::method::linear_algebra::{finite, finite_list};
use crate::method::structure::{ElementKind, Material};
use nalgebra::{DMatrix, DVector, Vector3};

/// Unit-size stiffness of an element of any kind, lbf/in per in (gage) or per in² (area).
///
/// `corners` in inches; the result is 6 × 6 for a rod, 9 × 9 for a triangle, 12 × 12 for a panel.
///
/// # Errors
/// [`Error::WrongCornerCount`], and those of the element's own function.
pub fn unit_stiffness(
    kind: ElementKind,
    corners: &[Vector3<f64>],
    material: &Material,
) -> Result<DMatrix<f64>, Error> {
    match (kind, corners) {
        (ElementKind::Rod, &[a, b]) => rod([a, b], material.youngs_modulus),
        (ElementKind::Triangle, &[a, b, c]) => membrane::triangle([a, b, c], material),
        (ElementKind::ShearPanel, &[a, b, c, d]) => shear::shear_panel(&[a, b, c, d], material),
        (ElementKind::Membrane, &[a, b, c, d]) => membrane::membrane(&[a, b, c, d], material),
        _ => Err(Error::WrongCornerCount {
            expected: kind.corner_count(),
            found: corners.len(),
        }),
    }
}

/// Stiffness of a rod, an axial member, of unit cross section, lbf/in per in² of area (6 × 6; x, y, z of each end).
///
/// $$ K = \frac{E}{L} b b^t, \qquad b = (-n, n), \qquad n = (x_2 - x_1)/L $$
///
/// `youngs_modulus` in lbf/in², `ends` in inches. Rank one: it resists only stretching. Source: Przemieniecki, *Theory
/// of Matrix Structural Analysis*, section 5.2.
///
/// # Errors
/// [`Error::ZeroLength`] when the ends coincide to working precision; [`Error::NotFinite`].
///
/// # Example
///
/// ```rust
/// use corfem::method::elements::rod;
/// use nalgebra::Vector3;
///
/// // E/L = 1e7 / 10 along the rod, nothing across it.
/// let stiffness = rod([Vector3::zeros(), 10.0 * Vector3::x()], 1.0e7)?;
/// assert_eq!([(0, 0), (3, 0), (1, 1)].map(|entry| stiffness[entry]), [1.0e6, -1.0e6, 0.0]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn rod(ends: [Vector3<f64>; 2], youngs_modulus: f64) -> Result<DMatrix<f64>, Error> {
    let along = ends[1] - ends[0];
    let length = along.norm();
    // Ends closer than the round-off of their own coordinates have no direction.
    if length.is_nan() || length <= 1e-12 * (ends[0].norm() + ends[1].norm()) {
        return Err(Error::ZeroLength(length));
    }
    let n = along / length;
    let b = DVector::from_iterator(6, (-n).iter().chain(n.iter()).copied());
    finite(
        "element stiffness",
        (youngs_modulus / length) * &b * b.transpose(),
    )
}

/// Volume an element of unit size lumps at each of its corners, in³ per in of gage or in² of area.
///
/// Times density (lbf·s²/in⁴) and size it is the mass that moves with the corner, alike in x, y and z:
///
/// $$ v_{rod} = \frac{L}{2}, \qquad v_{triangle} = \frac{A}{3}, \qquad v_{quadrilateral, i} = \frac{A + A_i}{6} $$
///
/// where $A_i$ is the area of the triangle of corner $i$ and its two neighbors and $A = |d_{13} \times d_{24}|/2$ the
/// quadrilateral's in its mean plane. As in NASTRAN, the four of a warped panel sum to slightly more than $A$. Source:
/// the lumped masses of NASTRAN, NASA SP-222, and for warped quadrilaterals its routine EMADTQ.
///
/// # Errors
/// [`Error::WrongCornerCount`] when the corners do not fit the kind; [`Error::NotFinite`].
pub fn corner_volumes(kind: ElementKind, corners: &[Vector3<f64>]) -> Result<Vec<f64>, Error> {
    let triangle =
        |a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>| 0.5 * (b - a).cross(&(c - a)).norm();
    let volumes = match (kind, corners) {
        (ElementKind::Rod, [a, b]) => vec![0.5 * (b - a).norm(); 2],
        (ElementKind::Triangle, [a, b, c]) => vec![triangle(a, b, c) / 3.0; 3],
        (ElementKind::ShearPanel | ElementKind::Membrane, [a, b, c, d]) => {
            let at_corner: [f64; 4] = [
                triangle(d, a, b),
                triangle(a, b, c),
                triangle(b, c, d),
                triangle(c, d, a),
            ];
            let area = 0.5 * (c - a).cross(&(d - b)).norm();
            at_corner
                .iter()
                .map(|corner| (area + corner) / 6.0)
                .collect()
        }
        _ => {
            return Err(Error::WrongCornerCount {
                expected: kind.corner_count(),
                found: corners.len(),
            });
        }
    };
    finite_list("element volumes", volumes)
}
