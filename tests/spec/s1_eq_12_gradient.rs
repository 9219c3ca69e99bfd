//! The second route to (12): the gradient of the error sum, the limit of the paper's difference, against exact differences and against
//! the paper's.

use crate::prelude::*;
use crate::spec::s1_eq_12_derivatives::{assert_near, exact_error_sum, with_one};

/// The paper's difference over its step.
fn slopes(problem: &Model, state: &State) -> Vec<f64> {
    let changes = problem.error_changes(state).unwrap();
    changes
        .iter()
        .map(|change| change / DERIVATIVE_STEP)
        .collect()
}

properties! {
    #[test]
    fn the_gradient_is_a_central_difference_of_exact_solutions(
        (chain, truth) in chain_and_truth(),
        factors in prop::collection::vec(0.95..1.05_f64, 5),
    ) {
        let count = truth.len();
        let problem = chain.model(&vec![1.0; count]).analyze(&chain.modes(&truth), None)?;
        let state = exact_state(&problem, &factors[..count])?;
        let h = 1e-6;
        for (e, slope) in gradient(&problem, &state)?.iter().enumerate() {
            let at = |by: f64| exact_state(&problem, &with_one(&state.factors, e, by)).unwrap();
            let (ahead, behind) = (at(1.0 + h), at(1.0 - h));
            prop_assume!(ahead.pairing == state.pairing && behind.pairing == state.pairing);
            let (ahead, behind) = (ahead.errors.sum(), behind.errors.sum());
            // A second difference this large is a kink of the error sum within the step.
            let kink = (ahead - 2.0 * state.errors.sum() + behind).abs();
            let difference = (slope * h - (ahead - behind) / 2.0).abs();
            prop_assert!(difference <= kink + DERIVATIVE_ROUND_OFF, "{e}: {difference:e} {kink:e}");
        }
    }
}

#[test]
fn the_gradient_of_boxes_is_a_central_difference() {
    for problem in CASES.map(first_problem) {
        let state = problem.exact();
        let h = 1e-5;
        let at = |e: usize, by: f64| exact_error_sum(&problem, &with_one(&state.factors, e, by));
        let central = (0..problem.shares().len())
            .map(|e| (at(e, 1.0 + h) - at(e, 1.0 - h)) / (2.0 * h))
            .collect_vec();
        assert_near(
            &gradient(&problem, state).unwrap(),
            &central,
            CENTRAL_DIFFERENCE_GRADIENT,
        );
    }
}

/// A model with every share a part of what it was: a tenth of a share changed by 0.1 % is the share changed by 0.01 %.
fn with_smaller_shares(dynamic: &DynamicModel, test: &Modes, part: f64) -> Model {
    let shares = dynamic.shares.iter().map(|share| part * share).collect();
    let dynamic = DynamicModel {
        shares,
        ..dynamic.clone()
    };
    dynamic.analyze(test, None).unwrap()
}

#[test]
fn the_papers_difference_tends_to_the_gradient_with_slope_one() {
    for number in [1, 2, 3] {
        let case = case_of(number);
        let dynamic = case.model().unwrap().matrices(&[1.0; 15]).unwrap();
        let test = case.test_modes().unwrap();
        let problem = with_smaller_shares(&dynamic, &test, 1.0);
        let exact = gradient(&problem, problem.exact()).unwrap();
        let points = [1.0, 0.3, 0.1, 0.03]
            .into_iter()
            .map(|part| {
                let smaller = with_smaller_shares(&dynamic, &test, part);
                let found = slopes(&smaller, problem.exact());
                let off = found.iter().zip(&exact);
                let off = off.map(|(found, exact)| found / part - exact);
                (part, off.map(|off| off * off).sum::<f64>().sqrt())
            })
            .collect_vec();
        let slope = log_log_slope(&points);
        assert!((slope - 1.0).abs() <= ORDER_SLACK, "{slope}: {points:?}");
    }
}

/// Two like oscillators, one stiffened: at equal roots the shapes have no derivative, but the roots have one.
#[test]
fn derivatives_at_repeated_roots_are_those_of_the_roots() {
    let stiffness = eye(2) * 100.0;
    let first = dmatrix![100.0, 0.0; 0.0, 0.0];
    let coupled = dmatrix![50.0, 50.0; 50.0, 50.0];
    let model = DynamicModel {
        shares: vec![first, coupled],
        mass: eye(2),
        stiffness,
    };
    let test = solve(&dmatrix![121.0, 0.0; 0.0, 144.0], &model.mass, 2).unwrap();
    let problem = model.analyze(&test, None).unwrap();
    let state = problem.exact();
    // r = 1/1.1 - 1 and 1/1.2 - 1; d(ratio)/dc of a whole share is ratio/2, of half a share in each ratio/4.
    let (a, b) = (1.0 / 1.1 - 1.0, 1.0 / 1.2 - 1.0);
    let e_f = f64::hypot(a, b);
    let expected = [a / 1.1 / 2.0 / e_f, (a / 1.1 + b / 1.2) / 4.0 / e_f];
    let exact = gradient(&problem, state).unwrap();
    assert_near(&exact, &expected, CONVERGED_STATE);
    assert_near(&slopes(&problem, state), &expected, CENTRAL_DIFFERENCE);
}

