//! The modal problem: what an inner loop keeps of the last exact solution, and the state it makes of factors.

use crate::common::boxes::{first_problem, problem_of, uneven_box};
use crate::common::tolerances::{CONVERGED_STATE, MATRIX_ROUND_OFF, PRINTED_RMS, ROUND_OFF};
use crate::common::vibrations::{Chain, chain_and_truth, error_sum_by_definition};
use corfem::method::appendix_c::UpdateRule;
use corfem::method::error::Error;
use corfem::method::modal::{DynamicModel, ModalProblem, Share};
use corfem::method::modes::Modes;
use nalgebra::{DMatrix, dmatrix};
use proptest::prelude::*;

/// The problem of a chain with all its modes.
fn problem(chain: &Chain, truth: &[f64]) -> ModalProblem {
    let count = truth.len();
    ModalProblem::new(&chain.model(&vec![1.0; count]), &chain.modes(truth), count).unwrap()
}

proptest! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn generalized_shares_sum_to_the_generalized_stiffness((chain, truth) in chain_and_truth()) {
        let problem = problem(&chain, &truth);
        prop_assert_eq!(problem.parameter_count(), truth.len());
        prop_assert_eq!(problem.generalized_shares.len(), truth.len());
        let sum: DMatrix<f64> = problem.generalized_shares.iter().map(Share::matrix).sum();
        let expected = DMatrix::from_diagonal(&problem.start.omega_squared);
        let error = (sum - &expected).amax();
        prop_assert!(error <= MATRIX_ROUND_OFF * expected.amax(), "{error:e}");
    }

    #[test]
    fn generalized_shares_are_those_of_the_start_modes((chain, truth) in chain_and_truth()) {
        let problem = problem(&chain, &truth);
        let model = chain.model(&vec![1.0; truth.len()]);
        for (share, generalized) in model.shares.iter().zip(&problem.generalized_shares) {
            let v = &problem.start.shapes;
            let expected = v.transpose() * share.matrix() * v;
            prop_assert!((generalized.matrix() - &expected).amax() <= MATRIX_ROUND_OFF * expected.amax());
        }
    }

    #[test]
    fn relative_test_shares_sums_to_one_at_the_truth((chain, truth) in chain_and_truth()) {
        // Σ_e V_G^t K_e V_G is ω_G² on the structure that was tested, so that the relative shares sum to one there.
        let count = truth.len();
        let test = chain.modes(&truth);
        let problem = ModalProblem::new(&chain.model(&truth), &test, count).unwrap();
        prop_assert_eq!(problem.test_shares.shape(), (count, count));
        for mode in 0..count {
            let sum = problem.test_shares.row(mode).sum();
            prop_assert!((sum - 1.0).abs() <= MATRIX_ROUND_OFF, "{sum}");
        }
    }

    #[test]
    fn the_start_state_is_the_last_exact_solution((chain, truth) in chain_and_truth()) {
        let problem = problem(&chain, &truth);
        let state = problem.start_state().unwrap();
        prop_assert_eq!(&state.factors, &vec![1.0; truth.len()]);
        prop_assert_eq!(&state.modes, &problem.start);
        prop_assert_eq!(&state.generalized_shapes, &DMatrix::identity(truth.len(), truth.len()));
        // One is a factor like any other.
        let same = problem.state_at(state.factors.clone(), UpdateRule::default()).unwrap();
        prop_assert!((same.errors.sum() - state.errors.sum()).abs() <= ROUND_OFF);
        prop_assert_eq!(same.pairing, state.pairing);
    }

    #[test]
    fn the_state_is_the_exact_solution_at_its_factors(
        (chain, truth) in chain_and_truth(),
        factors in prop::collection::vec(0.9..1.1_f64, 5),
    ) {
        // All the way round: perturbation in modal coordinates against an eigensolution of the physical matrices.
        let count = truth.len();
        let factors = &factors[..count];
        let problem = problem(&chain, &truth);
        let model = chain.model(factors);
        let expected = error_sum_by_definition(&model.stiffness, &model.mass, &problem.test);
        // Where roots are close the recursion gains little an order: the usual 60 are a cap, not a promise.
        let patient = UpdateRule::Recursive1Converged { tolerance: 1e-13, orders: 3000 };
        for rule in [UpdateRule::Eigensolution, patient] {
            let state = problem.state_at(factors.to_vec(), rule).unwrap();
            prop_assert_eq!(&state.factors[..], factors);
            prop_assert!((state.errors.sum() - expected).abs() <= CONVERGED_STATE, "{rule:?}");
            let v = &state.modes.shapes;
            prop_assert_eq!(v.shape(), (count, count));
            let mass = v.tr_mul(&(&model.mass * v));
            prop_assert!((mass - DMatrix::identity(count, count)).amax() <= CONVERGED_STATE);
            let stiffness = v.tr_mul(&(&model.stiffness * v));
            let diagonal = DMatrix::from_diagonal(&state.modes.omega_squared);
            prop_assert!((stiffness - &diagonal).amax() <= CONVERGED_STATE * diagonal.amax());
            let g = &state.generalized_shapes;
            prop_assert!((&problem.start.shapes * g - v).amax() <= MATRIX_ROUND_OFF * v.amax());
        }
    }

    #[test]
    fn a_common_factor_scales_frequencies_and_keeps_shapes(
        (chain, truth) in chain_and_truth(),
        factor in 0.5..1.5_f64,
    ) {
        let problem = problem(&chain, &truth);
        let state = problem.state_at(vec![factor; truth.len()], UpdateRule::default()).unwrap();
        let expected = factor * &problem.start.omega_squared;
        let error = (&state.modes.omega_squared - &expected).amax();
        prop_assert!(error <= MATRIX_ROUND_OFF * expected.amax(), "{error:e}");
        let shapes = (&state.modes.shapes - &problem.start.shapes).amax();
        prop_assert!(shapes <= MATRIX_ROUND_OFF * problem.start.shapes.amax(), "{shapes:e}");
    }
}

