//! Natural modes (3): order, scale and sign; faer's route against nalgebra's and against a closed form.

use crate::prelude::*;

properties! {
    #[test]
    fn shapes_are_mass_orthonormal((stiffness, mass, condition) in pencil()) {
        let size = stiffness.nrows();
        let modes = solve(&stiffness, &mass, size)?;
        prop_assert_eq!(modes.shapes().shape(), (size, size));
        let unit = modes.shapes().tr_mul(&(&mass * modes.shapes()));
        let error = (unit - eye(size)).amax();
        prop_assert!(error <= MATRIX_ROUND_OFF * condition, "{error:e}");
    }

    #[test]
    fn frequencies_ascend((stiffness, mass, _) in pencil()) {
        let modes = solve(&stiffness, &mass, stiffness.nrows())?;
        let frequencies = modes.frequencies_hz();
        prop_assert_eq!(frequencies.len(), stiffness.nrows());
        for pair in frequencies.windows(2) {
            prop_assert!(pair[0] <= pair[1]);
        }
        for (frequency, omega_squared) in frequencies.iter().zip(modes.omega_squared().iter()) {
            let back = (2.0 * PI * frequency).powi(2);
            prop_assert!(relative_error(back, omega_squared) <= ROUND_OFF);
        }
    }

    #[test]
    fn modes_satisfy_the_equation_of_motion((stiffness, mass, condition) in pencil()) {
        let modes = solve(&stiffness, &mass, stiffness.nrows())?;
        let inertia = &mass * modes.shapes() * DMatrix::from_diagonal(modes.omega_squared());
        let residual = (&stiffness * modes.shapes() - inertia).amax();
        let scale = stiffness.amax() * modes.shapes().amax();
        prop_assert!(residual <= MATRIX_ROUND_OFF * condition * scale, "{residual:e} of {scale:e}");
    }

    #[test]
    fn the_first_of_the_largest_components_is_positive((stiffness, mass, _) in pencil()) {
        let modes = solve(&stiffness, &mass, stiffness.nrows())?;
        for shape in modes.shapes().column_iter() {
            let largest = shape.amax() * (1.0 - EQUALLY_LARGE);
            let first = shape.iter().find(|component| component.abs() >= largest);
            prop_assert!(first.is_some_and(|&component| component > 0.0), "{shape}");
        }
    }

    #[test]
    fn faer_and_nalgebra_give_the_same_roots((stiffness, mass, condition) in pencil()) {
        let modes = solve(&stiffness, &mass, stiffness.nrows())?;
        let (roots, _) = modes_by_nalgebra(&stiffness, &mass);
        let error = (modes.omega_squared() - &roots).amax();
        prop_assert!(error <= EIGEN_ROUND_OFF * condition * roots.amax(), "{error:e}");
    }

    #[test]
    fn the_lowest_modes_are_the_first_of_all((stiffness, mass, _) in pencil()) {
        let all = solve(&stiffness, &mass, stiffness.nrows())?;
        for count in 1..=stiffness.nrows() {
            let lowest = solve(&stiffness, &mass, count)?;
            prop_assert_eq!(lowest.shapes().shape(), (stiffness.nrows(), count));
            prop_assert_eq!(lowest.omega_squared(), &all.omega_squared().rows(0, count));
            prop_assert_eq!(lowest.shapes(), &all.shapes().columns(0, count));
            prop_assert_eq!(all.lowest(count)?, lowest);
        }
    }

    #[test]
    fn measured_shapes_may_have_any_scale_and_sign(
        (stiffness, mass, condition) in pencil(),
        scales in prop::collection::vec((1e-3..1e3_f64, any::<bool>()), 6),
    ) {
        let modes = solve(&stiffness, &mass, stiffness.nrows())?;
        let mut raw = modes.shapes().clone();
        for (mut shape, &(scale, flip)) in raw.column_iter_mut().zip(&scales) {
            shape *= if flip { -scale } else { scale };
        }
        let measured = Modes::from_measured(&modes.frequencies_hz(), &raw)
            .and_then(|measured| measured.scaled_with(&mass))
            ?;
        prop_assert_eq!(measured.len(), modes.len());
        let largest = modes.shapes().amax();
        for (mode, &(_, flip)) in scales.iter().take(modes.len()).enumerate() {
            // The scale is gone and the sign stays.
            let sign = if flip { -1.0 } else { 1.0 };
            let error = (measured.shapes().column(mode) - sign * modes.shapes().column(mode)).amax();
            prop_assert!(error <= MATRIX_ROUND_OFF * condition * largest, "{error:e} of {largest:e}");
        }
        assert_alike(measured.omega_squared().iter(), modes.omega_squared().iter(), ROUND_OFF);
    }

    #[test]
    fn a_uniform_chain_has_the_modes_of_a_loaded_string(
        count in 1..=8_usize,
        stiffness in 100.0..10_000.0_f64,
        mass in 0.001..0.1_f64,
    ) {
        let assembled: DMatrix<f64> =
            (0..=count).map(|s| spring_stiffness(count, s, stiffness)).sum();
        let masses = DMatrix::from_diagonal_element(count, count, mass);
        let modes = solve(&assembled, &masses, count)?;
        let expected = uniform_held_modes(count, stiffness, mass);
        prop_assert_eq!(expected.shapes().shape(), (count, count));
        let roots = (modes.omega_squared() - expected.omega_squared()).amax();
        prop_assert!(roots <= EIGEN_ROUND_OFF * stiffness / mass, "{roots:e}");
        let shapes = (modes.shapes() - expected.shapes()).amax() * mass.sqrt();
        prop_assert!(shapes <= MATRIX_ROUND_OFF, "{shapes:e}");
    }
}

