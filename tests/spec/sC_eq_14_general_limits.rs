//! The general formulae of Appendix C at their limits: roots that meet, vanish, or exceed all numbers.

use crate::prelude::*;

/// The separation that an error names is the denominator relative to $(k_{ii} + \beta_{ii})\gamma_j$, here ten.
#[test]
fn separation_is_relative_to_the_rows_own_stiffness_times_the_root() {
    let mut change = ModalChange::of_vibrations(
        &dvector![1.0, 10.0],
        DMatrix::zeros(2, 2),
        DMatrix::zeros(2, 2),
    );
    // A slight coupling, for modes without any may meet.
    change.alpha[(0, 1)] = 1e-12;
    change.alpha[(1, 0)] = 1e-12;
    let meeting_at = |separation: f64| 9.0 - 10.0 * separation;
    change.alpha[(1, 1)] = meeting_at(1e-10);
    match change.pencil().unwrap().first_order() {
        Err(Error::CoalescingModes {
            first: 1,
            second: 0,
            separation,
        }) => {
            assert!(
                (separation / 1e-10 - 1.0).abs() < CANCELLED_DIFFERENCE,
                "{separation:e}"
            );
        }
        other => panic!("{other:?}"),
    }
    change.alpha[(1, 1)] = meeting_at(1e-8);
    assert!(change.pencil().unwrap().first_order().is_ok());
}

/// A change of mass that takes all of a mode's inertia, or more, leaves a root that is zero or negative. Such roots are those
/// of massless motions, or of a $G$ that is no mass: here they are roots like others, and the loops refuse them.
#[test]
fn roots_that_are_not_positive_are_roots_here() {
    for (taken, root) in [(-1.0, 0.0), (-1.5, -0.125)] {
        let change = ModalChange::of_vibrations(
            &dvector![1.0, 4.0],
            DMatrix::zeros(2, 2),
            DMatrix::from_diagonal(&dvector![0.0, taken]),
        );
        for rule in FORMULAE {
            let found = (rule.general)(&change).unwrap();
            assert_eq!(found.roots, dvector![1.0, root], "{}", rule.name);
            assert_eq!(found.shapes, DMatrix::identity(2, 2), "{}", rule.name);
        }
    }
}

/// Two modes so coupled that the shapes of order two are still numbers and the roots no longer.
#[test]
fn a_root_beyond_all_numbers_is_refused() {
    let mut change = ModalChange::of_vibrations(
        &dvector![1.0, 4.0],
        DMatrix::zeros(2, 2),
        DMatrix::zeros(2, 2),
    );
    change.alpha[(0, 1)] = 1e200;
    change.alpha[(1, 0)] = 1e200;
    match change.pencil().unwrap().recursive_1(2) {
        Err(Error::Value {
            what,
            owner,
            expected,
            ..
        }) => assert_eq!(
            (what, owner.as_str(), expected),
            ("perturbed roots", "entry (0, 0)", "a finite number")
        ),
        other => panic!("{other:?}"),
    }
}

/// Powers of two are exact: in other units of stiffness the recursion takes the same orders and changes the same.
#[test]
fn when_roots_settle_does_not_depend_on_units() {
    let settle = |unit: f64| {
        let beta = unit * dmatrix![0.1, 0.2, 0.1; 0.2, -0.1, 0.3; 0.1, 0.3, 0.2];
        let change = ModalChange::of_vibrations(
            &(unit * dvector![1.0, 3.0, 8.0]),
            beta,
            DMatrix::zeros(3, 3),
        );
        let settled = change.pencil().unwrap().recursive_1_converged().unwrap();
        (settled.order, settled.last_change)
    };
    assert_eq!(settle(2_f64.powi(60)), settle(1.0));
    assert_eq!(settle(2_f64.powi(-60)), settle(1.0));
}
