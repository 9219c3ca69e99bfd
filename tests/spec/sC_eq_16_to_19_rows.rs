//! What the rows of Appendix C say of first order and Recursive 2, and when Recursive 1 stops.

use crate::common::appendix_c::errors;
use crate::prelude::*;

/// Size of change at which every rule holds for every change a strategy gives.
const SIZE: f64 = 0.03;

properties! {
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
    fn the_recursion_stops_at_the_first_order_within_tolerance(change in full_change(4)) {
        let (k, beta) = (&change.stiffness, change.beta(SIZE));
        let of_order = |order| recursive_1(k, &beta, order).unwrap();
        let moved_by = |order| largest_change(&of_order(order).roots, &of_order(order - 1).roots);
        let found = recursive_1_converged(k, &beta).unwrap();
        prop_assert!((2..MOST_ORDERS).contains(&found.order), "{}", found.order);
        prop_assert!(found.last_change < ROOT_TOLERANCE);
        prop_assert_eq!(&of_order(found.order), &found.perturbed);
        prop_assert_eq!(found.last_change, moved_by(found.order));
        for order in 2..found.order {
            prop_assert!(moved_by(order) >= ROOT_TOLERANCE);
        }
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
}

#[test]
fn first_order_by_hand() {
    let found = first_order(&dvector![1.0, 4.0], &dmatrix![1.0, 0.5; 0.5, -1.0]).unwrap();
    // k + β is 2 and 3; p_21 = -0.5/(3 - 2), p_12 = -0.5/(2 - 3).
    assert_eq!(found.roots, dvector![1.0 / 2.0, 1.0 / 3.0]);
    let expected = dmatrix![1.0, 0.5; -0.5, 1.0];
    assert!((found.shapes - expected).amax() <= ROUND_OFF);
}

/// A change as large as the stiffness settles slowly: to a billionth and a ten-millionth in the orders allowed, or not at all.
#[test]
fn the_recursion_stops_at_its_last_order_and_says_how_far_it_was() {
    for (size, is_settled) in [(0.85, true), (0.9, true), (1.0, false)] {
        let ModalChange {
            generalized_stiffness: k,
            beta,
            ..
        } = four_modes(size);
        let of_order = |order| recursive_1(&k, &beta, order).unwrap();
        let moved = largest_change(
            &of_order(MOST_ORDERS).roots,
            &of_order(MOST_ORDERS - 1).roots,
        );
        match recursive_1_converged(&k, &beta) {
            Ok(found) => {
                assert!(is_settled, "{size}");
                assert_eq!(of_order(MOST_ORDERS), found.perturbed);
                assert_eq!((found.order, found.last_change), (MOST_ORDERS, moved));
                assert!((ROOT_TOLERANCE..LARGEST_UNSETTLED_CHANGE).contains(&moved));
            }
            Err(Error::UnsettledRoots {
                orders,
                last_change,
            }) => {
                assert!(!is_settled, "{size}");
                assert_eq!((orders, last_change), (MOST_ORDERS, moved));
                assert!(moved > LARGEST_UNSETTLED_CHANGE);
            }
            Err(other) => panic!("{other}"),
        }
    }
}
