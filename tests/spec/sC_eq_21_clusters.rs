//! Clusters of roots down to exact repetition, against exact eigensolutions, and the orders of the recursion with blocks.

use crate::common::appendix_c::{Clustered, clustered};
use crate::common::close_roots::changed;
use crate::prelude::*;

properties! {
    /// Clusters of roots down to exact repetition, stiffness and mass changed: roots and shapes are those of the
    /// eigensolution, shapes orthonormal in the changed mass, and the blocks are the clusters.
    #[test]
    fn clusters_of_roots_are_followed_exactly(Clustered { change, blocks } in clustered()) {
        let found = solved(&change);
        prop_assert_eq!(&found.blocks, &blocks);
        let (roots, shapes) = (&found.settled.perturbed.roots, &found.settled.perturbed.shapes);
        prop_assert!(roots.iter().chain(shapes.iter()).all(|value| value.is_finite()));
        prop_assert!(root_error(roots, &change) < EIGEN_ROUND_OFF, "{:e}", root_error(roots, &change));
        prop_assert!(residual(&found, &change) < EIGEN_ROUND_OFF);
        let (_, mass) = changed(&change);
        let product = shapes.tr_mul(&(mass * shapes));
        prop_assert!((product - DMatrix::identity(roots.len(), roots.len())).amax() < EIGEN_ROUND_OFF);
        // Ascending frequency within a block, falling roots.
        for block in &blocks {
            for pair in block.windows(2) {
                prop_assert!(roots[pair[0]] >= roots[pair[1]]);
            }
        }
    }

    /// Without close modes the rule is Recursive 1, order by order, but for the scale of the shapes.
    #[test]
    fn without_close_modes_it_is_recursive_1(change in separate_change(), orders in 2..20_usize) {
        let (pencil, tolerance) = (change.pencil()?, 1e-7);
        let moved_by = |order| {
            let of_order = |order| pencil.recursive_1(order).expect("separate modes").roots;
            largest_change(&of_order(order), &of_order(order - 1))
        };
        let is_quiet = |order| order > 1 && moved_by(order) < tolerance;
        let stops_at = (2..orders).find(|&order| is_quiet(order) && is_quiet(order - 1)).unwrap_or(orders);
        let settings = CloseRootsSettings { orders, tolerance, ..CloseRootsSettings::default() };
        match close_roots(&change, settings) {
            Ok(SolvedInBlocks { settled, blocks }) => {
                prop_assert!(blocks.is_empty());
                prop_assert_eq!(settled.order, stops_at);
                prop_assert!((settled.last_change - moved_by(stops_at)).abs() < ROUND_OFF);
                let Perturbed { roots, mut shapes } = pencil.recursive_1(stops_at)?;
                prop_assert!((&settled.perturbed.roots - &roots).amax() < ROUND_OFF);
                normalize_with_mass(&mut shapes, &change.alpha)?;
                prop_assert!((settled.perturbed.shapes - shapes).amax() < MATRIX_ROUND_OFF);
            }
            // Too few orders.
            Err(Error::UnsettledRoots { last_change, orders: found }) => {
                prop_assert_eq!((found, stops_at), (orders, orders));
                prop_assert!((last_change - moved_by(orders)).abs() < ROUND_OFF);
            }
            Err(other) => prop_assert!(false, "{other:?}"),
        }
        let settled = pencil.recursive_1_converged()?.perturbed;
        prop_assert!((solved(&change).settled.perturbed.roots - settled.roots).amax() < ROUND_OFF);
    }

    /// Whatever the change, the answer is finite or a typed error.
    #[test]
    fn any_change_gives_finite_modes_or_an_error(
        change in separate_spectrum(4).prop_flat_map(|k| change_of(k, 1.5)),
        separation in 0.0..1.0_f64,
    ) {
        let settings = CloseRootsSettings { separation, ..CloseRootsSettings::default() };
        match close_roots(&change, settings) {
            Ok(found) => {
                let perturbed = &found.settled.perturbed;
                prop_assert!(perturbed.roots.iter().all(|root| *root > 0.0 && root.is_finite()));
                prop_assert!(perturbed.shapes.iter().all(|value| value.is_finite()));
            }
            Err(error) => prop_assert!(
                matches!(
                    error,
                    Error::NotAVibration { .. }
                        | Error::NotPositiveDefinite { .. }
                        | Error::CoalescingModes { .. }
                        | Error::UnsettledRoots { .. }
                        | Error::Value { expected: "a finite number", .. }
                ),
                "{error}"
            ),
        }
    }

    /// With every root in one block the rule is the eigensolution, whatever the change.
    #[test]
    fn one_block_of_all_modes_is_the_eigensolution(change in separate_spectrum(4).prop_flat_map(|k| change_of(k, 0.2))) {
        let settings = CloseRootsSettings { separation: 1.0, ..CloseRootsSettings::default() };
        let found = close_roots(&change, settings)?;
        prop_assert_eq!(&found.blocks, &[vec![0, 1, 2, 3]]);
        prop_assert!(root_error(&found.settled.perturbed.roots, &change) < EIGEN_ROUND_OFF);
        prop_assert!(residual(&found, &change) < EIGEN_ROUND_OFF);
        prop_assert_eq!(found.settled.order, 3);
        prop_assert_eq!(found.settled.last_change, 0.0);
    }
}

