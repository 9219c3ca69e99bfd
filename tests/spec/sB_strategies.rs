//! The strategies of this subject are what they claim.

use crate::prelude::*;

/// Eigenvalues above round-off of the largest: the number of elastic modes.
fn elastic_count(stiffness: &DMatrix<f64>) -> usize {
    let values = SymmetricEigen::new(stiffness.clone()).eigenvalues;
    let floor = MATRIX_ROUND_OFF * values.max();
    values.iter().filter(|&&value| value > floor).count()
}

properties! {
    #[test]
    fn free_beams_have_two_rigid_body_modes(beam in free_beam()) {
        let count = beam.dofs.len();
        prop_assert!((5..=8).contains(&count));
        prop_assert_eq!(elastic_count(&beam.stiffness), count - 2);
        prop_assert!(beam.mass.diagonal().iter().all(|mass| (0.5..=1.0).contains(mass)));
        prop_assert!(beam.x().as_slice().is_sorted());
        prop_assert_eq!(beam.elastic_modes(2).shapes().shape(), (count, count - 2));
    }

    #[test]
    fn free_trusses_have_six_rigid_body_modes(truss in free_truss()) {
        prop_assert_eq!(elastic_count(&truss.stiffness), 9);
        prop_assert_eq!(truss.dofs.len(), 15);
    }

    #[test]
    fn suspension_rates_bound_the_suspension(
        beam in free_beam(),
        rates in prop::collection::vec(0.0..10.0_f64, 8),
    ) {
        let count = beam.dofs.len();
        let suspended = beam.suspended(&rates[..count]);
        let grounded = (suspended - &beam.stiffness).diagonal();
        for (dof, rate) in rates.iter().take(count).enumerate() {
            let expected = rate * beam.mass[(dof, dof)];
            prop_assert!((grounded[dof] - expected).abs() <= MATRIX_ROUND_OFF * beam.stiffness.amax());
        }
    }

    #[test]
    fn raw_shapes_do_not_vanish((beam, raw) in with_raw_shapes(free_beam(), 3)) {
        prop_assert_eq!(raw.shapes().shape(), (beam.dofs.len(), 3));
        for mode in 0..3 {
            prop_assert!(raw.shapes().column(mode).amax() >= 1.0);
            prop_assert!((1.0..=1e6).contains(&raw.omega_squared()[mode]));
        }
    }

    #[test]
    fn orthonormal_modes_are((exact, mass) in orthonormal_modes(7, 5)) {
        let overlap = exact.shapes().tr_mul(&(&mass * exact.shapes()));
        prop_assert!((overlap - eye(5)).amax() <= MATRIX_ROUND_OFF);
        for pair in exact.omega_squared().as_slice().windows(2) {
            prop_assert!(pair[1] / pair[0] >= 1.2_f64.powi(2) * (1.0 - MATRIX_ROUND_OFF));
        }
    }

    #[test]
    fn held_chains_are_held((stiffness, mass) in held_chain(7)) {
        prop_assert_eq!(elastic_count(&stiffness), 7);
        prop_assert_eq!(mass.shape(), (7, 7));
    }

    #[test]
    fn mixtures_overlap_two_modes((stiffness, mass) in held_chain(7), wrong in mixture(5)) {
        let exact = solve(&stiffness, &mass, 5)?;
        let spoiled = wrong.spoil(&exact);
        let [mode, first, second] = wrong.modes;
        prop_assert!(mode != first && mode != second && first != second);
        let shape = spoiled.shapes().column(mode).into_owned();
        prop_assert!((mass_norm(&shape, &mass) - 1.0).abs() <= MATRIX_ROUND_OFF);
        let overlap = exact.shapes().tr_mul(&(&mass * shape));
        prop_assert!((overlap[first] - wrong.fractions[0]).abs() <= MATRIX_ROUND_OFF);
        prop_assert!((overlap[second] - wrong.fractions[1]).abs() <= MATRIX_ROUND_OFF);
        prop_assert!(wrong.fractions.iter().all(|fraction| (0.3..=0.5).contains(&fraction.abs())));
    }
}
