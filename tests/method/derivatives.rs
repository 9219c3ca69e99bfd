//! Derivatives of the error sum (12) against exact differences, and a loop that allocates nothing.

use crate::common::boxes::{first_problem, problem_of, uneven_box};
use crate::common::counting_allocator::allocations;
use crate::common::tolerances::{
    CENTRAL_DIFFERENCE, CONVERGED_STATE, FIRST_ORDER_REMAINDER, ROUND_OFF,
};
use crate::common::vibrations::{Chain, chain_and_truth, error_sum_by_definition};
use corfem::method::appendix_c::UpdateRule;
use corfem::method::derivatives::{
    DERIVATIVE_STEP, Workspace, error_changes_into, error_derivatives,
};
use corfem::method::error::Error;
use corfem::method::model::{ModalProblem, ModalState};
use proptest::prelude::*;

/// The error sum by eigensolution in modal coordinates at the given factors.
fn exact_error_sum(problem: &ModalProblem, factors: Vec<f64>) -> f64 {
    let state = problem
        .state_at(factors, UpdateRule::Eigensolution)
        .unwrap();
    state.errors.sum()
}

/// Factors with one of them multiplied.
fn with_one(factors: &[f64], parameter: usize, by: f64) -> Vec<f64> {
    let mut changed = factors.to_vec();
    changed[parameter] *= by;
    changed
}

/// What first order leaves out of the change of the error sum by a 0.1 % step of a parameter: second-order terms of the
/// ratio of coupling to separation of any two modes.
fn first_order_remainder(problem: &ModalProblem, state: &ModalState, parameter: usize) -> f64 {
    let g = &state.generalized_shapes;
    let size = DERIVATIVE_STEP * state.factors[parameter];
    let beta = size * g.tr_mul(&(problem.generalized_shares[parameter].matrix() * g));
    let k = &state.modes.omega_squared;
    let mut ratio = size;
    for i in 0..k.len() {
        for j in (0..k.len()).filter(|&j| j != i) {
            ratio = ratio.max((beta[(i, j)] / (k[i] - k[j])).abs());
        }
    }
    FIRST_ORDER_REMAINDER * ratio * ratio
}

/// Largest and summed difference of derivatives from what they should be, against the largest derivative.
fn assert_near(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    let scale = expected.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    for (found, expected) in found.iter().zip(expected) {
        let error = (found - expected).abs();
        assert!(
            error <= tolerance * scale,
            "{found:e} {expected:e} of {scale:e}"
        );
    }
}

