//! The strategies of vibrating systems themselves: what they draw is what their descriptions promise.

use crate::common::pairings::counts;
use crate::prelude::*;

properties! {
    #[test]
    fn pencils_are_definite_with_their_condition((stiffness, mass, condition) in pencil()) {
        prop_assert!((1..=6).contains(&stiffness.nrows()));
        prop_assert_eq!(stiffness.shape(), mass.shape());
        let spread = |matrix: &DMatrix<f64>| {
            let values = matrix.symmetric_eigenvalues();
            (values.min(), values.max() / values.min())
        };
        let ((softest, stiffness_spread), (lightest, mass_spread)) = (spread(&stiffness), spread(&mass));
        prop_assert!(softest > 0.9 && lightest > 0.9);
        prop_assert!(stiffness_spread <= 1.1e10 && condition <= 1e4 * (1.0 + ROUND_OFF));
        prop_assert!(relative_error(mass_spread, condition) <= MATRIX_ROUND_OFF * condition);
    }

    #[test]
    fn full_changes_couple_every_pair_of_separate_modes(change in full_change(4)) {
        let (k, s) = (&change.stiffness, &change.direction);
        prop_assert!((100.0..=200.0).contains(&k[0]));
        for i in 1..4 {
            prop_assert!((2.0..4.0 + ROUND_OFF).contains(&(k[i] / k[i - 1])));
        }
        prop_assert_eq!(s, &s.transpose());
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            let coupling = s[(i, j)].abs() / (k[i] * k[j]).sqrt();
            prop_assert!((0.5 - ROUND_OFF..=1.0).contains(&coupling));
        }
        prop_assert_eq!(change.beta(0.5), 0.5 * s);
    }

    #[test]
    fn any_changes_reach_beyond_the_perturbation(change in any_change()) {
        let (k, s) = (&change.stiffness, &change.direction);
        prop_assert!((1..=5).contains(&k.len()));
        prop_assert_eq!(s.shape(), (k.len(), k.len()));
        prop_assert!((s - s.transpose()).amax() <= ROUND_OFF * k.amax());
        prop_assert!(s.amax() <= 3.0 * k.amax());
    }

    #[test]
    fn chains_have_separate_modes(chain in chain(5)) {
        let model = chain.model(&[1.0; 5]);
        prop_assert_eq!(model.shares.len(), 5);
        let (roots, _) = modes_by_nalgebra(&model.stiffness, &model.mass);
        for i in 1..5 {
            prop_assert!(roots[i] > roots[i - 1] * (1.0 + 1e-6), "{roots}");
        }
    }

    #[test]
    fn truths_are_ten_to_forty_percent_off((chain, truth) in chain_and_truth()) {
        prop_assert!((3..=5).contains(&truth.len()));
        prop_assert_eq!((chain.springs.len(), chain.masses.len()), (truth.len(), truth.len()));
        for factor in truth {
            let off = factor.max(1.0 / factor);
            prop_assert!((1.1 - ROUND_OFF..=1.4 + ROUND_OFF).contains(&off));
        }
    }

    #[test]
    fn rearrangements_are_permutations_with_signs(change in rearrangement(6)) {
        let mut order = change.order.clone();
        order.sort_unstable();
        prop_assert_eq!(order, (0..6).collect_vec());
        prop_assert!(change.sign.iter().all(|sign| sign.abs() == 1.0));
        let matrix = DMatrix::from_fn(2, 6, |row, column| (row * 6 + column) as f64);
        prop_assert_eq!(change.rows(&matrix.transpose()).transpose(), change.columns(&matrix));
    }

    #[test]
    fn there_are_no_more_test_modes_than_analysis_modes(
        (analysis, test) in counts(),
        cross in cross(),
        (noisy, pairs) in noisy_pairs(),
    ) {
        prop_assert!((1..=7).contains(&analysis) && (1..=analysis).contains(&test));
        prop_assert!(cross.ncols() <= cross.nrows() && cross.amax() <= 1.2);
        prop_assert_eq!(pairs.order.len(), noisy.ncols());
        for j in 0..noisy.ncols() {
            for i in 0..noisy.nrows() {
                let size = noisy[(i, j)].abs();
                if i == pairs.order[j] {
                    prop_assert!((0.65..=1.35).contains(&size));
                } else {
                    prop_assert!(size <= 0.35);
                }
            }
        }
    }

    #[test]
    fn inner_loops_start_within_their_limits(given in given()) {
        let count = given.truth.len();
        prop_assert_eq!((given.base.len(), given.total_ranges.len()), (count, count));
        for (base, range) in given.base.iter().zip(&given.total_ranges) {
            prop_assert!(range.is_none_or(|range| range.contains(*base)));
        }
        prop_assert!(given.settings.factor_range.contains(1.0));
    }
}

properties! {
    #![proptest_config(costly_config())]

    #[test]
    fn uneven_boxes_have_uneven_gages(case in uneven_box()) {
        prop_assert_eq!(case.panels.len(), 15);
        prop_assert!(case.panels.iter().all(|panel| (0.008..0.013).contains(&panel.gage)));
    }
}

#[test]
fn rearranged_columns_by_hand() {
    let change = crate::common::pairings::Rearrangement {
        order: vec![2, 0],
        sign: vec![-1.0, 1.0],
    };
    let found = change.columns(&dmatrix![1.0, 2.0, 3.0; 4.0, 5.0, 6.0]);
    assert_eq!(found, dmatrix![-3.0, 1.0; -6.0, 4.0]);
}

#[test]
fn the_slope_of_a_power_is_its_exponent() {
    let cubic: Vec<(f64, f64)> = [1.0, 2.0, 5.0].map(|x: f64| (x, 7.0 * x.powi(3))).into();
    assert!((log_log_slope(&cubic) - 3.0).abs() <= ROUND_OFF);
}
