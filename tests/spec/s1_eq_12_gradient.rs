//! The gradient of the error sum, the limit of the paper's difference (12), against exact differences.

use crate::common::boxes::first_problem;
use crate::common::counting_allocator::allocations;
use crate::common::log_log_slope;
use crate::common::tolerances::{
    CENTRAL_DIFFERENCE, CENTRAL_DIFFERENCE_GRADIENT, CONVERGED_STATE, DERIVATIVE_ROUND_OFF,
    ORDER_SLACK,
};
use crate::common::vibrations::{Chain, chain_and_truth};
use crate::spec::s1_eq_12_derivatives::{assert_near, exact_error_sum, with_one};
use crate::spec::s2_parameters_mass::both;
use corfem::method::appendix_c::SMALLEST_SEPARATION;
use corfem::method::derivatives::{
    DERIVATIVE_STEP, DerivativeRule, by_definition, error_changes, gradient,
};
use corfem::method::error::Error;
use corfem::method::error_sum::{ModeWeight, mode_errors};
use corfem::method::model::{DynamicModel, ModalModel, ParameterMatrix};
use corfem::method::modes::ModeSet;
use corfem::method::modes::solve;
use corfem::method::state::{ModalState, UpdateRule};
use corfem::torque_box::Case;
use nalgebra::{DMatrix, dmatrix};
use proptest::prelude::*;

properties! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn the_gradient_is_a_central_difference_of_exact_solutions(
        (chain, truth) in chain_and_truth(),
        factors in prop::collection::vec(0.95..1.05_f64, 5),
    ) {
        let count = truth.len();
        let problem = chain.model(&vec![1.0; count]).analyze(&chain.modes(&truth), None).unwrap();
        let state = ModalState::at(&problem, factors[..count].to_vec(), UpdateRule::Eigensolution).unwrap();
        let h = 1e-6;
        for (e, slope) in gradient(&problem, &state).unwrap().iter().enumerate() {
            let at = |by: f64| {
                ModalState::at(&problem, with_one(state.factors(), e, by), UpdateRule::Eigensolution).unwrap()
            };
            let (ahead, behind) = (at(1.0 + h), at(1.0 - h));
            prop_assume!(ahead.pairing() == state.pairing() && behind.pairing() == state.pairing());
            let (ahead, behind) = (ahead.errors().sum(), behind.errors().sum());
            // A second difference this large is a kink of the error sum within the step.
            let kink = (ahead - 2.0 * state.errors().sum() + behind).abs();
            let difference = (slope * h - (ahead - behind) / 2.0).abs();
            prop_assert!(difference <= kink + DERIVATIVE_ROUND_OFF, "{e}: {difference:e} {kink:e}");
        }
    }
}

/// Errors of the box's test modes with weights from zero to two.
#[test]
fn the_gradient_of_weighted_errors_is_their_central_difference() {
    for problem in [first_problem(2), mass_problem()] {
        let weight = |mode: usize| ModeWeight {
            frequency: mode as f64 % 3.0,
            shape: (mode + 1) as f64 % 3.0,
        };
        let weights: Vec<ModeWeight> = (0..problem.test().len()).map(weight).collect();
        let of_modes = mode_errors(
            &problem.exact().modes,
            &problem.exact().pairing,
            problem.test(),
        )
        .unwrap();
        let both = of_modes.iter().zip(&weights);
        let frequency: f64 = both
            .clone()
            .map(|(error, weight)| (weight.frequency * error.frequency).powi(2))
            .sum();
        let shape: f64 = both
            .map(|(error, weight)| (weight.shape * error.shape.expect("a shape")).powi(2))
            .sum();
        let weighted = problem.clone().weighted(&weights).unwrap();
        assert_eq!(weighted.weights(), weights);
        assert_near(
            &[weighted.exact().errors.sum()],
            &[frequency.sqrt() + shape.sqrt()],
            CONVERGED_STATE,
        );
        let (state, h) = (ModalState::start(&weighted), 1e-5);
        let at = |e: usize, by: f64| exact_error_sum(&weighted, with_one(state.factors(), e, by));
        let central: Vec<f64> = (0..weighted.shares().len())
            .map(|e| (at(e, 1.0 + h) - at(e, 1.0 - h)) / (2.0 * h))
            .collect();
        let found = gradient(&weighted, &state).unwrap();
        assert_near(&found, &central, CENTRAL_DIFFERENCE_GRADIENT);
        assert_ne!(
            found,
            gradient(&problem, &ModalState::start(&problem)).unwrap()
        );
        let ones = problem
            .clone()
            .weighted(&vec![ModeWeight::ONE; weights.len()])
            .unwrap();
        assert_eq!(
            gradient(&ones, &state).unwrap(),
            gradient(&problem, &state).unwrap()
        );
        let wrong = |weight: ModeWeight| {
            problem
                .clone()
                .weighted(&vec![weight; weights.len()])
                .map(drop)
                .unwrap_err()
        };
        for (frequency, shape) in [
            (-1.0, 1.0),
            (1.0, f64::NAN),
            (f64::INFINITY, 1.0),
            (0.0, 0.0),
        ] {
            assert!(matches!(
                wrong(ModeWeight { frequency, shape }),
                Error::Setting { name: "weight", .. }
            ));
        }
        assert!(matches!(
            problem.clone().weighted(&weights[1..]),
            Err(Error::WrongShape { .. })
        ));
    }
}

