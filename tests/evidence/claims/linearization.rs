//! Predicted modes beside exact ones: the order of every formula, and which is the more accurate.

use crate::evidence::predictions::{Exact, MEASURES, Prediction, both_structures};
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
            assert_within(found, 2.0, ORDER_SLACK);
        }
    }
    for (_, measure) in MEASURES {
        let found = slope(&wing, RECURSIVE, measure, [3, 6]);
        assert_within(found, 5.0, ORDER_HALFWAY);
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
