//! Balance of forces and moments (B.1 to B.4).

use crate::common::measured::FreeStructure;
use crate::prelude::*;

/// A force or moment that remains, relative to the sum of the magnitudes that make it up.
fn relative_resultant(
    arm: &DVector<f64>,
    omega_squared: f64,
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    shape: &DVector<f64>,
) -> f64 {
    let forces = (omega_squared * mass - stiffness) * shape;
    let parts = (omega_squared * mass.abs() + stiffness.abs()) * shape.abs();
    arm.dot(&forces).abs() / arm.abs().dot(&parts)
}

/// Suspension rates at a fraction of what the lowest test frequency allows.
fn rates(structure: &FreeStructure, lowest: f64, fractions: &[f64]) -> Vec<f64> {
    let largest = LARGEST_SUSPENSION_RATIO * lowest;
    fractions
        .iter()
        .take(structure.dofs.len())
        .map(|fraction| fraction * largest)
        .collect()
}

properties! {
    /// (B.1) and (B.2), written out, on a free structure and on soft suspensions.
    #[test]
    fn symmetric_forces_and_moments_balance(
        (beam, raw) in with_raw_shapes(free_beam(), 3),
        fractions in prop::collection::vec(0.0..0.99_f64, 8),
        free in any::<bool>(),
    ) {
        let stiffness = if free {
            beam.stiffness.clone()
        } else {
            beam.suspended(&rates(&beam, raw.omega_squared().min(), &fractions))
        };
        let rigid_body = rigid_body_vectors(&beam.dofs).select_columns(&SYMMETRIC);
        let balanced = balance(&raw, &stiffness, &beam.mass, &rigid_body)?;
        let (ones, x) = (DVector::repeat(beam.dofs.len(), 1.0), beam.x());
        prop_assert_eq!(balanced.shapes.shape(), (beam.dofs.len(), 3));
        prop_assert_eq!(balanced.coefficients.shape(), (2, 3));
        prop_assert_eq!(balanced.change.len(), 3);
        for mode in 0..3 {
            let shape = balanced.shapes.column(mode).into_owned();
            for arm in [&ones, &x] {
                let left = relative_resultant(arm, raw.omega_squared()[mode], &stiffness, &beam.mass, &shape);
                prop_assert!(left <= BALANCE_RESIDUAL, "{left:e}");
            }
            let motion = balanced.coefficients[(0, mode)] * &ones + balanced.coefficients[(1, mode)] * &x;
            let expected = raw.shapes().column(mode) + &motion;
            prop_assert!((&shape - expected).amax() <= BALANCE_EQUATIONS * raw.shapes().column(mode).amax());
            assert_relative_eq!(
                balanced.change[mode],
                mass_norm(&motion, &beam.mass) / mass_norm(&raw.shapes().column(mode).into_owned(), &beam.mass),
                max_relative = BALANCE_EQUATIONS, epsilon = BALANCE_EQUATIONS
            );
        }
    }

    /// Side force, rolling and yawing moment, written out from positions and forces, on a truss in space.
    #[test]
    fn antisymmetric_forces_and_moments_balance((truss, raw) in with_raw_shapes(free_truss(), 3)) {
        let rigid_body = rigid_body_vectors(&truss.dofs).select_columns(&ANTISYMMETRIC);
        let balanced = balance(&raw, &truss.stiffness, &truss.mass, &rigid_body)?;
        prop_assert_eq!(balanced.shapes.shape(), (15, 3));
        prop_assert_eq!(balanced.coefficients.shape(), (3, 3));
        for mode in 0..3 {
            let impedance = raw.omega_squared()[mode] * &truss.mass - &truss.stiffness;
            let forces = &impedance * balanced.shapes.column(mode);
            let scale = (impedance.abs() * balanced.shapes.column(mode).abs()).sum();
            let (mut side, mut roll, mut yaw) = (0.0, 0.0, 0.0);
            for joint in 0..5 {
                let at = truss.dofs[3 * joint].position;
                let force = forces.fixed_rows::<3>(3 * joint);
                side += force[1];
                roll += at.y * force[2] - at.z * force[1];
                yaw += at.x * force[1] - at.y * force[0];
            }
            // The joints lie within 50 in of the axes.
            prop_assert!(side.abs() <= BALANCE_RESIDUAL * scale);
            prop_assert!(roll.abs() <= 50.0 * BALANCE_RESIDUAL * scale);
            prop_assert!(yaw.abs() <= 50.0 * BALANCE_RESIDUAL * scale);
        }
    }

    /// (B.3) and (B.4) as simultaneous equations by nalgebra's LU, another route than the suspension modes.
    #[test]
    fn coefficients_solve_the_simultaneous_equations(
        (beam, raw) in with_raw_shapes(free_beam(), 2),
        fractions in prop::collection::vec(0.0..0.99_f64, 8),
    ) {
        let stiffness = beam.suspended(&rates(&beam, raw.omega_squared().min(), &fractions));
        let rigid_body = rigid_body_vectors(&beam.dofs).select_columns(&SYMMETRIC);
        let balanced = balance(&raw, &stiffness, &beam.mass, &rigid_body)?;
        for mode in 0..2 {
            let impedance = raw.omega_squared()[mode] * &beam.mass - &stiffness;
            let left = rigid_body.tr_mul(&(&impedance * &rigid_body));
            let right = -rigid_body.tr_mul(&(&impedance * raw.shapes().column(mode)));
            let solved = left.lu().solve(&right).unwrap();
            let motion = &rigid_body * solved;
            let shape = raw.shapes().column(mode) + &motion;
            // The elastic forces, up to 1e8 of the inertia at 1 rad/s, cancel in the resultants.
            let forces = (raw.omega_squared()[mode] * beam.mass.abs() + stiffness.abs()) * raw.shapes().column(mode).abs();
            let scale = forces.amax() / raw.omega_squared()[mode];
            prop_assert!(
                (balanced.shapes.column(mode) - shape).amax() <= BALANCE_EQUATIONS * scale
            );
        }
    }

    /// Moving the reference axis by a changes r1 to r1 + a r2 and nothing else.
    #[test]
    fn the_reference_axis_does_not_matter(
        (beam, raw) in with_raw_shapes(free_beam(), 2),
        axis in -100.0..100.0_f64,
    ) {
        let free = DMatrix::zeros(beam.dofs.len(), beam.dofs.len());
        let mut moved = beam.clone();
        for dof in &mut moved.dofs {
            dof.position.x -= axis;
        }
        let here = balance(&raw, &free, &beam.mass, &rigid_body_vectors(&beam.dofs).select_columns(&SYMMETRIC))?;
        let there = balance(&raw, &free, &beam.mass, &rigid_body_vectors(&moved.dofs).select_columns(&SYMMETRIC))?;
        prop_assert!((&here.shapes - &there.shapes).amax() <= BALANCE_EQUATIONS * raw.shapes().amax());
        for mode in 0..2 {
            let (r1, r2) = (here.coefficients[(0, mode)], here.coefficients[(1, mode)]);
            // A pitch of a tenth per inch, 300 in from the axis, is a plunge of 30.
            prop_assert!((there.coefficients[(1, mode)] - r2).abs() <= BALANCE_EQUATIONS * raw.shapes().amax());
            prop_assert!((there.coefficients[(0, mode)] - r1 - axis * r2).abs() <= 100.0 * BALANCE_EQUATIONS * raw.shapes().amax());
        }
    }

    /// Held structures: no motion has a smaller ratio of stiffness to mass than the lowest mode, so with that mode among
    /// the test modes the ratio is at least one and the error certain.
    #[test]
    fn a_held_structure_is_refused((stiffness, mass) in held_chain(6)) {
        let exact = solve(&stiffness, &mass, 6)?;
        let ones = DMatrix::repeat(6, 1, 1.0);
        let quotient = stiffness.sum() / (mass.trace() * exact.omega_squared()[0]);
        match balance(&exact, &stiffness, &mass, &ones) {
            Err(Error::Value { what: "rigid-body stiffness over inertia", value: ratio, .. }) => {
                prop_assert!(ratio >= 1.0);
                assert_relative_eq!(ratio, quotient, max_relative = EXACT_MODE_RESIDUAL);
            }
            other => prop_assert!(false, "expected a refusal, found {other:?}"),
        }
    }
}
