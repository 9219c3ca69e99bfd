//! Chains of springs: the smallest structures, for examples and for learning.

use crate::method::error::Error;
use crate::method::structure::{Element, ElementKind, Grid, Material, Structure};
use nalgebra::Vector3;

/// A chain as a structure: springs (lbf/in) in a row along x between grids 1, 2, …, which are free along x alone. `held` says which
/// of the two ends are fixed.
///
/// Each spring is a rod of unit length and modulus, whose area, in², is its stiffness.
///
/// # Errors
/// [`Error::Count`] without springs; [`Error::Value`] for one that is not.
pub fn rods(springs: &[f64], held: [bool; 2]) -> Result<Structure, Error> {
    let (last, material) = (springs.len() + 1, Material::isotropic(1.0, 0.25)?);
    let grid = |label: usize| {
        let is_held = (label == 1 && held[0]) || (label == last && held[1]);
        Grid {
            label,
            position: Vector3::new(label as f64, 0.0, 0.0),
            constrained: [is_held, true, true],
        }
    };
    let (kind, grids) = (ElementKind::Rod, |label| vec![label, label + 1]);
    let rod = |(&size, label): (&f64, usize)| Element {
        label,
        kind,
        grids: grids(label),
        size,
        material,
    };
    Structure::new(
        (1..=last).map(grid).collect(),
        springs.iter().zip(1..).map(rod).collect(),
    )
}
