//! Chains of point masses and springs: the smallest structures, for examples and for learning.

use crate::method::error::Error;
use crate::method::structure::{Element, ElementKind, Grid, Material, Structure};
use nalgebra::{DMatrix, DVector, Vector3};

/// Stiffness of spring $s$ of a chain of `mass_count` masses, lbf/in (d × d): spring 0 holds mass 0 to the ground,
/// spring $s$ joins masses $s-1$ and $s$, and spring d, if there is one, holds the last mass to the ground.
///
/// $$ K_s = k_s b b^t, \qquad b = e_s - e_{s-1}, $$
///
/// without the unit vector of a mass that does not exist. Any other spring touches no mass and gives zero.
pub fn spring_stiffness(mass_count: usize, spring: usize, stiffness: f64) -> DMatrix<f64> {
    let mut ends = DVector::zeros(mass_count);
    if spring < mass_count {
        ends[spring] = 1.0;
    }
    if (1..=mass_count).contains(&spring) {
        ends[spring - 1] = -1.0;
    }
    stiffness * &ends * ends.transpose()
}

/// A chain as a structure: springs (lbf/in) in a row along x between grids 1, 2, …, which are free along x alone. `held` says which
/// of the two ends are fixed.
///
/// Each spring is a rod of unit length and modulus, whose area, in², is its stiffness.
///
/// # Errors
/// [`Error::Empty`] without springs; [`Error::NotPositive`] for one that is not.
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
