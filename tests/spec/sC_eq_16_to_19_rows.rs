//! Appendix C row by row: every rule against its formula written out with explicit sums, and its report of convergence.

use crate::common::appendix_c::{errors, largest_change, original, recursive_2};
use crate::common::tolerances::{MATRIX_ROUND_OFF, ROUND_OFF};
use crate::common::vibrations::full_change;
use corfem::method::appendix_c::{
    LARGEST_UNSETTLED_CHANGE, Perturbed, first_order, recursive_1, recursive_1_converged,
};
use corfem::method::error::Error;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;

/// Size of change at which every rule holds for every change a strategy gives.
const SIZE: f64 = 0.03;

/// (C.20), (C.21).
fn first_by_rows(k: &DVector<f64>, beta: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let n = k.len();
    let lambda = |i: usize| 1.0 / k[i];
    let roots = DVector::from_fn(n, |i, _| {
        lambda(i) - lambda(i) * beta[(i, i)] / (k[i] + beta[(i, i)])
    });
    let shapes = DMatrix::from_fn(n, n, |i, j| {
        if i == j {
            1.0
        } else {
            -beta[(i, j)] / (k[i] + beta[(i, i)] - 1.0 / roots[j])
        }
    });
    (roots, shapes)
}

/// (C.22) with the corrected indices, one order from the one before.
fn recursive_1_by_rows(
    k: &DVector<f64>,
    beta: &DMatrix<f64>,
    (roots, shapes): (DVector<f64>, DMatrix<f64>),
) -> (DVector<f64>, DMatrix<f64>) {
    let n = k.len();
    let own = |i: usize| k[i] + beta[(i, i)];
    let new_roots = DVector::from_fn(n, |i, _| {
        let sum: f64 = (0..n)
            .filter(|&j| j != i)
            .map(|j| beta[(i, j)] * shapes[(j, i)])
            .sum();
        1.0 / k[i] - (beta[(i, i)] / k[i] + roots[i] * sum) / own(i)
    });
    let new_shapes = DMatrix::from_fn(n, n, |i, j| {
        if i == j {
            return 1.0;
        }
        let sum: f64 = (0..n)
            .filter(|&s| s != i && s != j)
            .map(|s| beta[(i, s)] * shapes[(s, j)])
            .sum();
        -(beta[(i, j)] + sum) / (own(i) - 1.0 / roots[j])
    });
    (new_roots, new_shapes)
}

/// (C.24): the root of every mode from its whole row.
fn explicit_by_rows(k: &DVector<f64>, beta: &DMatrix<f64>, shapes: &DMatrix<f64>) -> DVector<f64> {
    DVector::from_fn(k.len(), |i, _| {
        let sum: f64 = (0..k.len()).map(|j| beta[(i, j)] * shapes[(j, i)]).sum();
        1.0 / k[i] - sum / (k[i] * (k[i] + sum))
    })
}

fn assert_close(found: &Perturbed, (roots, shapes): &(DVector<f64>, DMatrix<f64>)) {
    assert_eq!(found.roots.len(), roots.len());
    assert_eq!(found.shapes.shape(), shapes.shape());
    for (a, b) in found.roots.iter().zip(roots.iter()) {
        assert!((a / b - 1.0).abs() <= ROUND_OFF, "{a} {b}");
    }
    let error = (&found.shapes - shapes).amax();
    assert!(error <= ROUND_OFF, "{error:e}");
}

