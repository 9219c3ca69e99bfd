//! Two degrees of freedom: closed forms against the eigensolver, and the recursions against the closed forms.
//!
//! With two modes alone a shape's only error is its root's, so that the recursions gain two orders at every other step:
//! Recursive 1 of order r has roots of order 2⌊r/2⌋ + 2 and shapes of order 2⌈r/2⌉ + 1, Recursive 2 roots of order 2r and
//! shapes of order 2r + 1, the original formulae roots of order 4.

use crate::common::appendix_c::Plain;
use crate::common::closed_forms::two_dof::{perturbed, squared_frequencies};
use crate::prelude::*;

properties! {
    #[test]
    fn the_closed_form_roots_are_those_of_the_eigensolver(
        (stiffness, _) in positive_definite(2, 6.0),
        (mass, exponents) in positive_definite(2, 3.0),
    ) {
        let found = squared_frequencies(&stiffness, &mass);
        let (expected, _) = modes_by_nalgebra(&stiffness, &mass);
        let condition = 10f64.powf((exponents[0] - exponents[1]).abs());
        for (a, b) in found.iter().zip(expected.iter()) {
            prop_assert!((a - b).abs() <= EIGEN_ROUND_OFF * condition * expected[1], "{a} {b}");
        }
    }

    #[test]
    fn closed_form_roots_satisfy_vieta(
        stiffness in symmetric(2),
        (mass, exponents) in positive_definite(2, 2.0),
    ) {
        // Any symmetric stiffness, also of motions that are no vibrations.
        let [lower, upper] = squared_frequencies(&stiffness, &mass);
        prop_assert!(lower <= upper);
        let condition = 10f64.powf((exponents[0] - exponents[1]).abs());
        let scale = lower.abs().max(upper.abs());
        let flexible = mass.clone().try_inverse().unwrap() * &stiffness;
        let slack = MATRIX_ROUND_OFF * condition;
        prop_assert!((lower + upper - flexible.trace()).abs() <= slack * scale);
        let product = stiffness.determinant() / mass.determinant();
        prop_assert!((lower * upper - product).abs() <= slack * scale * scale);
    }

    #[test]
    fn the_rotation_is_the_eigensolution_of_two_modes(change in full_change(2)) {
        let beta = change.beta(0.2);
        let closed = perturbed(&change.stiffness, &beta);
        let exact = exact(&change.stiffness, &beta).unwrap();
        prop_assert_eq!(closed.shapes.shape(), (2, 2));
        prop_assert_eq!(closed.roots.len(), 2);
        for (a, b) in closed.roots.iter().zip(exact.roots.iter()) {
            prop_assert!((a / b - 1.0).abs() <= MATRIX_ROUND_OFF, "{a} {b}");
        }
        prop_assert!((closed.shapes - exact.shapes).amax() <= MATRIX_ROUND_OFF);
    }

    #[test]
    fn the_two_closed_forms_agree(change in full_change(2)) {
        let beta = change.beta(0.3);
        let rotation = perturbed(&change.stiffness, &beta);
        let changed = DMatrix::from_diagonal(&change.stiffness) + beta;
        let [lower, upper] = squared_frequencies(&changed, &DMatrix::identity(2, 2));
        prop_assert!((rotation.roots.max() * lower - 1.0).abs() <= MATRIX_ROUND_OFF);
        prop_assert!((rotation.roots.min() * upper - 1.0).abs() <= MATRIX_ROUND_OFF);
    }

    #[test]
    fn recursions_converge_to_the_closed_form(change in full_change(2)) {
        let beta = change.beta(0.05);
        let exact = perturbed(&change.stiffness, &beta);
        for found in [
            recursive_1_converged(&change.stiffness, &beta).unwrap().perturbed,
            recursive_2(&change.stiffness, &beta, 8).unwrap(),
        ] {
            for (a, b) in found.roots.iter().zip(exact.roots.iter()) {
                prop_assert!((a / b - 1.0).abs() <= CONVERGED_RECURSION, "{a} {b}");
            }
            prop_assert!((found.shapes - &exact.shapes).amax() <= CONVERGED_RECURSION);
        }
    }

    #[test]
    fn two_modes_gain_two_orders_at_every_other_step(change in full_change(2)) {
        let rules: [(&str, Plain, f64, f64, f64); 6] = [
            ("first order", first_order, 0.004, 2.0, 3.0),
            ("original", original, 0.01, 4.0, 3.0),
            ("Recursive 1, order 2", |k, beta| recursive_1(k, beta, 2), 0.01, 4.0, 3.0),
            ("Recursive 1, order 3", |k, beta| recursive_1(k, beta, 3), 0.02, 4.0, 5.0),
            ("Recursive 1, order 4", |k, beta| recursive_1(k, beta, 4), 0.03, 6.0, 5.0),
            ("Recursive 2, order 2", |k, beta| recursive_2(k, beta, 2), 0.02, 4.0, 5.0),
        ];
        for (name, rule, largest, root_order, shape_order) in rules {
            let (mut roots, mut shapes) = (Vec::new(), Vec::new());
            for size in (0..4).map(|step| largest * 0.7_f64.powi(step)) {
                let beta = change.beta(size);
                let exact = perturbed(&change.stiffness, &beta);
                let found = rule(&change.stiffness, &beta).unwrap();
                let error = found.roots.component_div(&exact.roots).add_scalar(-1.0).amax();
                roots.push((size, error));
                shapes.push((size, (found.shapes - exact.shapes).amax()));
            }
            for (points, order) in [(&mut roots, root_order), (&mut shapes, shape_order)] {
                points.retain(|point| point.1 > MEASURABLE_ERROR);
                prop_assert!(points.len() >= 2, "{name} {points:?}");
                let slope = log_log_slope(points);
                prop_assert!((slope - order).abs() <= ORDER_HALFWAY, "{name} {order} {slope}");
            }
        }
    }
}

