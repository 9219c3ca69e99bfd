//! `paper/errata.md` for the text and Appendices A and B; Appendix C is in `errata_appendix_c.rs`.
//!
//! Each test takes a form literally and shows what is wrong with it, or that it is right.

use crate::common::appendix_c::three_mass_chain;
use crate::common::boxes::first_problem;
use crate::common::tolerances::{
    EIGEN_ROUND_OFF, MATRIX_ROUND_OFF, PRINTED_SRSS, ROUND_OFF, WRONG_FORM,
};
use approx::assert_relative_eq;
use corfem::method::appendix_a::{Condensed, condense};
use corfem::method::appendix_b::{generalized_mass, orthogonalize};
use corfem::method::derivatives::by_definition;
use corfem::method::modes::ModeSet;
use corfem::method::state::{ModalState, UpdateRule};
use corfem::method::step::{StepRule, stiffness_changes, unlimited_factors};
use corfem::torque_box::Case;
use corfem::torque_box::published::PublishedTable;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use std::f64::consts::PI;

fn condensed(stiffness: &DMatrix<f64>, t: &DMatrix<f64>) -> Condensed {
    condense(stiffness, t).expect("independent")
}

#[test]
fn root_is_the_reciprocal_of_the_squared_circular_frequency() {
    // (10), f = (λ + Δλ)^(−1/2)/2π, agrees with (Kλ − M)v = 0; the line that calls λ = ω² does not.
    let problem = first_problem(1);
    let lambda = problem.exact().modes.omega_squared().map(f64::recip);
    for (root, frequency) in lambda.iter().zip(problem.exact().modes.frequencies_hz()) {
        assert_relative_eq!(
            root.powf(-0.5) / (2.0 * PI),
            frequency,
            max_relative = EIGEN_ROUND_OFF
        );
        let as_printed = (2.0 * PI * frequency).powi(2);
        assert!((as_printed.powf(-0.5) / (2.0 * PI) / frequency - 1.0).abs() > 0.9);
    }
}

#[test]
fn transformation_of_2_is_right_as_printed() {
    // (2) prints B = K_D Tᵗ K_S⁻¹: the transpose of (A.7) and (A.8) with T there, for K_S and K_D are symmetric.
    let stiffness = three_mass_chain([1.0, 2.0, 0.5], [1.0, 1.0, 3.0]);
    let t = dmatrix![1.0, 0.5; 0.0, 1.0; 0.25, 0.0];
    let condensed = condensed(&stiffness, &t);
    let printed = &condensed.stiffness * t.transpose() * stiffness.try_inverse().expect("held");
    assert!((printed.transpose() - condensed.transformation).amax() < MATRIX_ROUND_OFF);
}

#[test]
fn print_of_a_7_and_a_8_has_a_transpose_too_many() {
    // (A.7), (A.8) print Bᵗ = K_S⁻¹ Tᵗ K_D, where Tᵗ has not as many rows as K_S.
    let model = Case::new(1).expect("a case").model().expect("a model");
    let t = &model.load_distribution().clone();
    assert_eq!(t.nrows(), model.structure().free_dof().len());
    assert_ne!(t.transpose().nrows(), t.nrows());
    // Where it has as many, the product exists and is not the inverse of q_D = Tᵗ q_S (A.4), as q_S = Bᵗ q_D has to be.
    let stiffness = three_mass_chain([1.0, 2.0, 0.5], [1.0, 1.0, 3.0]);
    let t = dmatrix![1.0, 0.5, 0.0; 0.0, 1.0, 0.0; 0.25, 0.0, 1.0];
    let condensed = condensed(&stiffness, &t);
    let there_and_back = |b: &DMatrix<f64>| (t.tr_mul(b) - DMatrix::identity(3, 3)).amax();
    let printed = stiffness.try_inverse().expect("held") * t.transpose() * &condensed.stiffness;
    assert!(there_and_back(&condensed.transformation) < MATRIX_ROUND_OFF);
    assert!(there_and_back(&printed) > WRONG_FORM);
}

#[test]
fn roots_of_b_7_are_squared_circular_frequencies() {
    // (B.7): q = ω² λ⁻¹ D⁻¹ m₁ q, D the diagonal of m₁. With λ_i = ω_Gi² the new modes satisfy it; with the λ = 1/ω² of
    // (10) and (C.1) they do not, and not even one mode alone would, whose frequency nothing changes.
    let raw = ModeSet::new(dvector![100.0, 400.0], dmatrix![2.0, 0.3; 0.0, 1.0]).expect("modes");
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
    let alone = ModeSet::new(dvector![100.0], dmatrix![2.0; 0.0]).expect("modes");
    let omega_squared = orthogonalize(&alone, &mass)
        .expect("one shape")
        .modes
        .omega_squared()[0];
    assert_relative_eq!(omega_squared, 100.0, max_relative = ROUND_OFF);
}

#[test]
fn frequency_error_is_relative() {
    // Table 3's initial errors in percent have the SRSS the text prints, 0.3828; differences in hertz do not.
    let table = PublishedTable::number(3).expect("it reads");
    let (mut relative, mut absolute) = (0.0, 0.0);
    for mode in 1..=9 {
        let row = mode.to_string();
        let percent = table.required(&row, "initial_percent").expect("printed");
        let difference = table.required(&row, "initial_hz").expect("printed")
            - table.required(&row, "gvt_hz").expect("printed");
        relative += (percent / 100.0_f64).powi(2);
        absolute += difference * difference;
    }
    assert!(
        (relative.sqrt() - 0.3828).abs() < PRINTED_SRSS,
        "{}",
        relative.sqrt()
    );
    assert!(
        (97.0..98.0).contains(&absolute.sqrt()),
        "{}",
        absolute.sqrt()
    );
}

#[test]
fn printed_step_is_the_change_of_the_factor_not_the_factor() {
    // (13) prints c = R e_S Δe/Δk. On Case 2, 50 % too stiff throughout, that factor is near zero, below its own bound,
    // for every element; one minus it is a factor.
    let problem = first_problem(2);
    let state = ModalState::start(&problem);
    let errors = by_definition(&problem, &state).expect("separate modes");
    let stiffness = stiffness_changes(&problem, &[1.0; 15], &[1.0; 15], StepRule::Diagonal);
    let error_sum = state.errors().sum();
    let factors = unlimited_factors(&errors, &stiffness, error_sum, 0.8);
    let e_s_after = |factors: Vec<f64>| {
        let state = ModalState::at(&problem, factors, UpdateRule::default());
        state.map_or(f64::INFINITY, |state| state.errors().sum())
    };
    assert!(e_s_after(factors.clone()) < error_sum);
    let printed: Vec<f64> = factors.iter().map(|factor| 1.0 - factor).collect();
    assert!(printed.iter().all(|&factor| factor < 0.55), "{printed:?}");
    assert!(e_s_after(printed) > error_sum);
}
