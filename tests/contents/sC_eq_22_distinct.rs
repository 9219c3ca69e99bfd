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
    /// Whatever the change, of stiffness alone or of mass too, the roots of an accepted answer are those of the eigensolution within
    /// the error that its residuals allow: seven radii where the discs of four roots overlap.
    #[test]
    fn an_accepted_recursion_is_a_solution(change in change_of(dvector![1.0, 1.5, 2.2, 4.0], 0.6)) {
        let (k, beta) = (&change.generalized_stiffness, &change.beta);
        let with_mass = change.pencil()?;
        let alone = of_stiffness(k, beta).pencil()?;
        for (found, pencil) in [
            (recursive_1_converged(k, beta), &alone),
            (alone.recursive_1_converged(), &alone),
            (with_mass.recursive_1_converged(), &with_mass),
        ] {
            let (Ok(found), Some(_)) = (found, pencil.g().clone().cholesky()) else { continue };
            prop_assert!(found.root_error <= LARGEST_ROOT_ERROR);
            let exact = modes_by_nalgebra(pencil.a(), pencil.g()).0;
            let roots = ascending(found.perturbed.roots.map(f64::recip).iter());
            assert_alike(roots.iter(), exact.iter(), 7.0 * found.root_error + EIGEN_ROUND_OFF);
        }
    }
}

/// A recursion that creeps changes its third root by 2.7e-7 of itself in the last order, and is 3.8e-4 away: the residual tells.
#[test]
fn a_recursion_that_creeps_is_refused() {
    let k = dvector![1.0, 1.5, 2.2];
    let beta = dmatrix![-0.5, -0.1, 0.5; -0.1, 1.0, -0.3; 0.5, -0.3, 0.1];
    let exact = modes_by_nalgebra(&(DMatrix::from_diagonal(&k) + &beta), &eye(3)).0;
    let reached = recursive_1(&k, &beta, MOST_ORDERS).unwrap().roots;
    let error = (exact[1] * reached[2] - 1.0).abs();
    let with_mass = of_stiffness(&k, &beta).pencil().unwrap();
    for refused in [
        recursive_1_converged(&k, &beta),
        with_mass.recursive_1_converged(),
    ] {
        let Err(Error::UnsettledRoots {
            last_change,
            root_error,
            ..
        }) = refused
        else {
            panic!("{refused:?}")
        };
        assert!(
            last_change < LARGEST_UNSETTLED_CHANGE && error > 3.7e-4,
            "{last_change:e} {error:e}"
        );
        assert!(
            root_error >= error && root_error < 1.01 * error,
            "{root_error:e} {error:e}"
        );
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
