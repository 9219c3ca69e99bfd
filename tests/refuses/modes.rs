//! What the eigenproblem and the measured modes refuse, by variant and by who is named.

use crate::common::assert_refused;
use corfem::method::error::Error;
use corfem::method::modes::{ModeSet, solve};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

fn identity(size: usize) -> DMatrix<f64> {
    DMatrix::identity(size, size)
}

fn diagonal(entries: &[f64]) -> DMatrix<f64> {
    DMatrix::from_diagonal(&DVector::from_column_slice(entries))
}

#[test]
fn a_zero_or_negative_mass_names_its_dof() {
    for (masses, expected) in [
        ([1.0, 0.0, 1.0], 1),
        ([1.0, 1.0, -2.0], 2),
        ([0.0, 1.0, 1.0], 0),
    ] {
        assert_refused(
            solve(&identity(3), &diagonal(&masses), 3),
            Error::NotPositiveDefinite {
                what: "dynamic mass",
                dof: expected,
            },
        );
    }
}

#[test]
fn an_indefinite_mass_names_where_it_shows() {
    // The leading 2 x 2 is singular although its diagonal is positive.
    assert_refused(
        solve(&identity(2), &dmatrix![1.0, 2.0; 2.0, 1.0], 2),
        Error::NotPositiveDefinite {
            what: "dynamic mass",
            dof: 1,
        },
    );
}

#[test]
fn nan_and_infinity_name_their_entry() {
    let mut stiffness = identity(3);
    stiffness[(2, 1)] = f64::NAN;
    match solve(&stiffness, &identity(3), 3) {
        Err(Error::NotFinite {
            what,
            row,
            column,
            value,
        }) => {
            assert_eq!((what, row, column), ("dynamic stiffness", 2, 1));
            assert!(value.is_nan());
        }
        other => panic!("{other:?}"),
    }
    let mut mass = identity(3);
    mass[(0, 2)] = f64::INFINITY;
    assert_refused(
        solve(&identity(3), &mass, 3),
        Error::NotFinite {
            what: "dynamic mass",
            row: 0,
            column: 2,
            value: f64::INFINITY,
        },
    );
}

#[test]
fn an_unsymmetric_matrix_names_the_worst_pair() {
    let stiffness = dmatrix![4.0, 1.0, 0.0; 1.0, 4.0, 0.5; 0.0, 0.9, 4.0];
    match solve(&stiffness, &identity(3), 3) {
        Err(Error::NotSymmetric {
            what,
            row,
            column,
            difference,
        }) => {
            assert_eq!((what, row, column), ("dynamic stiffness", 2, 1));
            assert!((difference - 0.1).abs() < f64::EPSILON);
        }
        other => panic!("{other:?}"),
    }
    match solve(&identity(2), &dmatrix![1.0, 0.1; 0.0, 1.0], 2) {
        Err(Error::NotSymmetric {
            what, row, column, ..
        }) => assert_eq!((what, row, column), ("dynamic mass", 1, 0)),
        other => panic!("{other:?}"),
    }
}

#[test]
fn matrices_of_other_shapes_are_refused() {
    assert_refused(
        solve(&DMatrix::zeros(3, 2), &identity(3), 1),
        Error::WrongShape {
            what: "dynamic stiffness",
            expected_rows: 3,
            expected_columns: 3,
            rows: 3,
            columns: 2,
        },
    );
    assert_refused(
        solve(&identity(3), &identity(2), 1),
        Error::WrongShape {
            what: "dynamic mass",
            expected_rows: 3,
            expected_columns: 3,
            rows: 2,
            columns: 2,
        },
    );
}

