//! The modal model: what the loops are handed, and the state they make of factors.

use crate::prelude::*;

properties! {
    #[test]
    fn generalized_shares_sum_to_the_generalized_stiffness((chain, truth) in chain_and_truth()) {
        let problem = chain_problem(&chain, &truth);
        prop_assert_eq!(problem.shares().len(), truth.len());
        let sum: DMatrix<f64> = problem.shares().iter().sum();
        let expected = DMatrix::from_diagonal(problem.exact().modes.omega_squared());
        let error = (sum - &expected).amax();
        prop_assert!(error <= MATRIX_ROUND_OFF * expected.amax(), "{error:e}");
    }

    #[test]
    fn generalized_shares_are_those_of_the_start_modes((chain, truth) in chain_and_truth()) {
        let problem = chain_problem(&chain, &truth);
        let model = chain.model(&vec![1.0; truth.len()]);
        for (share, generalized) in model.shares.iter().zip(problem.shares()) {
            let v = problem.exact().modes.shapes();
            let expected = v.transpose() * share * v;
            prop_assert!((generalized - &expected).amax() <= MATRIX_ROUND_OFF * expected.amax());
        }
    }

    #[test]
    fn relative_test_shares_sum_to_the_identity_at_the_truth((chain, truth) in chain_and_truth()) {
        // Σ_e V_G^t K_e V_G is diag(ω_G²) on the structure that was tested, so that the relative shares sum to the identity.
        let count = truth.len();
        let test = chain.modes(&truth);
        let problem = chain.model(&truth).analyze(&test, Some(count))?;
        let sum: DMatrix<f64> = problem.test_shares().iter().sum();
        let error = (&sum - eye(count)).amax();
        prop_assert!(error <= MATRIX_ROUND_OFF, "{error:e}");
    }

    #[test]
    fn the_start_state_is_the_last_exact_solution((chain, truth) in chain_and_truth()) {
        let problem = chain_problem(&chain, &truth);
        let (state, ones) = (problem.exact(), vec![1.0; truth.len()]);
        prop_assert_eq!(&state.share_factors, &ones);
        prop_assert_eq!(&state.modes, &chain.modes(&ones));
        prop_assert_eq!(&state.generalized_shapes, &eye(truth.len()));
        // One is a factor like any other.
        let same = problem.at(&ones)?;
        prop_assert_eq!(&same.share_factors, &ones);
        prop_assert!((same.errors.sum() - state.errors.sum()).abs() <= ROUND_OFF);
        prop_assert_eq!(same.pairing, state.pairing.clone());
    }

    #[test]
    fn the_state_is_the_exact_solution_at_its_factors(
        (chain, truth) in chain_and_truth(),
        factors in prop::collection::vec(0.9..1.1_f64, 5),
    ) {
        // All the way round: perturbation in modal coordinates against an eigensolution of the physical matrices.
        let count = truth.len();
        let factors = &factors[..count];
        let problem = chain_problem(&chain, &truth);
        let model = chain.model(factors);
        let expected = error_sum_by_definition(&model.stiffness, &model.mass, &chain.modes(&truth));
        let changes = problem.shares().iter().zip(factors).map(|(share, factor)| (factor - 1.0) * share);
        let recursion = recursive_1_converged(problem.exact().modes.omega_squared(), &changes.sum());
        let mut states = vec![("eigensolution", exact_state(&problem, factors)?)];
        // Where roots are close the recursion gains little an order, and sixty may not be enough for every digit.
        if recursion.is_ok_and(|it| it.order < MOST_ORDERS) {
            states.push(("Recursive 1", problem.at(factors)?));
        }
        for (rule, State { share_factors: found, modes, generalized_shapes, errors, .. }) in states {
            prop_assert_eq!(found, factors);
            prop_assert!((errors.sum() - expected).abs() <= CONVERGED_STATE, "{rule}");
            let v = modes.shapes();
            prop_assert_eq!(v.shape(), (count, count));
            let mass = v.tr_mul(&(&model.mass * v));
            prop_assert!((mass - eye(count)).amax() <= CONVERGED_STATE);
            let stiffness = v.tr_mul(&(&model.stiffness * v));
            let diagonal = DMatrix::from_diagonal(modes.omega_squared());
            prop_assert!((stiffness - &diagonal).amax() <= CONVERGED_STATE * diagonal.amax());
            let from_exact = problem.exact().modes.shapes() * generalized_shapes;
            prop_assert!((from_exact - v).amax() <= MATRIX_ROUND_OFF * v.amax());
        }
    }
}

