//! Coordinate assurance by what its definition promises.

use crate::prelude::*;

/// Shapes none of which is near zero.
fn shapes(dof: usize, modes: usize) -> impl Strategy<Value = DMatrix<f64>> {
    prop::collection::vec(-1.0..1.0_f64, dof * modes).prop_map(move |values| {
        let mut shapes = DMatrix::from_vec(dof, modes, values);
        (0..modes).for_each(|mode| {
            shapes[(mode % dof, mode)] += if shapes[(mode % dof, mode)] < 0.0 {
                -0.5
            } else {
                0.5
            }
        });
        shapes
    })
}

/// Scales of either sign, from a thousandth to a thousand.
fn scales(modes: usize) -> impl Strategy<Value = DMatrix<f64>> {
    let one = (-3.0..3.0_f64, any::<bool>())
        .prop_map(|(decade, minus)| 10_f64.powf(decade) * if minus { -1.0 } else { 1.0 });
    prop::collection::vec(one, modes).prop_map(diagonal)
}

/// Test mode 0 with analysis mode 2, test mode 1 without, test mode 2 with analysis mode 0.
const PAIRS: [Option<usize>; 3] = [Some(2), None, Some(0)];

properties! {
    #[test]
    fn scales_and_signs_change_no_coordinate_assurance(
        (analysis, test) in (shapes(5, 4), shapes(5, 3)),
        (a, b) in (scales(4), scales(3)),
    ) {
        let comac = coordinate_assurance(&analysis, &test, &PAIRS)?;
        let scaled = coordinate_assurance(&(analysis * a), &(test * b), &PAIRS)?;
        prop_assert!((scaled - comac).amax() < MATRIX_ROUND_OFF);
    }

    #[test]
    fn no_coordinate_assurance_is_beyond_one((analysis, test) in (shapes(5, 4), shapes(5, 3))) {
        let comac = coordinate_assurance(&analysis, &test, &PAIRS)?;
        prop_assert!(comac.iter().all(|value| (0.0..=1.0).contains(value)), "{}", comac);
    }

    #[test]
    fn equal_shapes_have_assurance_one_at_every_coordinate(test in shapes(5, 3), scale in scales(3)) {
        let pairs = [Some(0), Some(1), Some(2)];
        let comac = coordinate_assurance(&test, &(&test * scale), &pairs)?;
        prop_assert!(comac.iter().all(|value| (value - 1.0).abs() < ROUND_OFF), "{}", comac);
    }

}

#[test]
fn a_sensor_at_fault_has_the_lowest_coordinate_assurance_of_all_that_move() {
    let modes = uniform_held_modes(6, 1000.0, 0.01);
    let mut test = modes.shapes().columns(0, 4).into_owned();
    // Two cables exchanged.
    test.swap_rows(0, 3);
    let pairs = [Some(0), Some(1), Some(2), Some(3)];
    let comac = coordinate_assurance(modes.shapes(), &test, &pairs).unwrap();
    let mut order = (0..6).collect_vec();
    order.sort_by(|a, b| comac[*a].total_cmp(&comac[*b]));
    order.truncate(2);
    order.sort_unstable();
    assert_eq!(order, [0, 3], "{comac}");
}

#[test]
fn coordinates_that_do_not_move_are_as_good_as_they_agree() {
    let analysis = dmatrix![1.0; 0.0; 0.0; 1.0];
    let test = dmatrix![1.0; 0.0; 0.5; 0.0];
    let comac = coordinate_assurance(&analysis, &test, &[Some(0)]).unwrap();
    assert_eq!(comac.as_slice(), [1.0, 1.0, 0.0, 0.0]);
}

#[test]
fn what_does_not_fit_is_refused() {
    let (two, three) = (eye(2), eye(3));
    let (zero, no_number) = (DMatrix::zeros(2, 1), f64::NAN * &two);
    for (analysis, test, pairs, words) in [
        (&two, &two, &[Some(0), None][..], "an answer"),
        (
            &two,
            &three,
            &[None; 3],
            "test mode shapes: 3 x 3 instead of 2 x 3",
        ),
        (&two, &two, &[Some(0)], "pairs: 1 x 1 instead of 2 x 1"),
        (
            &two,
            &two,
            &[None; 2],
            "pairs: 0 given or asked for; there must be at least 1",
        ),
        (
            &two,
            &two,
            &[None, Some(2)],
            "pairs: there is no analysis mode (from zero) 2",
        ),
        (
            &two,
            &zero,
            &[Some(0)],
            "largest component of paired test mode 0 (from zero) is 0; it must be positive and finite",
        ),
        (
            &no_number,
            &two,
            &[Some(0), None],
            "mode shapes of entry (0, 0) is NaN; it must be a finite number",
        ),
    ] {
        assert_eq!(said(coordinate_assurance(analysis, test, pairs)), words);
    }
}
