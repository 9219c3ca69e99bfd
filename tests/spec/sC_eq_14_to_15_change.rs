//! Appendix C for a change of stiffness: what holds for every way of solving it, and the exact solution they tend to.

use crate::common::appendix_c::EIGENSOLUTION;
use crate::prelude::*;

/// Size of change at which every rule holds for every change a strategy gives.
const SMALL: f64 = 0.02;

properties! {
    #[test]
    fn no_change_changes_nothing(change in full_change(4)) {
        for rule in rules() {
            let perturbed = (rule.plain)(&change.stiffness, &change.beta(0.0)).unwrap();
            prop_assert_eq!(perturbed.shapes, DMatrix::identity(4, 4));
            for (root, k) in perturbed.roots.iter().zip(change.stiffness.iter()) {
                prop_assert!((root * k - 1.0).abs() <= ROUND_OFF);
            }
        }
    }

    #[test]
    fn a_diagonal_change_is_exact_at_first_order(
        change in full_change(4),
        sizes in prop::collection::vec(-0.3..3.0_f64, 4),
    ) {
        // Modes that do not couple keep their shapes and their Rayleigh quotient is exact. Roots may pass each other.
        let mut beta = DMatrix::zeros(4, 4);
        for i in 0..4 {
            beta[(i, i)] = sizes[i] * change.stiffness[i];
        }
        let changed: Vec<f64> = (0..4).map(|i| change.stiffness[i] + beta[(i, i)]).collect();
        for rule in rules() {
            let perturbed = (rule.plain)(&change.stiffness, &beta).unwrap();
            for (root, k) in perturbed.roots.iter().zip(&changed) {
                prop_assert!((root * k - 1.0).abs() <= ROUND_OFF, "{} {root} {k}", rule.name);
            }
            prop_assert!((perturbed.shapes - DMatrix::identity(4, 4)).amax() <= ROUND_OFF);
        }
    }

    #[test]
    fn own_components_are_one(change in full_change(5)) {
        for rule in rules() {
            let perturbed = (rule.plain)(&change.stiffness, &change.beta(SMALL)).unwrap();
            prop_assert_eq!(perturbed.shapes.shape(), (5, 5));
            prop_assert_eq!(perturbed.roots.len(), 5);
            for j in 0..5 {
                prop_assert!((perturbed.shapes[(j, j)] - 1.0).abs() <= ROUND_OFF);
            }
        }
    }

    #[test]
    fn results_do_not_depend_on_the_order_of_modes(
        change in full_change(4),
        other in rearrangement(4),
    ) {
        let beta = change.beta(SMALL);
        let (stiffness, turned) = (
            change.stiffness.select_rows(&other.order),
            beta.select_rows(&other.order).select_columns(&other.order),
        );
        for rule in rules() {
            let before = (rule.plain)(&change.stiffness, &beta).unwrap();
            let after = (rule.plain)(&stiffness, &turned).unwrap();
            let roots = before.roots.select_rows(&other.order);
            let shapes = before.shapes.select_rows(&other.order).select_columns(&other.order);
            prop_assert!((&after.roots - &roots).amax() <= ROUND_OFF * roots.amax());
            prop_assert!((&after.shapes - &shapes).amax() <= MATRIX_ROUND_OFF, "{}", rule.name);
        }
    }

    #[test]
    fn roots_scale_with_flexibility_and_shapes_not_at_all(
        change in full_change(4),
        scale in 0.01..100.0_f64,
    ) {
        let beta = change.beta(SMALL);
        for rule in rules() {
            let before = (rule.plain)(&change.stiffness, &beta).unwrap();
            let after = (rule.plain)(&(scale * &change.stiffness), &(scale * &beta)).unwrap();
            for (a, b) in after.roots.iter().zip(before.roots.iter()) {
                prop_assert!((a * scale / b - 1.0).abs() <= ROUND_OFF);
            }
            prop_assert!((after.shapes - before.shapes).amax() <= MATRIX_ROUND_OFF, "{}", rule.name);
        }
    }

    #[test]
    fn any_change_gives_finite_modes_or_a_typed_error(change in any_change()) {
        for rule in stiffness_rules().chain([EIGENSOLUTION]) {
            match (rule.plain)(&change.stiffness, &change.beta(1.0)) {
                Ok(Perturbed { roots, shapes }) => {
                    prop_assert!(roots.iter().all(|root| *root > 0.0 && root.is_finite()));
                    prop_assert!(shapes.iter().all(|component| component.is_finite()));
                }
                Err(
                    Error::CoalescingModes { .. }
                    | Error::UnsettledRoots { .. }
                    | Error::NotAVibration { .. },
                ) => {}
                Err(other) => prop_assert!(false, "{}: {other}", rule.name),
            }
        }
    }

    #[test]
    fn the_modal_eigensolution_satisfies_every_row(change in full_change(5)) {
        // (C.16): [k (γ − Λ) + β γ] p = 0, that is (k + β) p = p/γ.
        let beta = change.beta(0.1);
        let found = exact(&change.stiffness, &beta).unwrap();
        let changed = DMatrix::from_diagonal(&change.stiffness) + beta;
        let residual = &changed * &found.shapes
            - &found.shapes * DMatrix::from_diagonal(&found.roots.map(f64::recip));
        let scale = changed.amax() * found.shapes.amax();
        prop_assert!(residual.amax() <= MATRIX_ROUND_OFF * scale, "{:e}", residual.amax());
    }

    #[test]
    fn the_modal_eigensolution_is_that_of_nalgebra(change in full_change(5)) {
        let beta = change.beta(0.1);
        let found = exact(&change.stiffness, &beta).unwrap();
        let changed = DMatrix::from_diagonal(&change.stiffness) + beta;
        let (omega_squared, _) = modes_by_nalgebra(&changed, &DMatrix::identity(5, 5));
        let mut found: Vec<f64> = found.roots.iter().map(|root| 1.0 / root).collect();
        found.sort_by(f64::total_cmp);
        for (a, b) in found.iter().zip(omega_squared.iter()) {
            prop_assert!((a - b).abs() <= EIGEN_ROUND_OFF * omega_squared.amax(), "{a} {b}");
        }
    }

    #[test]
    fn the_converged_recursion_is_the_eigensolution(change in full_change(5)) {
        let beta = change.beta(SMALL);
        let settled = recursive_1_converged(&change.stiffness, &beta).unwrap();
        let recursive = settled.perturbed;
        let exact = exact(&change.stiffness, &beta).unwrap();
        for (a, b) in recursive.roots.iter().zip(exact.roots.iter()) {
            prop_assert!((a / b - 1.0).abs() <= CONVERGED_RECURSION, "{a} {b}");
        }
        let error = (recursive.shapes - exact.shapes).amax();
        prop_assert!(error <= CONVERGED_RECURSION * change.stiffness.amax(), "{error:e}");
    }

    #[test]
    fn normalized_shapes_have_unit_generalized_mass(change in full_change(4)) {
        let shapes = exact(&change.stiffness, &change.beta(0.1)).unwrap().shapes;
        let mut unit = shapes.clone();
        normalize_with_mass(&mut unit, &DMatrix::zeros(4, 4)).unwrap();
        for j in 0..4 {
            prop_assert!((unit.column(j).norm() - 1.0).abs() <= ROUND_OFF);
            prop_assert!(unit[(j, j)] > 0.0);
            let back = unit.column(j) / unit[(j, j)];
            prop_assert!((back - shapes.column(j)).amax() <= ROUND_OFF * shapes.amax());
        }
        // Exact shapes of a symmetric change are orthogonal too.
        let orthogonal = unit.tr_mul(&unit);
        prop_assert!((orthogonal - DMatrix::identity(4, 4)).amax() <= MATRIX_ROUND_OFF);
    }
}