proptest! {
    #![proptest_config(crate::common::costly_config())]

    #[test]
    fn shares_of_the_box_leave_the_rods_out(case in uneven_box()) {
        // The parameters are the panels; what the nine modes have beyond them is the rods' stiffness.
        let problem = problem_of(&case);
        let panels: DMatrix<f64> = problem.generalized_shares.iter().map(Share::matrix).sum();
        let rods = DMatrix::from_diagonal(&problem.start.omega_squared) - panels;
        let lowest = rods.symmetric_eigenvalues().min();
        prop_assert!(lowest >= -MATRIX_ROUND_OFF * problem.start.omega_squared.amax());
    }
}

/// What the last order still changed tells how far the roots are from the exact ones.
#[test]
fn the_state_says_how_far_its_recursion_had_to_go() {
    let chain = Chain::uniform(4);
    let problem = problem(&chain, &[1.2; 4]);
    let factors = vec![1.3, 0.9, 1.1, 0.8];
    let state = |rule| problem.state_at(factors.clone(), rule).unwrap();
    let exact = state(UpdateRule::Eigensolution);
    assert_eq!(exact.last_change, 0.0);
    assert_eq!(problem.start_state().unwrap().last_change, 0.0);
    let mut last = f64::INFINITY;
    for order in [2, 4, 8, 16] {
        let found = state(UpdateRule::Recursive1 { order });
        let ratios = found
            .modes
            .omega_squared
            .component_div(&exact.modes.omega_squared);
        let error = ratios.add_scalar(-1.0).amax();
        // The next orders change the roots less, together by no more than twice as much.
        assert!(error < 2.0 * found.last_change, "{order}: {error:e}");
        assert!(
            found.last_change < 0.5 * last,
            "{order}: {:e}",
            found.last_change
        );
        last = found.last_change;
    }
}