proptest! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn the_error_change_is_exact_to_second_order_of_the_step(
        (chain, truth) in chain_and_truth(),
        factors in prop::collection::vec(0.95..1.05_f64, 5),
    ) {
        let count = truth.len();
        let problem =
            ModalProblem::new(&chain.model(&vec![1.0; count]), &chain.modes(&truth), count).unwrap();
        let state = problem.state_at(factors[..count].to_vec(), UpdateRule::Eigensolution).unwrap();
        let found = error_derivatives(&problem, &state).unwrap();
        prop_assert_eq!(found.error_change.len(), count);
        for (e, change) in found.error_change.iter().enumerate() {
            let factors = with_one(&state.factors, e, 1.0 + DERIVATIVE_STEP);
            let ahead = problem.state_at(factors, UpdateRule::Eigensolution).unwrap();
            // The derivative keeps the present pairing; where that changes the error sum jumps.
            prop_assume!(ahead.pairing == state.pairing);
            let exact = ahead.errors.sum() - state.errors.sum();
            let bound = first_order_remainder(&problem, &state, e);
            prop_assert!((change - exact).abs() <= bound, "{e}: {change:e} {exact:e} {bound:e}");
        }
    }

    #[test]
    fn derivatives_are_central_differences_of_the_physical_structure(
        (chain, truth) in chain_and_truth(),
    ) {
        let count = truth.len();
        let start = vec![1.0; count];
        let problem = ModalProblem::new(&chain.model(&start), &chain.modes(&truth), count).unwrap();
        let state = problem.start_state().unwrap();
        let error_sum = |factors: &[f64]| {
            let model = chain.model(factors);
            error_sum_by_definition(&model.stiffness, &model.mass, &problem.test)
        };
        let (h, here) = (DERIVATIVE_STEP, error_sum(&start));
        let found = error_derivatives(&problem, &state).unwrap();
        for (e, change) in found.error_change.iter().enumerate() {
            let ahead = error_sum(&with_one(&start, e, 1.0 + h));
            let behind = error_sum(&with_one(&start, e, 1.0 - h));
            // A forward difference is off by half the second one, which is large where the error sum has a kink:
            // where a shape or frequency error is near zero, or another component becomes the largest.
            let curvature = (ahead - 2.0 * here + behind).abs() / 2.0;
            let bound = curvature + first_order_remainder(&problem, &state, e);
            prop_assert!((change - (ahead - behind) / 2.0).abs() <= bound, "{e} {bound:e}");
        }
    }

    #[test]
    fn share_changes_are_a_thousandth_of_the_present_shares_on_the_test_modes(
        (chain, truth) in chain_and_truth(),
        factors in prop::collection::vec(0.9..1.1_f64, 5),
    ) {
        let (count, test) = (truth.len(), chain.modes(&truth));
        let problem = ModalProblem::new(&chain.model(&vec![1.0; count]), &test, count).unwrap();
        let state = problem.state_at(factors[..count].to_vec(), UpdateRule::Eigensolution).unwrap();
        let found = error_derivatives(&problem, &state).unwrap().share_change;
        prop_assert_eq!(found.shape(), (count, count));
        let present = chain.model(&factors[..count]);
        for e in 0..count {
            for i in 0..count {
                let shape = test.shapes.column(i);
                let energy = (shape.transpose() * present.shares[e].matrix() * shape)[0];
                let expected = 0.001 * energy / test.omega_squared[i];
                prop_assert!((found[(i, e)] - expected).abs() <= ROUND_OFF);
            }
        }
    }

    #[test]
    fn the_sum_of_all_derivatives_is_that_of_a_common_factor((chain, truth) in chain_and_truth()) {
        // A factor on everything leaves shapes alone and multiplies frequencies by its root.
        let count = truth.len();
        let problem =
            ModalProblem::new(&chain.model(&vec![1.0; count]), &chain.modes(&truth), count).unwrap();
        let state = problem.start_state().unwrap();
        let found = error_derivatives(&problem, &state).unwrap();
        let sum: f64 = found.error_change.iter().sum();
        let ratios: Vec<f64> = (0..count)
            .map(|j| {
                let i = state.pairing.analysis_mode[j];
                (state.modes.omega_squared[i] / problem.test.omega_squared[j]).sqrt()
            })
            .collect();
        let slope: f64 = ratios.iter().map(|r| (r - 1.0) * r / 2.0).sum::<f64>() / state.errors.frequency;
        let mut bound = 0.0;
        for e in 0..count {
            let ahead = exact_error_sum(&problem, with_one(&state.factors, e, 1.0 + DERIVATIVE_STEP));
            let behind = exact_error_sum(&problem, with_one(&state.factors, e, 1.0 - DERIVATIVE_STEP));
            // A kink within the step, where another component becomes the largest, costs a whole second difference.
            bound += (ahead - 2.0 * state.errors.sum() + behind).abs()
                + first_order_remainder(&problem, &state, e);
        }
        let expected = slope * DERIVATIVE_STEP;
        prop_assert!((sum - expected).abs() <= bound, "{sum:e} {expected:e} {bound:e}");
    }
}

