//! What the eigenproblem, measured modes and mode sorting refuse, and who is named.

use crate::prelude::*;

#[test]
fn eigenproblems_are_refused_by_what_is_wrong_with_them() {
    let with = |row: usize, column: usize, value: f64| {
        let mut matrix = eye(3);
        matrix[(row, column)] = value;
        matrix
    };
    // The worst pair differs by 0.4, a tenth of the largest entry.
    let skew = dmatrix![4.0, 1.0, 0.0; 1.0, 4.0, 0.5; 0.0, 0.9, 4.0];
    for (stiffness, own, count, words) in [
        (
            eye(3),
            diagonal([1.0, 0.0, 1.0]),
            3,
            "dynamic mass is not positive definite: row 1 (from zero) is a combination of those before it, or not positive",
        ),
        (
            eye(3),
            diagonal([1.0, 1.0, -2.0]),
            3,
            "dynamic mass is not positive definite: row 2 (from zero) is a combination of those before it, or not positive",
        ),
        (
            eye(3),
            diagonal([0.0, 1.0, 1.0]),
            3,
            "dynamic mass is not positive definite: row 0 (from zero) is a combination of those before it, or not positive",
        ),
        // Its diagonal is positive.
        (
            eye(2),
            dmatrix![1.0, 2.0; 2.0, 1.0],
            2,
            "dynamic mass is not positive definite: row 1 (from zero) is a combination of those before it, or not positive",
        ),
        (
            with(2, 1, f64::NAN),
            eye(3),
            1,
            "dynamic stiffness of entry (2, 1) is NaN; it must be a finite number",
        ),
        (
            eye(3),
            with(0, 2, f64::INFINITY),
            1,
            "dynamic mass of entry (0, 2) is inf; it must be a finite number",
        ),
        (
            skew,
            eye(3),
            1,
            "relative asymmetry of dynamic stiffness is 0.1; it must be at most 1e-8",
        ),
        (
            eye(2),
            dmatrix![1.0, 0.1; 0.0, 1.0],
            1,
            "relative asymmetry of dynamic mass is 0.1; it must be at most 1e-8",
        ),
        (
            DMatrix::zeros(3, 2),
            eye(3),
            1,
            "dynamic stiffness: 3 x 2 instead of 3 x 3",
        ),
        (eye(3), eye(2), 1, "dynamic mass: 2 x 2 instead of 3 x 3"),
        (
            eye(3),
            eye(3),
            0,
            "modes: 0 given or asked for; there must be 1 to 3",
        ),
        (
            eye(3),
            eye(3),
            4,
            "modes: 4 given or asked for; there must be 1 to 3",
        ),
        (
            diagonal([3.0, -2.0]),
            diagonal([1.0, 4.0]),
            1,
            "mode 0 (from zero) is no vibration: its eigenvalue is -5.000000e-1; it must be positive and finite",
        ),
        (
            diagonal([0.0, 1.0]),
            eye(2),
            1,
            "mode 0 (from zero) is no vibration: its eigenvalue is 0.000000e0; it must be positive and finite",
        ),
    ] {
        assert_eq!(said(solve(&stiffness, &own, count)), words);
    }
}

#[test]
fn modes_that_are_none_are_refused_by_their_place() {
    let none = "modes: 0 given or asked for; there must be at least 1";
    let measured = |hertz: &[f64]| said(Modes::from_measured(hertz, &eye(hertz.len())));
    let (two, modes) = (
        dvector![1.0, 2.0],
        Modes::from_measured(&[1.0, 2.0], &eye(2)).unwrap(),
    );
    for (found, words) in [
        (said(Modes::new(dvector![], DMatrix::zeros(2, 0))), none),
        (
            said(Modes::new(two.clone(), DMatrix::zeros(3, 1))),
            "mode shapes: 3 x 1 instead of 3 x 2",
        ),
        (
            said(Modes::new(dvector![1.0], dmatrix![1.0; f64::NAN])),
            "mode shapes of entry (1, 0) is NaN; it must be a finite number",
        ),
        (
            said(Modes::new(dvector![1.0, 0.0], eye(2))),
            "mode 1 (from zero) is no vibration: its eigenvalue is 0.000000e0; it must be positive and finite",
        ),
        (
            said(Modes::new(two, dmatrix![1.0, 0.0; 0.0, 0.0])),
            "largest component of mode 1 (from zero) is 0; it must be positive and finite",
        ),
        (measured(&[]), none),
        (
            measured(&[1.0, 0.0]),
            "frequency of mode 1 (from zero) is 0; it must be positive and finite",
        ),
        (
            measured(&[1.0, -1.0]),
            "frequency of mode 1 (from zero) is -1; it must be positive and finite",
        ),
        (
            measured(&[1.0, f64::INFINITY]),
            "frequency of mode 1 (from zero) is inf; it must be positive and finite",
        ),
        (
            measured(&[1.0, f64::NAN]),
            "frequency of mode 1 (from zero) is NaN; it must be positive and finite",
        ),
        // Their squares are no positive numbers.
        (
            measured(&[1e-170]),
            "mode 0 (from zero) is no vibration: its eigenvalue is 0.000000e0; it must be positive and finite",
        ),
        (
            measured(&[1e170]),
            "mode 0 (from zero) is no vibration: its eigenvalue is inf; it must be positive and finite",
        ),
        (
            said(modes.lowest(0)),
            "modes: 0 given or asked for; there must be 1 to 2",
        ),
        (
            said(modes.lowest(3)),
            "modes: 3 given or asked for; there must be 1 to 2",
        ),
        (
            said(modes.scaled_with(&diagonal([1.0, -4.0]))),
            "generalized mass of mode 1 (from zero) is -4; it must be positive and finite",
        ),
        (
            said(modes.scaled_with(&eye(3))),
            "mass: 3 x 3 instead of 2 x 2",
        ),
    ] {
        assert_eq!(found, words);
    }
}

