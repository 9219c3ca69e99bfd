//! The report on test modes by hand: balance and its limit, settings, and what is refused.

use crate::common::appendix_b::{modes, relative_difference, slight_overlap, unit_shapes};
use crate::common::tolerances::{ORTHOGONAL_INPUT, ROUND_OFF};
use approx::assert_relative_eq;
use corfem::method::appendix_b::{MovementLimits, Supports, balance, examine};
use corfem::method::error::Error;
use nalgebra::{DMatrix, dmatrix};

#[test]
fn a_balance_at_its_limit_is_allowed_and_past_it_not() {
    let (mass, stiffness) = (DMatrix::identity(3, 3), DMatrix::zeros(3, 3));
    let rigid_body = dmatrix![1.0, -1.0; 1.0, 0.0; 1.0, 1.0];
    let supports = Supports::Free {
        stiffness: &stiffness,
        rigid_body: &rigid_body,
    };
    let raw = modes(&[7.0], dmatrix![1.1; -2.0; 1.0]);
    let change = balance(&raw, &stiffness, &mass, &rigid_body)
        .unwrap()
        .change[0];
    let at = MovementLimits {
        balance: change,
        ..MovementLimits::default()
    };
    let found = examine(&raw, &mass, supports, &at).unwrap();
    assert_eq!(found.kept, [0]);
    assert_eq!(found.reports[0].balance, Some(change));
    assert_relative_eq!(
        *found.modes.shapes(),
        dmatrix![1.0; -2.0; 1.0] / 6.0_f64.sqrt(),
        max_relative = ROUND_OFF
    );
    let past = MovementLimits {
        balance: change.next_down(),
        ..MovementLimits::default()
    };
    let refused = examine(&raw, &mass, supports, &past);
    assert!(
        matches!(
            refused,
            Err(Error::Empty {
                what: "test modes within the limits"
            })
        ),
        "{refused:?}"
    );
}

#[test]
fn balancing_uses_the_suspension_that_is_given() {
    let mass = DMatrix::identity(3, 3);
    let rigid_body = dmatrix![1.0, -1.0; 1.0, 0.0; 1.0, 1.0];
    let stiffness = DMatrix::from_diagonal(&nalgebra::dvector![3.0, 0.0, 3.0]);
    let raw = modes(&[100.0], dmatrix![1.1; -2.0; 1.0]);
    let supports = Supports::Free {
        stiffness: &stiffness,
        rigid_body: &rigid_body,
    };
    let found = examine(&raw, &mass, supports, &MovementLimits::default()).unwrap();
    let balanced = balance(&raw, &stiffness, &mass, &rigid_body).unwrap();
    assert_eq!(found.reports[0].balance, Some(balanced.change[0]));
    let shape = balanced.shapes.column(0).normalize();
    assert_relative_eq!(
        found.modes.shapes().column(0).into_owned(),
        shape,
        max_relative = ROUND_OFF
    );
}

#[test]
fn a_held_structure_called_free_is_refused() {
    let mass = DMatrix::<f64>::identity(3, 3);
    let rigid_body = DMatrix::repeat(3, 1, 1.0);
    let supports = Supports::Free {
        stiffness: &mass,
        rigid_body: &rigid_body,
    };
    let raw = modes(&[1.0], dmatrix![1.0; 0.0; 0.0]);
    let outcome = examine(&raw, &mass, supports, &MovementLimits::default());
    assert!(
        matches!(outcome, Err(Error::Supported { mode: 0, .. })),
        "{outcome:?}"
    );
}

#[test]
fn dependent_modes_keep_their_numbers_when_one_before_them_is_deleted() {
    let mass = DMatrix::<f64>::identity(4, 4);
    let stiffness = DMatrix::zeros(4, 4);
    let rigid_body = DMatrix::repeat(4, 1, 1.0);
    let supports = Supports::Free {
        stiffness: &stiffness,
        rigid_body: &rigid_body,
    };
    let shape = [1.0, -1.0, 0.0, 0.0];
    let raw = modes(
        &[1.0, 2.0, 3.0, 4.0],
        unit_shapes(&[[1.0, 1.0, 1.0, 0.0], shape, [0.0, 0.0, 1.0, -1.0], shape]),
    );
    let outcome = examine(&raw, &mass, supports, &MovementLimits::default());
    assert!(
        matches!(
            outcome,
            Err(Error::Dependent {
                what: "test mode",
                index: 3
            })
        ),
        "{outcome:?}"
    );
}

#[test]
fn default_limits_are_the_documented_ones() {
    let expected = MovementLimits {
        balance: 0.1,
        frequency: 0.02,
        shape: 0.1,
    };
    assert_eq!(MovementLimits::default(), expected);
}

#[test]
fn limits_out_of_range_are_refused() {
    let (raw, mass, _) = slight_overlap();
    let good = MovementLimits::default();
    for (limits, setting, value) in [
        (
            MovementLimits {
                balance: 0.0,
                ..good
            },
            "balance",
            0.0,
        ),
        (
            MovementLimits {
                balance: 1.0,
                ..good
            },
            "balance",
            1.0,
        ),
        (
            MovementLimits {
                frequency: -1.0,
                ..good
            },
            "frequency",
            -1.0,
        ),
        (
            MovementLimits {
                frequency: f64::INFINITY,
                ..good
            },
            "frequency",
            f64::INFINITY,
        ),
        (MovementLimits { shape: 0.0, ..good }, "shape", 0.0),
        (
            MovementLimits {
                shape: f64::NAN,
                ..good
            },
            "shape",
            f64::NAN,
        ),
    ] {
        match examine(&raw, &mass, Supports::Held, &limits) {
            Err(Error::Setting { name, found, .. }) => {
                assert_eq!(name, setting);
                assert_eq!(found.to_bits(), value.to_bits());
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn the_wing_box_s_own_test_modes_are_kept() {
    let case = corfem::torque_box::Case::new(2).unwrap();
    let raw = case.test_modes().unwrap();
    let found = examine(
        &raw,
        &case.reconstruction.mass(),
        Supports::Held,
        &MovementLimits::default(),
    )
    .unwrap();
    assert_eq!(found.kept, (0..9).collect::<Vec<_>>());
    assert!(relative_difference(raw.shapes(), found.modes.shapes()) <= ORTHOGONAL_INPUT);
}
