//! `paper/errata.md`, entry by entry: what the print says cannot be, and what is done instead.
//!
//! Each test takes the printed form literally and shows what is wrong with it on the box or on a small example.

use crate::common::appendix_c::exact;
use crate::common::boxes::first_problem;
use crate::common::tolerances::{EIGEN_ROUND_OFF, MATRIX_ROUND_OFF, PRINTED_SRSS};
use approx::assert_relative_eq;
use corfem::cases::Case;
use corfem::cases::published::PublishedTable;
use corfem::method::appendix_c::{Perturbed, recursive_1_converged};
use corfem::method::derivatives::by_definition;
use corfem::method::state::{ModalState, UpdateRule};
use corfem::method::step::{StepRule, stiffness_changes, unlimited_factors};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

/// A change of every element by ten percent, up and down in turn, in the modes of Case 2.
fn change() -> (DVector<f64>, DMatrix<f64>) {
    let problem = first_problem(2);
    let mut beta = DMatrix::zeros(9, 9);
    for (e, share) in problem.shares.iter().enumerate() {
        beta += if e % 2 == 0 { 0.1 } else { -0.1 } * share.matrix();
    }
    (problem.exact.modes.omega_squared.clone(), beta)
}

/// Its modes by Recursive 1, carried to convergence.
fn converged(k: &DVector<f64>, beta: &DMatrix<f64>) -> Perturbed {
    let settled = recursive_1_converged(k, beta, 1e-13, 60);
    settled.expect("separate modes").perturbed
}

#[test]
fn root_is_the_reciprocal_of_the_squared_circular_frequency() {
    // (10), f = (λ + Δλ)^(−1/2)/2π, agrees with (Kλ − M)v = 0; the line that calls λ = ω² does not.
    let problem = first_problem(1);
    let lambda = problem.exact.modes.omega_squared.map(f64::recip);
    for (root, frequency) in lambda.iter().zip(problem.exact.modes.frequencies_hz()) {
        assert_relative_eq!(root.powf(-0.5) / (2.0 * PI), frequency, max_relative = EIGEN_ROUND_OFF);
        let as_printed = (2.0 * PI * frequency).powi(2);
        assert!((as_printed.powf(-0.5) / (2.0 * PI) / frequency - 1.0).abs() > 0.9);
    }
}

#[test]
fn print_of_the_transformation_has_a_transpose_too_many() {
    // (2), (A.7), (A.8) print Tᵗ where T (structural by dynamic DOF) alone has as many rows as K_S.
    let model = Case::new(1).expect("a case").model().expect("a model");
    let t = model.load_distribution();
    assert_eq!(t.nrows(), model.structure().free_dof().len());
    assert_eq!(t.ncols(), model.mass().nrows());
}

#[test]
fn first_order_of_the_root_recursion_needs_the_shapes_transposed() {
    // (7) and (C.22) print Σ β_ij p_ij in the root; the row of mode i of (C.16) has β_ij p_ji, j ≠ i.
    let (k, beta) = change();
    let exact = exact(&k, &beta).expect("solved");
    let ours = converged(&k, &beta);
    let p = &ours.shapes;
    let root = |sum: f64, i: usize| {
        let lambda = 1.0 / k[i];
        lambda - (beta[(i, i)] * lambda + ours.roots[i] * sum) / (k[i] + beta[(i, i)])
    };
    let (mut worst_ours, mut worst_printed) = (0.0_f64, 0.0_f64);
    for i in 0..9 {
        let others = (0..9).filter(|&j| j != i);
        let transposed: f64 = others.clone().map(|j| beta[(i, j)] * p[(j, i)]).sum();
        let printed: f64 = others.map(|j| beta[(i, j)] * p[(i, j)]).sum();
        worst_ours = worst_ours.max((root(transposed, i) / exact.roots[i] - 1.0).abs());
        worst_printed = worst_printed.max((root(printed, i) / exact.roots[i] - 1.0).abs());
    }
    assert!(worst_ours < EIGEN_ROUND_OFF, "{worst_ours}");
    assert!(worst_printed > 1e4 * EIGEN_ROUND_OFF, "{worst_printed}");
}

#[test]
fn root_recursion_carries_the_changed_root_not_the_old_one() {
    // (7) prints λ_i before the sum over the other modes; with it the converged root is not exact.
    let (k, beta) = change();
    let exact = exact(&k, &beta).expect("solved");
    let p = converged(&k, &beta).shapes;
    let mut worst = 0.0_f64;
    for i in 0..9 {
        let lambda = 1.0 / k[i];
        let sum: f64 = (0..9).filter(|&j| j != i).map(|j| beta[(i, j)] * p[(j, i)]).sum();
        let printed = lambda - (beta[(i, i)] * lambda + lambda * sum) / (k[i] + beta[(i, i)]);
        worst = worst.max((printed / exact.roots[i] - 1.0).abs());
    }
    assert!(worst > 1e4 * EIGEN_ROUND_OFF, "{worst}");
}

