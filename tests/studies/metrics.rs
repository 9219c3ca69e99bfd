//! Pseudo-orthogonality, modal scale factors and coordinate assurance, each by what its definition promises.

use crate::common::strategies::positive_definite;
use crate::common::tolerances::{MATRIX_ROUND_OFF, ROUND_OFF};
use corfem::closed_forms::spring_chain::uniform_held_modes;
use corfem::method::error::Error;
use corfem::method::pairing::{cross_orthogonality, modal_assurance};
use corfem::studies::metrics::{coordinate_assurance, modal_scale_factors, pseudo_orthogonality};
use nalgebra::{DMatrix, DVector, dmatrix};
use proptest::prelude::*;

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
    prop::collection::vec(one, modes)
        .prop_map(|scales| DMatrix::from_diagonal(&DVector::from_vec(scales)))
}

/// Test mode 0 with analysis mode 2, test mode 1 without, test mode 2 with analysis mode 0.
const PAIRS: [Option<usize>; 3] = [Some(2), None, Some(0)];

proptest! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn scales_and_signs_change_no_magnitude_of_pseudo_orthogonality_and_no_coordinate_assurance(
        (analysis, test) in (shapes(5, 4), shapes(5, 3)),
        (a, b) in (scales(4), scales(3)),
        (mass, _) in positive_definite(5, 1.0),
    ) {
        let pseudo = pseudo_orthogonality(&analysis, &test, &mass).unwrap();
        let scaled = pseudo_orthogonality(&(&analysis * &a), &(&test * &b), &mass).unwrap();
        prop_assert_eq!(pseudo.shape(), (4, 3));
        prop_assert!((scaled.abs() - pseudo.abs()).amax() < MATRIX_ROUND_OFF);
        let signs = |scales: &DMatrix<f64>| DMatrix::from_diagonal(&scales.diagonal().map(f64::signum));
        let signs = signs(&a) * &pseudo * signs(&b);
        prop_assert!((scaled - signs).amax() < MATRIX_ROUND_OFF, "the signs of the shapes are its signs");
        let comac = coordinate_assurance(&analysis, &test, &PAIRS).unwrap();
        let scaled = coordinate_assurance(&(analysis * a), &(test * b), &PAIRS).unwrap();
        prop_assert!((scaled - comac).amax() < MATRIX_ROUND_OFF);
    }

    #[test]
    fn no_measure_is_beyond_one((analysis, test) in (shapes(5, 4), shapes(5, 3)), (mass, _) in positive_definite(5, 1.0)) {
        let pseudo = pseudo_orthogonality(&analysis, &test, &mass).unwrap();
        prop_assert!(pseudo.amax() <= 1.0 + ROUND_OFF, "Cauchy and Schwarz: {}", pseudo);
        let comac = coordinate_assurance(&analysis, &test, &PAIRS).unwrap();
        prop_assert!(comac.iter().all(|value| (0.0..=1.0).contains(value)), "{}", comac);
    }

    #[test]
    fn equal_shapes_have_assurance_one_at_every_coordinate(test in shapes(5, 3), scale in scales(3)) {
        let pairs = [Some(0), Some(1), Some(2)];
        let comac = coordinate_assurance(&test, &(&test * scale), &pairs).unwrap();
        prop_assert!(comac.iter().all(|value| (value - 1.0).abs() < ROUND_OFF), "{}", comac);
    }

    #[test]
    fn with_a_mass_of_one_the_square_of_pseudo_orthogonality_is_modal_assurance(
        (analysis, test) in (shapes(5, 4), shapes(5, 3)),
    ) {
        let pseudo = pseudo_orthogonality(&analysis, &test, &DMatrix::identity(5, 5)).unwrap();
        let assurance = modal_assurance(&analysis, &test).unwrap();
        prop_assert!((pseudo.map(|x| x * x) - assurance).amax() < ROUND_OFF);
    }

    #[test]
    fn the_scale_factor_leaves_a_difference_orthogonal_to_the_analysis_shape(
        (analysis, test) in (shapes(5, 4), shapes(5, 3)),
    ) {
        let factors = modal_scale_factors(&analysis, &test).unwrap();
        for (i, v) in analysis.column_iter().enumerate() {
            for (j, w) in test.column_iter().enumerate() {
                prop_assert!((w - factors[(i, j)] * v).dot(&v).abs() < ROUND_OFF * 5.0);
            }
        }
    }

    #[test]
    fn the_scale_factor_of_a_multiple_is_the_multiple(analysis in shapes(5, 3), scale in scales(3)) {
        let factors = modal_scale_factors(&analysis, &(&analysis * &scale)).unwrap();
        for mode in 0..3 {
            prop_assert!((factors[(mode, mode)] / scale[(mode, mode)] - 1.0).abs() < ROUND_OFF);
        }
    }
}

