//! (B.7), whose roots are squared circular frequencies.

use crate::common::tolerances::{MATRIX_ROUND_OFF, ROUND_OFF, WRONG_FORM};
use approx::assert_relative_eq;
use corfem::method::appendix_b::orthogonalize;
use corfem::method::modes::{Modes, generalized_mass};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

#[test]
fn roots_of_b_7_are_squared_circular_frequencies() {
    // (B.7): q = ω² λ⁻¹ D⁻¹ m₁ q, D the diagonal of m₁. With λ_i = ω_Gi² the new modes satisfy it; with the λ = 1/ω² of
    // (10) and (C.1) they do not, and not even one mode alone would, whose frequency nothing changes.
    let raw = Modes::new(dvector![100.0, 400.0], dmatrix![2.0, 0.3; 0.0, 1.0]).expect("modes");
    let mass = DMatrix::from_diagonal(&dvector![1.0, 3.0]);
    let modes = orthogonalize(&raw, &mass)
        .expect("independent shapes")
        .modes;
    let m = generalized_mass(raw.shapes(), &mass).unwrap();
    let q = raw
        .shapes()
        .clone()
        .try_inverse()
        .expect("independent shapes")
        * modes.shapes();
    let right_side = |lambda: &DVector<f64>| {
        let inverse = lambda.component_mul(&m.diagonal()).map(f64::recip);
        DMatrix::from_diagonal(&inverse) * &m * &q * DMatrix::from_diagonal(modes.omega_squared())
    };
    assert!((right_side(raw.omega_squared()) - &q).amax() < MATRIX_ROUND_OFF);
    assert!((right_side(&raw.omega_squared().map(f64::recip)) - &q).amax() > WRONG_FORM);
    let alone = Modes::new(dvector![100.0], dmatrix![2.0; 0.0]).expect("modes");
    let omega_squared = orthogonalize(&alone, &mass)
        .expect("one shape")
        .modes
        .omega_squared()[0];
    assert_relative_eq!(omega_squared, 100.0, max_relative = ROUND_OFF);
}
