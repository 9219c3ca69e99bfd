//! Predicted modes beside exact ones: the order of every formula, and which is the more accurate.

use crate::evidence::predictions::{
    Exact, MEASURES, Prediction, STEPS, both_structures, predictions,
};
use crate::prelude::*;

const FIRST: usize = 0;
const RECURSIVE: usize = 1;
const TAYLOR: usize = 2;
const TAYLOR_OF_ROOTS: usize = 3;

fn error(of: &Prediction, method: usize) -> Errors {
    of.errors[method].unwrap()
}

/// Mean log-log slope between two of the steps.
fn slope(
    all: &[Prediction],
    method: usize,
    measure: fn(&Errors) -> f64,
    [from, to]: [usize; 2],
) -> f64 {
    let [large, small] = [from, to].map(|row| measure(&error(&all[row], method)));
    (large / small).ln() / (all[from].step / all[to].step).ln()
}

#[test]
fn first_order_and_taylor_are_of_second_order_and_recursive_1_of_its_own_and_one() {
    let [(_, case), (_, wing)] = both_structures(Exact::SameCondensation).unwrap();
    for all in [&case, &wing] {
        for (method, measure) in [FIRST, TAYLOR, TAYLOR_OF_ROOTS]
            .into_iter()
            .flat_map(|m| MEASURES.map(|of| (m, of.1)))
        {
            let found = slope(all, method, measure, [4, 7]);
            assert!((found - 2.0).abs() < ORDER_SLACK, "{method}: {found}");
        }
    }
    for (_, measure) in MEASURES {
        let found = slope(&wing, RECURSIVE, measure, [3, 6]);
        assert!((found - 5.0).abs() < ORDER_HALFWAY, "{found}");
        assert!(
            measure(&error(&case[3], RECURSIVE)) < ROUND_OFF_FLOOR,
            "the box is at round-off from an eighth on"
        );
    }
}

#[test]
fn perturbation_is_more_accurate_than_a_taylor_step_of_the_same_derivatives() {
    for (name, all) in both_structures(Exact::SameCondensation).unwrap() {
        for of in &all {
            let [first, recursive, taylor, of_roots] = [0, 1, 2, 3].map(|method| error(of, method));
            // C.20 is linear in ω²: Rayleigh's quotient on the old shape.
            let (one, other) = (first.frequency_rms(), taylor.frequency_rms());
            assert_relative_eq!(
                one,
                other,
                max_relative = ROUND_OFF,
                epsilon = MEASURABLE_ERROR
            );
            assert!(
                of_roots.frequency_rms() > 1.1 * taylor.frequency_rms(),
                "{name} {}",
                of.step
            );
            assert!(
                first.shape_rms() < 0.85 * taylor.shape_rms(),
                "{name} {}",
                of.step
            );
            assert_eq!(taylor.shape_rms(), of_roots.shape_rms());
            assert!(
                recursive.frequency_rms() < 0.25 * first.frequency_rms(),
                "{name} {}",
                of.step
            );
            // A whole step exchanges two close modes of the wing.
            assert!(
                of.step == 1.0 || recursive.shape_rms() < 0.07 * first.shape_rms(),
                "{name} {}",
                of.step
            );
        }
    }
}

#[test]
fn a_new_condensation_leaves_second_order_to_every_formula() {
    let [(_, case), _] = both_structures(Exact::NewCondensation).unwrap();
    for (method, measure) in [FIRST, RECURSIVE, TAYLOR]
        .into_iter()
        .flat_map(|m| MEASURES.map(|of| (m, of.1)))
    {
        let found = slope(&case, method, measure, [4, 7]);
        assert!((found - 2.0).abs() < ORDER_SLACK, "{method}: {found}");
    }
    assert!(STEPS.iter().zip(&case).all(|(step, of)| *step == of.step));
}

#[test]
fn whole_step_ends_at_the_test_and_lost_roots_are_no_prediction() {
    let known = Known::of_case(2).unwrap();
    let zero = predictions(&known.model, &known.truth, &[0.0], Exact::NewCondensation).unwrap();
    let each = zero[0].errors.iter().map(|errors| errors.unwrap().sum());
    assert!(each.into_iter().all(|sum| sum < ROUND_OFF_FLOOR));
    let thrice = vec![3.0; known.truth.len()];
    let found = predictions(&known.model, &thrice, &[1.0], Exact::SameCondensation).unwrap();
    let lost = found[0].errors.iter().map(Option::is_none).collect_vec();
    assert_eq!(lost, [false, false, false, true]);
}
