//! Orthogonal test modes (B.5 to B.7).

use crate::prelude::*;

const DOF: usize = 7;
const MODES: usize = 5;
/// Noise on every component of a mass-orthonormal set. The 35 components keep the overlap matrix within
/// 2·6·0.04 + (6·0.04)² of the identity, so it stays definite.
const NOISE: f64 = 0.04;

/// Shapes of exact modes with noise in and out of their span.
fn noisy() -> impl Strategy<Value = (Modes, DMatrix<f64>)> {
    (orthonormal_modes(DOF, MODES), noise(DOF, MODES)).prop_map(|((mut exact, mass), noise)| {
        let inverse = mass.clone().cholesky().unwrap().l().try_inverse().unwrap();
        alter(&mut exact, |_, shapes| {
            *shapes += NOISE * inverse.tr_mul(&noise)
        });
        (exact, mass)
    })
}

/// The overlap matrix of shapes scaled to unit generalized mass.
fn overlap(shapes: &DMatrix<f64>, mass: &DMatrix<f64>) -> DMatrix<f64> {
    let generalized = shapes.tr_mul(&(mass * shapes));
    DMatrix::from_fn(generalized.nrows(), generalized.ncols(), |i, j| {
        generalized[(i, j)] / (generalized[(i, i)] * generalized[(j, j)]).sqrt()
    })
}

fn sorted(values: &DVector<f64>) -> Vec<f64> {
    let mut values = values.as_slice().to_vec();
    values.sort_by(f64::total_cmp);
    values
}

