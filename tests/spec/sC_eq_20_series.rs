//! Orders of Appendix C exactly: roots and shapes as power series in the size $t$ of a change, in rational numbers.
//!
//! For a pencil of integers with separate roots the exact series come from Rayleigh and Schrödinger's recursion, which has no
//! formula of the appendix in it. The rows of the appendix, evaluated on series, have the same coefficients below a power of $t$
//! and another at that power:
//!
//! | rule | roots agree below | shapes agree below |
//! |---|---|---|
//! | first order | $t^2$ | $t^2$ |
//! | original | $t^3$ | $t^2$ |
//! | Recursive 1, order r | $t^{r+1}$ | $t^{r+1}$ |
//! | Recursive 2, order r ≥ 2 | $t^{2r-1}$ | $t^{2r}$ |
//!
//! for changes of stiffness alone, and of stiffness and mass together, symmetric or not. The functions of the crate are those rows
//! in floating point: they differ from the rows in rational numbers by round-off.

use crate::common::appendix_c::{ModalChange, eigensolution, of_stiffness};
use crate::common::blocks::{CloseRootsSettings, close_roots};
use crate::common::rational_rows::Change;
use crate::common::rational_series::{Found, IntegerPencil, Series};
use crate::common::tolerances::{RATIONAL_ROUND_OFF, ROUND_OFF};
use corfem::method::perturbation::{Perturbed, first_order, recursive_1, recursive_1_converged};
use nalgebra::{DMatrix, DVector};
use num_rational::BigRational;
use proptest::prelude::*;

/// One more than the highest order that is tested.
const TERMS: usize = 7;

/// Orders of the recursions that are tested.
const ORDERS: (usize, usize) = (4, 3);

/// Every rule's name, its rows in full, and the powers below which roots and shapes agree with the exact ones.
fn rules(change: &Change) -> Vec<(String, Found, (usize, usize))> {
    let first = (
        "first order".to_owned(),
        change.general_first_order(),
        (2, 2),
    );
    let original = ("original".to_owned(), change.general_original(), (3, 2));
    let one = (1..=ORDERS.0).zip(change.general_recursive_1());
    let one = one.map(|(r, found)| (format!("Recursive 1, order {r}"), found, (r + 1, r + 1)));
    let two = (1..=ORDERS.1).zip(change.general_recursive_2());
    let two = two.map(|(r, found)| {
        (
            format!("Recursive 2, order {r}"),
            found,
            ((2 * r - 1).max(2), 2 * r),
        )
    });
    [first, original]
        .into_iter()
        .chain(one)
        .chain(two)
        .collect()
}

/// Three modes with $k$ apart by one to six, and full integer changes from one to a largest, symmetric or not.
fn pencil(is_symmetric: bool, largest: i64) -> impl Strategy<Value = IntegerPencil> {
    let entry = move || {
        (1..=largest, any::<bool>()).prop_map(|(size, sign)| if sign { size } else { -size })
    };
    let entries = || prop::collection::vec(entry(), 9);
    (prop::collection::vec(1..=6_i64, 3), entries(), entries()).prop_map(move |(gaps, b, a)| {
        let square = |entries: Vec<i64>| {
            let entry = |i: usize, j: usize| {
                if is_symmetric {
                    entries[3 * i.min(j) + i.max(j)]
                } else {
                    entries[3 * i + j]
                }
            };
            (0..3)
                .map(|i| (0..3).map(|j| entry(i, j)).collect())
                .collect()
        };
        let k = gaps.iter().scan(0, |k, gap| {
            *k += gap;
            Some(*k)
        });
        IntegerPencil {
            k: k.collect(),
            b: square(b),
            a: square(a),
        }
    })
}

/// Small changes, symmetric or not.
fn any_pencil() -> impl Strategy<Value = IntegerPencil> {
    prop_oneof![pencil(true, 4), pencil(false, 4)]
}

/// The change as the crate has it. A power of two for $t$ leaves every entry exact.
fn in_floating_point(pencil: &IntegerPencil, t: f64) -> ModalChange {
    let size = pencil.k.len();
    let k = DVector::from_iterator(size, pencil.k.iter().map(|&k| k as f64));
    let scaled = |matrix: &[Vec<i64>]| DMatrix::from_fn(size, size, |i, j| t * matrix[i][j] as f64);
    ModalChange::of_vibrations(&k, scaled(&pencil.b), scaled(&pencil.a))
}