#[test]
fn fewer_analysis_modes_are_the_lowest_ones() {
    let chain = Chain::uniform(5);
    let test = chain.modes(&[1.2; 5]).lowest(2).unwrap();
    let all = ModalProblem::new(&chain.model(&[1.0; 5]), &test, 5).unwrap();
    let some = ModalProblem::new(&chain.model(&[1.0; 5]), &test, 3).unwrap();
    assert_eq!(some.start, all.start.lowest(3).unwrap());
    assert_eq!(some.start_cross.shape(), (3, 2));
    assert_eq!(some.test_shares.shape(), (2, 5));
    assert_eq!(some.generalized_shares[0].matrix().shape(), (3, 3));
    assert_eq!(
        some.start_state().unwrap().generalized_shapes.shape(),
        (3, 3)
    );
}

#[test]
fn the_problem_of_case_1_has_its_errors() {
    let state = first_problem(1).start_state().unwrap();
    // Initial RMS errors of the reconstructed box, 12.1 and 7.56 % (published 12.76 and 7.67 %).
    assert!((state.errors.frequency_rms() - 0.1211).abs() < PRINTED_RMS);
    assert!((state.errors.shape_rms() - 0.0756).abs() < PRINTED_RMS);
}

#[test]
fn problems_that_do_not_fit_are_refused() {
    let chain = Chain::uniform(3);
    let (model, test) = (chain.model(&[1.0; 3]), chain.modes(&[1.0; 3]));
    let new = |change: &dyn Fn(&mut DynamicModel)| {
        let mut model = model.clone();
        change(&mut model);
        ModalProblem::new(&model, &test, 3)
    };
    assert!(matches!(
        new(&|model| model.shares.clear()),
        Err(Error::Empty { what: "parameters" })
    ));
    assert!(matches!(
        new(&|model| model.shares[1] = Share::Stiffness(DMatrix::identity(2, 2))),
        Err(Error::WrongShape {
            what: "parameter share",
            expected_rows: 3,
            expected_columns: 3,
            rows: 2,
            columns: 2
        })
    ));
    assert!(matches!(
        new(&|model| model.shares[2] =
            Share::Stiffness(dmatrix![1.0, 0.0, 0.0; 2.0, 1.0, 0.0; 0.0, 0.0, 1.0])),
        Err(Error::NotSymmetric {
            what: "parameter share",
            row: 1,
            column: 0,
            ..
        })
    ));
    assert!(matches!(
        new(&|model| model.mass[(1, 1)] = 0.0),
        Err(Error::NotPositiveDefinite {
            what: "dynamic mass",
            dof: 1
        })
    ));
    assert!(matches!(
        ModalProblem::new(&model, &test, 2),
        Err(Error::TooMany {
            what: "test modes",
            available: 2,
            requested: 3
        })
    ));
    let other = Modes {
        shapes: DMatrix::identity(4, 3),
        ..test.clone()
    };
    assert!(matches!(
        ModalProblem::new(&model, &other, 3),
        Err(Error::WrongShape {
            what: "test mode shapes",
            expected_rows: 3,
            rows: 4,
            ..
        })
    ));
}

#[test]
fn there_is_one_factor_a_parameter() {
    let chain = Chain::uniform(3);
    let problem = problem(&chain, &[1.1; 3]);
    for factors in [vec![1.0; 2], vec![1.0; 4]] {
        let found = factors.len();
        match problem.state_at(factors, UpdateRule::default()) {
            Err(Error::WrongShape {
                what,
                expected_rows,
                expected_columns,
                rows,
                columns,
            }) => assert_eq!(
                (what, expected_rows, expected_columns, rows, columns),
                ("parameter factors", 3, 1, found, 1)
            ),
            other => panic!("{other:?}"),
        }
    }
    assert!(matches!(
        problem.state_at(vec![1.0, f64::NAN, 1.0], UpdateRule::default()),
        Err(Error::NotFinite {
            what: "generalized stiffness change",
            ..
        })
    ));
}
