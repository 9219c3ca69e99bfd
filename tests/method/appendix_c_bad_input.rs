//! What the perturbation refuses, rule by rule: bad input, lost roots, coalescing modes, orders of zero.

use crate::common::tolerances::{CANCELLED_DIFFERENCE, ROUND_OFF};
use crate::method::appendix_c::RULES;
use corfem::method::appendix_c::{
    SMALLEST_SEPARATION, UpdateRule, first_order, original, perturb, recursive_1,
    recursive_1_converged, recursive_2,
};
use corfem::method::error::Error;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

#[test]
fn every_rule_needs_modes() {
    for rule in RULES {
        match perturb(&DVector::zeros(0), &DMatrix::zeros(0, 0), rule) {
            Err(Error::Empty { what }) => assert_eq!(what, "modes"),
            other => panic!("{rule:?}: {other:?}"),
        }
    }
}

#[test]
fn every_rule_refuses_a_change_of_another_shape() {
    for rule in RULES {
        for (rows, columns) in [(3, 3), (2, 3), (1, 2)] {
            match perturb(&dvector![1.0, 2.0], &DMatrix::zeros(rows, columns), rule) {
                Err(Error::WrongShape {
                    what,
                    expected_rows,
                    expected_columns,
                    rows: found_rows,
                    columns: found_columns,
                }) => assert_eq!(
                    (
                        what,
                        expected_rows,
                        expected_columns,
                        found_rows,
                        found_columns
                    ),
                    ("generalized stiffness change", 2, 2, rows, columns)
                ),
                other => panic!("{rule:?}: {other:?}"),
            }
        }
    }
}

#[test]
fn every_rule_refuses_nan() {
    let beta = dmatrix![0.0, f64::NAN; 0.0, 0.0];
    for rule in RULES {
        match perturb(&dvector![1.0, 2.0], &beta, rule) {
            Err(Error::NotFinite {
                what, row, column, ..
            }) => assert_eq!((what, row, column), ("generalized stiffness change", 0, 1)),
            other => panic!("{rule:?}: {other:?}"),
        }
    }
}

#[test]
fn every_rule_starts_from_vibrations() {
    for rule in RULES {
        for bad in [0.0, -1.0, f64::INFINITY] {
            match perturb(&dvector![1.0, bad], &DMatrix::zeros(2, 2), rule) {
                Err(Error::NotAVibration { mode, value }) => assert_eq!((mode, value), (1, bad)),
                other => panic!("{rule:?}: {other:?}"),
            }
        }
        assert!(matches!(
            perturb(&dvector![f64::NAN], &DMatrix::zeros(1, 1), rule),
            Err(Error::NotAVibration { mode: 0, value }) if value.is_nan()
        ));
    }
}

#[test]
fn a_change_that_takes_all_stiffness_loses_the_root() {
    for lost in [-2.0, -3.0] {
        let beta = dmatrix![0.0, 0.0; 0.0, lost];
        for rule in RULES
            .iter()
            .filter(|&&rule| rule != UpdateRule::Eigensolution)
        {
            match perturb(&dvector![1.0, 2.0], &beta, *rule) {
                Err(Error::LostRoot { mode, value }) => {
                    assert_eq!((mode, value), (1, 1.0 / (2.0 + lost)));
                }
                other => panic!("{rule:?}: {other:?}"),
            }
        }
    }
}

