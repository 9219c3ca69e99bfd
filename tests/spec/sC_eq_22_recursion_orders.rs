//! Orders of convergence by log-log slope: how the error of every rule falls with the size of the change.
//!
//! With ε the size of the change relative to the stiffness, the relative errors of roots and the errors of shapes are
//! O(ε^s) with the s below, by expansion and by measurement. Two modes alone do better: there a shape is exact but
//! for its root, and the theorem is in `appendix_c_two_dof`.
//!
//! | rule | roots | shapes |
//! |---|---|---|
//! | first order | 2 | 2 |
//! | original | 3 | 2 |
//! | Recursive 1, order r | r + 1 | r + 1 |
//! | Recursive 2, order r ≥ 2 | 2r − 1 | 2r |

use crate::common::appendix_c::{Plain, errors, exact, original, recursive_2};
use crate::common::log_log_slope;
use crate::common::tolerances::{MEASURABLE_ERROR, ORDER_HALFWAY, SECOND_ORDER_REMAINDER};
use crate::common::vibrations::{Change, full_change};
use corfem::method::appendix_c::{first_order, recursive_1};
use nalgebra::{dmatrix, dvector};
use proptest::prelude::*;

/// Sizes and errors of roots and of shapes over four changes from `largest` down, each 0.7 of the one before; of the
/// errors those above round-off.
fn measured(change: &Change, rule: Plain, largest: f64) -> [Vec<(f64, f64)>; 2] {
    let (roots, shapes): (Vec<_>, Vec<_>) = (0..4)
        .map(|step| largest * 0.7_f64.powi(step))
        .map(|size| {
            let beta = change.beta(size);
            let found = rule(&change.stiffness, &beta).unwrap();
            let (root, shape) = errors(&found, &exact(&change.stiffness, &beta).unwrap());
            ((size, root), (size, shape))
        })
        .unzip();
    [roots, shapes].map(|points| {
        let is_measurable = |point: &(f64, f64)| point.1 > MEASURABLE_ERROR;
        points.into_iter().filter(is_measurable).collect()
    })
}

/// Slopes of the errors of roots and shapes.
fn slopes(change: &Change, rule: Plain, largest: f64) -> [f64; 2] {
    measured(change, rule, largest).map(|points| {
        assert!(points.len() >= 2, "too little to measure: {points:?}");
        log_log_slope(&points)
    })
}

/// Whether errors fall at least with the orders as the change gets small. Two terms of an expansion may cancel at one
/// size; an eighth of it tells them apart, or is as exact as numbers are.
fn fall_with(orders: [f64; 2], change: &Change, rule: Plain, largest: f64) -> Result<(), String> {
    let first = slopes(change, rule, largest);
    for (row, order) in orders.into_iter().enumerate() {
        let is_steep = |slope: f64| slope >= order - ORDER_HALFWAY;
        let later = &measured(change, rule, largest / 8.0)[row];
        if !is_steep(first[row]) && later.len() >= 2 && !is_steep(log_log_slope(later)) {
            return Err(format!("{}: {first:?}", ["roots", "shapes"][row]));
        }
    }
    Ok(())
}

/// Rule, largest change to measure at (larger for higher orders, whose errors soon sink into round-off), and the
/// orders of roots and shapes.
const ORDERS: [(&str, Plain, f64, f64, f64); 8] = [
    ("first order", first_order, 0.002, 2.0, 2.0),
    ("original", original, 0.002, 3.0, 2.0),
    (
        "Recursive 1, order 1",
        |k, b| recursive_1(k, b, 1),
        0.002,
        2.0,
        2.0,
    ),
    (
        "Recursive 1, order 2",
        |k, b| recursive_1(k, b, 2),
        0.004,
        3.0,
        3.0,
    ),
    (
        "Recursive 1, order 3",
        |k, b| recursive_1(k, b, 3),
        0.008,
        4.0,
        4.0,
    ),
    (
        "Recursive 1, order 4",
        |k, b| recursive_1(k, b, 4),
        0.012,
        5.0,
        5.0,
    ),
    (
        "Recursive 2, order 2",
        |k, b| recursive_2(k, b, 2),
        0.008,
        3.0,
        4.0,
    ),
    (
        "Recursive 2, order 3",
        |k, b| recursive_2(k, b, 3),
        0.02,
        5.0,
        6.0,
    ),
];

