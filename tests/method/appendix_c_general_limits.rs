//! The general formulae of Appendix C at their limits: roots that meet, vanish, or exceed all numbers.

use crate::common::tolerances::CANCELLED_DIFFERENCE;
use corfem::method::appendix_c::{
    CloseRootsSettings, ModalChange, UpdateRule, close_roots, general, perturb_with_mass,
};
use corfem::method::error::Error;
use nalgebra::{DMatrix, DVector, dvector};

/// The separation that an error names is the denominator relative to $(k_{ii} + \beta_{ii})\gamma_j$, here ten.
#[test]
fn separation_is_relative_to_the_rows_own_stiffness_times_the_root() {
    let mut change = ModalChange::of_vibrations(
        &dvector![1.0, 10.0],
        DMatrix::zeros(2, 2),
        DMatrix::zeros(2, 2),
    );
    let meeting_at = |separation: f64| 9.0 - 10.0 * separation;
    change.alpha[(1, 1)] = meeting_at(1e-10);
    let settings = CloseRootsSettings {
        separation: 0.0,
        ..CloseRootsSettings::default()
    };
    for result in [
        general::first_order(&change),
        close_roots(&change, settings).map(|solved| solved.perturbed),
    ] {
        assert!(
            matches!(
                result,
                Err(Error::CoalescingModes { first: 1, second: 0, separation }) if (separation / 1e-10 - 1.0).abs() < CANCELLED_DIFFERENCE
            ),
            "{result:?}"
        );
    }
    change.alpha[(1, 1)] = meeting_at(1e-8);
    assert!(general::first_order(&change).is_ok());
}

#[test]
fn no_modes_are_empty() {
    let of = |size: usize| {
        let none = DMatrix::zeros(size, size);
        ModalChange::of_vibrations(&DVector::from_element(size, 1.0), none.clone(), none)
    };
    assert!(of(0).is_empty());
    assert!(!of(1).is_empty());
    assert_eq!((of(0).len(), of(2).len()), (0, 2));
}

/// Mass changes that take all of a mode's inertia leave the root zero, which is none.
#[test]
fn a_root_of_zero_is_lost() {
    let mut change = ModalChange::of_vibrations(
        &dvector![1.0, 4.0],
        DMatrix::zeros(2, 2),
        DMatrix::zeros(2, 2),
    );
    change.alpha[(1, 1)] = -1.0;
    for rule in [UpdateRule::FirstOrder, UpdateRule::Recursive1 { order: 2 }] {
        match perturb_with_mass(&change, rule) {
            Err(Error::LostRoot { mode, value }) => assert_eq!((mode, value), (1, 0.0)),
            other => panic!("{other:?}"),
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
    match general::recursive_1(&change, 2) {
        Err(Error::NotFinite { what, row, .. }) => assert_eq!((what, row), ("perturbed roots", 0)),
        other => panic!("{other:?}"),
    }
}
