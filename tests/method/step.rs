//! The step (13): factors from derivatives by three rules, and the bounds that hold them.

use crate::common::tolerances::ROUND_OFF;
use corfem::method::derivatives::{DERIVATIVE_STEP, Derivatives};
use corfem::method::error::Error;
use corfem::method::step::{Limit, Range, StepRule, limited_factor, unlimited_factors};
use nalgebra::{DMatrix, dmatrix};
use proptest::prelude::*;

/// Changes of the error sum and stiffness of up to six parameters on three test modes, the parameters' stiffness
/// within a factor of a hundred of each other.
fn derivatives() -> impl Strategy<Value = Derivatives> {
    (1..=6_usize).prop_flat_map(|count| {
        (
            prop::collection::vec(-1e-3..1e-3_f64, count),
            prop::collection::vec(1e-5..1e-3_f64, 3 * count),
        )
            .prop_map(move |(error_change, stiffness)| Derivatives {
                error_change,
                share_change: DMatrix::from_vec(3, count, stiffness),
            })
    })
}

/// A range around one, wide or narrow.
fn range() -> impl Strategy<Value = Range> {
    (0.1..0.99_f64, 1.01..10.0_f64).prop_map(|(lower, upper)| Range { lower, upper })
}

proptest! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn steps_are_in_proportion_to_relaxation_and_error_sum(
        derivatives in derivatives(),
        error_sum in 0.01..1.0_f64,
        relaxation in 0.1..2.0_f64,
    ) {
        for rule in [StepRule::RootSumOfSquares, StepRule::SumOverModes, StepRule::SteepestDescent] {
            let unit = unlimited_factors(&derivatives, 1.0, 1.0, rule);
            let found = unlimited_factors(&derivatives, error_sum, relaxation, rule);
            prop_assert_eq!(found.len(), derivatives.error_change.len());
            for (c, unit) in found.iter().zip(&unit) {
                let expected = relaxation * error_sum * (unit - 1.0);
                prop_assert!((c - 1.0 - expected).abs() <= ROUND_OFF * (1.0 + expected.abs()));
            }
        }
    }

    #[test]
    fn every_rule_goes_downhill(derivatives in derivatives()) {
        for rule in [StepRule::RootSumOfSquares, StepRule::SumOverModes, StepRule::SteepestDescent] {
            let factors = unlimited_factors(&derivatives, 0.3, 1.0, rule);
            for (factor, change) in factors.iter().zip(&derivatives.error_change) {
                prop_assert!((factor - 1.0) * change <= 0.0, "{rule:?} {factor} {change}");
            }
        }
    }

    #[test]
    fn a_sum_over_modes_steps_no_farther_than_a_root_of_squares(derivatives in derivatives()) {
        let long = unlimited_factors(&derivatives, 0.3, 1.0, StepRule::RootSumOfSquares);
        let short = unlimited_factors(&derivatives, 0.3, 1.0, StepRule::SumOverModes);
        for (long, short) in long.iter().zip(&short) {
            // Between one and √3 for three modes.
            prop_assert!((short - 1.0).abs() <= (long - 1.0).abs() * (1.0 + ROUND_OFF));
            prop_assert!((long - 1.0).abs() <= 3_f64.sqrt() * (short - 1.0).abs() + ROUND_OFF);
        }
    }

    #[test]
    fn steepest_descent_brings_the_linearized_error_sum_to_zero(
        derivatives in derivatives(),
        error_sum in 0.01..1.0_f64,
    ) {
        prop_assume!(derivatives.error_change.iter().any(|change| change.abs() > 1e-6));
        let factors = unlimited_factors(&derivatives, error_sum, 1.0, StepRule::SteepestDescent);
        let change: f64 = factors
            .iter()
            .zip(&derivatives.error_change)
            .map(|(factor, change)| (factor - 1.0) * change / DERIVATIVE_STEP)
            .sum();
        prop_assert!((change + error_sum).abs() <= ROUND_OFF * 10.0, "{change}");
    }

    #[test]
    fn limits_hold(
        (total, place, step) in (0.2..5.0_f64, 0.001..0.999_f64, -3.0..6.0_f64),
        factor_range in range(),
        total_range in range(),
    ) {
        // Where the product so far lies within its range, as it does in the loops.
        let product = total_range.lower + place * (total_range.upper - total_range.lower);
        let base = product / total;
        let (next, limit) = limited_factor(total, base, step, factor_range, Some(total_range));
        let factor = next / total;
        prop_assert!(factor >= factor_range.lower * (1.0 - ROUND_OFF));
        prop_assert!(factor <= factor_range.upper * (1.0 + ROUND_OFF));
        prop_assert!(base * next >= total_range.lower * (1.0 - ROUND_OFF));
        prop_assert!(base * next <= total_range.upper * (1.0 + ROUND_OFF));
        match limit {
            Limit::None => prop_assert_eq!(next, total * step),
            Limit::Factor => prop_assert!(!factor_range.contains(step)),
            Limit::Total => {
                let at_lower = (base * next / total_range.lower - 1.0).abs() <= ROUND_OFF;
                let at_upper = (base * next / total_range.upper - 1.0).abs() <= ROUND_OFF;
                prop_assert!(at_lower || at_upper);
            }
        }
    }

    #[test]
    fn a_range_contains_what_lies_between_its_ends(range in range(), value in 0.0..12.0_f64) {
        prop_assert_eq!(range.contains(value), range.lower <= value && value <= range.upper);
        prop_assert!(range.contains(range.lower) && range.contains(range.upper));
    }
}

