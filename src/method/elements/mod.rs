//! Element stiffness matrices in global axes, for unit gage or area.
//! Tour: [chapter 7](crate::tour::chapter_07_box).
//!
//! Each function takes corner positions in inches and a material, and returns the stiffness at the x, y, z translations
//! of the corners in the order given. Stiffness is proportional to gage or area.

pub mod membrane;
pub mod shear;

use super::structure::{ElementKind, Material, Point};
use crate::method::linear_algebra::{Matrix, Vector};

/// Stiffness of an element of any kind and unit size, lbf/in per in (gage) or per in² (area), for the corners of a
/// [`Structure`](crate::method::structure::Structure): 6 × 6 for a rod, 9 × 9 for a triangle, 12 × 12 for a panel.
pub fn unit_stiffness(kind: ElementKind, corners: &[Point], material: &Material) -> Matrix {
    match kind {
        ElementKind::Rod => rod(corners, material.youngs_modulus),
        ElementKind::Triangle => membrane::triangle(corners, material),
        ElementKind::ShearPanel => shear::shear_panel(corners, material),
        ElementKind::Membrane => membrane::membrane(corners, material),
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
/// let stiffness = rod(&[Vector3::zeros(), 10.0 * Vector3::x()], 1.0e7);
/// assert_eq!([(0, 0), (3, 0), (1, 1)].map(|entry| stiffness[entry]), [1.0e6, -1.0e6, 0.0]);
/// ```
pub fn rod(ends: &[Point], youngs_modulus: f64) -> Matrix {
    let along = ends[1] - ends[0];
    let length = along.norm();
    let n = along / length;
    let b = Vector::from_iterator(6, (-n).iter().chain(n.iter()).copied());
    (youngs_modulus / length) * &b * b.transpose()
}