/// A model with every share a part of what it was: a tenth of a share changed by 0.1 % is the share changed by 0.01 %.
fn with_smaller_shares((dynamic, test): &(DynamicModel, ModeSet), part: f64) -> ModalModel {
    let smaller = |share: &ParameterMatrix| share.map(|matrix| part * matrix);
    let shares = dynamic.shares.iter().map(smaller).collect();
    let dynamic = DynamicModel {
        shares,
        ..dynamic.clone()
    };
    dynamic.analyze(test, None).unwrap()
}

/// A case's matrices and its test modes.
fn matrices_of(number: usize) -> (DynamicModel, ModeSet) {
    let case = Case::new(number).unwrap();
    (
        case.model().unwrap().matrices(&[1.0; 15]).unwrap(),
        case.test_modes().unwrap().into(),
    )
}

#[test]
fn the_papers_difference_tends_to_the_gradient_with_slope_one() {
    let (masses, test) = both();
    let masses = (masses.matrices(&[1.0; 24]).unwrap(), test);
    for given in [matrices_of(1), matrices_of(2), matrices_of(3), masses] {
        let problem = with_smaller_shares(&given, 1.0);
        let state = ModalState::start(&problem);
        let exact = gradient(&problem, &state).unwrap();
        let points: Vec<(f64, f64)> = [1.0, 0.3, 0.1, 0.03]
            .into_iter()
            .map(|part| {
                let found = by_definition(&with_smaller_shares(&given, part), &state).unwrap();
                let off = found
                    .iter()
                    .zip(&exact)
                    .map(|(change, slope)| change / (part * DERIVATIVE_STEP) - slope);
                (part, off.map(|off| off * off).sum::<f64>().sqrt())
            })
            .collect();
        let slope = log_log_slope(&points);
        assert!((slope - 1.0).abs() <= ORDER_SLACK, "{slope}: {points:?}");
    }
}

/// The box with stiffnesses and point masses as parameters.
fn mass_problem() -> ModalModel {
    let (model, test) = both();
    model.analyze(&[1.0; 24], &test, None).unwrap()
}

#[test]
fn the_gradient_of_boxes_is_a_central_difference() {
    for problem in [
        first_problem(1),
        first_problem(2),
        first_problem(3),
        first_problem(4),
        mass_problem(),
    ] {
        let state = ModalState::start(&problem);
        let h = 1e-5;
        let at = |e: usize, by: f64| exact_error_sum(&problem, with_one(state.factors(), e, by));
        let central: Vec<f64> = (0..problem.shares().len())
            .map(|e| (at(e, 1.0 + h) - at(e, 1.0 - h)) / (2.0 * h))
            .collect();
        assert_near(
            &gradient(&problem, &state).unwrap(),
            &central,
            CENTRAL_DIFFERENCE_GRADIENT,
        );
    }
}

/// Two like oscillators, one stiffened: at equal roots the shapes have no derivative, but the roots have one.
#[test]
fn derivatives_at_repeated_roots_are_those_of_the_roots() {
    let stiffness = DMatrix::identity(2, 2) * 100.0;
    let first = dmatrix![100.0, 0.0; 0.0, 0.0];
    let coupled = dmatrix![50.0, 50.0; 50.0, 50.0];
    let model = DynamicModel {
        shares: vec![
            ParameterMatrix::Stiffness(first),
            ParameterMatrix::Stiffness(coupled),
        ],
        mass: DMatrix::identity(2, 2),
        stiffness,
    };
    let test = solve(&dmatrix![121.0, 0.0; 0.0, 144.0], &model.mass, 2).unwrap();
    let problem = model.analyze(&test, None).unwrap();
    let state = ModalState::start(&problem);
    // r = 1/1.1 - 1 and 1/1.2 - 1; d(ratio)/dc of a whole share is ratio/2, of half a share in each ratio/4.
    let (a, b) = (1.0 / 1.1 - 1.0, 1.0 / 1.2 - 1.0);
    let e_f = f64::hypot(a, b);
    let expected = [a / 1.1 / 2.0 / e_f, (a / 1.1 + b / 1.2) / 4.0 / e_f];
    assert_near(
        &gradient(&problem, &state).unwrap(),
        &expected,
        CONVERGED_STATE,
    );
    let found: Vec<f64> = by_definition(&problem, &state)
        .unwrap()
        .iter()
        .map(|change| change / DERIVATIVE_STEP)
        .collect();
    assert_near(&found, &expected, CENTRAL_DIFFERENCE);
}

