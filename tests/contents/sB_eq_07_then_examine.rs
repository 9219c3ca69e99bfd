//! The report on test modes, and the deletion of deviant ones.

use crate::prelude::*;

/// The modes without one of them.
fn without(all: &Modes, mode: usize) -> Modes {
    Modes::new(
        all.omega_squared().clone().remove_row(mode),
        all.shapes().clone().remove_column(mode),
    )
    .unwrap()
}

properties! {
    /// Exact modes of a held structure pass unchanged.
    #[test]
    fn exact_modes_of_a_held_structure_are_kept((stiffness, mass) in held_chain(7)) {
        let exact = solve(&stiffness, &mass, 5)?;
        let found = examine(&exact, &mass, Supports::Held, &MovementLimits::default())?;
        prop_assert_eq!(&found.kept, &vec![0, 1, 2, 3, 4]);
        prop_assert_eq!(&found.change, &vec![0.0; 5]);
        prop_assert!(relative_difference(exact.shapes(), found.modes.shapes()) <= ORTHOGONAL_INPUT);
        for (mode, movement) in found.movement.iter().enumerate() {
            let movement = movement.unwrap();
            prop_assert!(movement.shape <= ORTHOGONAL_INPUT && movement.frequency.abs() <= ORTHOGONAL_INPUT);
            assert_relative_eq!(found.modes.omega_squared()[mode], exact.omega_squared()[mode], max_relative = ORTHOGONAL_INPUT);
        }
    }

    /// Exact modes of a free structure pass unchanged, and the report says that balancing did nothing.
    #[test]
    fn exact_modes_of_a_free_structure_are_kept(beam in free_beam()) {
        let exact = beam.elastic_modes(2);
        let rigid_body = rigid_body_vectors(&beam.dofs).select_columns(&SYMMETRIC);
        let supports = Supports::Free { stiffness: &beam.stiffness, rigid_body: &rigid_body };
        let found = examine(&exact, &beam.mass, supports, &MovementLimits::default())?;
        let spread = exact.omega_squared().max() / exact.omega_squared().min();
        prop_assert_eq!(found.kept, (0..exact.len()).collect_vec());
        prop_assert!(relative_difference(exact.shapes(), found.modes.shapes()) <= EXACT_MODE_RESIDUAL * spread);
        for (change, movement) in found.change.iter().zip(&found.movement) {
            prop_assert!(*change <= EXACT_MODE_RESIDUAL * spread);
            prop_assert!(movement.unwrap().shape <= EXACT_MODE_RESIDUAL * spread);
        }
    }

    /// Wherever in the spectrum a wrong mode lies, it is the one deleted: it overlaps two others by at least 0.3 while
    /// those overlap it alone, and an overlap of 0.3 moves some mode by 0.15 at least. The rest come out as if it had not
    /// been measured.
    #[test]
    fn the_wrong_mode_is_the_one_deleted((stiffness, mass) in held_chain(7), wrong in mixture(5)) {
        let exact = solve(&stiffness, &mass, 5)?;
        let mode = wrong.modes[0];
        let found = examine(&wrong.spoil(&exact), &mass, Supports::Held, &MovementLimits::default())?;
        prop_assert_eq!(&found.kept, &(0..5).filter(|&other| other != mode).collect_vec());
        let expected = without(&exact, mode);
        prop_assert!(relative_difference(expected.shapes(), found.modes.shapes()) <= ORTHOGONAL_INPUT);
        for (found, expected) in found.modes.omega_squared().iter().zip(expected.omega_squared().iter()) {
            assert_relative_eq!(*found, *expected, max_relative = ORTHOGONAL_INPUT);
        }
        let moved = orthogonalize(&wrong.spoil(&exact), &mass)?.movement;
        prop_assert_eq!(found.movement[mode], Some(moved[mode]));
    }

    /// An accelerometer mounted upside down leaves a net force, so balancing finds the mode; the masses are of one size,
    /// so reversing the point of most kinetic energy takes at least 2 (1/√8) √(0.5/7.5) = 18 % of the shape.
    #[test]
    fn a_reversed_accelerometer_is_found_by_balancing(beam in free_beam(), pick in any::<prop::sample::Index>()) {
        let exact = beam.elastic_modes(2);
        let mode = pick.index(exact.len());
        let energy = beam.mass.diagonal().component_mul(&exact.shapes().column(mode).map(|v| v * v));
        let mut raw = exact.clone();
        alter(&mut raw, |_, shapes| shapes[(energy.imax(), mode)] *= -1.0);
        let rigid_body = rigid_body_vectors(&beam.dofs).select_columns(&SYMMETRIC);
        let supports = Supports::Free { stiffness: &beam.stiffness, rigid_body: &rigid_body };
        let found = examine(&raw, &beam.mass, supports, &MovementLimits::default())?;
        prop_assert_eq!(&found.kept, &(0..exact.len()).filter(|&other| other != mode).collect_vec());
        prop_assert_eq!((found.change.len(), found.movement.len()), (exact.len(), exact.len()));
        prop_assert_eq!(found.movement[mode], None);
        prop_assert!(found.change[mode] >= 0.18);
        let spread = exact.omega_squared().max() / exact.omega_squared().min();
        prop_assert!(
            relative_difference(without(&exact, mode).shapes(), found.modes.shapes()) <= EXACT_MODE_RESIDUAL * spread
        );
    }

    /// (B.1), (B.2) and (B.5) hold together for whatever is kept of noisy modes of a free structure, and every kept mode
    /// is within the limits.
    #[test]
    fn kept_free_modes_are_balanced_and_orthonormal(
        (beam, noise) in free_beam().prop_flat_map(|beam| {
            let size = beam.dofs.len();
            (Just(beam), noise(size, size - 2))
        }),
    ) {
        let mut raw = beam.elastic_modes(2);
        // Small enough that balancing, at most the noise's mass norm of 0.02 √8, deletes none.
        alter(&mut raw, |_, shapes| *shapes += 0.02 * noise);
        let rigid_body = rigid_body_vectors(&beam.dofs).select_columns(&SYMMETRIC);
        let supports = Supports::Free { stiffness: &beam.stiffness, rigid_body: &rigid_body };
        let limits = MovementLimits::default();
        let found = examine(&raw, &beam.mass, supports, &limits)?;
        let count = found.kept.len();
        prop_assert_eq!(found.modes.shapes().shape(), (beam.dofs.len(), count));
        prop_assert_eq!(found.modes.len(), count);
        let overlap = generalized_mass(found.modes.shapes(), &beam.mass)? - eye(count);
        prop_assert!(overlap.amax() <= ORTHOGONAL_INPUT);
        for (place, omega_squared) in found.modes.omega_squared().iter().enumerate() {
            let shape = found.modes.shapes().column(place);
            let impedance = *omega_squared * &beam.mass - &beam.stiffness;
            let parts = impedance.abs() * shape.abs();
            for arm in rigid_body.column_iter() {
                let left = arm.dot(&(&impedance * shape)).abs() / arm.abs().dot(&parts);
                prop_assert!(left <= BALANCE_RESIDUAL, "{left:e}");
            }
        }
        for &mode in &found.kept {
            prop_assert!(found.change[mode] <= limits.balance);
            let movement = found.movement[mode].unwrap();
            prop_assert!(movement.shape <= limits.shape && movement.frequency.abs() <= limits.frequency);
        }
    }

    /// A deleted mode leaves no trace: the kept ones examined alone come out the same, all of them kept.
    #[test]
    fn deletion_leaves_no_trace((stiffness, mass) in held_chain(7), noise in noise(7, 5)) {
        let mut raw = solve(&stiffness, &mass, 5)?;
        alter(&mut raw, |_, shapes| *shapes += 0.1 * noise);
        let found = examine(&raw, &mass, Supports::Held, &MovementLimits::default())?;
        let chosen = Modes::new(DVector::from_iterator(found.kept.len(), found.kept.iter().map(|&mode| raw.omega_squared()[mode])), raw.shapes().select_columns(&found.kept))?;
        let again = examine(&chosen, &mass, Supports::Held, &MovementLimits::default())?;
        prop_assert_eq!(again.modes, found.modes);
        prop_assert_eq!(again.kept, (0..found.kept.len()).collect_vec());
    }
}

/// A mass may give every shape a positive generalized mass and be indefinite all the same.
#[test]
fn an_indefinite_mass_is_refused() {
    let mass = dmatrix![1.0, 2.0; 2.0, 1.0];
    let raw = Modes::new(vec![1.0, 4.0].into(), eye(2)).unwrap();
    let refused = examine(&raw, &mass, Supports::Held, &MovementLimits::default());
    assert_eq!(said(refused), not_definite("dynamic mass", 1));
}
