//! Balance of forces and moments (B.1 to B.4) on three masses, and what is refused.

use crate::prelude::*;

/// Three unit masses at −1, 0 and 1, one of the outer moved: {1} takes a third, {x} a half, 1/6 (1, −2, 1) remains.
fn three_masses() -> (DMatrix<f64>, DMatrix<f64>) {
    (eye(3), dmatrix![1.0, -1.0; 1.0, 0.0; 1.0, 1.0])
}

#[test]
fn three_free_masses_by_hand() {
    let (mass, rigid_body) = three_masses();
    let raw = modes(&[7.0], dmatrix![1.0; 0.0; 0.0]);
    let balanced = balance(&raw, &zero_square(3), &mass, &rigid_body).unwrap();
    assert_relative_eq!(
        balanced.coefficients,
        dmatrix![-1.0 / 3.0; 0.5],
        max_relative = ROUND_OFF
    );
    assert_relative_eq!(
        balanced.shapes,
        dmatrix![1.0; -2.0; 1.0] / 6.0,
        max_relative = ROUND_OFF
    );
    assert_relative_eq!(
        balanced.change[0],
        (5.0_f64 / 6.0).sqrt(),
        max_relative = ROUND_OFF
    );
}

#[test]
fn three_suspended_masses_by_hand() {
    // Springs of rate k at both ends: r1 = −(ω² − k)/(3ω² − 2k), r2 = 1/2.
    let (mass, rigid_body) = three_masses();
    let (omega_squared, k) = (100.0, 3.0);
    let stiffness = diagonal([k, 0.0, k]);
    let raw = modes(&[omega_squared], dmatrix![1.0; 0.0; 0.0]);
    let balanced = balance(&raw, &stiffness, &mass, &rigid_body).unwrap();
    let plunge = -(omega_squared - k) / (3.0 * omega_squared - 2.0 * k);
    assert_relative_eq!(
        balanced.coefficients,
        dmatrix![plunge; 0.5],
        max_relative = ROUND_OFF
    );
    let change = (3.0 * plunge * plunge + 2.0 * 0.25_f64).sqrt();
    assert_relative_eq!(balanced.change[0], change, max_relative = ROUND_OFF);
}

#[test]
fn suspension_is_refused_past_the_limit_and_named() {
    // Masses 1, 2, 3 on springs of c times the mass: every suspension mode has μ = c.
    let mass = diagonal([1.0, 2.0, 3.0]);
    let rigid_body = three_masses().1;
    let raw = modes(&[400.0, 100.0, 50.0], eye(3));
    let allowed = LARGEST_SUSPENSION_RATIO * 50.0;
    for (rate, refused) in [
        (0.999_999 * allowed, None),
        (1.000_001 * allowed, Some((2, 50.0))),
        (-1.000_001 * allowed, Some((2, 50.0))),
        (2.5 * allowed, Some((1, 100.0))),
    ] {
        let outcome = balance(&raw, &(rate * &mass), &mass, &rigid_body);
        match (outcome, refused) {
            (Ok(balanced), None) => assert_eq!(balanced.shapes.shape(), (3, 3)),
            (Err(error), Some((first, omega_squared))) => {
                let most = format!("at most {LARGEST_SUSPENSION_RATIO}, as on a free or softly");
                assert!(error.to_string().contains(&most), "{error}");
                let Error::Value {
                    owner,
                    value: ratio,
                    ..
                } = error
                else {
                    panic!("expected Error::Value, found {error}");
                };
                assert_eq!(owner, format!("mode {first} (from zero)"));
                assert_relative_eq!(ratio, rate.abs() / omega_squared, max_relative = ROUND_OFF);
            }
            (outcome, _) => panic!("rate {rate}: found {outcome:?}"),
        }
    }
}

#[test]
fn the_stiffest_suspension_mode_decides() {
    // Plunge μ = 2k/3, pitch μ = k.
    let (mass, rigid_body) = three_masses();
    let k = 1.2 * LARGEST_SUSPENSION_RATIO * 100.0;
    let stiffness = diagonal([k, 0.0, k]);
    let raw = modes(&[100.0], dmatrix![1.0; 0.0; 0.0]);
    let Err(Error::Value { value: ratio, .. }) = balance(&raw, &stiffness, &mass, &rigid_body)
    else {
        panic!("pitch lies above the limit");
    };
    assert_relative_eq!(ratio, k / 100.0, max_relative = ROUND_OFF);
    let plunge = rigid_body.columns(0, 1).into_owned();
    assert!(balance(&raw, &stiffness, &mass, &plunge).is_ok());
}

