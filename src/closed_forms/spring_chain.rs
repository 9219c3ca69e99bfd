//! Chains of point masses and springs: structures whose stiffness is written down at sight, and, when uniform, whose
//! modes are too.

use super::analytical::{ChainEnds, chain_eigenvalues};
use crate::method::error::{Error, at_least_one};
use crate::method::modes::Modes;
use crate::method::structure::positive;
use nalgebra::{DMatrix, DVector};
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