#[test]
fn with_the_whole_mass_pseudo_orthogonality_of_modes_is_cross_orthogonality() {
    let modes = uniform_held_modes(6, 1000.0, 0.01).expect("a chain");
    let mass = DMatrix::from_diagonal_element(6, 6, 0.01);
    let few = modes.lowest(3).expect("modes");
    let cross = cross_orthogonality(&modes, &few, &mass).expect("it fits");
    let pseudo =
        pseudo_orthogonality(&(2.5 * modes.shapes()), few.shapes(), &mass).expect("it fits");
    assert!((pseudo - cross).amax() < MATRIX_ROUND_OFF);
}

#[test]
fn shapes_whose_squares_leave_the_range_of_numbers_are_compared_all_the_same() {
    let (analysis, test) = (dmatrix![1.0, 0.3; 0.5, -2.0], dmatrix![0.8, 1.0; 0.7, -0.5]);
    let mass = dmatrix![2.0, 0.1; 0.1, 1.0];
    let usual = pseudo_orthogonality(&analysis, &test, &mass).expect("it fits");
    for scale in [1e200, 1e-200] {
        let scaled =
            pseudo_orthogonality(&(scale * &analysis), &(&test / scale), &mass).expect("it fits");
        assert!((scaled - &usual).amax() < ROUND_OFF);
    }
}

#[test]
fn a_sensor_at_fault_has_the_lowest_coordinate_assurance_of_all_that_move() {
    let modes = uniform_held_modes(6, 1000.0, 0.01).expect("a chain");
    let mut test = modes.shapes().columns(0, 4).into_owned();
    // Two cables exchanged.
    test.swap_rows(0, 3);
    let pairs = [Some(0), Some(1), Some(2), Some(3)];
    let comac = coordinate_assurance(modes.shapes(), &test, &pairs).expect("pairs");
    let mut order: Vec<usize> = (0..6).collect();
    order.sort_by(|a, b| comac[*a].total_cmp(&comac[*b]));
    order.truncate(2);
    order.sort_unstable();
    assert_eq!(order, [0, 3], "{comac}");
}

#[test]
fn coordinates_that_do_not_move_are_as_good_as_they_agree() {
    let analysis = dmatrix![1.0; 0.0; 0.0; 1.0];
    let test = dmatrix![1.0; 0.0; 0.5; 0.0];
    let comac = coordinate_assurance(&analysis, &test, &[Some(0)]).expect("a pair");
    assert_eq!(comac.as_slice(), [1.0, 1.0, 0.0, 0.0]);
}

#[test]
fn what_does_not_fit_is_refused() {
    let (two, three) = (
        DMatrix::<f64>::identity(2, 2),
        DMatrix::<f64>::identity(3, 3),
    );
    let zero = DMatrix::<f64>::zeros(2, 1);
    let wrong = |error: Option<Error>| matches!(error, Some(Error::WrongShape { .. }));
    assert!(
        wrong(pseudo_orthogonality(&three, &two, &two).err())
            && wrong(pseudo_orthogonality(&two, &three, &two).err())
    );
    assert!(wrong(modal_scale_factors(&two, &three).err()));
    assert!(wrong(coordinate_assurance(&two, &three, &[None; 3]).err()));
    assert!(wrong(coordinate_assurance(&two, &two, &[Some(0)]).err()));
    assert!(matches!(
        coordinate_assurance(&two, &two, &[None; 2]),
        Err(Error::Empty { .. })
    ));
    assert!(matches!(
        coordinate_assurance(&two, &two, &[None, Some(2)]),
        Err(Error::Unknown { label: 2, .. })
    ));
    assert!(matches!(
        coordinate_assurance(&two, &zero, &[Some(0)]),
        Err(Error::NotPositive { .. })
    ));
    assert!(matches!(
        modal_scale_factors(&zero, &two),
        Err(Error::NotPositive { .. })
    ));
    let negative = -DMatrix::<f64>::identity(2, 2);
    assert!(matches!(
        pseudo_orthogonality(&two, &two, &negative),
        Err(Error::NotPositive {
            what: "generalized mass",
            ..
        })
    ));
    assert!(matches!(
        pseudo_orthogonality(&(f64::NAN * &two), &two, &two),
        Err(Error::NotFinite { .. })
    ));
}
