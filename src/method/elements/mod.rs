//! Element stiffness matrices in global axes, for unit gage or area, and lumped element masses.
//! Tour: [chapter 7](crate::tour::chapter_07_box).
//!
//! Each function takes corner positions in inches and a material, and returns the stiffness at the x, y, z translations
//! of the corners in the order given. Stiffness is proportional to gage or area.

pub mod membrane;
pub mod shear;

use crate::method::geometry::Geometry;
use crate::method::structure::Material;
use nalgebra::{DMatrix, DVector, Vector3};

/// Unit-size stiffness of an element of any kind, lbf/in per in (gage) or per in² (area).
///
/// The result is 6 × 6 for a rod, 9 × 9 for a triangle, 12 × 12 for a panel.
pub fn unit_stiffness(geometry: &Geometry, material: &Material) -> DMatrix<f64> {
    match geometry {
        Geometry::Rod(ends) => rod(*ends, material.youngs_modulus),
        Geometry::Triangle(corners) => membrane::triangle(*corners, material),
        Geometry::ShearPanel(panel) => shear::shear_panel(panel, material),
        Geometry::Membrane(panel) => membrane::membrane(panel, material),
    }
}

/// Stiffness of a rod, an axial member, of unit cross section, lbf/in per in² of area (6 × 6; x, y, z of each end).
///
/// $$ K = \frac{E}{L} b b^t, \qquad b = (-n, n), \qquad n = (x_2 - x_1)/L $$
///
/// `youngs_modulus` in lbf/in², `ends` in inches. Rank one: it resists only stretching. Source: Przemieniecki, *Theory
/// of Matrix Structural Analysis*, section 5.2. Ends that coincide have no such stiffness: its entries are not finite numbers.
///
/// # Example
///
/// ```rust
/// use corfem::method::elements::rod;
/// use nalgebra::Vector3;
///
/// // E/L = 1e7 / 10 along the rod, nothing across it.
/// let stiffness = rod([Vector3::zeros(), 10.0 * Vector3::x()], 1.0e7);
/// assert_eq!([(0, 0), (3, 0), (1, 1)].map(|entry| stiffness[entry]), [1.0e6, -1.0e6, 0.0]);
/// ```
pub fn rod(ends: [Vector3<f64>; 2], youngs_modulus: f64) -> DMatrix<f64> {
    let along = ends[1] - ends[0];
    let length = along.norm();
    let n = along / length;
    let b = DVector::from_iterator(6, (-n).iter().chain(n.iter()).copied());
    (youngs_modulus / length) * &b * b.transpose()
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
pub fn corner_volumes(geometry: &Geometry) -> Vec<f64> {
    let triangle =
        |a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>| 0.5 * (b - a).cross(&(c - a)).norm();
    match geometry {
        Geometry::Rod([a, b]) => vec![0.5 * (b - a).norm(); 2],
        &Geometry::Triangle([a, b, c]) => vec![triangle(a, b, c) / 3.0; 3],
        Geometry::ShearPanel(panel) | Geometry::Membrane(panel) => {
            let [a, b, c, d] = panel.corners_in_space();
            let at_corner = [
                triangle(d, a, b),
                triangle(a, b, c),
                triangle(b, c, d),
                triangle(c, d, a),
            ];
            at_corner
                .iter()
                .map(|corner| (panel.area() + corner) / 6.0)
                .collect()
        }
    }
}
