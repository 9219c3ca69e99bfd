//! Orthogonal test modes (B.6, B.7) on two and three shapes, and what is refused.

use crate::common::appendix_b::modes;
use crate::common::tolerances::{ORTHOGONAL_INPUT, ROUND_OFF};
use approx::assert_relative_eq;
use corfem::method::appendix_b::{generalized_mass, orthogonalize};
use corfem::method::error::Error;
use corfem::method::modes::ModeSet;
use nalgebra::{DMatrix, DVector, dmatrix};
use std::f64::consts::PI;

#[test]
fn generalized_mass_by_hand() {
    let shapes = dmatrix![1.0, 2.0; 0.0, 1.0];
    let mass = dmatrix![3.0, 1.0; 1.0, 5.0];
    // V^t M V = [3 7; 7 21].
    assert_eq!(
        generalized_mass(&shapes, &mass).unwrap(),
        dmatrix![3.0, 7.0; 7.0, 21.0]
    );
    assert_eq!(
        generalized_mass(&DMatrix::zeros(2, 1), &mass)
            .unwrap()
            .shape(),
        (1, 1)
    );
}

#[test]
fn an_overlap_is_charged_to_the_higher_mode() {
    // First order: the lower of two shapes moves by e a/(b − a), the higher by e b/(b − a).
    let (a, b, e) = (100.0, 400.0, 1e-4);
    let shapes = dmatrix![1.0, e; 0.0, (1.0_f64 - e * e).sqrt()];
    let found = orthogonalize(&modes(&[a, b], shapes), &DMatrix::identity(2, 2)).unwrap();
    assert_relative_eq!(found.movement[0].shape, e / 3.0, max_relative = 10.0 * e);
    assert_relative_eq!(
        found.movement[1].shape,
        4.0 * e / 3.0,
        max_relative = 10.0 * e
    );
}

#[test]
fn one_mode_is_only_scaled() {
    let mass = dmatrix![4.0, 0.0; 0.0, 1.0];
    let found = orthogonalize(&modes(&[9.0], dmatrix![-1.0; 0.0]), &mass).unwrap();
    assert_relative_eq!(
        *found.modes.shapes(),
        dmatrix![-0.5; 0.0],
        max_relative = ROUND_OFF
    );
    assert_relative_eq!(
        found.modes.omega_squared()[0],
        9.0,
        max_relative = ROUND_OFF
    );
}

#[test]
fn nearly_dependent_shapes_are_told_from_dependent_ones() {
    for (angle, dependent) in [(1e-5, false), (1e-7, true)] {
        let shapes = dmatrix![1.0, 1.0; 0.0, angle];
        let outcome = orthogonalize(&modes(&[1.0, 2.0], shapes), &DMatrix::identity(2, 2));
        assert_eq!(
            matches!(
                outcome,
                Err(Error::Dependent {
                    what: "test mode",
                    index: 1
                })
            ),
            dependent,
            "{outcome:?}"
        );
        assert_eq!(outcome.is_ok(), !dependent);
    }
}

#[test]
fn equal_shapes_are_dependent_in_faer_s_own_pivot_too() {
    let shapes = dmatrix![1.0, 0.0, 1.0; 0.0, 1.0, 0.0; 0.0, 0.0, 0.0];
    let outcome = orthogonalize(&modes(&[1.0, 2.0, 3.0], shapes), &DMatrix::identity(3, 3));
    assert!(
        matches!(
            outcome,
            Err(Error::Dependent {
                what: "test mode",
                index: 2
            })
        ),
        "{outcome:?}"
    );
}