properties! {
    #[test]
    fn orthogonalized_shapes_are_mass_orthonormal((raw, mass) in noisy()) {
        let found = orthogonalize(&raw, &mass)?;
        prop_assert_eq!(found.modes.shapes().shape(), (DOF, MODES));
        prop_assert_eq!(found.modes.len(), MODES);
        prop_assert_eq!(found.movement.len(), MODES);
        let identity = eye(MODES);
        prop_assert!((generalized_mass(found.modes.shapes(), &mass)? - identity).amax() <= MATRIX_ROUND_OFF);
    }

    /// (B.7) itself: the new shapes are V q, and q with the new roots satisfies the equations of motion of the raw set.
    #[test]
    fn combinations_satisfy_the_equations_of_motion((raw, mass) in noisy()) {
        let found = orthogonalize(&raw, &mass)?;
        let generalized = raw.shapes().tr_mul(&(&mass * raw.shapes()));
        let q = generalized.clone().lu().solve(&raw.shapes().tr_mul(&(&mass * found.modes.shapes()))).unwrap();
        prop_assert!((raw.shapes() * &q - found.modes.shapes()).amax() <= MATRIX_ROUND_OFF * raw.shapes().amax());
        let stiffness = DMatrix::from_fn(MODES, MODES, |i, j| {
            if i == j { raw.omega_squared()[i] * generalized[(i, i)] } else { 0.0 }
        });
        let inertia = generalized * &q * DMatrix::from_diagonal(found.modes.omega_squared());
        prop_assert!((stiffness * &q - inertia).amax() <= MATRIX_ROUND_OFF * raw.omega_squared().max());
    }

    /// nalgebra's eigenvalues of D^-1/2 m D^-1/2 are the reciprocals of the squared frequencies.
    #[test]
    fn roots_agree_with_another_reduction((raw, mass) in noisy()) {
        let found = orthogonalize(&raw, &mass)?;
        let root = DMatrix::from_diagonal(&raw.omega_squared().map(|value| value.sqrt().recip()));
        let eigen = SymmetricEigen::new(&root * overlap(raw.shapes(), &mass) * &root);
        let expected = sorted(&eigen.eigenvalues.map(f64::recip));
        let condition = raw.omega_squared().max() / raw.omega_squared().min();
        for (found, expected) in sorted(found.modes.omega_squared()).into_iter().zip(expected) {
            assert_relative_eq!(found, expected, max_relative = EIGEN_ROUND_OFF * condition);
        }
    }

    /// Orthogonal shapes of any scale, sign and order, also of equal frequency, stay as they are.
    #[test]
    fn orthogonal_modes_are_a_fixed_point(
        (exact, mass) in orthonormal_modes(DOF, MODES),
        scales in prop::collection::vec(prop_oneof![-10.0..-0.1_f64, 0.1..10.0_f64], MODES),
        order in Just((0..MODES).collect_vec()).prop_shuffle(),
        repeated in any::<bool>(),
    ) {
        let mut omega_squared = DVector::from_fn(MODES, |i, _| exact.omega_squared()[order[i]]);
        if repeated {
            omega_squared.fill(exact.omega_squared()[0]);
        }
        let signed = DMatrix::from_fn(DOF, MODES, |row, i| exact.shapes()[(row, order[i])] * scales[i].signum());
        let scaled = &signed * DMatrix::from_diagonal(&DVector::from_vec(scales).abs());
        let found = orthogonalize(&modes(omega_squared.as_slice(), scaled), &mass)?;
        prop_assert!(relative_difference(&signed, found.modes.shapes()) <= ORTHOGONAL_INPUT);
        for mode in 0..MODES {
            assert_relative_eq!(found.modes.omega_squared()[mode], omega_squared[mode], max_relative = ORTHOGONAL_INPUT);
            prop_assert!(found.movement[mode].frequency.abs() <= ORTHOGONAL_INPUT);
            prop_assert!(found.movement[mode].shape <= ORTHOGONAL_INPUT);
        }
    }

    /// Order, scale and sign of the raw shapes carry over and change nothing else.
    #[test]
    fn order_and_scale_carry_over(
        (raw, mass) in noisy(),
        scales in prop::collection::vec(prop_oneof![-10.0..-0.1_f64, 0.1..10.0_f64], MODES),
        order in Just((0..MODES).collect_vec()).prop_shuffle(),
    ) {
        let found = orthogonalize(&raw, &mass)?;
        let shuffled = DMatrix::from_fn(DOF, MODES, |row, i| raw.shapes()[(row, order[i])] * scales[i]);
        let omega_squared = order.iter().map(|&i| raw.omega_squared()[i]).collect_vec();
        let other = orthogonalize(&modes(&omega_squared, shuffled), &mass)?;
        let condition = raw.omega_squared().max() / raw.omega_squared().min();
        let tolerance = EIGEN_ROUND_OFF * condition;
        for i in 0..MODES {
            assert_relative_eq!(other.modes.omega_squared()[i], found.modes.omega_squared()[order[i]], max_relative = tolerance);
            assert_relative_eq!(other.movement[i].frequency, found.movement[order[i]].frequency, epsilon = tolerance);
            assert_relative_eq!(other.movement[i].shape, found.movement[order[i]].shape, epsilon = tolerance);
            let same = found.modes.shapes().column(order[i]) * scales[i].signum();
            prop_assert!((other.modes.shapes().column(i) - same).amax() <= tolerance * raw.shapes().amax());
        }
    }

    /// The movement is what its definition says, and agrees with the modal assurance criterion in the mass product.
    #[test]
    fn movement_is_measured_from_the_raw_mode((raw, mass) in noisy()) {
        let found = orthogonalize(&raw, &mass)?;
        let root = mass.clone().cholesky().unwrap().l().transpose();
        let assurance = modal_assurance(&(&root * found.modes.shapes()), &(&root * raw.shapes()))?;
        let (before, after) = (raw.frequencies_hz(), found.modes.frequencies_hz());
        for mode in 0..MODES {
            let movement = found.movement[mode];
            assert_relative_eq!(movement.frequency, (after[mode] - before[mode]) / before[mode], epsilon = ROUND_OFF);
            let shape = raw.shapes().column(mode).into_owned();
            let shape = &shape / mass_norm(&shape, &mass);
            let difference = found.modes.shapes().column(mode) - shape;
            assert_relative_eq!(movement.shape, mass_norm(&difference, &mass), epsilon = ROUND_OFF);
            assert_relative_eq!(
                (1.0 - movement.shape.powi(2) / 2.0).powi(2), assurance[(mode, mode)], epsilon = MATRIX_ROUND_OFF
            );
        }
    }

    /// Two modes of overlap e: (1 − e²)μ² − (a + b)μ + ab = 0 for the squared frequencies a and b.
    #[test]
    fn two_modes_have_a_closed_form(
        lower in 10.0..1000.0_f64,
        ratio in 1.1..4.0_f64,
        e in -0.9..0.9_f64,
        scales in (0.1..10.0_f64, 0.1..10.0_f64),
    ) {
        let (a, b) = (lower, lower * ratio);
        let mass = eye(2);
        let shapes = dmatrix![scales.0, scales.1 * e; 0.0, scales.1 * (1.0 - e * e).sqrt()];
        let found = orthogonalize(&modes(&[a, b], shapes), &mass)?;
        let middle = (a + b) / (2.0 * (1.0 - e * e));
        let high = middle + (middle.powi(2) - a * b / (1.0 - e * e)).sqrt();
        let low = a * b / ((1.0 - e * e) * high);
        let roots = sorted(found.modes.omega_squared());
        assert_relative_eq!(roots[0], low, max_relative = MATRIX_ROUND_OFF);
        assert_relative_eq!(roots[1], high, max_relative = MATRIX_ROUND_OFF);
        // The lower frequency goes down, the higher up.
        prop_assert!(roots[0] <= a * (1.0 + ROUND_OFF) && roots[1] >= b * (1.0 - ROUND_OFF));
    }
}
