//! Why elements and not matrices: the comparison's numbers by other routes, and what they show.

use crate::evidence::by_matrix::{TEST_MODES, baruch_stiffness, compare, tested_and_doubled};
use crate::prelude::*;

#[test]
fn element_factors_are_analyzed_anew_and_matrices_are_added_to() {
    for case in [1, 2, 3].map(case_of) {
        let ([_, truth, elements, baruch], found) = compare(&case);
        let of = |gages: &[f64]| tested_and_doubled(&case, gages);
        let [first, doubled] = of(&case.first_gages());
        let design_change = &doubled.stiffness - &first.stiffness;
        let test = case.test_modes().unwrap().lowest(TEST_MODES).unwrap();
        let corrected = baruch_stiffness(&first.stiffness, &first.mass, &test);
        let by_matrix = [corrected.clone(), corrected + design_change];
        let right = of(&[TEST_GAGE; 15]).map(|own| own.stiffness);
        assert_eq!(truth.stiffness, right[0]);
        for (own, stiffnesses) in [
            (&elements, of(&found).map(|own| own.stiffness)),
            (&baruch, by_matrix),
        ] {
            for ((stiffness, right), errors) in stiffnesses.iter().zip(&right).zip(&own.errors) {
                // Modes keep their order here, so that pairing them is no more than counting.
                let [modes, truth] = [stiffness, right]
                    .map(|own| solve(own, &first.mass, 9).unwrap().frequencies_hz());
                for mode in 0..9 {
                    assert_within(
                        errors[mode],
                        modes[mode] / truth[mode] - 1.0,
                        EIGEN_ROUND_OFF,
                    );
                }
            }
            assert_within(
                (&own.stiffness - &stiffnesses[0]).amax() / first.stiffness.amax(),
                0.0,
                CORRECTION_ROUND_OFF,
            );
        }
    }
}

#[test]
fn matrix_corrections_have_the_test_modes_and_leave_the_others() {
    for case in [1, 2, 3].map(case_of) {
        let ([initial, _, elements, baruch], _) = compare(&case);
        let largest = |errors: &[f64]| errors.iter().map(|error| error.abs()).largest();
        let [initial, elements, baruch] =
            [initial, elements, baruch].map(|own| own.errors[0].clone());
        assert!(largest(&baruch[..TEST_MODES]) <= CORRECTION_ROUND_OFF);
        for (found, before) in baruch.iter().zip(&initial).skip(TEST_MODES) {
            assert_within(found, before, UNMEASURED_MODE);
        }
        let [elements, initial] = [elements, initial].map(|errors| largest(&errors[TEST_MODES..]));
        assert!(elements < 0.5 * initial);
    }
}