fn exactly(value: f64) -> BigRational {
    BigRational::from_float(value).expect("a finite number")
}

fn magnitude(value: BigRational) -> BigRational {
    let opposite = -value.clone();
    value.max(opposite)
}

/// Whether roots, relative to themselves, and shapes, relative to the largest component or one, are within a tolerance of
/// rational ones; compared exactly.
fn are_within(found: &Perturbed, exact: &Found, tolerance: f64) -> Result<(), String> {
    let tolerance = exactly(tolerance);
    let number = |series: &Series| series.0[0].clone();
    for (j, root) in exact.roots.iter().map(number).enumerate() {
        if magnitude(exactly(found.roots[j]) - &root) > &tolerance * magnitude(root.clone()) {
            return Err(format!("root {j}: {} for {root}", found.roots[j]));
        }
        let column: Vec<BigRational> = exact.shapes.iter().map(|row| number(&row[j])).collect();
        let largest = column
            .iter()
            .cloned()
            .map(magnitude)
            .max()
            .expect("at least one");
        for (i, component) in column.iter().enumerate() {
            if magnitude(exactly(found.shapes[(i, j)]) - component) > &tolerance * &largest {
                return Err(format!(
                    "shape {i}, {j}: {} for {component}",
                    found.shapes[(i, j)]
                ));
            }
        }
    }
    Ok(())
}

/// The sum of the exact series at a $t$ so small that the terms left out are nothing.
fn summed(pencil: &IntegerPencil, terms: usize, t: f64) -> Found {
    let at = |series: &Series| Series(vec![series.at(&exactly(t))]);
    let Found { roots, shapes } = pencil.exact(terms);
    Found {
        roots: roots.iter().map(at).collect(),
        shapes: shapes
            .iter()
            .map(|row| row.iter().map(at).collect())
            .collect(),
    }
}

properties! {
    #![proptest_config(crate::common::exact_config())]

    #[test]
    fn the_exact_series_solve_the_changed_pencil(pencil in any_pencil()) {
        let residual = pencil.residual(&pencil.exact(TERMS));
        prop_assert!(residual.concat().into_iter().all(|entry| entry == Series::integer(0, TERMS)));
    }

    #[test]
    fn every_rule_agrees_with_the_exact_series_to_its_order(pencil in any_pencil()) {
        for pencil in [pencil.of_stiffness(), pencil] {
            let (exact, change) = (pencil.exact(TERMS), Change::series(&pencil, TERMS));
            for (name, found, (root, shape)) in rules(&change) {
                let (roots, shapes) = found.agreement(&exact);
                prop_assert!(roots >= root && shapes >= shape, "{name}");
            }
        }
    }

    /// Among small integers the next coefficients vanish by accident; of integers up to a thousand none have been found.
    #[test]
    fn every_rule_agrees_to_its_order_and_no_further(pencil in prop_oneof![pencil(true, 999), pencil(false, 999)]) {
        for pencil in [pencil.of_stiffness(), pencil] {
            let (exact, change) = (pencil.exact(TERMS), Change::series(&pencil, TERMS));
            for (name, found, orders) in rules(&change) {
                prop_assert_eq!(found.agreement(&exact), orders, "{}", name);
            }
        }
    }

    #[test]
    fn the_rows_for_stiffness_alone_are_those_in_full_without_mass(pencil in any_pencil()) {
        let change = Change::series(&pencil.of_stiffness(), TERMS);
        prop_assert_eq!(change.original(), change.general_original());
        for (found, in_full) in change.recursive_1().zip(change.general_recursive_1()).take(ORDERS.0) {
            prop_assert_eq!(found, in_full);
        }
        for (found, in_full) in change.recursive_2().zip(change.general_recursive_2()).take(ORDERS.1) {
            prop_assert_eq!(found, in_full);
        }
    }

}

