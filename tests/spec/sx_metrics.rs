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

properties! {
    #[test]
    fn scales_and_signs_change_no_coordinate_assurance(
        (analysis, test) in (shapes(5, 3), shapes(5, 3)),
        (a, b) in (scales(3), scales(3)),
    ) {
        let comac = coordinate_assurance(&analysis, &test);
        let scaled = coordinate_assurance(&(analysis * a), &(test * b));
        prop_assert!((scaled - comac).amax() < MATRIX_ROUND_OFF);
    }

    #[test]
    fn no_coordinate_assurance_is_beyond_one((analysis, test) in (shapes(5, 3), shapes(5, 3))) {
        let comac = coordinate_assurance(&analysis, &test);
        prop_assert!(comac.iter().all(|value| (0.0..=1.0).contains(value)), "{}", comac);
    }

    #[test]
    fn equal_shapes_have_assurance_one_at_every_coordinate(test in shapes(5, 3), scale in scales(3)) {
        let comac = coordinate_assurance(&test, &(&test * scale));
        prop_assert!(comac.iter().all(|value| (value - 1.0).abs() < ROUND_OFF), "{}", comac);
    }

}

#[test]
fn a_sensor_at_fault_has_the_lowest_coordinate_assurance_of_all_that_move() {
    let modes = uniform_held_modes(6, 1000.0, 0.01);
    let mut test = modes.shapes().columns(0, 4).into_owned();
    // Two cables exchanged.
    test.swap_rows(0, 3);
    let paired = modes.shapes().columns(0, 4).into_owned();
    let comac = coordinate_assurance(&paired, &test);
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
    let comac = coordinate_assurance(&analysis, &test);
    assert_eq!(comac.as_slice(), [1.0, 1.0, 0.0, 0.0]);
}
