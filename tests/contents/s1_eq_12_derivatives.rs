//! Derivatives of the error sum (12) by the paper's difference, against exact differences.

use crate::prelude::*;
use corfem::method::derivatives::HELD_SEPARATION;

/// The error sum by eigensolution in modal coordinates at the given factors.
pub fn exact_error_sum(problem: &ModalModel, factors: &[f64]) -> f64 {
    exact_state(problem, factors).unwrap().errors.sum()
}

/// Factors with one of them multiplied.
pub fn with_one(factors: &[f64], parameter: usize, by: f64) -> Vec<f64> {
    let mut changed = factors.to_vec();
    changed[parameter] *= by;
    changed
}

/// What first order leaves out of the change of the error sum by a 0.1 % step of a parameter: second-order terms of the
/// ratio of coupling to separation of any two modes.
fn first_order_remainder(problem: &ModalModel, state: &State, parameter: usize) -> f64 {
    let g = &state.generalized_shapes;
    let size = DERIVATIVE_STEP * state.share_factors[parameter];
    let beta = size * g.tr_mul(&(&problem.shares()[parameter] * g));
    let k = state.modes.omega_squared();
    let mut ratio = size;
    for i in 0..k.len() {
        for j in (0..k.len()).filter(|&j| j != i) {
            ratio = ratio.max((beta[(i, j)] / (k[i] - k[j])).abs());
        }
    }
    FIRST_ORDER_REMAINDER * ratio * ratio
}