#[test]
fn shape_recursion_divides_by_the_denominator_with_a_minus_sign() {
    // The second line of (C.22) loses the minus sign and inverts a bracket it already divides by; (8) has it right.
    let (k, beta) = change();
    let exact = exact(&k, &beta).expect("solved");
    let ours = converged(&k, &beta);
    assert!((&ours.shapes - &exact.shapes).amax() < 1e3 * EIGEN_ROUND_OFF);
    let (mut agree, mut turned) = (0.0_f64, 0.0_f64);
    for j in 0..9 {
        for i in (0..9).filter(|&i| i != j) {
            let sum: f64 = (0..9).filter(|&s| s != i && s != j).map(|s| beta[(i, s)] * ours.shapes[(s, j)]).sum();
            let p = -(beta[(i, j)] + sum) / (k[i] + beta[(i, i)] - 1.0 / ours.roots[j]);
            agree = agree.max((p - exact.shapes[(i, j)]).abs());
            turned = turned.max((-p - exact.shapes[(i, j)]).abs());
        }
    }
    assert!(agree < 1e3 * EIGEN_ROUND_OFF && turned > 0.001, "{agree} {turned}");
}

#[test]
fn explicit_root_sums_over_its_own_mode_too() {
    // (C.24): with j = i left out of the sum the second-order root misses the first-order change.
    let (k, beta) = change();
    let exact = exact(&k, &beta).expect("solved");
    let (mut with, mut without) = (0.0_f64, 0.0_f64);
    for i in 0..9 {
        let sum: f64 = (0..9).map(|j| beta[(i, j)] * exact.shapes[(j, i)]).sum();
        let root = |s: f64| 1.0 / k[i] - s / k[i] / (k[i] + s);
        with = with.max((root(sum) / exact.roots[i] - 1.0).abs());
        without = without.max((root(sum - beta[(i, i)]) / exact.roots[i] - 1.0).abs());
    }
    assert!(with < EIGEN_ROUND_OFF && without > 0.01, "{with} {without}");
}

#[test]
fn frequency_error_is_relative() {
    // Table 3's initial errors in percent have the SRSS the text prints, 0.3828; differences in hertz do not.
    let table = PublishedTable::number(3).expect("it reads");
    let (mut relative, mut absolute) = (0.0, 0.0);
    for mode in 1..=9 {
        let row = mode.to_string();
        let percent = table.required(&row, "initial_percent").expect("printed");
        let difference =
            table.required(&row, "initial_hz").expect("printed") - table.required(&row, "gvt_hz").expect("printed");
        relative += (percent / 100.0_f64).powi(2);
        absolute += difference * difference;
    }
    assert!((relative.sqrt() - 0.3828).abs() < PRINTED_SRSS, "{}", relative.sqrt());
    assert!(absolute.sqrt() > 1.0);
}

#[test]
fn printed_step_is_the_change_of_the_factor_not_the_factor() {
    // (13) prints c = R e_S Δe/Δk. On Case 2, 50 % too stiff throughout, that factor is near zero, below its own bound,
    // for every element; one minus it is a factor.
    let problem = first_problem(2);
    let state = ModalState::start(&problem);
    let errors = by_definition(&problem, &state).expect("separate modes");
    let stiffness = stiffness_changes(&problem, &[1.0; 15], &[1.0; 15], &errors, StepRule::Own);
    let error_sum = state.errors.sum();
    let factors = unlimited_factors(&errors, &stiffness, error_sum, 0.8);
    let e_s_after = |factors: Vec<f64>| {
        let state = ModalState::at(&problem, factors, UpdateRule::default());
        state.map_or(f64::INFINITY, |state| state.errors.sum())
    };
    assert!(e_s_after(factors.clone()) < error_sum);
    let printed: Vec<f64> = factors.iter().map(|factor| 1.0 - factor).collect();
    assert!(printed.iter().all(|&factor| factor < 0.55), "{printed:?}");
    assert!(e_s_after(printed) > error_sum);
}

#[test]
fn generalized_matrices_obey_g_equals_k_lambda() {
    // The line before (C.13) prints k = gΛ; from (C.12) it is g = kΛ, and with g = I that makes k = 1/λ = ω².
    let problem = first_problem(1);
    let model = Case::new(1).expect("a case").model().expect("a model");
    let dynamic = model.matrices(&[1.0; 15]).expect("held");
    let v = &problem.exact.modes.shapes;
    let (k, g) = (v.tr_mul(&(&dynamic.stiffness * v)), v.tr_mul(&(&dynamic.mass * v)));
    for i in 0..9 {
        let lambda = 1.0 / problem.exact.modes.omega_squared[i];
        assert_relative_eq!(g[(i, i)], k[(i, i)] * lambda, max_relative = MATRIX_ROUND_OFF);
        assert!((k[(i, i)] / (g[(i, i)] * lambda) - 1.0).abs() > 0.5);
    }
}