properties! {
    #![proptest_config(costly_config())]

    #[test]
    fn shares_of_the_box_leave_the_rods_out(case in uneven_box()) {
        // The parameters are the panels; what the nine modes have beyond them is the rods' stiffness.
        let problem = problem_of(&case);
        let panels: DMatrix<f64> = problem.shares().iter().sum();
        let rods = DMatrix::from_diagonal(problem.exact().modes.omega_squared()) - panels;
        let lowest = rods.symmetric_eigenvalues().min();
        prop_assert!(lowest >= -MATRIX_ROUND_OFF * problem.exact().modes.omega_squared().amax());
    }
}

#[test]
fn fewer_analysis_modes_are_the_lowest_ones() {
    let chain = Chain::uniform(5);
    let test = chain.modes(&[1.2; 5]).lowest(2).unwrap();
    let all = chain.model(&[1.0; 5]).analyze(&test, Some(5)).unwrap();
    let some = chain.model(&[1.0; 5]).analyze(&test, Some(3)).unwrap();
    assert_eq!(some.exact().modes, all.exact().modes.lowest(3).unwrap());
    assert_eq!(some.cross().shape(), (3, 2));
    assert_eq!(some.test_shares().len(), 5);
    assert_eq!(some.test_shares()[0].shape(), (2, 2));
    assert_eq!(some.shares()[0].shape(), (3, 3));
    assert_eq!(some.exact().generalized_shapes.shape(), (3, 3));
}

#[test]
fn the_problem_of_case_1_has_its_errors() {
    let problem = first_problem(1);
    let errors = problem.exact().errors;
    // Initial RMS errors of the reconstructed box, 12.1 and 7.56 % (published 12.76 and 7.67 %).
    assert_within(errors.frequency_rms(), 0.1211, PRINTED_RMS);
    assert_within(errors.shape_rms(), 0.0756, PRINTED_RMS);
}

#[test]
fn problems_that_do_not_fit_are_refused() {
    let chain = Chain::uniform(3);
    let (model, test) = (chain.model(&[1.0; 3]), chain.modes(&[1.0; 3]));
    let new = |change: &dyn Fn(&mut DynamicModel)| {
        let mut model = model.clone();
        change(&mut model);
        model.analyze(&test, Some(3))
    };
    assert_refused(
        new(&|model| model.shares[1] = eye(2)),
        Error::WrongShape {
            what: "parameter share",
            expected_rows: 3,
            expected_columns: 3,
            rows: 2,
            columns: 2,
        },
    );
    assert_refused(
        new(&|model| model.shares[2] = dmatrix![1.0, 0.0, 0.0; 2.0, 1.0, 0.0; 0.0, 0.0, 1.0]),
        Error::Value {
            what: "relative asymmetry",
            owner: "parameter share".into(),
            value: 1.0,
            expected: "at most 1e-8",
        },
    );
    assert_refused(
        new(&|model| model.mass[(1, 1)] = 0.0),
        Error::NotPositiveDefinite {
            what: "dynamic mass",
            row: 1,
        },
    );
    assert_refused(
        model.analyze(&test, Some(2)),
        Error::Count {
            what: "test modes",
            found: 3,
            least: 1,
            most: 2,
        },
    );
    let at_four = Modes::new(test.omega_squared().clone(), DMatrix::identity(4, 3));
    assert_refused(
        model.analyze(&at_four.unwrap(), Some(3)),
        Error::WrongShape {
            what: "test mode shapes",
            expected_rows: 3,
            expected_columns: 3,
            rows: 4,
            columns: 3,
        },
    );
}

