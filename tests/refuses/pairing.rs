//! What mode sorting refuses.

use crate::prelude::*;

/// Modes of one shape, at some DOF.
fn modes(dof: usize, count: usize) -> Modes {
    let shapes = DMatrix::from_element(dof, count, 1.0);
    Modes::new(DVector::from_element(count, 1.0), shapes).unwrap()
}

#[test]
fn no_test_modes_too_many_or_nan_are_refused() {
    for (cross, words) in [
        (
            DMatrix::zeros(3, 0),
            "test modes: 0 given or asked for; there must be 1 to 3",
        ),
        (
            DMatrix::zeros(2, 3),
            "test modes: 3 given or asked for; there must be 1 to 2",
        ),
        (
            dmatrix![1.0, 0.0; 0.0, f64::NAN],
            "cross-orthogonality of entry (1, 1) is NaN; it must be a finite number",
        ),
    ] {
        assert_eq!(said(pair_modes(&cross)), words);
    }
}

#[test]
fn shapes_and_mass_must_fit() {
    let identity = |size: usize| eye(size);
    for (analysis, test, mass, words) in [
        (
            modes(2, 1),
            modes(3, 2),
            identity(3),
            "dynamic mass: 3 x 3 instead of 2 x 2",
        ),
        (
            modes(3, 1),
            modes(4, 2),
            identity(3),
            "test mode shapes: 4 x 2 instead of 3 x 2",
        ),
        (
            modes(3, 1),
            modes(3, 1),
            DMatrix::zeros(3, 2),
            "dynamic mass: 3 x 2 instead of 3 x 3",
        ),
    ] {
        assert_eq!(said(cross_orthogonality(&analysis, &test, &mass)), words);
    }
    assert_eq!(
        said(modal_assurance(
            &DMatrix::zeros(3, 2),
            &DMatrix::zeros(4, 1)
        )),
        "mode shapes: 4 x 1 instead of 3 x 1"
    );
}

#[test]
fn a_zero_shape_has_no_assurance() {
    let (shapes, mut with_zero) = (DMatrix::identity(3, 2), DMatrix::identity(3, 2));
    with_zero.column_mut(1).fill(0.0);
    for (one, other, owner) in [
        (&with_zero, &shapes, "shape of mode 1 (from zero)"),
        (&shapes, &with_zero, "other shape of mode 1 (from zero)"),
    ] {
        assert_eq!(
            said(modal_assurance(one, other)),
            format!("largest component of {owner} is 0; it must be positive and finite")
        );
    }
}

#[test]
fn pairs_that_are_not_those_of_the_modes_have_no_error() {
    let errors = |dof: usize, analysis_mode: Vec<usize>| {
        let signs = vec![1.0; analysis_mode.len()];
        let pairing = Pairing {
            analysis_mode,
            sign: signs,
        };
        mode_errors(&modes(3, 2), &pairing, &modes(dof, 2))
    };
    assert_eq!(errors(3, vec![0, 1]).unwrap().len(), 2);
    for (dof, pairing, words) in [
        (4, vec![0, 1], "test mode shapes: 4 x 2 instead of 3 x 2"),
        (3, vec![0], "test mode shapes: 3 x 2 instead of 3 x 1"),
        (3, vec![0, 1, 1], "test mode shapes: 3 x 2 instead of 3 x 3"),
        (
            3,
            vec![0, 2],
            "paired analysis modes: 3 given or asked for; there must be 1 to 2",
        ),
    ] {
        assert_eq!(said(errors(dof, pairing)), words);
    }
}

#[test]
fn pairs_of_no_modes_are_refused() {
    let paired = |modes_paired: &[usize], signs: &[f64]| {
        let pairing = Pairing {
            analysis_mode: modes_paired.to_vec(),
            sign: signs.to_vec(),
        };
        said(pairing.paired(&modes(3, 2)))
    };
    assert_eq!(
        paired(&[0, 1], &[1.0]),
        "signs of paired modes: 1 x 1 instead of 2 x 1"
    );
    assert_eq!(
        paired(&[2], &[1.0]),
        "paired analysis modes: 3 given or asked for; there must be 1 to 2"
    );
}
