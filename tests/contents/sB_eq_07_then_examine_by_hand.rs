//! The report on test modes by hand: balance and its limit, settings, and what is refused.

use crate::prelude::*;

#[test]
fn a_balance_at_its_limit_is_allowed_and_past_it_not() {
    let (mass, stiffness) = (eye(3), zero_square(3));
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
    assert_eq!(found.change[0], change);
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
    assert_eq!(
        said(refused),
        "test modes within the limits: 0 given or asked for; there must be at least 1"
    );
}

#[test]
fn balancing_uses_the_suspension_that_is_given() {
    let mass = eye(3);
    let rigid_body = dmatrix![1.0, -1.0; 1.0, 0.0; 1.0, 1.0];
    let stiffness = diagonal([3.0, 0.0, 3.0]);
    let raw = modes(&[100.0], dmatrix![1.1; -2.0; 1.0]);
    let supports = Supports::Free {
        stiffness: &stiffness,
        rigid_body: &rigid_body,
    };
    let found = examine(&raw, &mass, supports, &MovementLimits::default()).unwrap();
    let balanced = balance(&raw, &stiffness, &mass, &rigid_body).unwrap();
    assert_eq!(found.change[0], balanced.change[0]);
    let shape = balanced.shapes.column(0).normalize();
    assert_relative_eq!(
        found.modes.shapes().column(0).into_owned(),
        shape,
        max_relative = ROUND_OFF
    );
}

#[test]
fn a_held_structure_called_free_is_refused() {
    let mass = eye(4);
    let rigid_body = DMatrix::repeat(4, 1, 1.0);
    let supports = Supports::Free {
        stiffness: &mass,
        rigid_body: &rigid_body,
    };
    let raw = modes(&[1.0], dmatrix![1.0; 0.0; 0.0; 0.0]);
    let outcome = examine(&raw, &mass, supports, &MovementLimits::default());
    assert_eq!(
        said(outcome),
        "rigid-body stiffness over inertia of mode 0 (from zero) is 1; it must be at most 0.04, as on a free or softly suspended \
         structure: supports balance the forces of any other"
    );
}

#[test]
fn dependent_modes_are_numbered_among_those_that_are_left() {
    let mass = eye(4);
    let stiffness = zero_square(4);
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
    // Balancing deletes the first, so that the last is the third of those that are left.
    let outcome = examine(&raw, &mass, supports, &MovementLimits::default());
    assert_eq!(said(outcome), not_definite("overlap of the test shapes", 2));
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
    type Set = fn(&mut MovementLimits, f64);
    let setters: [(&str, Set); 3] = [
        ("balance", |limits, value| limits.balance = value),
        ("frequency", |limits, value| limits.frequency = value),
        ("shape", |limits, value| limits.shape = value),
    ];
    for (setting, set) in setters {
        for value in [0.0, -1.0, f64::INFINITY, f64::NAN] {
            let mut limits = good;
            set(&mut limits, value);
            assert_eq!(
                said(examine(&raw, &mass, Supports::Held, &limits)),
                format!(
                    "{setting} of the movement limits is {value}; it must be positive and finite"
                )
            );
        }
    }
}
