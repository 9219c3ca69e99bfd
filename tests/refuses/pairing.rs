//! What mode sorting refuses.

use corfem::method::error::Error;
use corfem::method::modes::ModeSet;
use corfem::method::pairing::{cross_orthogonality, modal_assurance, pair_modes};
use nalgebra::{DMatrix, DVector, dmatrix};

#[test]
fn no_test_modes_too_many_or_nan_are_refused() {
    match pair_modes(&DMatrix::zeros(3, 0)) {
        Err(Error::Empty { what }) => assert_eq!(what, "test modes"),
        other => panic!("{other:?}"),
    }
    match pair_modes(&DMatrix::zeros(2, 3)) {
        Err(Error::TooMany {
            what,
            available,
            requested,
        }) => {
            assert_eq!((what, available, requested), ("test modes", 2, 3))
        }
        other => panic!("{other:?}"),
    }
    match pair_modes(&dmatrix![1.0, 0.0; 0.0, f64::NAN]) {
        Err(Error::NotFinite {
            what, row, column, ..
        }) => {
            assert_eq!((what, row, column), ("cross-orthogonality", 1, 1))
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn shapes_and_mass_must_fit() {
    let modes = |dof: usize, count: usize| {
        ModeSet::new(
            DVector::from_element(count, 1.0),
            DMatrix::from_element(dof, count, 1.0),
        )
        .expect("modes")
    };
    let identity = |size: usize| DMatrix::<f64>::identity(size, size);
    for (analysis, test, mass, expected) in [
        (
            modes(2, 1),
            modes(3, 2),
            identity(3),
            ("analysis mode shapes", 3, 1, 2, 1),
        ),
        (
            modes(3, 1),
            modes(4, 2),
            identity(3),
            ("test mode shapes", 3, 2, 4, 2),
        ),
        (
            modes(3, 1),
            modes(3, 1),
            DMatrix::zeros(3, 2),
            ("dynamic mass", 3, 3, 3, 2),
        ),
    ] {
        match cross_orthogonality(&analysis, &test, &mass) {
            Err(Error::WrongShape {
                what,
                expected_rows,
                expected_columns,
                rows,
                columns,
            }) => {
                assert_eq!(
                    (what, expected_rows, expected_columns, rows, columns),
                    expected
                )
            }
            other => panic!("{other:?}"),
        }
    }
    match modal_assurance(&DMatrix::zeros(3, 2), &DMatrix::zeros(4, 1)) {
        Err(Error::WrongShape {
            what,
            expected_rows,
            expected_columns,
            rows,
            columns,
        }) => {
            assert_eq!(
                (what, expected_rows, expected_columns, rows, columns),
                ("mode shapes", 3, 1, 4, 1)
            )
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_zero_shape_has_no_assurance() {
    let (shapes, mut with_zero) = (DMatrix::identity(3, 2), DMatrix::identity(3, 2));
    with_zero.column_mut(1).fill(0.0);
    for (one, other, expected) in [
        (&with_zero, &shapes, "mode shape 1 (from zero)"),
        (&shapes, &with_zero, "other mode shape 1 (from zero)"),
    ] {
        match modal_assurance(one, other) {
            Err(Error::NotPositive { what, owner, value }) => {
                assert_eq!(
                    (what, owner.as_str(), value),
                    ("largest component", expected, 0.0)
                );
            }
            other => panic!("{other:?}"),
        }
    }
}