/// Modes of one shape, at some DOF.
fn alike(dof: usize, count: usize) -> Modes {
    let shapes = DMatrix::from_element(dof, count, 1.0);
    Modes::new(DVector::from_element(count, 1.0), shapes).unwrap()
}

#[test]
fn what_cannot_be_paired_is_refused() {
    let crossed = |analysis: usize, test: usize, mass: DMatrix<f64>| {
        said(cross_orthogonality(
            &alike(analysis, 1),
            &alike(test, 2),
            &mass,
        ))
    };
    let assured = |one, other| said(modal_assurance(&one, &other));
    let (two, with_zero) = (
        DMatrix::identity(3, 2),
        dmatrix![1.0, 0.0; 0.0, 0.0; 0.0, 0.0],
    );
    let pairing = |modes: &[usize], signs: usize| Pairing {
        analysis_mode: modes.to_vec(),
        sign: vec![1.0; signs],
    };
    let errors = |dof: usize, own: &[usize]| {
        said(mode_errors(
            &alike(3, 2),
            &pairing(own, own.len()),
            &alike(dof, 2),
        ))
    };
    let paired = |own: &[usize], signs| said(pairing(own, signs).paired(&alike(3, 2)));
    for (found, words) in [
        (
            said(pair_modes(&DMatrix::zeros(3, 0))),
            "test modes: 0 given or asked for; there must be 1 to 3",
        ),
        (
            said(pair_modes(&DMatrix::zeros(2, 3))),
            "test modes: 3 given or asked for; there must be 1 to 2",
        ),
        (
            said(pair_modes(&dmatrix![1.0, 0.0; 0.0, f64::NAN])),
            "cross-orthogonality of entry (1, 1) is NaN; it must be a finite number",
        ),
        (
            crossed(2, 3, eye(3)),
            "dynamic mass: 3 x 3 instead of 2 x 2",
        ),
        (
            crossed(3, 4, eye(3)),
            "test mode shapes: 4 x 2 instead of 3 x 2",
        ),
        (
            crossed(3, 3, DMatrix::zeros(3, 2)),
            "dynamic mass: 3 x 2 instead of 3 x 3",
        ),
        (
            assured(DMatrix::zeros(3, 2), DMatrix::zeros(4, 1)),
            "mode shapes: 4 x 1 instead of 3 x 1",
        ),
        (
            assured(with_zero.clone(), two.clone()),
            "largest component of shape of mode 1 (from zero) is 0; it must be positive and finite",
        ),
        (
            assured(two, with_zero),
            "largest component of other shape of mode 1 (from zero) is 0; it must be positive and finite",
        ),
        (errors(3, &[0, 1]), "an answer"),
        (
            errors(4, &[0, 1]),
            "test mode shapes: 4 x 2 instead of 3 x 2",
        ),
        (errors(3, &[0]), "test mode shapes: 3 x 2 instead of 3 x 1"),
        (
            errors(3, &[0, 1, 1]),
            "test mode shapes: 3 x 2 instead of 3 x 3",
        ),
        (
            errors(3, &[0, 2]),
            "paired analysis modes: 3 given or asked for; there must be 1 to 2",
        ),
        (
            paired(&[0, 1], 1),
            "signs of paired modes: 1 x 1 instead of 2 x 1",
        ),
        (
            paired(&[2], 1),
            "paired analysis modes: 3 given or asked for; there must be 1 to 2",
        ),
    ] {
        assert_eq!(found, words);
    }
}