#[test]
fn two_masses_by_hand() {
    // Springs 3 to ground and 2 between, masses 1 and 2 times 0.25: (k - 0.25 x)(...) with roots by hand:
    // det [5 - m x, -2; -2, 2 - 2 m x] = 2 (mx)^2 - 12 mx + 6 = 0, mx = 3 -+ sqrt(6).
    let stiffness = dmatrix![5.0, -2.0; -2.0, 2.0];
    let mass = dmatrix![0.25, 0.0; 0.0, 0.5];
    let modes = solve(&stiffness, &mass, 2).unwrap();
    assert_eq!(modes.len(), 2);
    assert_alike(
        modes.omega_squared().iter(),
        [4.0 * (3.0 - 6_f64.sqrt()), 4.0 * (3.0 + 6_f64.sqrt())],
        ROUND_OFF,
    );
    let frequency = (4.0 * (3.0 - 6_f64.sqrt())).sqrt() / (2.0 * PI);
    assert!(relative_error(modes.frequencies_hz()[0], frequency) <= ROUND_OFF);
}

#[test]
fn sign_rule_by_hand() {
    let mut shapes = dmatrix![
        -1.0,  1.0, -1.0,       -1.0,      0.5, 0.0;
         0.5, -2.0,  1.0,        1.0,     -3.0, 0.0;
         0.2,  1.9,  1.0 + 5e-7, 1.00002, -3.0, 0.0
    ];
    apply_sign_rule(&mut shapes);
    let expected = dmatrix![
         1.0, -1.0,  1.0,          -1.0,    -0.5, 0.0;
        -0.5,  2.0, -1.0,           1.0,     3.0, 0.0;
        -0.2, -1.9, -(1.0 + 5e-7),  1.00002, 3.0, 0.0
    ];
    assert_eq!(shapes, expected);
}

#[test]
fn nearly_symmetric_stiffness_is_taken_as_symmetric() {
    // Round-off of a congruence transformation is no mistake; 1e-9 of the largest entry still passes.
    let stiffness = dmatrix![2.0, 1.0 + 1e-9; 1.0 - 1e-9, 2.0];
    let modes = solve(&stiffness, &eye(2), 2).unwrap();
    assert!((modes.omega_squared() - dvector![1.0, 3.0]).amax() <= ROUND_OFF);
}

#[test]
fn measured_modes_by_hand() {
    // Mass 4 and shape 3: generalized mass 36, so the shape becomes 1/2; 1 Hz is (2 pi)^2.
    let modes = Modes::from_measured(&[1.0, 0.5], &dmatrix![-3.0, 0.0; 0.0, 2.0])
        .and_then(|measured| measured.scaled_with(&dmatrix![4.0, 0.0; 0.0, 25.0]))
        .unwrap();
    assert_eq!(*modes.shapes(), dmatrix![-0.5, 0.0; 0.0, 0.2]);
    assert_alike([modes.omega_squared()[0]], [(4.0 * PI * PI)], ROUND_OFF);
    assert_alike([modes.omega_squared()[1]], [(PI * PI)], ROUND_OFF);
}

#[test]
fn measured_modes_keep_their_order() {
    let identity = eye(2);
    let modes = Modes::from_measured(&[9.0, 4.0], &identity).unwrap();
    assert!(modes.omega_squared()[0] > modes.omega_squared()[1]);
}
