//! What the eigenproblem and the measured modes refuse, and who is named.

use crate::prelude::*;

#[test]
fn a_mass_that_is_not_positive_definite_names_where_it_shows() {
    for (mass, row) in [
        (diagonal([1.0, 0.0, 1.0]), 1),
        (diagonal([1.0, 1.0, -2.0]), 2),
        (diagonal([0.0, 1.0, 1.0]), 0),
        // Its diagonal is positive.
        (dmatrix![1.0, 2.0; 2.0, 1.0], 1),
    ] {
        let size = mass.nrows();
        assert_eq!(
            said(solve(&eye(size), &mass, size)),
            not_definite("dynamic mass", row)
        );
    }
}

#[test]
fn matrices_that_do_not_fit_are_refused_by_name() {
    let with = |mut matrix: DMatrix<f64>, at: (usize, usize), value: f64| {
        matrix[at] = value;
        matrix
    };
    let skew = dmatrix![4.0, 1.0, 0.0; 1.0, 4.0, 0.5; 0.0, 0.9, 4.0];
    let unlike = dmatrix![1.0, 0.1; 0.0, 1.0];
    for (stiffness, mass, words) in [
        (
            with(eye(3), (2, 1), f64::NAN),
            eye(3),
            "dynamic stiffness of entry (2, 1) is NaN; it must be a finite number",
        ),
        (
            eye(3),
            with(eye(3), (0, 2), f64::INFINITY),
            "dynamic mass of entry (0, 2) is inf; it must be a finite number",
        ),
        // The worst pair differs by 0.4, a tenth of the largest entry.
        (
            skew,
            eye(3),
            "relative asymmetry of dynamic stiffness is 0.1; it must be at most 1e-8",
        ),
        (
            eye(2),
            unlike,
            "relative asymmetry of dynamic mass is 0.1; it must be at most 1e-8",
        ),
        (
            DMatrix::zeros(3, 2),
            eye(3),
            "dynamic stiffness: 3 x 2 instead of 3 x 3",
        ),
        (eye(3), eye(2), "dynamic mass: 2 x 2 instead of 3 x 3"),
    ] {
        assert_eq!(said(solve(&stiffness, &mass, 1)), words);
    }
}

#[test]
fn too_many_modes_or_none_are_refused() {
    let words = |found: usize, most: usize| {
        format!("modes: {found} given or asked for; there must be 1 to {most}")
    };
    for count in [0, 4] {
        assert_eq!(said(solve(&eye(3), &eye(3), count)), words(count, 3));
    }
    let modes = solve(&eye(3), &eye(3), 2).unwrap();
    for count in [0, 3] {
        assert_eq!(said(modes.lowest(count)), words(count, 2));
    }
}

#[test]
fn a_motion_that_is_no_vibration_is_refused() {
    for (stiffness, mass, value) in [
        (diagonal([3.0, -2.0]), diagonal([1.0, 4.0]), "-5.000000e-1"),
        (diagonal([0.0, 1.0]), eye(2), "0.000000e0"),
    ] {
        assert_eq!(
            said(solve(&stiffness, &mass, 1)),
            format!(
                "mode 0 (from zero) is no vibration: its eigenvalue is {value}; it must be positive and finite"
            )
        );
    }
}

#[test]
fn modes_that_are_none_are_refused_by_their_place() {
    let nan = dmatrix![1.0; f64::NAN];
    let still = dmatrix![1.0, 0.0; 0.0, 0.0];
    let fits = "it must be positive and finite";
    for (squares, shapes, words) in [
        (
            dvector![],
            DMatrix::zeros(2, 0),
            "modes: 0 given or asked for; there must be at least 1".to_owned(),
        ),
        (
            dvector![1.0, 2.0],
            DMatrix::zeros(3, 1),
            "mode shapes: 3 x 1 instead of 3 x 2".into(),
        ),
        (
            dvector![1.0],
            nan,
            "mode shapes of entry (1, 0) is NaN; it must be a finite number".into(),
        ),
        (
            dvector![1.0, 0.0],
            eye(2),
            format!("mode 1 (from zero) is no vibration: its eigenvalue is 0.000000e0; {fits}"),
        ),
        (
            dvector![1.0, 2.0],
            still,
            format!("largest component of mode 1 (from zero) is 0; {fits}"),
        ),
    ] {
        assert_eq!(said(Modes::new(squares, shapes)), words);
    }
}

#[test]
fn measured_modes_must_fit_together() {
    assert_eq!(
        said(Modes::from_measured(&[], &DMatrix::zeros(2, 0))),
        "modes: 0 given or asked for; there must be at least 1"
    );
    assert_eq!(
        said(Modes::from_measured(&[1.0, 2.0], &DMatrix::zeros(3, 1))),
        "mode shapes: 3 x 1 instead of 3 x 2"
    );
}

#[test]
fn measured_frequencies_must_be_positive() {
    for bad in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        assert_eq!(
            said(Modes::from_measured(&[1.0, bad], &eye(2))),
            format!("frequency of mode 1 (from zero) is {bad}; it must be positive and finite")
        );
    }
}

#[test]
fn a_frequency_whose_square_is_no_positive_number_is_refused() {
    for (frequency, square) in [(1e-170, "0.000000e0"), (1e170, "inf")] {
        let words = format!(
            "mode 0 (from zero) is no vibration: its eigenvalue is {square}; it must be positive and finite"
        );
        assert_eq!(said(Modes::from_measured(&[frequency], &eye(1))), words);
    }
}

#[test]
fn shapes_are_scaled_with_a_mass_that_fits_and_that_they_move() {
    let modes = Modes::from_measured(&[1.0, 2.0], &eye(2)).unwrap();
    assert_eq!(
        said(modes.scaled_with(&diagonal([1.0, -4.0]))),
        "generalized mass of mode 1 (from zero) is -4; it must be positive and finite"
    );
    assert_eq!(
        said(modes.scaled_with(&eye(3))),
        "dynamic mass: 3 x 3 instead of 2 x 2"
    );
}
