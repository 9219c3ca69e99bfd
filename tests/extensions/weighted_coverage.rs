//! How often 95 % intervals hold the truth, and that a culprit is found.

use crate::evidence::coverage::{ENOUGH, SEEDS, all_coverages, tables};
use crate::extensions::weighted::at;
use crate::prelude::*;

/// Seeds of the tests that every run makes.
const FEW: RangeInclusive<u64> = 1..=4;

#[test]
fn intervals_hold_the_truth_in_most_of_a_few_tests() {
    let all = all_coverages(FEW);
    let counts = all.each_ref().map(|of| of.parameters.len());
    assert_eq!(counts, [15, 21, 10]);
    for of in &all {
        let held = of.overall();
        assert!((FEW_COVERAGE..=1.0).contains(&held), "{}: {held}", of.name);
        let tests = FEW.count() as f64;
        assert!(of.explained * tests + 1.0 >= tests, "{}", of.name);
        assert!(
            of.degrees_of_freedom < ENOUGH || of.flagged == 1.0,
            "{}",
            of.name
        );
    }
    // The noise that each test of a run has is its own.
    assert!(all_coverages(5..=5)[1].misfit != all_coverages(6..=6)[1].misfit);
}

#[test]
#[ignore = "minutes: three hundred tests of each structure"]
fn intervals_hold_the_truth_in_93_to_97_of_100_tests() {
    let numbers = Numbers {
        relative: GOLDEN_RELATIVE,
        absolute: GOLDEN_COVERAGE,
        last_digit: false,
        ..Numbers::AS_WRITTEN
    };
    assert_golden("coverage", &csv(&tables(SEEDS)), numbers);
}

#[test]
fn a_single_error_is_undone_by_its_own_factor() {
    let case = case_of(4);
    let right = case
        .model_with(&[0.01; 15])
        .unwrap()
        .matrices(&[1.0; 15])
        .unwrap();
    let test = solve(&right.stiffness, &right.mass, 9).unwrap();
    let weights = equal_weights(Noise::USUAL, 9);
    for culprit in 0..15 {
        let mut factors = [1.0; 15];
        factors[culprit] = 0.05;
        let model = Comparison::from(&at(&right, &factors).analyze(&test, None).unwrap());
        let suspects = by_single_fit(&model, &weights).unwrap();
        assert_eq!(suspects.len(), 15);
        assert_eq!(suspects[0].parameter, culprit);
        assert!(
            relative_error(suspects[0].factor, 20.0) < SINGLE_FIT_FACTOR,
            "{:?}",
            suspects[0]
        );
        // All but nothing is left of the objective.
        let start = 0.5 * residuals(&model, &weights).unwrap().norm_squared();
        assert!(suspects[0].evidence <= start * (1.0 + MATRIX_ROUND_OFF));
        assert!(suspects[0].evidence > (1.0 - SINGLE_FIT_FACTOR) * start);
        assert!(
            suspects
                .windows(2)
                .all(|pair| pair[0].evidence as f32 >= pair[1].evidence as f32)
        );
    }
}