#[test]
fn round_off_of_a_product_is_no_overlap() {
    // Two modes of one frequency turn by 45 degrees for any overlap at all, so round-off must not count as one.
    let movement = |overlap: f64| {
        let shapes = dmatrix![1.0, overlap; 0.0, 1.0];
        let found = orthogonalize(&modes(&[4.0, 4.0], shapes), &DMatrix::identity(2, 2)).unwrap();
        found.movement[0].shape
    };
    assert_eq!(movement(0.999e-12), 0.0);
    for overlap in [1e-12, -1e-12, 1.001e-12] {
        let turned = 2.0 * (PI / 8.0).sin();
        assert_relative_eq!(movement(overlap), turned, max_relative = ORTHOGONAL_INPUT);
    }
}

#[test]
fn overlaps_are_reported_between_unit_shapes() {
    let mass = dmatrix![4.0, 0.0; 0.0, 1.0];
    let found = orthogonalize(&modes(&[1.0, 9.0], dmatrix![3.0, 1.0; 0.0, 2.0]), &mass).unwrap();
    // Mass products: 36, 12 and 8.
    let overlap = 12.0 / (36.0_f64 * 8.0).sqrt();
    assert_relative_eq!(
        found.overlap,
        dmatrix![1.0, overlap; overlap, 1.0],
        max_relative = ROUND_OFF
    );
}

#[test]
fn bad_input_is_refused() {
    let mass = DMatrix::<f64>::identity(3, 3);
    let shapes = DMatrix::identity(3, 2);
    let refused = |omega: &[f64], shapes: &DMatrix<f64>, mass: &DMatrix<f64>| {
        ModeSet::new(DVector::from_column_slice(omega), shapes.clone())
            .and_then(|raw| orthogonalize(&raw, mass))
            .unwrap_err()
    };
    assert!(matches!(
        refused(&[], &DMatrix::zeros(3, 0), &mass),
        Error::Empty { what: "test modes" }
    ));
    assert!(matches!(
        refused(&[1.0, 2.0], &DMatrix::identity(2, 2), &mass),
        Error::WrongShape {
            what: "test mode shapes",
            expected_rows: 3,
            expected_columns: 2,
            rows: 2,
            columns: 2
        }
    ));
    assert!(matches!(
        refused(&[1.0, 2.0, 3.0], &shapes, &mass),
        Error::WrongShape {
            what: "test mode shapes",
            expected_rows: 3,
            expected_columns: 3,
            rows: 3,
            columns: 2
        }
    ));
    let mut unknown = shapes.clone();
    unknown[(1, 1)] = f64::INFINITY;
    assert!(matches!(
        refused(&[1.0, 2.0], &unknown, &mass),
        Error::NotFinite {
            what: "test mode shapes",
            row: 1,
            column: 1,
            ..
        }
    ));
    let mut still = shapes.clone();
    still.column_mut(1).fill(0.0);
    match refused(&[1.0, 2.0], &still, &mass) {
        Error::NotPositive {
            what: "largest component",
            owner,
            value,
        } => {
            assert_eq!((owner.as_str(), value), ("test mode 1 (from zero)", 0.0));
        }
        other => panic!("{other:?}"),
    }
    for bad in [0.0, -4.0, f64::NAN, f64::INFINITY] {
        match refused(&[1.0, bad], &shapes, &mass) {
            Error::NotPositive {
                what: "squared frequency",
                owner,
                value,
            } => {
                assert_eq!(owner, "test mode 1 (from zero)");
                assert_eq!(value.to_bits(), bad.to_bits());
            }
            other => panic!("{other:?}"),
        }
    }
    let mut massless = mass.clone();
    massless[(2, 2)] = 0.0;
    assert!(matches!(
        refused(&[1.0, 2.0], &shapes, &massless),
        Error::NotPositiveDefinite {
            what: "dynamic mass",
            dof: 2
        }
    ));
    let mut skew = mass.clone();
    skew[(2, 0)] = 1.0;
    assert!(matches!(
        refused(&[1.0, 2.0], &shapes, &skew),
        Error::NotSymmetric {
            what: "dynamic mass",
            row: 2,
            column: 0,
            ..
        }
    ));
}
