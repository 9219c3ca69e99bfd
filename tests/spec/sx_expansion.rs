//! Test shapes from the sensors to all degrees of freedom.

use crate::prelude::*;
use corfem::job::expansion::expand;

/// Where the sensors of a chain of eight are.
const SENSORS: [usize; 4] = [1, 3, 4, 7];

fn modes() -> DMatrix<f64> {
    uniform_held_modes(8, 1000.0, 0.01)
        .shapes()
        .columns(0, 3)
        .into_owned()
}

properties! {
    #[test]
    fn shapes_in_the_span_of_the_modes_are_reproduced(shares in prop::collection::vec(-1.0..1.0_f64, 6)) {
        let all = modes();
        let shapes = &all * DMatrix::from_vec(3, 2, shares);
        let expanded = expand(&all, &all.select_rows(&SENSORS), &shapes.select_rows(&SENSORS), 0.0).unwrap();
        prop_assert!((expanded - &shapes).amax() < MATRIX_ROUND_OFF * all.amax());
    }

    #[test]
    fn what_the_sensors_measured_otherwise_is_orthogonal_to_the_modes_there(
        measured in prop::collection::vec(-1.0..1.0_f64, 4),
        scale in -12..12,
    ) {
        let (all, measured) = (modes() * 10_f64.powi(scale), DMatrix::from_vec(4, 1, measured));
        let at_sensors = all.select_rows(&SENSORS);
        let expanded = expand(&all, &at_sensors, &measured, 0.0).unwrap();
        let left = measured - expanded.select_rows(&SENSORS);
        prop_assert!(at_sensors.tr_mul(&left).amax() < MATRIX_ROUND_OFF * at_sensors.amax());
    }
}

#[test]
fn with_the_mass_by_modes_they_are_orthonormal_and_a_test_shape_weighs_what_its_nearest_combination_does()
 {
    let at_sensors = modes().select_rows(&SENSORS);
    let mass = mass_by_modes(&at_sensors, 0.0).unwrap();
    assert!((at_sensors.tr_mul(&(&mass * &at_sensors)) - eye(3)).amax() < MATRIX_ROUND_OFF);
    let measured = dmatrix![0.3; -1.0; 0.8; 0.1];
    let shares = expand(&eye(3), &at_sensors, &measured, 0.0).unwrap();
    let weight = (measured.tr_mul(&(&mass * &measured)))[(0, 0)];
    assert!(
        relative_error(weight, shares.norm_squared()) < MATRIX_ROUND_OFF,
        "{weight}"
    );
    assert_eq!(mass_by_modes(&DMatrix::identity(2, 3), 0.0), None);
}

#[test]
fn sensors_that_cannot_tell_the_modes_apart_are_refused() {
    let all = modes();
    let few = |rows: &[usize]| {
        expand(
            &all,
            &all.select_rows(rows),
            &DMatrix::identity(rows.len(), 1),
            0.0,
        )
    };
    assert_eq!([few(&[1, 3]), few(&[1, 3, 3, 1])], [None, None]);
    let unseen = dmatrix![1.0, 0.0; 2.0, 0.0; 0.5, 0.0];
    let twice = dmatrix![1.0, -2.0, 0.0; 0.0, 0.0, 1.0; 0.5, -1.0, 0.0];
    for all in [unseen, twice, DMatrix::zeros(2, 0), f64::NAN * eye(2)] {
        let test = DMatrix::identity(all.nrows(), 1);
        assert_eq!(expand(&all, &all, &test, 0.0), None);
    }
}

#[test]
fn modes_are_dependent_that_differ_by_a_billionth_of_their_length() {
    // Of two unit columns at a small angle the singular values are the root of two, and the angle over it.
    let at = |angle: f64| {
        let two = dmatrix![1.0, 1.0; 0.0, angle];
        expand(&two, &two, &dmatrix![1.0; 0.0], 0.0)
    };
    assert_eq!(at(1.9e-9), None);
    assert!(at(2.1e-9).is_some());
}