properties! {
    #![proptest_config(crate::common::costly_config())]

    #[test]
    fn the_functions_are_the_rows_in_floating_point(pencil in any_pencil(), halvings in 9..=12_i32) {
        let t = 0.5_f64.powi(halvings);
        let rows = Change::at(&pencil, &exactly(t));
        let change = in_floating_point(&pencil, t).pencil().unwrap();
        for (order, exact) in (1..=ORDERS.0).zip(rows.general_recursive_1()) {
            let found = change.recursive_1(order).unwrap();
            prop_assert_eq!(are_within(&found, &exact, RATIONAL_ROUND_OFF), Ok(()), "Recursive 1, {}", order);
        }
        for (order, exact) in (1..=ORDERS.1).zip(rows.general_recursive_2()) {
            let found = change.recursive_2(order).unwrap();
            prop_assert_eq!(are_within(&found, &exact, RATIONAL_ROUND_OFF), Ok(()), "Recursive 2, {}", order);
        }
        let (first, original) = (change.first_order().unwrap(), change.original().unwrap());
        prop_assert_eq!(are_within(&first, &rows.general_first_order(), RATIONAL_ROUND_OFF), Ok(()));
        prop_assert_eq!(are_within(&original, &rows.general_original(), RATIONAL_ROUND_OFF), Ok(()));
    }

    #[test]
    fn the_functions_for_stiffness_alone_are_the_rows_in_floating_point(pencil in any_pencil(), halvings in 9..=12_i32) {
        let t = 0.5_f64.powi(halvings);
        let rows = Change::at(&pencil.of_stiffness(), &exactly(t));
        let ModalChange { generalized_stiffness: k, beta, .. } = in_floating_point(&pencil, t);
        prop_assert_eq!(are_within(&first_order(&k, &beta).unwrap(), &rows.first_order(), RATIONAL_ROUND_OFF), Ok(()));
        for (order, exact) in (1..=ORDERS.0).zip(rows.recursive_1()) {
            let found = recursive_1(&k, &beta, order).unwrap();
            prop_assert_eq!(are_within(&found, &exact, RATIONAL_ROUND_OFF), Ok(()), "{}", order);
        }
    }

    /// Terms to $t^{11}$ at $t = 2^{-12}$ leave out less than $10^{-24}$: couplings of four in three modes whose roots are one
    /// apart make the coefficients grow some ten times a power.
    #[test]
    fn what_the_recursions_approach_is_the_sum_of_the_series(pencil in pencil(true, 4)) {
        let t = 0.5_f64.powi(12);
        let stiffness = pencil.of_stiffness();
        let (in_full, alone) = (summed(&pencil, 12, t), summed(&stiffness, 12, t));
        let change = in_floating_point(&pencil, t);
        let settled = change.pencil().unwrap().recursive_1_converged().unwrap().perturbed;
        prop_assert_eq!(are_within(&settled, &in_full, ROUND_OFF), Ok(()));
        prop_assert_eq!(are_within(&eigensolution(&change).unwrap(), &in_full, ROUND_OFF), Ok(()));
        let apart = CloseRootsSettings { separation: 0.01, ..Default::default() };
        let mut blocks = close_roots(&change, apart).unwrap().settled.perturbed;
        for (j, mut shape) in blocks.shapes.column_iter_mut().enumerate() {
            let own = shape[j];
            shape /= own;
        }
        prop_assert_eq!(are_within(&blocks, &in_full, ROUND_OFF), Ok(()));
        let k = &change.generalized_stiffness;
        let settled = recursive_1_converged(k, &change.beta).unwrap().perturbed;
        prop_assert_eq!(are_within(&settled, &alone, ROUND_OFF), Ok(()));
        prop_assert_eq!(are_within(&eigensolution(&of_stiffness(k, &change.beta)).unwrap(), &alone, ROUND_OFF), Ok(()));
    }
}

/// Four modes and every rule, by numbers that anyone may check.
#[test]
fn four_modes_have_the_orders_of_the_table() {
    let pencil = IntegerPencil {
        k: vec![2, 5, 9, 14],
        b: vec![
            vec![1, -2, 3, 1],
            vec![-2, 3, 1, -1],
            vec![3, 1, -1, 2],
            vec![1, -1, 2, 2],
        ],
        a: vec![
            vec![1, 2, -1, 3],
            vec![2, -1, 2, 1],
            vec![-1, 2, 1, 1],
            vec![3, 1, 1, 2],
        ],
    };
    for pencil in [pencil.of_stiffness(), pencil] {
        let (exact, change) = (pencil.exact(TERMS), Change::series(&pencil, TERMS));
        for (name, found, orders) in rules(&change) {
            assert_eq!(found.agreement(&exact), orders, "{name}");
        }
    }
}
