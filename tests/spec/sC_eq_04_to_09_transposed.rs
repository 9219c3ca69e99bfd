//! (C.4), (C.6), (C.7) and (C.9) as printed: the transposed pencil has G transposed.

use crate::common::complex_pencils::{Complexes, aeroelastic_section, amax, complex, through};
use crate::common::tolerances::{COMPLEX_EIGEN_ROUND_OFF, WRONG_FORM};
use corfem::method::appendix_c::{LeftRightModes, solve};
use nalgebra::{Complex, DMatrix};

/// A wing section with aileron in a flow: stiffness, and G complex and unsymmetric.
pub fn wing_section() -> (Complexes, Complexes, LeftRightModes<Complex<f64>>) {
    let (stiffness, g) = aeroelastic_section(0.15);
    let modes = solve(&stiffness, &g).expect("three modes");
    (complex(&stiffness), g, modes)
}

#[test]
fn transposed_pencil_needs_g_transposed() {
    // (C.4), (C.6), (C.7), (C.9) print G where the transposed pencil (C.2) has Gᵗ. K is its own transpose.
    let (stiffness, g, modes) = wing_section();
    let (u, v) = (&modes.left, &modes.right);
    let c_4 = |g: &Complexes| {
        amax(&(through(v, &stiffness, u) * DMatrix::from_diagonal(&modes.roots) - through(v, g, u)))
    };
    assert!(c_4(&g.transpose()) < COMPLEX_EIGEN_ROUND_OFF);
    assert!(c_4(&g) > WRONG_FORM);
    // (C.9): a scalar equals its transpose, uᵗGv = vᵗGᵗu; vᵗGu is another number.
    let b = through(u, &g, v);
    assert!(amax(&(&b - through(v, &g.transpose(), u).transpose())) < COMPLEX_EIGEN_ROUND_OFF);
    assert!(amax(&(&b - through(v, &g, u).transpose())) > WRONG_FORM);
}