/// Four modes, two of them with one root, and a change that couples all of them.
fn pair_among_four(size: f64) -> ModalChange {
    ModalChange::of_vibrations(
        &dvector![1.0, 4.0, 4.0, 14.0],
        four_modes(size).beta,
        DMatrix::zeros(4, 4),
    )
}

/// Largest change of a root in the last order, whether that is small enough to count as settled or not.
fn last_change(change: &ModalChange, orders: usize, tolerance: f64) -> f64 {
    let settings = CloseRootsSettings {
        orders,
        tolerance,
        ..CloseRootsSettings::default()
    };
    match close_roots(change, settings) {
        Ok(found) => {
            assert_eq!(found.settled.order, orders);
            assert!(found.settled.last_change <= LARGEST_UNSETTLED_CHANGE);
            found.settled.last_change
        }
        Err(Error::UnsettledRoots {
            orders: found,
            last_change,
        }) => {
            assert_eq!(found, orders);
            assert!(last_change > LARGEST_UNSETTLED_CHANGE);
            last_change
        }
        Err(other) => panic!("{other}"),
    }
}

/// Order r of the recursion has roots with an error of order r + 1, in blocks as without, so that it moves them by order r.
#[test]
fn every_order_of_the_recursion_with_blocks_moves_the_roots_by_that_order() {
    for orders in 2..=4 {
        let points: Vec<(f64, f64)> = [0.1, 0.07, 0.05]
            .into_iter()
            .map(|size| (size, last_change(&pair_among_four(size), orders, 1e-13)))
            .collect();
        let slope = log_log_slope(&points);
        assert!(
            (slope - orders as f64).abs() < 2.0 * ORDER_SLACK,
            "order {orders}: {slope}"
        );
    }
}

/// A fixed order r leaves single roots with an error of order r + 1. The roots of a block are Rayleigh's quotients on shapes of
/// that order, with an error of order 2(r + 1): round-off where the others still have eight digits.
#[test]
fn roots_of_a_block_gain_two_orders_each_time() {
    // Changes small enough for the roots to count as settled at the order.
    for (orders, sizes) in [(3, [0.03, 0.02, 0.0125]), (4, [0.1, 0.07, 0.05])] {
        let settings = CloseRootsSettings {
            orders,
            ..CloseRootsSettings::default()
        };
        let mut singles = Vec::new();
        for size in sizes {
            let change = pair_among_four(size);
            let found = close_roots(&change, settings).unwrap();
            assert_eq!(found.blocks, [vec![1, 2]]);
            assert_eq!(found.settled.order, orders);
            let (stiffness, mass) = changed(&change);
            let exact = solve(&stiffness, &mass, 4).unwrap();
            let roots = found.settled.perturbed.roots;
            let error = |i: usize| (roots[i] * exact.omega_squared()[i] - 1.0).abs();
            let (block, single) = (error(1).max(error(2)), error(0).max(error(3)));
            assert!(
                block < ROUND_OFF && single > 10.0 * ROUND_OFF,
                "order {orders}: {block:e} {single:e}"
            );
            singles.push((size, single));
        }
        let slope = log_log_slope(&singles);
        assert!(
            (slope - orders as f64 - 1.0).abs() < 2.0 * ORDER_SLACK,
            "order {orders}: {slope}"
        );
    }
}

/// The recursion stops at its tolerance and says how far the last order moved a root, in blocks too.
#[test]
fn recursion_with_blocks_stops_at_its_tolerance() {
    let (_, _, modes) = repeated_chain();
    let change = spring_change(&modes, [0.3, 0.0, 0.1], [0.2, 0.0, 0.0]);
    let default = solved(&change).settled;
    assert!(default.last_change < 1e-13 && default.order > 3 && default.order < 60);
    let loose = CloseRootsSettings {
        tolerance: 1e-7,
        ..CloseRootsSettings::default()
    };
    let loose = close_roots(&change, loose).unwrap().settled;
    assert!(loose.last_change < 1e-7 && loose.order > 3 && loose.order < default.order);
    // Two quiet orders, and a louder one before them.
    assert!(last_change(&change, loose.order - 1, 1e-7) < 1e-7);
    assert!(last_change(&change, loose.order - 2, 1e-7) >= 1e-7);
    // One order alone has nothing to compare with.
    assert_eq!(last_change(&change, 1, 1e-7), 1.0);
    assert_eq!(
        CloseRootsSettings::default(),
        CloseRootsSettings {
            separation: 0.1,
            tolerance: 1e-13,
            orders: 60
        }
    );
}
