//! What of a change of the matrix elements could have made.

use crate::evidence::claims::matrix_comparison::{TEST_MODES, by_name, compared, gages, model};
use crate::evidence::matrix_correction::{baruch_stiffness, weighted_norm};
use crate::prelude::*;

#[test]
fn nearest_factors_leave_the_least() {
    for case in 1..=3 {
        let comparison = compared(case);
        let first = model(case, &gages(case, &[1.0; 15], false));
        let test = case_of(case)
            .test_modes()
            .unwrap()
            .lowest(TEST_MODES)
            .unwrap();
        let corrected = baruch_stiffness(&first.stiffness, &first.mass, &test);
        let change: DMatrix<f64> = corrected - &first.stiffness;
        let left = |factors: &[f64]| {
            let made = first.shares.iter().zip(factors);
            let made: DMatrix<f64> = made.map(|(share, c)| (c - 1.0) * share).sum();
            weighted_norm(&(&change - made), &first.mass) / weighted_norm(&change, &first.mass)
        };
        let nearest = comparison
            .factors
            .iter()
            .map(|f| f.nearest_to_baruch)
            .collect_vec();
        let least = left(&nearest);
        let beyond = by_name(&comparison, "Baruch").beyond_elements;
        assert!(
            (least - beyond).abs() <= CORRECTION_ROUND_OFF,
            "{least} {beyond}"
        );
        for element in 0..15 {
            for step in [-0.01, 0.01] {
                let mut other = nearest.clone();
                other[element] += step;
                assert!(left(&other) > least);
            }
        }
        // What elements did change can be made of elements, but for the new B; what matrices did cannot.
        assert!(by_name(&comparison, "Truth").beyond_elements < 0.006);
        assert!(by_name(&comparison, "Element factors").beyond_elements < 0.006);
        assert!(beyond > 0.1, "{beyond}");
    }
}

#[test]
fn like_covers_share_a_change_equally() {
    // Upper and lower covers of Case 2 have one share between them at its start.
    let comparison = compared(2);
    for (upper, lower) in [(2, 15), (4, 8), (9, 11)] {
        let factor = |element: usize| comparison.factors[element - 1].nearest_to_baruch;
        assert!((factor(upper) - factor(lower)).abs() < CORRECTION_ROUND_OFF);
    }
}
