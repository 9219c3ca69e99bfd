//! Chains of point masses and springs: structures whose stiffness is written down at sight, and, when uniform, whose
//! modes are too.

use super::analytical::{ChainEnds, chain_eigenvalues};
use crate::method::error::{Error, at_least_one};
use crate::method::modes::Modes;
use crate::method::structure::{Element, ElementKind, Grid, Material, Structure, positive};
use nalgebra::{DMatrix, DVector, Vector3};
use std::f64::consts::PI;

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

/// Modes of the uniform chain of `mass_count` masses $m$ (lbf·s²/in) and $d+1$ springs $k$ (lbf/in), both ends held:
///
/// $$ \omega_i^2 = 4\frac{k}{m}\sin^2\frac{i\pi}{2(d+1)}, \qquad
///    v_{ji} = \sqrt{\frac{2}{(d+1)m}} \sin\frac{ij\pi}{d+1}, \qquad i, j = 1 \dots d $$
///
/// Source: Lagrange, *Mécanique analytique* (1788): the string loaded with equal masses.
///
/// # Errors
/// [`Error::Empty`] without masses; [`Error::NotPositive`] for a spring or mass that is not.
pub fn uniform_held_modes(mass_count: usize, stiffness: f64, mass: f64) -> Result<Modes, Error> {
    at_least_one("masses", mass_count)?;
    let owner = || "the uniform chain".to_owned();
    positive("stiffness", owner, stiffness)?;
    positive("mass", owner, mass)?;
    let span = (mass_count + 1) as f64;
    let shapes = DMatrix::from_fn(mass_count, mass_count, |j, i| {
        let angle = ((i + 1) * (j + 1)) as f64 * PI / span;
        (2.0 / (span * mass)).sqrt() * angle.sin()
    });
    let omega_squared = chain_eigenvalues(ChainEnds::FixedFixed, mass_count, stiffness, mass);
    Ok(Modes::ascending(DVector::from_vec(omega_squared), shapes))
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
