//! What mode sorting refuses.

use crate::common::assert_refused;
use corfem::method::error::Error;
use corfem::method::error_sum::mode_errors;
use corfem::method::modes::ModeSet;
use corfem::method::pairing::{Pairing, cross_orthogonality, modal_assurance, pair_modes};
use nalgebra::{DMatrix, DVector, dmatrix};

#[test]
fn no_test_modes_too_many_or_nan_are_refused() {
    assert_refused(
        pair_modes(&DMatrix::zeros(3, 0)),
        Error::Empty { what: "test modes" },
    );
    assert_refused(
        pair_modes(&DMatrix::zeros(2, 3)),
        Error::TooMany {
            what: "test modes",
            available: 2,
            requested: 3,
        },
    );
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
        let (what, expected_rows, expected_columns, rows, columns) = expected;
        assert_refused(
            cross_orthogonality(&analysis, &test, &mass),
            Error::WrongShape {
                what,
                expected_rows,
                expected_columns,
                rows,
                columns,
            },
        );
    }
    assert_refused(
        modal_assurance(&DMatrix::zeros(3, 2), &DMatrix::zeros(4, 1)),
        Error::WrongShape {
            what: "mode shapes",
            expected_rows: 3,
            expected_columns: 1,
            rows: 4,
            columns: 1,
        },
    );
}

#[test]
fn a_zero_shape_has_no_assurance() {
    let (shapes, mut with_zero) = (DMatrix::identity(3, 2), DMatrix::identity(3, 2));
    with_zero.column_mut(1).fill(0.0);
    for (one, other, expected) in [
        (&with_zero, &shapes, "mode shape 1 (from zero)"),
        (&shapes, &with_zero, "other mode shape 1 (from zero)"),
    ] {
        assert_refused(
            modal_assurance(one, other),
            Error::NotPositive {
                what: "largest component",
                owner: expected.into(),
                value: 0.0,
            },
        );
    }
}

#[test]
fn pairs_that_are_not_those_of_the_modes_have_no_error() {
    let modes = |dof: usize, count: usize| {
        let shapes = DMatrix::from_element(dof, count, 1.0);
        ModeSet::new(DVector::from_element(count, 1.0), shapes).expect("modes")
    };
    let pairs = |analysis_mode: Vec<usize>| {
        let signs = vec![1.0; analysis_mode.len()];
        Pairing::new(analysis_mode, signs).expect("pairs")
    };
    let errors = |test: &ModeSet, pairing: Vec<usize>| {
        mode_errors(&modes(3, 2), &pairs(pairing), test).map(|errors| errors.len())
    };
    let test = modes(3, 2);
    assert_eq!(errors(&test, vec![0, 1]).ok(), Some(2));
    assert!(matches!(
        errors(&modes(4, 2), vec![0, 1]),
        Err(Error::WrongShape {
            what: "test mode shapes",
            expected_rows: 3,
            rows: 4,
            ..
        })
    ));
    for pairing in [vec![0], vec![0, 1, 1]] {
        let count = pairing.len();
        assert!(matches!(
            errors(&test, pairing),
            Err(Error::WrongShape { what: "paired modes", expected_rows: 2, rows, .. }) if rows == count
        ));
    }
    assert!(matches!(
        errors(&test, vec![0, 2]),
        Err(Error::TooMany {
            what: "paired analysis modes",
            available: 2,
            requested: 3,
        })
    ));
}