#[test]
fn a_suspension_at_the_limit_is_allowed() {
    // One mass of the three on a spring, and its motion the only rigid-body vector: μ is the spring's rate exactly.
    let raw = modes(&[100.0], dmatrix![1.0; 1.0; 0.0]);
    let rate = LARGEST_SUSPENSION_RATIO * 100.0;
    let stiffness = diagonal([rate, 0.0, 0.0]);
    let outcome = balance(&raw, &stiffness, &eye(3), &dmatrix![1.0; 0.0; 0.0]);
    assert_relative_eq!(
        outcome.unwrap().shapes,
        dmatrix![0.0; 1.0; 0.0],
        epsilon = ROUND_OFF
    );
}

#[test]
fn dependent_rigid_body_vectors_are_named() {
    let (mass, _) = three_masses();
    let free = zero_square(3);
    let raw = modes(&[7.0], dmatrix![1.0; 0.0; 0.0]);
    for (rigid_body, dependent) in [
        // All points at one station: pitch is plunge.
        (dmatrix![1.0, 8.0; 1.0, 8.0; 1.0, 8.0], 1),
        // Vertical points see no side force.
        (dmatrix![0.0, 1.0; 0.0, 1.0; 0.0, 1.0], 0),
        (dmatrix![1.0, -1.0, 3.0; 1.0, 0.0, 1.0; 1.0, 1.0, -1.0], 2),
        (
            dmatrix![1.0, -1.0, 0.0, 2.0; 1.0, 0.0, 1.0, 5.0; 1.0, 1.0, 0.0, 4.0],
            3,
        ),
    ] {
        assert_eq!(
            said(balance(&raw, &free, &mass, &rigid_body)),
            not_definite("rigid-body mass", dependent)
        );
    }
}

#[test]
fn a_far_reference_axis_is_not_dependence() {
    let (mass, _) = three_masses();
    let rigid_body = dmatrix![1.0, 999.0; 1.0, 1000.0; 1.0, 1001.0];
    let raw = modes(&[7.0], dmatrix![1.0; 0.0; 0.0]);
    let balanced = balance(&raw, &zero_square(3), &mass, &rigid_body).unwrap();
    assert_relative_eq!(
        balanced.shapes,
        dmatrix![1.0; -2.0; 1.0] / 6.0,
        max_relative = FAR_REFERENCE_AXIS
    );
}

#[test]
fn aerodynamic_forces_in_the_mass_are_refused() {
    // The paper allows them in M. They are not conservative, as the balance has to be: a flow acts on the first mass
    // where the last one moves, and not the other way round.
    let (mut mass, rigid_body) = three_masses();
    mass[(0, 2)] = 0.1;
    let outcome = balance(
        &modes(&[7.0], dmatrix![1.0; 0.0; 0.0]),
        &zero_square(3),
        &mass,
        &rigid_body,
    );
    assert_eq!(
        said(outcome),
        "relative asymmetry of dynamic mass is 0.1; it must be at most 1e-8"
    );
}

#[test]
fn bad_input_is_refused() {
    let (mass, rigid_body) = three_masses();
    let free = || zero_square(3);
    let raw = modes(&[7.0], dmatrix![1.0; 0.0; 0.0]);
    let skew = dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 0.0; 0.0, 0.0, 0.0];
    let unknown = dmatrix![1.0, -1.0; 1.0, 0.0; 1.0, f64::NAN];
    for (stiffness, rigid, words) in [
        (
            zero_square(2),
            rigid_body.clone(),
            "dynamic stiffness: 2 x 2 instead of 3 x 3",
        ),
        (
            skew,
            rigid_body,
            "relative asymmetry of dynamic stiffness is 1; it must be at most 1e-8",
        ),
        (
            free(),
            DMatrix::zeros(3, 0),
            "rigid-body stiffness: 0 given or asked for; there must be at least 1",
        ),
        (free(), eye(2), "rigid-body vectors: 2 x 2 instead of 3 x 2"),
        (
            free(),
            unknown,
            "rigid-body vectors of entry (2, 1) is NaN; it must be a finite number",
        ),
    ] {
        assert_eq!(said(balance(&raw, &stiffness, &mass, &rigid)), words);
    }
}
