//! (C.15) to (C.19) as scanned and printed.

use crate::common::appendix_c::{ModalChange, eigensolution};
use crate::common::tolerances::{MATRIX_ROUND_OFF, WRONG_FORM};
use corfem::method::perturbation::Perturbed;
use nalgebra::{DMatrix, dmatrix, dvector};

/// Three modes under a change of stiffness and mass.
fn three_modes() -> (ModalChange, Perturbed) {
    let beta = dmatrix![0.1, 0.2, -0.3; 0.2, -0.2, 0.4; -0.3, 0.4, 0.5];
    let alpha = dmatrix![0.1, -0.05, 0.02; -0.05, 0.2, 0.03; 0.02, 0.03, -0.1];
    let change = ModalChange::of_vibrations(&dvector![1.0, 3.0, 8.0], beta, alpha);
    let exact = eigensolution(&change).expect("separate modes");
    (change, exact)
}

/// The matrix of (C.17), (C.18) or (C.19) for a changed root, with what stands for β_is γ − α_is.
fn rows(change: &ModalChange, gamma: f64, entry: impl Fn(f64, f64) -> f64) -> DMatrix<f64> {
    DMatrix::from_fn(3, 3, |i, s| {
        let own = if i == s {
            change.generalized_stiffness[i] * (gamma - 1.0 / change.generalized_stiffness[i])
        } else {
            0.0
        };
        own + entry(change.beta[(i, s)], change.alpha[(i, s)])
    })
}

#[test]
fn rows_of_three_modes_subtract_alpha() {
    // (C.16) to (C.19): the scan raises −α to an exponent. (C.14) has βλ − α.
    let (change, exact) = three_modes();
    for (&gamma, p) in exact.roots.iter().zip(exact.shapes.column_iter()) {
        let subtracted = rows(&change, gamma, |beta, alpha| beta * gamma - alpha) * p;
        let raised = rows(&change, gamma, |beta, alpha| beta * gamma.powf(-alpha)) * p;
        assert!(subtracted.amax() < MATRIX_ROUND_OFF, "{subtracted}");
        assert!(raised.amax() > WRONG_FORM, "{raised}");
    }
}

#[test]
fn own_component_counts_once() {
    // (C.15) prints δ_ji + p_ji and (C.21) p_ii = 1: together the mode's own component would be two.
    let (change, exact) = three_modes();
    for mode in 0..3 {
        let rows = rows(&change, exact.roots[mode], |beta, alpha| {
            beta * exact.roots[mode] - alpha
        });
        let mut p = exact.shapes.column(mode).into_owned();
        assert!((&rows * &p).amax() < MATRIX_ROUND_OFF);
        p[mode] += 1.0;
        assert!((&rows * &p).amax() > WRONG_FORM);
    }
}
