//! What the perturbation refuses, rule by rule: bad input, lost roots, coalescing modes, roots that do not settle, orders of
//! zero.

use crate::common::appendix_c::{
    FORMULAE, exact, largest_change, original, recursive_2, rules, stiffness_rules,
};
use crate::common::assert_refused;
use crate::common::tolerances::{CANCELLED_DIFFERENCE, ROUND_OFF};
use corfem::method::appendix_c::{
    LARGEST_UNSETTLED_CHANGE, SMALLEST_SEPARATION, first_order, recursive_1, recursive_1_converged,
};
use corfem::method::error::Error;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

#[test]
fn every_rule_needs_modes() {
    for rule in rules() {
        match (rule.plain)(&DVector::zeros(0), &DMatrix::zeros(0, 0)) {
            Err(Error::Empty { what }) => assert_eq!(what, "modes"),
            other => panic!("{}: {other:?}", rule.name),
        }
    }
}

#[test]
fn every_rule_refuses_a_change_of_another_shape() {
    for rule in rules() {
        for (rows, columns) in [(3, 3), (2, 3), (1, 2)] {
            match (rule.plain)(&dvector![1.0, 2.0], &DMatrix::zeros(rows, columns)) {
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
                other => panic!("{}: {other:?}", rule.name),
            }
        }
    }
}

#[test]
fn every_rule_refuses_nan() {
    let beta = dmatrix![0.0, f64::NAN; 0.0, 0.0];
    for rule in rules() {
        match (rule.plain)(&dvector![1.0, 2.0], &beta) {
            Err(Error::NotFinite {
                what, row, column, ..
            }) => {
                assert_eq!((what, row, column), ("generalized stiffness change", 0, 1))
            }
            other => panic!("{}: {other:?}", rule.name),
        }
    }
}

#[test]
fn every_formula_of_the_loops_starts_from_vibrations() {
    for rule in stiffness_rules() {
        for bad in [0.0, -1.0, f64::INFINITY] {
            match (rule.plain)(&dvector![1.0, bad], &DMatrix::zeros(2, 2)) {
                Err(Error::NotAVibration { mode, value }) => assert_eq!((mode, value), (1, bad)),
                other => panic!("{}: {other:?}", rule.name),
            }
        }
        assert!(matches!(
            (rule.plain)(&dvector![f64::NAN], &DMatrix::zeros(1, 1)),
            Err(Error::NotAVibration { mode: 0, value }) if value.is_nan()
        ));
    }
}

/// It works on roots as well as on stiffnesses, and says which of the two is not a number it can use.
#[test]
fn the_eigensolution_starts_from_vibrations() {
    let from = |bad: f64| exact(&dvector![1.0, bad], &DMatrix::zeros(2, 2));
    assert!(matches!(
        from(0.0),
        Err(Error::NotFinite { what: "roots", row: 1, value, .. }) if value == f64::INFINITY
    ));
    // Modes of the eigensolution are numbered in ascending order: the one that is no vibration comes first.
    assert!(matches!(
        from(-1.0),
        Err(Error::NotAVibration { mode: 0, value }) if value == -1.0
    ));
    for bad in [f64::INFINITY, f64::NAN] {
        assert!(matches!(
            from(bad),
            Err(Error::NotFinite { what: "generalized stiffness", row: 1, value, .. })
                if value.to_bits() == bad.to_bits()
        ));
    }
}