#[test]
fn two_masses_on_three_springs() {
    // Two masses 2 held by springs 3 and joined by a spring 5: in phase 3/2, out of phase (3 + 10)/2.
    let stiffness = dmatrix![8.0, -5.0; -5.0, 8.0];
    let [lower, upper] =
        squared_frequencies(&stiffness, &DMatrix::from_diagonal_element(2, 2, 2.0));
    assert!((lower - 1.5).abs() <= ROUND_OFF);
    assert!((upper - 6.5).abs() <= ROUND_OFF);
}

#[test]
fn coupled_masses_by_hand() {
    // det [2 - 2x, -1 - x; -1 - x, 3 - x] = x^2 - 10 x + 5 = 0, x = 5 -+ 2 sqrt 5.
    let found = squared_frequencies(
        &dmatrix![2.0, -1.0; -1.0, 3.0],
        &dmatrix![2.0, 1.0; 1.0, 1.0],
    );
    let [lower, upper] = found;
    assert!((lower - (5.0 - 20_f64.sqrt())).abs() <= ROUND_OFF);
    assert!((upper - (5.0 + 20_f64.sqrt())).abs() <= 10.0 * ROUND_OFF);
}

#[test]
fn a_free_motion_and_an_unstable_one_have_their_roots() {
    let identity = DMatrix::identity(2, 2);
    let free = dmatrix![1.0, -1.0; -1.0, 1.0];
    assert_eq!(squared_frequencies(&free, &identity), [0.0, 2.0]);
    let none = DMatrix::zeros(2, 2);
    assert_eq!(squared_frequencies(&none, &identity), [0.0, 0.0]);
    let unstable = dmatrix![-3.0, 0.0; 0.0, -1.0];
    assert_eq!(squared_frequencies(&unstable, &identity), [-3.0, -1.0]);
}

#[test]
fn the_small_root_keeps_its_digits() {
    // Springs that differ by 1e12: the difference of the textbook formula would leave four digits.
    let stiffness = dmatrix![1e12 + 1.0, -1.0; -1.0, 1.0];
    let [lower, _] = squared_frequencies(&stiffness, &DMatrix::identity(2, 2));
    assert!((lower - (1.0 - 1e-12)).abs() <= ROUND_OFF);
}

#[test]
fn uncoupled_modes_keep_their_shapes() {
    let found = perturbed(&dvector![1.0, 2.0], &dmatrix![3.0, 0.0; 0.0, -1.0]);
    assert_eq!(found.roots, dvector![0.25, 1.0]);
    assert_eq!(found.shapes, DMatrix::identity(2, 2));
}

#[test]
fn coalescing_modes_turn_by_45_degrees() {
    let found = perturbed(&dvector![1.0, 2.0], &dmatrix![1.0, 0.5; 0.5, 0.0]);
    assert_eq!(found.roots, dvector![1.0 / 1.5, 1.0 / 2.5]);
    assert_eq!(found.shapes, dmatrix![1.0, 1.0; -1.0, 1.0]);
}