#[test]
fn one_mode_alone_is_exact_by_every_rule() {
    // Rayleigh's quotient is the root, 1/(2 + 0.5), and there is no other mode to turn to.
    let (k, beta) = (dvector![2.0], dmatrix![0.5]);
    for rule in rules() {
        let found = (rule.plain)(&k, &beta).unwrap();
        assert!((found.roots[0] - 0.4).abs() <= ROUND_OFF, "{}", rule.name);
        assert_eq!(found.shapes, dmatrix![1.0], "{}", rule.name);
    }
}

#[test]
fn the_eigensolution_continues_modes_past_each_other() {
    // Mode 0 rises from 1 past mode 1 at 2; with a slight coupling it is still mode 0.
    let exact = exact(&dvector![1.0, 2.0], &dmatrix![3.0, 0.01; 0.01, 0.0]).unwrap();
    assert!(exact.roots[0] < exact.roots[1]);
    assert!((1.0 / exact.roots[0] - 4.0).abs() < NEARLY_UNCOUPLED);
    assert!(exact.shapes[(1, 0)].abs() < NEARLY_UNCOUPLED);
}

#[test]
fn a_mode_that_nothing_continues_is_refused() {
    // Modes of the reflection [I - u u^t, u; u^t, 0], u = (1, 1, 1)/sqrt 3: the three largest components pair the
    // first three, and what is left of mode 3 has no part in itself.
    let third = 1.0 / 3.0;
    let u = 1.0 / 3_f64.sqrt();
    let shapes = dmatrix![
        1.0 - third, -third, -third, u;
        -third, 1.0 - third, -third, u;
        -third, -third, 1.0 - third, u;
        u, u, u, 0.0
    ];
    let stiffness = dvector![1.0, 2.0, 3.0, 4.0];
    let changed = &shapes * DMatrix::from_diagonal(&stiffness) * shapes.transpose();
    let beta = changed - DMatrix::from_diagonal(&stiffness);
    match exact(&stiffness, &beta) {
        Err(Error::CoalescingModes {
            first,
            second,
            separation,
        }) => {
            assert_eq!((first, second), (3, 3));
            assert!(separation < 1e-9);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_change_that_leaves_no_stiffness_is_no_vibration() {
    assert_refused(
        exact(&dvector![1.0, 2.0], &dmatrix![-3.0, 0.0; 0.0, 0.0]),
        Error::NotAVibration {
            mode: 0,
            value: -2.0,
        },
    );
}
