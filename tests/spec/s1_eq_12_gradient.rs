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
        assert_within(slope, 1.0, ORDER_SLACK);
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
    assert_within(found[0], (1.0 + DERIVATIVE_STEP).sqrt() - 1.0, ROUND_OFF);
}