/// Three parameters on two test modes: stiffnesses (0.003, 0.004), (0.006, 0.008) and none.
fn by_hand() -> Derivatives {
    Derivatives {
        error_change: vec![0.002, -0.001, 0.0],
        share_change: dmatrix![0.003, 0.006, 0.0; 0.004, 0.008, 0.0],
    }
}

fn assert_close(found: &[f64], expected: [f64; 3]) {
    assert_eq!(found.len(), 3);
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= ROUND_OFF, "{found} {expected}");
    }
}

#[test]
fn root_sum_of_squares_by_hand() {
    // Δk is 0.005 and 0.010: 1 - 0.8 · 0.5 · 0.002/0.005 and 1 + 0.8 · 0.5 · 0.001/0.010.
    let found = unlimited_factors(&by_hand(), 0.5, 0.8, StepRule::RootSumOfSquares);
    assert_close(&found, [0.84, 1.04, 1.0]);
    assert_eq!(StepRule::default(), StepRule::RootSumOfSquares);
}

#[test]
fn sum_over_modes_by_hand() {
    // Δk is 0.007 and 0.014.
    let found = unlimited_factors(&by_hand(), 0.7, 1.0, StepRule::SumOverModes);
    assert_close(&found, [0.8, 1.05, 1.0]);
}

#[test]
fn steepest_descent_by_hand() {
    // d is 2, -1 and 0, and the sum of squares 5: 1 - 0.5 · 2/5 and 1 + 0.5 · 1/5.
    let found = unlimited_factors(&by_hand(), 0.5, 1.0, StepRule::SteepestDescent);
    assert_close(&found, [0.8, 1.1, 1.0]);
}

#[test]
fn a_parameter_without_stiffness_keeps_one() {
    // Also when round-off gives it a derivative.
    let derivatives = Derivatives {
        error_change: vec![1e-18, 0.0],
        share_change: DMatrix::zeros(2, 2),
    };
    for rule in [StepRule::RootSumOfSquares, StepRule::SumOverModes] {
        assert_eq!(unlimited_factors(&derivatives, 0.5, 1.0, rule), [1.0, 1.0]);
    }
    let flat = Derivatives {
        error_change: vec![0.0, 0.0],
        ..by_hand()
    };
    assert_eq!(
        unlimited_factors(&flat, 0.5, 1.0, StepRule::SteepestDescent),
        [1.0, 1.0]
    );
}

#[test]
fn limits_by_hand() {
    let factor_range = Range {
        lower: 0.5,
        upper: 1.5,
    };
    let total_range = Some(Range {
        lower: 0.7,
        upper: 1.3,
    });
    for ((total, base, step, range), expected) in [
        // Nothing in the way, also at the very ends.
        ((1.2, 2.0, 1.25, None), (1.5, Limit::None)),
        ((1.0, 1.0, 0.5, None), (0.5, Limit::None)),
        ((1.0, 1.0, 1.5, None), (1.5, Limit::None)),
        ((1.0, 1.0, 1.3, total_range), (1.3, Limit::None)),
        ((1.0, 1.0, 0.7, total_range), (0.7, Limit::None)),
        // One iteration's bounds, on the step and not on the product.
        ((2.0, 1.0, 3.0, None), (3.0, Limit::Factor)),
        ((2.0, 1.0, -3.0, None), (1.0, Limit::Factor)),
        // The total's bounds, on the product with the passes before.
        ((1.0, 1.0, 1.4, total_range), (1.3, Limit::Total)),
        ((1.0, 1.0, 0.6, total_range), (0.7, Limit::Total)),
        ((1.0, 0.5, 1.5, total_range), (1.5, Limit::None)),
        ((2.0, 0.5, 1.5, total_range), (2.6, Limit::Total)),
        // Both: the total's has the last word.
        ((1.0, 1.0, 9.0, total_range), (1.3, Limit::Total)),
        ((1.0, 1.0, 0.1, total_range), (0.7, Limit::Total)),
        // The iteration's alone where the total's leaves room.
        (
            (0.8, 1.0, 9.0, total_range),
            (1.2000000000000002, Limit::Factor),
        ),
    ] {
        let found = limited_factor(total, base, step, factor_range, range);
        assert_eq!(found, expected, "{total} {base} {step} {range:?}");
    }
}

#[test]
fn crossed_ranges_do_not_panic() {
    let crossed = Range {
        lower: 2.0,
        upper: 1.0,
    };
    let (next, _) = limited_factor(1.0, 1.0, 1.5, crossed, Some(crossed));
    assert!(next.is_finite());
}

#[test]
fn ranges_are_of_positive_finite_numbers_in_order() {
    let range = Range::positive("gage", 0.007, 0.013).unwrap();
    assert_eq!((range.lower, range.upper), (0.007, 0.013));
    for (low, high) in [
        (0.0, 1.0),
        (-1.0, 1.0),
        (1.0, 1.0),
        (2.0, 1.0),
        (1.0, f64::INFINITY),
    ] {
        match Range::positive("gage", low, high) {
            Err(Error::Limits { what, lower, upper }) => {
                assert_eq!((what.as_str(), lower, upper), ("gage", low, high));
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(Range::positive("gage", f64::NAN, 1.0).is_err());
    assert!(Range::positive("gage", 0.5, f64::NAN).is_err());
}