proptest! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn errors_fall_at_least_with_the_order_of_the_rule(change in full_change(4)) {
        for (name, rule, largest, root_order, shape_order) in ORDERS {
            let fallen = fall_with([root_order, shape_order], &change, rule, largest);
            prop_assert!(fallen.is_ok(), "{name}, {fallen:?}");
        }
    }

    #[test]
    fn the_first_order_root_errs_by_the_second_order_term(change in full_change(4)) {
        // Rayleigh and Schroedinger: 1/γ_i = k_i + β_ii − Σ_j β_ij²/(k_j − k_i) + O(ε³).
        let size = 1e-4;
        let (k, beta) = (&change.stiffness, change.beta(size));
        let first = first_order(k, &beta).unwrap();
        let second = original(k, &beta).unwrap();
        for i in 0..4 {
            let term: f64 = (0..4)
                .filter(|&j| j != i)
                .map(|j| beta[(i, j)].powi(2) / (k[j] - k[i]))
                .sum();
            let series = k[i] + beta[(i, i)] - term;
            let bound = SECOND_ORDER_REMAINDER * size.powi(3) * k.amax();
            prop_assert!((1.0 / second.roots[i] - series).abs() <= bound);
            prop_assert!((1.0 / first.roots[i] - term - series).abs() <= bound);
        }
    }

    #[test]
    fn every_order_of_recursive_1_is_nearer_the_eigensolution(change in full_change(4)) {
        let beta = change.beta(0.004);
        let exact = exact(&change.stiffness, &beta).unwrap();
        let mut before = errors(&first_order(&change.stiffness, &beta).unwrap(), &exact);
        for order in 2..=4 {
            let found = recursive_1(&change.stiffness, &beta, order).unwrap();
            let now = errors(&found, &exact);
            prop_assert!(now.0 <= before.0 && now.1 <= before.1, "{order}: {now:?} {before:?}");
            before = now;
        }
    }
}

#[test]
fn errors_fall_exactly_with_the_order_of_the_rule() {
    // A change without accidental zeros in any coefficient: the slopes are the orders, no more and no less.
    let change = Change {
        stiffness: dvector![1.0, 2.0, 4.5, 10.0],
        direction: dmatrix![
            0.7, 1.1, -1.5, 2.2;
            1.1, -1.4, 2.4, 3.1;
            -1.5, 2.4, 3.3, -5.0;
            2.2, 3.1, -5.0, 6.5
        ],
    };
    for (name, rule, largest, root_order, shape_order) in ORDERS {
        let [roots, shapes] = slopes(&change, rule, largest);
        assert!(
            (roots - root_order).abs() <= ORDER_HALFWAY,
            "{name} roots {roots}"
        );
        assert!(
            (shapes - shape_order).abs() <= ORDER_HALFWAY,
            "{name} shapes {shapes}"
        );
    }
}

#[test]
fn recursive_2_gains_two_orders_where_recursive_1_gains_one() {
    let change = Change {
        stiffness: dvector![1.0, 3.0, 8.0],
        direction: dmatrix![0.5, 1.5, 2.0; 1.5, -2.0, 4.0; 2.0, 4.0, 5.0],
    };
    let beta = change.beta(0.03);
    let exact = exact(&change.stiffness, &beta).unwrap();
    for order in [3, 4] {
        let one = errors(
            &recursive_1(&change.stiffness, &beta, order).unwrap(),
            &exact,
        );
        let two = errors(
            &recursive_2(&change.stiffness, &beta, order).unwrap(),
            &exact,
        );
        assert!(two.0 < one.0 && two.1 < one.1, "{order}: {one:?} {two:?}");
    }
}
