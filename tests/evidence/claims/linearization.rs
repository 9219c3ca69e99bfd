//! Predicted modes beside exact ones: the order of every formula, and which is the more accurate.

use crate::evidence::linearization::{MEASURES, STEPS, predictions};
use crate::prelude::*;

const FIRST: usize = 0;
const RECURSIVE: usize = 1;
const TAYLOR: usize = 2;
const TAYLOR_OF_ROOTS: usize = 3;

/// Case 2 and the delta wing.
fn both_structures() -> [Vec<[Errors; 4]>; 2] {
    [Known::of_case(2), Known::delta_wing()].map(|known| predictions(&known, false))
}

/// Mean log-log slope between two of the steps.
fn slope(
    all: &[[Errors; 4]],
    method: usize,
    measure: fn(&Errors) -> f64,
    [from, to]: [usize; 2],
) -> f64 {
    let [large, small] = [from, to].map(|row| measure(&all[row][method]));
    (large / small).ln() / (STEPS[from] / STEPS[to]).ln()
}

#[test]
fn first_order_and_taylor_are_of_second_order_and_recursive_1_of_its_own_and_one() {
    let [case, wing] = both_structures();
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
            measure(&case[3][RECURSIVE]) < ROUND_OFF_FLOOR,
            "the box is at round-off from an eighth on"
        );
    }
}
