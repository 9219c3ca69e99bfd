//! The uniform chain with both ends held, whose modes are written down.

use crate::prelude::*;

/// Modes of the uniform chain of `mass_count` masses $m$ (lbf·s²/in) and $d+1$ springs $k$ (lbf/in), both ends held:
///
/// $$ \omega_i^2 = 4\frac{k}{m}\sin^2\frac{i\pi}{2(d+1)}, \qquad
///    v_{ji} = \sqrt{\frac{2}{(d+1)m}} \sin\frac{ij\pi}{d+1}, \qquad i, j = 1 \dots d $$
///
/// Each is signed so that the first of its largest components (within one part in a million) is positive.
///
/// Source: Lagrange, *Mécanique analytique* (1788): the string loaded with equal masses.
pub fn uniform_held_modes(mass_count: usize, stiffness: f64, mass: f64) -> Modes {
    let span = (mass_count + 1) as f64;
    let mut shapes = DMatrix::from_fn(mass_count, mass_count, |j, i| {
        let angle = ((i + 1) * (j + 1)) as f64 * PI / span;
        (2.0 / (span * mass)).sqrt() * angle.sin()
    });
    apply_sign_rule(&mut shapes);
    let omega_squared = chain_eigenvalues(ChainEnds::FixedFixed, mass_count, stiffness, mass);
    Modes::new(DVector::from_vec(omega_squared), shapes).unwrap()
}