#[test]
fn an_error_of_zero_has_no_slope() {
    // The frequencies agree and the shapes too: the error sum has a kink here, and no direction to go.
    let chain = Chain::uniform(1);
    let problem = chain
        .model(&[1.0])
        .analyze(&chain.modes(&[1.0]), None)
        .unwrap();
    let state = ModalState::start(&problem);
    assert_eq!(state.errors().sum(), 0.0);
    assert_eq!(gradient(&problem, &state).unwrap(), [0.0]);
}

#[test]
fn the_gradient_allocates_nothing_a_parameter() {
    let problem = first_problem(3);
    let state = ModalState::start(&problem);
    let (mut dynamic, test) = matrices_of(3);
    dynamic.shares.extend(dynamic.shares.clone());
    let twice = dynamic.analyze(&test, None).unwrap();
    let double = ModalState::start(&twice);
    let once = allocations(|| drop(gradient(&problem, &state).unwrap()));
    assert_eq!(
        allocations(|| drop(gradient(&twice, &double).unwrap())),
        once
    );
    // The counter counts.
    let mut kept = Vec::new();
    assert_eq!(allocations(|| kept.push(1_u8)), 1);
    assert_eq!(allocations(|| kept.reserve_exact(100)), 1);
}

#[test]
fn either_rule_gives_changes_for_a_thousandth() {
    let problem = first_problem(2);
    let state = ModalState::start(&problem);
    let changes = |rule| error_changes(&problem, &state, rule).unwrap();
    assert_eq!(
        changes(DerivativeRule::Definition),
        by_definition(&problem, &state).unwrap()
    );
    let slopes = gradient(&problem, &state).unwrap();
    for (change, slope) in changes(DerivativeRule::Gradient).iter().zip(slopes) {
        assert_eq!(*change, DERIVATIVE_STEP * slope);
    }
}

/// Roots that differ by round-off are one root, and their gradient is that of equal ones.
#[test]
fn roots_apart_by_round_off_count_as_equal() {
    let gradient_at = |apart: f64| {
        let first = ParameterMatrix::Stiffness(dmatrix![100.0, 0.0; 0.0, 0.0]);
        let coupled = ParameterMatrix::Stiffness(dmatrix![50.0, 50.0; 50.0, 50.0]);
        let stiffness = dmatrix![100.0, 0.0; 0.0, 100.0 * (1.0 + apart)];
        let model = DynamicModel {
            shares: vec![first, coupled],
            mass: DMatrix::identity(2, 2),
            stiffness,
        };
        let test = solve(&dmatrix![121.0, 5.0; 5.0, 144.0], &model.mass, 2).unwrap();
        let problem = model.analyze(&test, None).unwrap();
        gradient(&problem, &ModalState::start(&problem)).unwrap()
    };
    let equal = gradient_at(0.0);
    assert_near(
        &gradient_at(0.5 * SMALLEST_SEPARATION),
        &equal,
        CENTRAL_DIFFERENCE,
    );
    // A little further apart the shapes have a derivative, and it is large.
    assert!(gradient_at(2.0 * SMALLEST_SEPARATION)[1].abs() > 1e3 * equal[1].abs());
}

/// Two DOF apart have the shapes of the test exactly. The error is that of the first frequency, 1 - (2/3)√c, whose derivative at c = 1
/// is -1/3.
#[test]
fn where_shapes_are_equal_the_gradient_is_that_of_frequencies() {
    let model = DynamicModel {
        stiffness: dmatrix![4.0, 0.0; 0.0, 16.0],
        mass: DMatrix::identity(2, 2),
        shares: vec![ParameterMatrix::Stiffness(dmatrix![4.0, 1.0; 1.0, 0.0])],
    };
    let test = ModeSet::new(vec![9.0, 16.0].into(), DMatrix::identity(2, 2)).expect("modes");
    let problem = model.analyze(&test, None).expect("a problem");
    assert_eq!(problem.exact().errors.shape, 0.0);
    let found = gradient(&problem, &ModalState::start(&problem)).expect("a gradient");
    assert_near(&found, &[-1.0 / 3.0], CONVERGED_STATE);
}