proptest! {
    #![proptest_config(crate::common::costly_config())]

    #[test]
    fn derivatives_of_boxes_are_exact_to_second_order_of_the_step(case in uneven_box()) {
        let problem = problem_of(&case);
        let state = problem.start_state().unwrap();
        let found = error_derivatives(&problem, &state).unwrap();
        prop_assert_eq!(found.error_change.len(), 15);
        for (e, change) in found.error_change.iter().enumerate() {
            let factors = with_one(&state.factors, e, 1.0 + DERIVATIVE_STEP);
            let ahead = problem.state_at(factors, UpdateRule::Eigensolution).unwrap();
            // The derivative keeps the present pairing; where that changes the error sum jumps.
            prop_assume!(ahead.pairing == state.pairing);
            let exact = ahead.errors.sum() - state.errors.sum();
            let bound = first_order_remainder(&problem, &state, e);
            prop_assert!((change - exact).abs() <= bound, "{e}: {change:e} {exact:e} {bound:e}");
        }
    }
}

#[test]
fn derivatives_of_the_box_are_central_differences() {
    for case in 1..=4 {
        let problem = first_problem(case);
        let state = problem.start_state().unwrap();
        let found = error_derivatives(&problem, &state).unwrap();
        let h = DERIVATIVE_STEP / 10.0;
        let central: Vec<f64> = (0..15)
            .map(|e| {
                let ahead = exact_error_sum(&problem, with_one(&state.factors, e, 1.0 + h));
                let behind = exact_error_sum(&problem, with_one(&state.factors, e, 1.0 - h));
                (ahead - behind) / (2.0 * h)
            })
            .collect();
        let slopes: Vec<f64> = found
            .error_change
            .iter()
            .map(|change| change / DERIVATIVE_STEP)
            .collect();
        assert_near(&slopes, &central, CENTRAL_DIFFERENCE);
    }
}

#[test]
fn derivatives_away_from_the_start_are_those_of_a_new_start() {
    // The state at some factors, and the exact solution there as a problem of its own, see the same structure.
    let chain = Chain::uniform(4);
    let (test, factors) = (chain.modes(&[1.2, 0.8, 1.3, 0.9]), [1.05, 0.97, 1.1, 0.94]);
    let problem = ModalProblem::new(&chain.model(&[1.0; 4]), &test, 4).unwrap();
    let state = problem
        .state_at(factors.to_vec(), UpdateRule::default())
        .unwrap();
    let moved = ModalProblem::new(&chain.model(&factors), &test, 4).unwrap();
    let found = error_derivatives(&problem, &state).unwrap();
    let expected = error_derivatives(&moved, &moved.start_state().unwrap()).unwrap();
    for (a, b) in found.error_change.iter().zip(&expected.error_change) {
        assert!((a - b).abs() <= CONVERGED_STATE, "{a:e} {b:e}");
    }
    let difference = (found.share_change - expected.share_change).amax();
    assert!(difference <= ROUND_OFF);
}

#[test]
fn the_loop_over_parameters_allocates_nothing() {
    let chain = Chain::uniform(40);
    let large = ModalProblem::new(&chain.model(&[1.0; 40]), &chain.modes(&[1.2; 40]), 40).unwrap();
    for problem in [first_problem(3), large] {
        let state = problem.start_state().unwrap();
        let mut workspace = Workspace::new(&problem);
        let mut change = vec![0.0; problem.parameter_count()];
        let count = allocations(|| {
            error_changes_into(&problem, &state, &mut workspace, &mut change).unwrap();
        });
        assert_eq!(count, 0);
        assert_eq!(
            change,
            error_derivatives(&problem, &state).unwrap().error_change
        );
    }
    // The counter counts.
    let mut kept = Vec::new();
    assert_eq!(allocations(|| kept.push(1_u8)), 1);
    assert_eq!(allocations(|| kept.reserve_exact(100)), 1);
}

#[test]
fn there_is_one_error_change_a_parameter() {
    let problem = first_problem(1);
    let state = problem.start_state().unwrap();
    let mut workspace = Workspace::new(&problem);
    for count in [14, 16] {
        match error_changes_into(&problem, &state, &mut workspace, &mut vec![0.0; count]) {
            Err(Error::WrongShape {
                what,
                expected_rows,
                rows,
                ..
            }) => assert_eq!((what, expected_rows, rows), ("error changes", 15, count)),
            other => panic!("{other:?}"),
        }
    }
}
