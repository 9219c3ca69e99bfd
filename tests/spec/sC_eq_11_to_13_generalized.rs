//! (C.11) to (C.13), the pencil in generalized coordinates, and (C.14) through it, as printed.

use super::s1_eq_07_roots::MODES;
use super::sC_eq_04_to_09_transposed::wing_section;
use crate::common::boxes::first_problem;
use crate::common::complex_pencils::{Complexes, aeroelastic_section, amax, complex, through};
use crate::common::tolerances::{COMPLEX_EIGEN_ROUND_OFF, MATRIX_ROUND_OFF, WRONG_FORM};
use approx::assert_relative_eq;
use corfem::method::analysis::Analysis;
use corfem::method::appendix_c::Pencil;
use corfem::torque_box::Case;
use nalgebra::{Complex, DMatrix, dmatrix};

#[test]
fn generalized_matrices_obey_g_equals_k_lambda() {
    // The line before (C.13) prints k = gΛ; from (C.5) it is g = kΛ, and with g = I that makes k = 1/λ = ω².
    let problem = first_problem(1);
    let model = Case::new(1).expect("a case").model().expect("a model");
    let dynamic = model.matrices(&[1.0; 15]).expect("held");
    let v = problem.exact().modes.shapes();
    let (k, g) = (
        v.tr_mul(&(&dynamic.stiffness * v)),
        v.tr_mul(&(&dynamic.mass * v)),
    );
    for i in 0..MODES {
        let lambda = 1.0 / problem.exact().modes.omega_squared()[i];
        assert_relative_eq!(
            g[(i, i)],
            k[(i, i)] * lambda,
            max_relative = MATRIX_ROUND_OFF
        );
        assert!((k[(i, i)] / (g[(i, i)] * lambda) - 1.0).abs() > WRONG_FORM);
    }
}

#[test]
fn changes_are_seen_through_the_transposed_left_shapes() {
    // Before (C.14) the scan has α = U ΔG Vᵗ, β = U ΔK V. Premultiplied by Uᵗ, as (C.12) is, the changed pencil in
    // v = Vq is k(λ − Λ) + βλ − α, for any λ, with Uᵗ in both.
    let (stiffness, g, modes) = wing_section();
    let (u, v) = (&modes.left, &modes.right);
    let stiffness_change = complex(&dmatrix![0.1, 0.0, 0.02; 0.0, -0.2, 0.0; 0.02, 0.0, 0.05]);
    let g_change = aeroelastic_section(0.3).1 - &g;
    let lambda = Complex::new(0.7, 0.2);
    let changed = through(
        u,
        &((&stiffness + &stiffness_change) * lambda - (&g + &g_change)),
        v,
    );
    let k = through(u, &stiffness, v);
    let unchanged = &k * (DMatrix::identity(3, 3) * lambda - DMatrix::from_diagonal(&modes.roots));
    let error = |alpha: &Complexes, beta: &Complexes| {
        amax(&(&unchanged + beta * lambda - alpha - &changed))
    };
    // The pencil of the crate holds A = k + β and G = kΛ + α.
    let ours = Pencil::new(&stiffness, &modes, &stiffness_change, &g_change).expect("it fits");
    let alpha = ours.g() - &k * DMatrix::from_diagonal(&modes.roots);
    let beta = ours.a() - &k;
    assert!(error(&alpha, &beta) < COMPLEX_EIGEN_ROUND_OFF);
    assert!(error(&(u * &g_change * v.transpose()), &beta) > WRONG_FORM);
    assert!(error(&alpha, &(u * &stiffness_change * v)) > WRONG_FORM);
}