#[test]
fn a_change_that_takes_all_stiffness_loses_the_root() {
    for lost in [-2.0, -3.0] {
        let beta = dmatrix![0.0, 0.0; 0.0, lost];
        for rule in stiffness_rules() {
            match (rule.plain)(&dvector![1.0, 2.0], &beta) {
                Err(Error::LostRoot { mode, value }) => {
                    assert_eq!((mode, value), (1, 1.0 / (2.0 + lost)));
                }
                other => panic!("{}: {other:?}", rule.name),
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
    // The explicit root of mode 0 is 1/(1 + S) with S = 2 (-2) = -4; the general formulae know roots of either sign.
    for found in [original(&k, &beta), recursive_2(&k, &beta, 2)] {
        assert!((found.unwrap().roots[0] - 1.0 / (1.0 - 4.0)).abs() < 4.0 * f64::EPSILON);
    }
}

#[test]
fn modes_that_come_together_are_named() {
    // k + β is 2 for both modes, so that the denominator of row 1 in mode 0 vanishes.
    let beta = dmatrix![1.0, 0.1; 0.1, 0.0];
    for rule in FORMULAE {
        match (rule.plain)(&dvector![1.0, 2.0], &beta) {
            Err(Error::CoalescingModes {
                first,
                second,
                separation,
            }) => {
                assert_eq!((first, second, separation), (1, 0, 0.0))
            }
            other => panic!("{}: {other:?}", rule.name),
        }
    }
    // What the recursion cannot do, the eigensolution can: 2 -+ 0.1.
    let exact = exact(&dvector![1.0, 2.0], &beta).unwrap();
    let sum: f64 = exact.roots.iter().map(|root| 1.0 / root).sum();
    assert!((sum - 4.0).abs() < 10.0 * ROUND_OFF);
}

/// Two modes that a change couples slightly count as coalescing when their roots are closer than the smallest separation, a
/// fraction of the stiffness whatever its size.
#[test]
fn coupled_modes_coalesce_below_the_smallest_separation() {
    let coupling = 1e-12;
    let separated_by = |fraction: f64, scale: f64| {
        let k = scale * dvector![1.0, 1.0 + fraction * SMALLEST_SEPARATION];
        first_order(&k, &(scale * dmatrix![0.0, coupling; coupling, 0.0]))
    };
    for scale in [1e-6, 1.0, 1e6] {
        let shapes = separated_by(2.0, scale).unwrap().shapes;
        let turn = coupling / (2.0 * SMALLEST_SEPARATION);
        assert!((shapes[(0, 1)] / turn - 1.0).abs() < CANCELLED_DIFFERENCE);
        assert!((shapes[(1, 0)] / turn + 1.0).abs() < CANCELLED_DIFFERENCE);
        match separated_by(0.5, scale) {
            Err(Error::CoalescingModes {
                first,
                second,
                separation,
            }) => {
                assert_eq!((first, second), (1, 0));
                let ratio = separation / SMALLEST_SEPARATION;
                assert!((ratio / 0.5 - 1.0).abs() < CANCELLED_DIFFERENCE, "{ratio}");
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_mode_on_a_root_of_the_others_makes_the_linear_system_singular() {
    // Mode 0 stays at 1; modes 1 and 2 become [2, 2; 2, 5] with the roots 1 and 6.
    let k = dvector![1.0, 2.0, 5.0];
    let beta = dmatrix![0.0, 0.0, 0.0; 0.0, 0.0, 2.0; 0.0, 2.0, 0.0];
    assert!(original(&k, &beta).is_ok());
    assert_refused(
        recursive_2(&k, &beta, 2),
        Error::CoalescingModes {
            first: 0,
            second: 0,
            separation: 0.0,
        },
    );
}

#[test]
fn order_zero_is_no_order() {
    let (k, beta) = (dvector![1.0, 2.0], DMatrix::zeros(2, 2));
    for result in [
        recursive_1(&k, &beta, 0),
        recursive_2(&k, &beta, 0),
        recursive_1_converged(&k, &beta, 1e-13, 0).map(|settled| settled.perturbed),
    ] {
        assert_refused(
            result,
            Error::Setting {
                name: "order",
                expected: "at least 1",
                found: 0.0,
            },
        );
    }
}

#[test]
fn roots_that_do_not_settle_are_refused_with_their_last_change() {
    // Coupled by a tenth of their distance, two modes gain about two digits in two orders: three orders are too few.
    let (k, beta) = (dvector![1.0, 2.0], dmatrix![0.0, 0.1; 0.1, 0.0]);
    let of_order = |order| recursive_1(&k, &beta, order).unwrap().roots;
    match recursive_1_converged(&k, &beta, 1e-13, 3) {
        Err(Error::UnsettledRoots {
            largest,
            orders,
            last_change,
        }) => {
            assert_eq!((largest, orders), (LARGEST_UNSETTLED_CHANGE, 3));
            assert_eq!(last_change, largest_change(&of_order(3), &of_order(2)));
        }
        other => panic!("{other:?}"),
    }
    // One order alone has nothing to compare with.
    assert!(matches!(
        recursive_1_converged(&k, &beta, 1e-13, 1),
        Err(Error::UnsettledRoots { orders: 1, .. })
    ));
    let settled = recursive_1_converged(&k, &beta, 1e-13, 60).unwrap();
    assert!(settled.last_change < 1e-13);
}

/// Mode 0 comes down to mode 1 at the second order: with mode 2 its root is 1 + 1/2, with mode 1 it changes by 0.01/(k₁ - 1), and k₁ is
/// chosen so that the two together are 1/k₁.
#[test]
fn modes_that_an_order_after_the_first_brings_together_are_refused() {
    let k1 = (2.49 - (2.49_f64.powi(2) - 6.0).sqrt()) / 3.0;
    let k = dvector![1.0, k1, 3.0];
    let beta = dmatrix![0.0, 0.1, 1.0; 0.1, 0.0, 0.0; 1.0, 0.0, 0.0];
    let second = recursive_1(&k, &beta, 2).expect("two orders");
    assert!((second.roots[0] * k1 - 1.0).abs() < ROUND_OFF);
    let refused = recursive_1(&k, &beta, 3);
    assert!(
        matches!(
            refused,
            Err(Error::CoalescingModes {
                first: 1,
                second: 0,
                ..
            })
        ),
        "{refused:?}"
    );
}