/// A model of which nothing may change has its exact modes and no derivatives.
#[test]
fn a_model_without_parameters_has_nothing_to_change() {
    let chain = Chain::uniform(3);
    let mut model = chain.model(&[1.0; 3]);
    model.shares.clear();
    let fixed = model.analyze(&chain.modes(&[1.1; 3]), None).unwrap();
    assert!(fixed.error_changes(fixed.exact()).unwrap().is_empty());
    let same = fixed.at(&[]).unwrap();
    assert_within(same.errors.sum(), fixed.exact().errors.sum(), ROUND_OFF);
}

#[test]
fn there_is_one_factor_a_parameter() {
    let chain = Chain::uniform(3);
    let problem = chain_problem(&chain, &[1.1; 3]);
    for factors in [vec![1.0; 2], vec![1.0; 4]] {
        let found = factors.len();
        assert_refused(
            problem.at(&factors),
            Error::WrongShape {
                what: "parameter factors",
                expected_rows: 3,
                expected_columns: 1,
                rows: found,
                columns: 1,
            },
        );
    }
    assert_refused(
        problem.at(&[1.0, f64::NAN, 1.0]),
        Error::Value {
            what: "generalized stiffness change",
            owner: "entry (0, 0)".into(),
            value: f64::NAN,
            expected: "a finite number",
        },
    );
}

/// Test modes of any scale and sign give the same model: pairing, errors and everything the loops use.
#[test]
fn the_scale_of_the_test_shapes_does_not_matter() {
    let case = case_of(2);
    let model = case.model().unwrap();
    let test = case.test_modes().unwrap();
    let mut rescaled = test.clone();
    alter(&mut rescaled, |_, shapes| {
        for (mode, mut shape) in shapes.column_iter_mut().enumerate() {
            shape *= (-3.7_f64).powi(mode as i32 - 4);
        }
    });
    let (one, other) = (
        model.analyze(&[1.0; 15], &test, None).unwrap(),
        model.analyze(&[1.0; 15], &rescaled, None).unwrap(),
    );
    assert_eq!(
        one.exact().pairing.analysis_mode,
        other.exact().pairing.analysis_mode
    );
    assert_within(
        one.exact().errors.sum(),
        other.exact().errors.sum(),
        ROUND_OFF,
    );
    for (a, b) in one.test_shares().iter().zip(other.test_shares()) {
        assert!((a.diagonal() - b.diagonal()).amax() <= MATRIX_ROUND_OFF);
    }
}

properties! {
    #[test]
    fn no_scale_or_sign_of_a_test_shape_changes_pairing_errors_or_shares(
        (chain, truth) in chain_and_truth(),
        scales in prop::collection::vec(prop_oneof![-1e6..-1e-6_f64, 1e-6..1e6_f64], 5),
    ) {
        let model = chain.model(&vec![1.0; truth.len()]);
        let test = chain.modes(&truth);
        let mut scaled = test.clone();
        alter(&mut scaled, |_, shapes| shapes.column_iter_mut().zip(&scales).for_each(|(mut shape, scale)| shape *= *scale));
        let (one, other) = (model.analyze(&test, None)?, model.analyze(&scaled, None)?);
        prop_assert_eq!(&one.exact().pairing.analysis_mode, &other.exact().pairing.analysis_mode);
        prop_assert!((one.exact().errors.sum() - other.exact().errors.sum()).abs() <= MATRIX_ROUND_OFF);
        for ((a, b), scale) in one.exact().pairing.sign.iter().zip(&other.exact().pairing.sign).zip(&scales) {
            prop_assert_eq!(a * scale.signum(), *b);
        }
        for (a, b) in one.test_shares().iter().zip(other.test_shares()) {
            prop_assert!(relative_error(a.norm(), b.norm()) <= MATRIX_ROUND_OFF);
        }
    }
}