/// Roots that differ by round-off are one root, and their derivatives are those of equal ones.
#[test]
fn roots_apart_by_round_off_count_as_equal() {
    let problem_at = |apart: f64| {
        let first = dmatrix![100.0, 0.0; 0.0, 0.0];
        let coupled = dmatrix![50.0, 50.0; 50.0, 50.0];
        let stiffness = dmatrix![100.0, 0.0; 0.0, 100.0 * (1.0 + apart)];
        let model = DynamicModel {
            shares: vec![first, coupled],
            mass: eye(2),
            stiffness,
        };
        let test = solve(&dmatrix![121.0, 5.0; 5.0, 144.0], &model.mass, 2).unwrap();
        model.analyze(&test, None).unwrap()
    };
    let gradient_at = |apart: f64| {
        let problem = problem_at(apart);
        gradient(&problem, problem.exact()).unwrap()
    };
    let equal = gradient_at(0.0);
    assert_near(
        &gradient_at(0.5 * SMALLEST_SEPARATION),
        &equal,
        CENTRAL_DIFFERENCE,
    );
    // A little further apart the shapes have a derivative, and it is large.
    assert!(gradient_at(2.0 * SMALLEST_SEPARATION)[1].abs() > 1e3 * equal[1].abs());
    // The paper's difference, whose step would turn them, holds them to their own shapes.
    for apart in [0.0, 0.5, 2.0] {
        let problem = problem_at(apart * SMALLEST_SEPARATION);
        let found = slopes(&problem, problem.exact());
        assert_near(&found, &equal, CENTRAL_DIFFERENCE);
    }
}

#[test]
fn an_error_of_zero_has_no_slope() {
    // The frequencies agree and the shapes too: the error sum has a kink here, and no direction to go.
    let chain = Chain::uniform(1);
    let problem = chain
        .model(&[1.0])
        .analyze(&chain.modes(&[1.0]), None)
        .unwrap();
    let state = problem.exact();
    assert_eq!(state.errors.sum(), 0.0);
    assert_eq!(gradient(&problem, state).unwrap(), [0.0]);
    // The paper's difference goes uphill on one side of it.
    let found = problem.error_changes(state).unwrap();
    assert!((found[0] - ((1.0 + DERIVATIVE_STEP).sqrt() - 1.0)).abs() <= ROUND_OFF);
}

/// Two DOF apart have the shapes of the test exactly. The error is that of the first frequency, 1 - (2/3)√c, whose derivative at c = 1
/// is -1/3.
#[test]
fn where_shapes_are_equal_the_gradient_is_that_of_frequencies() {
    let model = DynamicModel {
        stiffness: dmatrix![4.0, 0.0; 0.0, 16.0],
        mass: eye(2),
        shares: vec![dmatrix![4.0, 1.0; 1.0, 0.0]],
    };
    let test = Modes::new(vec![9.0, 16.0].into(), eye(2)).unwrap();
    let problem = model.analyze(&test, None).unwrap();
    assert_eq!(problem.exact().errors.shape, 0.0);
    let found = gradient(&problem, problem.exact()).unwrap();
    assert_near(&found, &[-1.0 / 3.0], CONVERGED_STATE);
}

/// Where an error is zero its root has a kink, and counts as constant: frequencies alone, shapes alone, both.
#[test]
fn an_error_of_zero_counts_as_constant() {
    let shares = [
        dmatrix![4.0, 0.0; 0.0, 0.0],
        dmatrix![0.0, 0.0; 0.0, 9.0],
        dmatrix![1.0, 0.5; 0.5, 1.0],
    ];
    let apart = DynamicModel {
        stiffness: dmatrix![4.0, 0.0; 0.0, 9.0],
        mass: eye(2),
        shares: shares.to_vec(),
    };
    let modes = |squares: [f64; 2], shapes| Modes::new(squares.to_vec().into(), shapes).unwrap();
    let unit = eye(2);
    let frequencies = modes([5.0, 8.0], unit.clone());
    let shapes = modes([4.0, 9.0], dmatrix![1.0, 0.1; 0.2, 1.0]);
    let alike = modes([4.0, 9.0], unit);
    for (test, has_slope) in [(frequencies, true), (shapes, true), (alike, false)] {
        let problem = apart.analyze(&test, None).unwrap();
        let errors = problem.exact().errors;
        assert!(errors.frequency == 0.0 || errors.shape == 0.0);
        let found = gradient(&problem, problem.exact()).unwrap();
        assert_eq!(found.iter().any(|slope| *slope != 0.0), has_slope);
    }
}

/// Squared frequencies of a trillionth are apart by as much of themselves as those of a trillion.
#[test]
fn derivatives_are_the_same_in_any_unit() {
    let problem_in = |unit: f64| {
        let [first, second] = [dmatrix![4.0, 1.0; 1.0, 2.0], dmatrix![1.0, 0.5; 0.5, 7.0]];
        let coupled = DynamicModel {
            shares: vec![unit * &first, unit * &second],
            stiffness: unit * (first + second),
            mass: eye(2),
        };
        let shapes = dmatrix![1.0, 0.1; -0.5, 1.0];
        let test = Modes::new(vec![unit * 5.0, unit * 8.0].into(), shapes).unwrap();
        coupled.analyze(&test, None).unwrap()
    };
    let one = problem_in(1.0);
    for unit in [1e-12, 1e12] {
        let other = problem_in(unit);
        assert_near(
            &gradient(&other, other.exact()).unwrap(),
            &gradient(&one, one.exact()).unwrap(),
            CONVERGED_STATE,
        );
        assert_near(
            &slopes(&other, other.exact()),
            &slopes(&one, one.exact()),
            CONVERGED_STATE,
        );
    }
}
