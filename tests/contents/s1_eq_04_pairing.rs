//! Mode sorting (4): every test mode gets its own analysis mode, whatever the order and signs they come in.

use crate::common::pairings::cross_with_ties;
use crate::prelude::*;

fn assert_is_injective(pairing: &Pairing, cross: &DMatrix<f64>) {
    assert_eq!(pairing.analysis_mode.len(), cross.ncols());
    assert_eq!(pairing.sign.len(), cross.ncols());
    let mut taken = vec![false; cross.nrows()];
    for &i in &pairing.analysis_mode {
        assert!(!taken[i], "analysis mode {i} taken twice");
        taken[i] = true;
    }
}

properties! {
    #[test]
    fn every_test_mode_gets_its_own_analysis_mode(cross in cross()) {
        assert_is_injective(&pair_modes(&cross)?, &cross);
    }

    #[test]
    fn ties_go_to_the_lower_modes(cross in cross_with_ties()) {
        let pairing = pair_modes(&cross)?;
        assert_is_injective(&pairing, &cross);
        prop_assert_eq!(pairing.analysis_mode, pairs_by_sorting(&cross));
    }

    #[test]
    fn the_closest_pair_is_made_first(cross in cross()) {
        let found = pair_modes(&cross)?;
        prop_assert_eq!(found.analysis_mode, pairs_by_sorting(&cross));
    }

    #[test]
    fn signs_are_those_of_the_paired_entries(cross in cross()) {
        let pairing = pair_modes(&cross)?;
        for j in 0..cross.ncols() {
            let entry = cross[(pairing.analysis_mode[j], j)];
            prop_assert_eq!(pairing.sign[j].abs(), 1.0);
            prop_assert!(pairing.sign[j] * entry >= 0.0);
        }
    }

    #[test]
    fn order_and_signs_are_recovered_under_noise((cross, pairs) in noisy_pairs()) {
        let pairing = pair_modes(&cross)?;
        prop_assert_eq!(pairing.analysis_mode, pairs.order);
        prop_assert_eq!(pairing.sign, pairs.sign);
    }

    #[test]
    fn pairing_does_not_depend_on_order_or_sign_of_the_analysis_modes(
        cross in cross(),
        change in rearrangement(7),
    ) {
        let count = cross.nrows();
        let keep = (0..7).filter(|&place| change.order[place] < count).collect_vec();
        let order = keep.iter().map(|&place| change.order[place]).collect_vec();
        let mut rearranged = cross.select_rows(&order);
        for (row, &place) in keep.iter().enumerate() {
            rearranged.row_mut(row).scale_mut(change.sign[place]);
        }
        // Equal entries may change hands when the order does.
        let mut magnitudes = cross.iter().map(|m| (m.abs() - 1.0).abs()).collect_vec();
        magnitudes.sort_by(f64::total_cmp);
        prop_assume!(magnitudes.windows(2).all(|pair| pair[0] < pair[1]));
        let (before, after) = (pair_modes(&cross)?, pair_modes(&rearranged)?);
        for j in 0..cross.ncols() {
            let place = after.analysis_mode[j];
            prop_assert_eq!(order[place], before.analysis_mode[j]);
            prop_assert_eq!(after.sign[j], before.sign[j] * change.sign[keep[place]]);
        }
    }

    #[test]
    fn modes_are_orthogonal_to_each_other_and_not_to_themselves((stiffness, mass, condition) in pencil()) {
        let modes = solve(&stiffness, &mass, stiffness.nrows())?;
        let cross = cross_orthogonality(&modes, &modes, &mass)?;
        prop_assert_eq!(cross.shape(), (modes.len(), modes.len()));
        let error = (cross - eye(modes.len())).amax();
        prop_assert!(error <= MATRIX_ROUND_OFF * condition, "{error:e}");
    }

    #[test]
    fn modal_assurance_does_not_depend_on_scale(
        shapes in orthogonal(4),
        scales in prop::collection::vec((0.01..100.0_f64, any::<bool>()), 4),
    ) {
        let mut scaled = shapes.clone();
        for (mut column, (scale, flip)) in scaled.column_iter_mut().zip(scales) {
            column *= if flip { -scale } else { scale };
        }
        let mac = modal_assurance(&shapes, &scaled)?;
        let error = (mac - eye(4)).amax();
        prop_assert!(error <= ROUND_OFF, "{error:e}");
    }
}