#[test]
fn too_many_modes_or_none_are_refused() {
    assert_refused(
        solve(&identity(3), &identity(3), 4),
        Error::TooMany {
            what: "modes",
            available: 3,
            requested: 4,
        },
    );
    assert_refused(
        solve(&identity(3), &identity(3), 0),
        Error::Empty { what: "modes" },
    );
    let modes = solve(&identity(3), &identity(3), 2).unwrap();
    assert_refused(
        modes.lowest(3),
        Error::TooMany {
            what: "modes",
            available: 2,
            requested: 3,
        },
    );
    assert!(matches!(
        modes.lowest(0),
        Err(Error::Empty { what: "modes" })
    ));
}

#[test]
fn a_motion_that_is_no_vibration_is_refused() {
    assert_refused(
        solve(&diagonal(&[3.0, -2.0]), &diagonal(&[1.0, 4.0]), 2),
        Error::NotAVibration {
            mode: 0,
            value: -0.5,
        },
    );
    assert_refused(
        solve(&diagonal(&[0.0, 1.0]), &identity(2), 1),
        Error::NotAVibration {
            mode: 0,
            value: 0.0,
        },
    );
}

#[test]
fn measured_modes_must_fit_together() {
    assert_refused(
        ModeSet::from_measured(&[], &DMatrix::zeros(2, 0)),
        Error::Empty { what: "test modes" },
    );
    assert_refused(
        ModeSet::from_measured(&[1.0, 2.0], &DMatrix::zeros(3, 1)),
        Error::WrongShape {
            what: "test mode shapes",
            expected_rows: 3,
            expected_columns: 2,
            rows: 3,
            columns: 1,
        },
    );
    match ModeSet::from_measured(&[1.0], &dmatrix![1.0; f64::NAN]) {
        Err(Error::NotFinite {
            what, row, column, ..
        }) => {
            assert_eq!((what, row, column), ("test mode shapes", 1, 0));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn measured_frequencies_must_be_positive() {
    for bad in [0.0, -1.0, f64::INFINITY] {
        assert_refused(
            ModeSet::from_measured(&[1.0, bad], &identity(2)),
            Error::NotPositive {
                what: "frequency",
                owner: "test mode 1 (from zero)".into(),
                value: bad,
            },
        );
    }
    assert!(matches!(
        ModeSet::from_measured(&[f64::NAN], &dmatrix![1.0]),
        Err(Error::NotPositive { value, .. }) if value.is_nan()
    ));
}

#[test]
fn measured_shapes_must_move() {
    assert_refused(
        ModeSet::from_measured(&[1.0, 2.0], &dmatrix![1.0, 0.0; 0.0, 0.0]),
        Error::NotPositive {
            what: "largest component",
            owner: "test mode 1 (from zero)".into(),
            value: 0.0,
        },
    );
}

#[test]
fn shapes_are_scaled_with_a_mass_that_fits_and_that_they_move() {
    let modes = ModeSet::from_measured(&[1.0, 2.0], &identity(2)).unwrap();
    assert_refused(
        modes.scaled_with(&DMatrix::from_diagonal(&dvector![1.0, -4.0])),
        Error::NotPositive {
            what: "generalized mass",
            owner: "test mode 1 (from zero)".into(),
            value: -4.0,
        },
    );
    assert_refused(
        modes.scaled_with(&identity(3)),
        Error::WrongShape {
            what: "test mode shapes",
            expected_rows: 3,
            expected_columns: 2,
            rows: 2,
            columns: 2,
        },
    );
    let mut broken = identity(2);
    broken[(0, 1)] = f64::INFINITY;
    assert!(matches!(
        modes.with_shapes(broken),
        Err(Error::NotFinite {
            what: "test mode shapes",
            row: 0,
            column: 1,
            ..
        })
    ));
}

#[test]
fn a_frequency_whose_square_is_no_positive_number_is_refused() {
    for frequency in [1e-170, 1e170] {
        let refused = ModeSet::from_measured(&[frequency], &identity(1)).unwrap_err();
        assert!(
            matches!(
                refused,
                Error::NotPositive {
                    what: "squared frequency",
                    ..
                }
            ),
            "{refused:?}"
        );
    }
}