/// Largest and summed difference of derivatives from what they should be, against the largest derivative.
pub fn assert_near(found: &[f64], expected: &[f64], tolerance: f64) {
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

properties! {
    #[test]
    fn the_error_change_is_exact_to_second_order_of_the_step(
        (chain, truth) in chain_and_truth(),
        factors in prop::collection::vec(0.95..1.05_f64, 5),
    ) {
        let count = truth.len();
        let problem =
            chain.model(&vec![1.0; count]).analyze(&chain.modes(&truth), Some(count))?;
        let state = exact_state(&problem, &factors[..count])?;
        let found = problem.error_changes(&state)?;
        prop_assert_eq!(found.len(), count);
        for (e, change) in found.iter().enumerate() {
            let factors = with_one(&state.share_factors, e, 1.0 + DERIVATIVE_STEP);
            let ahead = exact_state(&problem, &factors)?;
            // The derivative keeps the present pairing; where that changes the error sum jumps.
            prop_assume!(ahead.pairing == state.pairing);
            let exact = ahead.errors.sum() - state.errors.sum();
            let bound = first_order_remainder(&problem, &state, e);
            prop_assert!((change - exact).abs() <= bound, "{e}: {change:e} {exact:e} {bound:e}");
        }
    }

    /// Weights of at most one leave no more of it than first order does without.
    #[test]
    fn the_change_of_weighted_errors_is_exact_to_second_order_of_the_step(
        (chain, truth) in chain_and_truth(),
        factors in prop::collection::vec(0.95..1.05_f64, 5),
        weights in prop::collection::vec((0.0..1.0_f64, 0.1..1.0_f64), 5),
    ) {
        let count = truth.len();
        let plain = chain.model(&vec![1.0; count]).analyze(&chain.modes(&truth), None)?;
        let weight = |&(frequency, shape): &(f64, f64)| ModeWeight { frequency, shape };
        let weights = weights.iter().take(count).map(weight).collect_vec();
        let at = |factors: &[f64]| {
            let state = exact_state(&plain, factors).unwrap();
            let each = mode_errors(&state.modes, &state.pairing, plain.test()).unwrap();
            let weighted = |(error, weight): (&ModeError, &ModeWeight)| ModeError {
                frequency: weight.frequency * error.frequency,
                shape: weight.shape * error.shape,
            };
            let weighted = each.iter().zip(&weights).map(weighted).collect_vec();
            State { errors: Errors::of(&weighted).unwrap(), ..state }
        };
        let state = at(&factors[..count]);
        let weighted = SensorModel::from(&plain).weighted(&weights)?;
        for (e, change) in weighted.error_changes(&state)?.iter().enumerate() {
            let ahead = at(&with_one(&state.share_factors, e, 1.0 + DERIVATIVE_STEP));
            prop_assume!(ahead.pairing == state.pairing);
            let exact = ahead.errors.sum() - state.errors.sum();
            let bound = first_order_remainder(&plain, &state, e);
            prop_assert!((change - exact).abs() <= bound, "{e}: {change:e} {exact:e} {bound:e}");
        }
    }

    #[test]
    fn derivatives_are_central_differences_of_the_physical_structure(
        (chain, truth) in chain_and_truth(),
    ) {
        let count = truth.len();
        let start = vec![1.0; count];
        let test = chain.modes(&truth);
        let problem = chain.model(&start).analyze(&test, None)?;
        let state = problem.exact();
        let error_sum = |factors: &[f64]| {
            let model = chain.model(factors);
            error_sum_by_definition(&model.stiffness, &model.mass, &test)
        };
        let (h, here) = (DERIVATIVE_STEP, error_sum(&start));
        let found = problem.error_changes(state)?;
        for (e, change) in found.iter().enumerate() {
            let ahead = error_sum(&with_one(&start, e, 1.0 + h));
            let behind = error_sum(&with_one(&start, e, 1.0 - h));
            // A forward difference is off by half the second one, which is large where the error sum has a kink:
            // where a shape or frequency error is near zero, or another component becomes the largest.
            let curvature = (ahead - 2.0 * here + behind).abs() / 2.0;
            let bound = curvature + first_order_remainder(&problem, state, e);
            prop_assert!((change - (ahead - behind) / 2.0).abs() <= bound, "{e} {bound:e}");
        }
    }
}

properties! {
    #![proptest_config(costly_config())]

    #[test]
    fn derivatives_of_boxes_are_exact_to_second_order_of_the_step(case in uneven_box()) {
        let problem = problem_of(&case);
        let state = problem.exact();
        let found = problem.error_changes(state)?;
        prop_assert_eq!(found.len(), 15);
        for (e, change) in found.iter().enumerate() {
            let factors = with_one(&state.share_factors, e, 1.0 + DERIVATIVE_STEP);
            let ahead = exact_state(&problem, &factors)?;
            // The derivative keeps the present pairing; where that changes the error sum jumps.
            prop_assume!(ahead.pairing == state.pairing);
            let exact = ahead.errors.sum() - state.errors.sum();
            let bound = first_order_remainder(&problem, state, e);
            prop_assert!((change - exact).abs() <= bound, "{e}: {change:e} {exact:e} {bound:e}");
        }
    }
}

#[test]
fn derivatives_of_the_box_are_central_differences() {
    for case in 1..=4 {
        let problem = first_problem(case);
        let state = problem.exact();
        let found = problem.error_changes(state).unwrap();
        let h = DERIVATIVE_STEP / 10.0;
        let central = (0..15)
            .map(|e| {
                let ahead = exact_error_sum(&problem, &with_one(&state.share_factors, e, 1.0 + h));
                let behind = exact_error_sum(&problem, &with_one(&state.share_factors, e, 1.0 - h));
                (ahead - behind) / (2.0 * h)
            })
            .collect_vec();
        let slopes = found
            .iter()
            .map(|change| change / DERIVATIVE_STEP)
            .collect_vec();
        assert_near(&slopes, &central, CENTRAL_DIFFERENCE);
    }
}

#[test]
fn derivatives_away_from_the_start_are_those_of_a_new_start() {
    // The state at some factors, and the exact solution there as a problem of its own, see the same structure.
    let chain = Chain::uniform(4);
    let (test, factors) = (chain.modes(&[1.2, 0.8, 1.3, 0.9]), [1.05, 0.97, 1.1, 0.94]);
    let problem = chain.model(&[1.0; 4]).analyze(&test, Some(4)).unwrap();
    let state = problem.at(&factors).unwrap();
    let moved = chain.model(&factors).analyze(&test, Some(4)).unwrap();
    let found = problem.error_changes(&state).unwrap();
    let expected = moved.error_changes(moved.exact()).unwrap();
    for (a, b) in found.iter().zip(&expected) {
        assert_within(a, b, CONVERGED_STATE);
    }
}

/// Two modes closer than a hundredth keep their own shapes, whatever couples them; two further apart do not.
#[test]
fn close_modes_are_held_to_their_own_shapes() {
    let changes = |apart: f64, coupling: f64| {
        let stiffness = dmatrix![100.0, 0.0; 0.0, 100.0 * (1.0 + apart)];
        let shares = vec![dmatrix![30.0, coupling; coupling, 50.0]];
        let model = DynamicModel {
            shares,
            mass: eye(2),
            stiffness,
        };
        let test = solve(&dmatrix![121.0, 5.0; 5.0, 144.0], &model.mass, 2).unwrap();
        let problem = model.analyze(&test, None).unwrap();
        problem.error_changes(problem.exact()).unwrap()
    };
    let (inside, outside) = (0.99 * HELD_SEPARATION, 1.02 * HELD_SEPARATION);
    assert_eq!(changes(inside, 20.0), changes(inside, 0.0));
    assert_ne!(changes(outside, 20.0), changes(outside, 0.0));
    // At the limit itself they are apart: one is a hundredth of a hundred.
    let change = DMatrix::repeat(2, 2, 1.0);
    assert_eq!(without_close_couplings(&[100.0, 99.0], &change), change);
}

/// Two like oscillators, one stiffened: at equal roots the shapes have no derivative, but the roots have one. With
/// $r = 1/1.1 - 1$ and $1/1.2 - 1$ the ratio of a whole share rises by half of itself, that of half a share in each by a fourth.
#[test]
fn derivatives_at_repeated_roots_are_those_of_the_roots() {
    let model = DynamicModel {
        shares: vec![diagonal([100.0, 0.0]), DMatrix::repeat(2, 2, 50.0)],
        mass: eye(2),
        stiffness: eye(2) * 100.0,
    };
    let test = solve(&diagonal([121.0, 144.0]), &model.mass, 2).unwrap();
    let problem = model.analyze(&test, None).unwrap();
    let changes = problem.error_changes(problem.exact()).unwrap();
    let (a, b) = (1.0 / 1.1 - 1.0, 1.0 / 1.2 - 1.0);
    let expected =
        [a / 2.2, (a / 1.1 + b / 1.2) / 4.0].map(|own| DERIVATIVE_STEP * own / f64::hypot(a, b));
    assert_near(&changes, &expected, CENTRAL_DIFFERENCE);
}
