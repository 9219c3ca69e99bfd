//! Which of overlapping test modes is deleted, by hand: unit masses, so overlaps are plain products.

use crate::prelude::*;

#[test]
fn of_two_overlapping_modes_the_higher_is_deleted() {
    for omega_squared in [[100.0, 400.0, 900.0], [400.0, 100.0, 900.0]] {
        let higher = usize::from(omega_squared[0] < omega_squared[1]);
        let raw = modes(
            &omega_squared,
            unit_shapes(&[
                [1.0, 0.0, 0.0, 0.0],
                [0.3, 1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
            ]),
        );
        let found = examine(&raw, &eye(4), Supports::Held, &MovementLimits::default()).unwrap();
        let expected = (0..3).filter(|&mode| mode != higher).collect_vec();
        assert_eq!(found.kept, expected);
    }
}

#[test]
fn a_third_mode_decides_between_two() {
    // Modes 0 and 1 overlap by 0.29; mode 0 has something of mode 2 besides, so it is the suspect, though lowest.
    let raw = modes(
        &[100.0, 400.0, 1600.0],
        unit_shapes(&[
            [1.0, 0.0, 0.0, 0.0],
            [0.3, 1.0, 0.0, 0.0],
            [0.02, 0.0, 1.0, 0.0],
        ]),
    );
    let found = examine(&raw, &eye(4), Supports::Held, &MovementLimits::default()).unwrap();
    assert_eq!(found.kept, [1, 2]);
}

#[test]
fn a_low_wrong_mode_is_told_by_its_many_overlaps() {
    // The lowest mode has a little of every other one: each of those moves farther than it, but only its deletion
    // leaves the rest orthogonal.
    let raw = modes(
        &[100.0, 900.0, 1600.0, 2500.0],
        unit_shapes(&[
            [1.0, 0.15, 0.08, 0.08],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]),
    );
    let mass = eye(4);
    let moved = orthogonalize(&raw, &mass).unwrap().movement;
    assert!(
        moved[0].shape < MovementLimits::default().shape
            && moved[1].shape > MovementLimits::default().shape
    );
    let found = examine(&raw, &mass, Supports::Held, &MovementLimits::default()).unwrap();
    assert_eq!(found.kept, [1, 2, 3]);
    assert!(found.movement[0].is_some());
    assert_eq!(found.modes.shapes().shape(), (4, 3));
}

#[test]
fn two_wrong_modes_are_both_deleted() {
    let raw = modes(
        &[100.0, 900.0, 1600.0, 2500.0],
        unit_shapes(&[
            [1.0, 0.0, 0.5, 0.5],
            [0.0, 1.0, 0.4, 0.6],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]),
    );
    let found = examine(&raw, &eye(4), Supports::Held, &MovementLimits::default()).unwrap();
    assert_eq!(found.kept, [2, 3]);
    assert!(found.movement.iter().all(Option::is_some));
}

#[test]
fn a_movement_at_its_limit_is_allowed_and_past_it_not() {
    let (raw, mass, movement) = slight_overlap();
    let far = MovementLimits {
        balance: 0.5,
        frequency: 10.0,
        shape: 10.0,
    };
    let largest_shape = movement[0].shape.max(movement[1].shape);
    let largest_frequency = movement[0].frequency.abs().max(movement[1].frequency.abs());
    // The lower frequency moves down and is the larger movement nowhere: both signs count.
    assert!(movement[0].frequency < 0.0 && movement[1].frequency > 0.0);
    for (at, past) in [
        (
            MovementLimits {
                shape: largest_shape,
                ..far
            },
            MovementLimits {
                shape: largest_shape.next_down(),
                ..far
            },
        ),
        (
            MovementLimits {
                frequency: largest_frequency,
                ..far
            },
            MovementLimits {
                frequency: largest_frequency.next_down(),
                ..far
            },
        ),
    ] {
        assert_eq!(
            examine(&raw, &mass, Supports::Held, &at).unwrap().kept,
            [0, 1]
        );
        assert_eq!(
            examine(&raw, &mass, Supports::Held, &past).unwrap().kept,
            [0]
        );
    }
}

#[test]
fn a_frequency_that_falls_counts_like_one_that_rises() {
    // The lowest of three overlapping frequencies falls farthest when the other two pull from close above.
    let raw = modes(
        &[100.0, 130.0, 140.0],
        unit_shapes(&[
            [1.0, 0.05, -0.05, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ]),
    );
    let mass = eye(4);
    let movement = orthogonalize(&raw, &mass).unwrap().movement;
    let fall = -movement[0].frequency;
    assert!(fall > movement[1].frequency.abs() && fall > movement[2].frequency.abs());
    let far = MovementLimits {
        balance: 0.5,
        frequency: fall.next_down(),
        shape: 10.0,
    };
    assert_eq!(
        examine(&raw, &mass, Supports::Held, &far)
            .unwrap()
            .kept
            .len(),
        2
    );
}