#[test]
fn on_a_conflict_the_closest_keeps_its_mode_and_the_other_takes_its_next_best() {
    // Both test modes want analysis mode 0; the second is closer, so the first takes 0.6 of mode 2.
    let cross = dmatrix![0.90, -0.95; 0.30, 0.70; -0.60, 0.20];
    let pairing = pair_modes(&cross).unwrap();
    assert_eq!(pairing.analysis_mode, [2, 0]);
    assert_eq!(pairing.sign, [-1.0, -1.0]);
}

#[test]
fn closest_to_one_is_not_largest() {
    let cross = dmatrix![1.3, 0.1; 0.8, 1.1];
    let pairing = pair_modes(&cross).unwrap();
    // 1.1 is the closest of all; 1.3 is what is left to the first.
    assert_eq!(pairing.analysis_mode, [0, 1]);
    let alone = pair_modes(&dmatrix![1.3; 0.8]).unwrap();
    assert_eq!(alone.analysis_mode, [1]);
}

#[test]
fn a_shape_without_a_sign_keeps_its_own() {
    let pairing = pair_modes(&dmatrix![0.0]).unwrap();
    assert_eq!(pairing.analysis_mode, [0]);
    assert_eq!(pairing.sign, [1.0]);
}

#[test]
fn cross_orthogonality_by_hand() {
    let modes = |shapes: DMatrix<f64>| {
        Modes::new(DVector::from_element(shapes.ncols(), 1.0), shapes).unwrap()
    };
    let analysis = modes(dmatrix![1.0, 2.0, 0.0; 0.0, 1.0, -1.0]);
    let test = modes(dmatrix![3.0; 5.0]);
    let mass = dmatrix![2.0, 1.0; 1.0, 4.0];
    // M w = (11, 23).
    let cross = cross_orthogonality(&analysis, &test, &mass).unwrap();
    assert_eq!(cross, dmatrix![11.0; 45.0; -23.0]);
}

#[test]
fn paired_by_hand() {
    let analysis = Modes::new(
        dvector![1.0, 4.0, 9.0],
        dmatrix![1.0, 2.0, 3.0; 4.0, 5.0, 6.0],
    )
    .unwrap();
    let pairing = Pairing {
        analysis_mode: vec![2, 0],
        sign: vec![-1.0, 1.0],
    };
    let paired = pairing.paired(&analysis).unwrap();
    assert_eq!(*paired.omega_squared(), dvector![9.0, 1.0]);
    assert_eq!(*paired.shapes(), dmatrix![-3.0, 1.0; -6.0, 4.0]);
}

#[test]
fn modal_assurance_by_hand() {
    // (1, 2) and (3, 1): 25 over 5 times 10; (1, 2) and (-2, 1) are orthogonal.
    let mac = modal_assurance(&dmatrix![1.0; 2.0], &dmatrix![3.0, -2.0; 1.0, 1.0]).unwrap();
    assert_eq!(mac, dmatrix![0.5, 0.0]);
}

/// The squares of such components are no numbers, and the assurance does not depend on scale.
#[test]
fn modal_assurance_of_very_large_and_small_shapes_is_theirs() {
    let shapes = dmatrix![1.0, 2.0; 3.0, -1.0; 0.5, 4.0];
    let expected = modal_assurance(&shapes, &shapes).unwrap();
    for scale in [1e-300, 1e-200, 1e200, 1e300] {
        let found = modal_assurance(&(&shapes * scale), &(&shapes / 7.0)).unwrap();
        assert!((found - &expected).amax() <= MATRIX_ROUND_OFF, "{scale:e}");
        let found = modal_assurance(&(&shapes / 7.0), &(&shapes * scale)).unwrap();
        assert!((found - &expected).amax() <= MATRIX_ROUND_OFF, "{scale:e}");
    }
}