proptest! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn first_order_by_rows(change in full_change(4)) {
        let (k, beta) = (&change.stiffness, change.beta(SIZE));
        let found = first_order(k, &beta).unwrap();
        assert_close(&found, &first_by_rows(k, &beta));
    }

    #[test]
    fn first_order_is_rayleighs_quotient_on_the_old_shape(change in full_change(4)) {
        let (k, beta) = (&change.stiffness, change.beta(SIZE));
        let found = first_order(k, &beta).unwrap();
        for i in 0..4 {
            let quotient = k[i] + beta[(i, i)];
            prop_assert!((found.roots[i] * quotient - 1.0).abs() <= ROUND_OFF);
        }
        // Rayleigh's principle: the lowest quotient lies above the lowest root.
        let exact = (DMatrix::from_diagonal(k) + &beta).symmetric_eigenvalues();
        prop_assert!(1.0 / found.roots.max() >= exact.min() * (1.0 - ROUND_OFF));
    }

    #[test]
    fn recursive_1_by_rows_to_any_order(change in full_change(4), order in 1..=8_usize) {
        let (k, beta) = (&change.stiffness, change.beta(SIZE));
        let mut expected = first_by_rows(k, &beta);
        for _ in 1..order {
            expected = recursive_1_by_rows(k, &beta, expected);
        }
        let found = recursive_1(k, &beta, order).unwrap();
        assert_close(&found, &expected);
    }

    #[test]
    fn the_recursion_stops_at_the_first_order_within_tolerance(
        change in full_change(4),
        exponent in -12.0..-6.0_f64,
    ) {
        let (k, beta, tolerance) = (&change.stiffness, change.beta(SIZE), 10f64.powf(exponent));
        let of_order = |order| recursive_1(k, &beta, order).unwrap();
        let moved_by = |order| largest_change(&of_order(order).roots, &of_order(order - 1).roots);
        let found = recursive_1_converged(k, &beta, tolerance, 60).unwrap();
        prop_assert!((2..60).contains(&found.order), "{}", found.order);
        prop_assert!(found.last_change < tolerance);
        prop_assert_eq!(&of_order(found.order), &found.perturbed);
        prop_assert!((found.last_change - moved_by(found.order)).abs() <= ROUND_OFF);
        for order in 2..found.order {
            prop_assert!(moved_by(order) >= tolerance);
        }
    }

    #[test]
    fn the_recursion_stops_at_its_last_order_and_says_how_far_it_was(
        change in full_change(4),
        orders in 2..=9_usize,
    ) {
        let (k, beta) = (&change.stiffness, change.beta(SIZE));
        let of_order = |order| recursive_1(k, &beta, order).unwrap();
        let moved = largest_change(&of_order(orders).roots, &of_order(orders - 1).roots);
        match recursive_1_converged(k, &beta, 0.0, orders) {
            Ok(found) => {
                prop_assert_eq!(&of_order(orders), &found.perturbed);
                prop_assert_eq!((found.order, found.last_change), (orders, moved));
                prop_assert!(moved <= LARGEST_UNSETTLED_CHANGE);
            }
            Err(Error::UnsettledRoots { largest, orders: allowed, last_change }) => {
                prop_assert_eq!((largest, allowed), (LARGEST_UNSETTLED_CHANGE, orders));
                prop_assert_eq!(last_change, moved);
                prop_assert!(moved > LARGEST_UNSETTLED_CHANGE);
            }
            Err(other) => prop_assert!(false, "{other}"),
        }
    }

    #[test]
    fn recursive_2_roots_come_from_the_shapes_before(change in full_change(4), order in 2..=5_usize) {
        let (k, beta) = (&change.stiffness, change.beta(SIZE));
        let before = recursive_2(k, &beta, order - 1).unwrap();
        let found = recursive_2(k, &beta, order).unwrap();
        let roots = explicit_by_rows(k, &beta, &before.shapes);
        assert_close(&found, &(roots, found.shapes.clone()));
    }

    #[test]
    fn recursive_2_shapes_satisfy_every_row_but_their_own(change in full_change(4), order in 2..=5_usize) {
        let (k, beta) = (&change.stiffness, change.beta(SIZE));
        let found = recursive_2(k, &beta, order).unwrap();
        let changed = DMatrix::from_diagonal(k) + &beta;
        let residual = &changed * &found.shapes
            - &found.shapes * DMatrix::from_diagonal(&found.roots.map(f64::recip));
        for j in 0..4 {
            for i in (0..4).filter(|&i| i != j) {
                prop_assert!(residual[(i, j)].abs() <= ROUND_OFF * changed.amax());
            }
        }
    }

    #[test]
    fn first_orders_are_all_the_same(change in full_change(4)) {
        let (k, beta) = (&change.stiffness, change.beta(SIZE));
        let first = first_order(k, &beta).unwrap();
        prop_assert_eq!(&recursive_1(k, &beta, 1).unwrap(), &first);
        let (root, shape) = errors(&recursive_2(k, &beta, 1).unwrap(), &first);
        prop_assert!(root < ROUND_OFF && shape < MATRIX_ROUND_OFF, "{root:e} {shape:e}");
    }

    #[test]
    fn the_original_formulae_are_first_order_with_the_root_once_more(change in full_change(4)) {
        let (k, beta) = (&change.stiffness, change.beta(SIZE));
        let first = first_order(k, &beta).unwrap();
        let found = original(k, &beta).unwrap();
        let roots = explicit_by_rows(k, &beta, &first.shapes);
        assert_close(&found, &(roots, first.shapes.clone()));
        // Their roots are those of Recursive 2's second order.
        prop_assert_eq!(found.roots, recursive_2(k, &beta, 2).unwrap().roots);
    }
}

#[test]
fn first_order_by_hand() {
    let found = first_order(&dvector![1.0, 4.0], &dmatrix![1.0, 0.5; 0.5, -1.0]).unwrap();
    // k + β is 2 and 3; p_21 = -0.5/(3 - 2), p_12 = -0.5/(2 - 3).
    assert_eq!(found.roots, dvector![1.0 / 2.0, 1.0 / 3.0]);
    let expected = dmatrix![1.0, 0.5; -0.5, 1.0];
    assert!((found.shapes - expected).amax() <= ROUND_OFF);
}
