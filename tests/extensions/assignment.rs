//! The pairing with the largest total, beside all pairings there are.

use crate::prelude::*;

/// The largest total of test modes from `test` on, by trying every analysis mode that is left, and none.
fn largest_total(closeness: &DMatrix<f64>, test: usize, taken: &mut Vec<usize>) -> f64 {
    if test == closeness.ncols() {
        return 0.0;
    }
    let mut best = largest_total(closeness, test + 1, taken);
    for analysis in 0..closeness.nrows() {
        if closeness[(analysis, test)] >= 0.0 && !taken.contains(&analysis) {
            taken.push(analysis);
            best =
                best.max(closeness[(analysis, test)] + largest_total(closeness, test + 1, taken));
            taken.pop();
        }
    }
    best
}

fn total(closeness: &DMatrix<f64>, pairs: &[Option<usize>]) -> f64 {
    pairs
        .iter()
        .enumerate()
        .filter_map(|(test, mode)| Some(closeness[((*mode)?, test)]))
        .sum()
}

/// Up to six modes on either side; half of the matrices have few different numbers, and so ties.
fn closeness() -> impl Strategy<Value = DMatrix<f64>> {
    (0..=6_usize, 0..=6_usize, any::<bool>()).prop_flat_map(|(analysis, test, ties)| {
        prop::collection::vec(-0.2..1.0_f64, analysis * test).prop_map(move |mut values| {
            values
                .iter_mut()
                .filter(|_| ties)
                .for_each(|value| *value = (3.0 * *value).round() / 3.0);
            DMatrix::from_vec(analysis, test, values)
        })
    })
}

properties! {
    #[test]
    fn the_total_is_the_largest_of_all_pairings(closeness in closeness()) {
        let pairs = pair_optimally(&closeness)?;
        let best = largest_total(&closeness, 0, &mut Vec::new());
        prop_assert!((total(&closeness, &pairs) - best).abs() < ROUND_OFF * 6.0, "{:?}", pairs);
    }

    #[test]
    fn no_mode_has_two_partners_and_no_pair_is_below_zero(closeness in closeness()) {
        let pairs = pair_optimally(&closeness)?;
        prop_assert_eq!(pairs.len(), closeness.ncols());
        let mut taken = pairs.iter().flatten().copied().collect_vec();
        taken.sort_unstable();
        prop_assert!(taken.windows(2).all(|pair| pair[0] != pair[1]), "{:?}", pairs);
        for (test, mode) in pairs.iter().enumerate() {
            prop_assert!(mode.is_none_or(|mode| closeness[(mode, test)] >= 0.0));
        }
    }

    #[test]
    fn no_other_pairing_of_the_method_has_a_larger_total(closeness in closeness()) {
        // The method's own needs a test mode, and an analysis mode for each.
        let closeness = if closeness.ncols() > closeness.nrows() { closeness.transpose() } else { closeness };
        let closeness = closeness.abs().resize_horizontally(closeness.ncols().max(1), 0.5).resize_vertically(closeness.nrows().max(1), 0.5);
        let closest_first = pair_modes(&closeness)?.analysis_mode.iter().copied().map(Some).collect_vec();
        let pairs = pair_optimally(&closeness)?;
        prop_assert!(total(&closeness, &pairs) >= total(&closeness, &closest_first) - ROUND_OFF * 6.0);
    }
}

/// Two nearly equal test modes that both look like analysis mode 0: the first takes it by 0.01, and the second is left with nothing.
#[test]
fn two_test_modes_that_look_like_one_analysis_mode_are_both_paired() {
    let closeness = dmatrix![0.91, 0.90; 0.88, 0.05];
    let closest_first = pair_modes(&closeness).unwrap().analysis_mode.to_vec();
    assert_eq!(closest_first, [0, 1]);
    assert_eq!(pair_optimally(&closeness).unwrap(), [Some(1), Some(0)]);
}

#[test]
fn modes_that_are_all_alike_are_paired_in_their_order_and_the_last_are_left_over() {
    let alike =
        |analysis, test| pair_optimally(&DMatrix::from_element(analysis, test, 0.5)).unwrap();
    assert_eq!(alike(4, 3), [Some(0), Some(1), Some(2)]);
    assert_eq!(alike(2, 4), [Some(0), Some(1), None, None]);
    assert_eq!(alike(0, 2), [None, None]);
    assert_eq!(alike(2, 0), [None; 0]);
    // A pair that counts nothing is still a pair.
    assert_eq!(pair_optimally(&zero_square(2)).unwrap(), [Some(0), Some(1)]);
}

/// Two pairs of 0.6 have a larger total than one of 1.0 with nothing beside it, but not one of 0.6 with one that is no pair.
#[test]
fn what_is_below_zero_is_no_pair() {
    let closeness = |other: f64| dmatrix![1.0, 0.6; other, 0.0];
    let pairs = |other: f64| pair_optimally(&closeness(other)).unwrap();
    assert_eq!(pairs(0.6), [Some(1), Some(0)]);
    assert_eq!(pairs(-0.6), [Some(0), Some(1)]);
}

#[test]
fn numbers_that_are_none_are_refused() {
    assert!(matches!(
        pair_optimally(&dmatrix![f64::NAN]),
        Err(Error::Value {
            what: "closeness",
            ..
        })
    ));
}