#[test]
fn a_strong_coupling_loses_the_root_in_a_higher_order() {
    // First order gives roots 1 and 1/2, p = (1, -2; 2, 1); the second order of mode 1 is 1/2 - 4/2 < 0.
    let (k, beta) = (dvector![1.0, 2.0], dmatrix![0.0, 2.0; 2.0, 0.0]);
    assert!(first_order(&k, &beta).is_ok());
    match recursive_1(&k, &beta, 2) {
        Err(Error::LostRoot { mode, value }) => {
            assert_eq!(mode, 1);
            assert!((value - (0.5 - 0.5 * 2.0 * 2.0 / 2.0)).abs() < f64::EPSILON);
        }
        other => panic!("{other:?}"),
    }
    // The explicit root of mode 0 is 1/(1 + S) with S = 2 (-2) = -4.
    for result in [original(&k, &beta), recursive_2(&k, &beta, 2)] {
        match result {
            Err(Error::LostRoot { mode, value }) => {
                assert_eq!(mode, 0);
                assert!((value - 1.0 / (1.0 - 4.0)).abs() < 4.0 * f64::EPSILON);
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn modes_that_come_together_are_named() {
    // k + β is 2 for both modes, so that the denominator of row 1 in mode 0 vanishes.
    let beta = dmatrix![1.0, 0.1; 0.1, 0.0];
    for rule in RULES
        .iter()
        .filter(|&&rule| rule != UpdateRule::Eigensolution)
    {
        match perturb(&dvector![1.0, 2.0], &beta, *rule) {
            Err(Error::CoalescingModes {
                first,
                second,
                separation,
            }) => assert_eq!((first, second, separation), (1, 0, 0.0)),
            other => panic!("{rule:?}: {other:?}"),
        }
    }
    // What the recursion cannot do, the eigensolution can: 2 -+ 0.1.
    let exact = perturb(&dvector![1.0, 2.0], &beta, UpdateRule::Eigensolution).unwrap();
    let sum: f64 = exact.roots.iter().map(|root| 1.0 / root).sum();
    assert!((sum - 4.0).abs() < 10.0 * ROUND_OFF);
}

#[test]
fn modes_count_as_coalescing_below_the_smallest_separation() {
    let separated_by = |fraction: f64| {
        let k = dvector![1.0, 1.0 + fraction * SMALLEST_SEPARATION];
        first_order(&k, &DMatrix::zeros(2, 2))
    };
    assert_eq!(separated_by(2.0).unwrap().shapes, DMatrix::identity(2, 2));
    match separated_by(0.5) {
        Err(Error::CoalescingModes {
            first,
            second,
            separation,
        }) => {
            assert_eq!((first, second), (1, 0));
            assert!((separation / SMALLEST_SEPARATION - 0.5).abs() < CANCELLED_DIFFERENCE);
        }
        other => panic!("{other:?}"),
    }
    // The fraction is of the stiffness, whatever its size.
    let soft = dvector![1e-6, 1e-6 * (1.0 + 2.0 * SMALLEST_SEPARATION)];
    assert!(first_order(&soft, &DMatrix::zeros(2, 2)).is_ok());
    let stiff = dvector![1e6, 1e6 * (1.0 + 0.5 * SMALLEST_SEPARATION)];
    match first_order(&stiff, &DMatrix::zeros(2, 2)) {
        Err(Error::CoalescingModes { separation, .. }) => {
            assert!((separation / SMALLEST_SEPARATION - 0.5).abs() < CANCELLED_DIFFERENCE);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_mode_on_a_root_of_the_others_makes_the_linear_system_singular() {
    // Mode 0 stays at 1; modes 1 and 2 become [2, 2; 2, 5] with the roots 1 and 6.
    let k = dvector![1.0, 2.0, 5.0];
    let beta = dmatrix![0.0, 0.0, 0.0; 0.0, 0.0, 2.0; 0.0, 2.0, 0.0];
    assert!(original(&k, &beta).is_ok());
    match recursive_2(&k, &beta, 2) {
        Err(Error::CoalescingModes {
            first,
            second,
            separation,
        }) => assert_eq!((first, second, separation), (0, 0, 0.0)),
        other => panic!("{other:?}"),
    }
}

#[test]
fn order_zero_is_no_order() {
    let (k, beta) = (dvector![1.0, 2.0], DMatrix::zeros(2, 2));
    for result in [
        recursive_1(&k, &beta, 0),
        recursive_2(&k, &beta, 0),
        recursive_1_converged(&k, &beta, 1e-3, 0),
    ] {
        match result {
            Err(Error::Setting {
                name,
                expected,
                found,
            }) => assert_eq!((name, expected, found), ("order", "at least 1", 0.0)),
            other => panic!("{other:?}"),
        }
    }
}
