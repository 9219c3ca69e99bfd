//! Orthogonal test modes (B.6, B.7) on two and three shapes, and what is refused.

use crate::prelude::*;

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
    let found = orthogonalize(&modes(&[a, b], shapes), &eye(2)).unwrap();
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
        let outcome = orthogonalize(&modes(&[1.0, 2.0], shapes), &eye(2));
        assert_eq!(outcome.is_ok(), !dependent);
        if dependent {
            assert_eq!(said(outcome), not_definite("overlap of the test shapes", 1));
        }
    }
}

#[test]
fn equal_shapes_are_dependent_in_faer_s_own_pivot_too() {
    let shapes = dmatrix![1.0, 0.0, 1.0; 0.0, 1.0, 0.0; 0.0, 0.0, 0.0];
    assert_eq!(
        said(orthogonalize(&modes(&[1.0, 2.0, 3.0], shapes), &eye(3))),
        not_definite("overlap of the test shapes", 2)
    );
}

#[test]
fn round_off_of_a_product_is_no_overlap() {
    // Two modes of one frequency turn by 45 degrees for any overlap at all, so round-off must not count as one.
    let movement = |overlap: f64| {
        let shapes = dmatrix![1.0, overlap; 0.0, 1.0];
        let found = orthogonalize(&modes(&[4.0, 4.0], shapes), &eye(2)).unwrap();
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
    let identity = |columns: usize| DMatrix::<f64>::identity(3, columns);
    let with = |mut matrix: DMatrix<f64>, at: (usize, usize), value: f64| {
        matrix[at] = value;
        matrix
    };
    let fits = "it must be positive and finite";
    let squared = |bad: f64| {
        format!("mode 1 (from zero) is no vibration: its eigenvalue is {bad:.6e}; {fits}")
    };
    let still = with(identity(2), (1, 1), 0.0);
    let (skew, massless) = (
        with(identity(3), (2, 0), 1.0),
        with(identity(3), (2, 2), 0.0),
    );
    for (omega, shapes, mass, words) in [
        (
            &[][..],
            DMatrix::zeros(3, 0),
            identity(3),
            "modes: 0 given or asked for; there must be at least 1".to_owned(),
        ),
        (
            &[1.0, 2.0][..],
            eye(2),
            identity(3),
            "mass: 3 x 3 instead of 2 x 2".into(),
        ),
        (
            &[1.0, 2.0, 3.0][..],
            identity(2),
            identity(3),
            "mode shapes: 3 x 2 instead of 3 x 3".into(),
        ),
        (
            &[1.0, 2.0][..],
            with(identity(2), (1, 1), f64::INFINITY),
            identity(3),
            "mode shapes of entry (1, 1) is inf; it must be a finite number".into(),
        ),
        (
            &[1.0, 2.0][..],
            still,
            identity(3),
            format!("largest component of mode 1 (from zero) is 0; {fits}"),
        ),
        (&[1.0, 0.0][..], identity(2), identity(3), squared(0.0)),
        (&[1.0, -4.0][..], identity(2), identity(3), squared(-4.0)),
        (
            &[1.0, f64::NAN][..],
            identity(2),
            identity(3),
            squared(f64::NAN),
        ),
        (
            &[1.0, f64::INFINITY][..],
            identity(2),
            identity(3),
            squared(f64::INFINITY),
        ),
        (
            &[1.0, 2.0][..],
            identity(2),
            massless,
            not_definite("dynamic mass", 2),
        ),
        (
            &[1.0, 2.0][..],
            identity(2),
            skew,
            "relative asymmetry of dynamic mass is 1; it must be at most 1e-8".into(),
        ),
    ] {
        let raw = Modes::new(DVector::from_column_slice(omega), shapes);
        assert_eq!(said(raw.and_then(|raw| orthogonalize(&raw, &mass))), words);
    }
}
