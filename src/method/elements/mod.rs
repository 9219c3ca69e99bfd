//! Element stiffness matrices in global axes, for unit gage or area.
//!
//! Each function takes corner positions in inches and a material, and returns the stiffness at the x, y, z translations
//! of the corners in the order given. Stiffness is proportional to gage or area.

pub mod mass;
pub mod membrane;
pub mod panel;
pub mod quadrature;
pub mod rod;
pub mod shear;
pub mod triangle;

use crate::method::error::Error;
use crate::method::structure::{ElementKind, Material};
use nalgebra::{DMatrix, Vector3};

/// Unit-size stiffness of an element of any kind, lbf/in per in (gage) or per in² (area).
///
/// `corners` in inches; the result is 6 × 6 for a rod, 9 × 9 for a triangle, 12 × 12 for a panel.
///
/// # Errors
/// [`Error::WrongCornerCount`], and those of the element's own function.
pub fn unit_stiffness(kind: ElementKind, corners: &[Vector3<f64>], material: &Material) -> Result<DMatrix<f64>, Error> {
    match (kind, corners) {
        (ElementKind::Rod, &[a, b]) => rod::rod([a, b], material.youngs_modulus),
        (ElementKind::Triangle, &[a, b, c]) => triangle::triangle([a, b, c], material),
        (ElementKind::ShearPanel, &[a, b, c, d]) => shear::shear_panel(&[a, b, c, d], material),
        (ElementKind::Membrane, &[a, b, c, d]) => membrane::membrane(&[a, b, c, d], material),
        _ => Err(Error::WrongCornerCount { expected: kind.corner_count(), found: corners.len() }),
    }
}
