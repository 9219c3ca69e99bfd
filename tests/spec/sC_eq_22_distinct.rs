//! A recursion that has settled has every mode once.

use crate::prelude::*;

/// Modes 1 and 2 come to rest on one mode and mode 3 is missed: all rows of (7) and (8) hold, and the set is none.
#[test]
fn a_recursion_that_finds_one_mode_twice_is_refused() {
    let k = dvector![1.0, 1.3, 3.0];
    let beta = dmatrix![0.0, 0.3, 0.0; 0.3, 0.0, 1.0; 0.0, 1.0, 0.0];
    let pencil = of_stiffness(&k, &beta).pencil().unwrap();
    for refused in [
        recursive_1_converged(&k, &beta).unwrap_err(),
        pencil.recursive_1_converged().unwrap_err(),
    ] {
        assert!(
            matches!(refused, Error::CoalescingModes { first: 0, second: 1, separation } if separation < 1e-6),
            "{refused:?}"
        );
    }
}

properties! {
    /// Whatever the change, an accepted answer has every mode once: its roots are those of the eigensolution.
    #[test]
    fn an_accepted_recursion_has_every_mode_once(change in change_of(dvector![1.0, 1.5, 2.2, 4.0], 0.6)) {
        let (k, beta) = (&change.generalized_stiffness, &change.beta);
        let Ok(found) = recursive_1_converged(k, beta) else { return Ok(()) };
        let exact = (DMatrix::from_diagonal(k) + beta).symmetric_eigenvalues();
        let sorted = |values: Vec<f64>| { let mut values = values; values.sort_by(f64::total_cmp); values };
        let roots = sorted(found.perturbed.roots.iter().map(|root| 1.0 / root).collect());
        assert_alike(roots.iter(), sorted(exact.iter().copied().collect()), SETTLED_ROOTS);
    }
}

/// Shapes whose own component is not the largest are long, and are one mode all the same.
#[test]
fn one_mode_by_long_shapes_is_found_twice_too() {
    let (k, beta) = (
        dvector![1.0, 2.2, 4.0],
        dmatrix![0.6, -0.7, -0.1; -0.7, 0.0, 1.5; -0.1, 1.5, -0.7],
    );
    let refused = recursive_1_converged(&k, &beta).unwrap_err();
    assert!(
        matches!(refused, Error::CoalescingModes { first: 0, second: 1, separation } if separation < 1e-6),
        "{refused:?}"
    );
}

/// Neighbors that a change of mass leaves oblique have long shapes that are no right angle apart, and are two modes.
#[test]
fn close_modes_that_a_change_of_mass_makes_oblique_are_two() {
    // The matrices of which these are the shapes, at squared frequencies of 1 and 1.0005.
    let shapes = dmatrix![1.0, 0.5; 0.5, 1.0];
    let back = shapes.clone().try_inverse().unwrap();
    let stiffness = back.tr_mul(&(diagonal([1.0, 1.0005]) * &back));
    let mass = back.tr_mul(&back);
    let unit = eye(2);
    let change = ModalChange::of_vibrations(&dvector![1.0, 1.0], stiffness - &unit, mass - &unit);
    let found = change.pencil().unwrap().recursive_1_converged().unwrap();
    assert!((found.perturbed.shapes - shapes).amax() <= SETTLED_ROOTS);
}
