//! Close and repeated roots: three-mass chains with known spectra, and how blocks form.

use crate::common::appendix_c::three_mass_chain;
use crate::common::close_roots::{
    changed, repeated_chain, residual, root_error, separate_chain, solved, spring_change,
};
use crate::common::log_log_slope;
use crate::common::tolerances::{
    EIGEN_ROUND_OFF, EQUALLY_LARGE, MATRIX_ROUND_OFF, NEARLY_UNCOUPLED, ORDER_SLACK, ROUND_OFF,
};
use corfem::method::appendix_c::{
    CloseRootsSettings, ModalChange, UpdateRule, close_roots, first_order_held, perturb,
};
use corfem::method::error::Error;
use nalgebra::{DMatrix, dmatrix, dvector};

#[test]
fn chains_have_the_spectra_they_are_said_to_have() {
    for ((_, _, modes), expected) in [
        (repeated_chain(), [1.0, 4.0, 4.0]),
        (separate_chain(), [1.0, 4.0, 8.0]),
    ] {
        for (found, expected) in modes.omega_squared.iter().zip(expected) {
            assert!(
                (found / expected - 1.0).abs() < ROUND_OFF,
                "{found} {expected}"
            );
        }
    }
}

/// Each spring of the chain with λ = 1, 4, 4 changed alone, by little and by much: the pair forms a block and the
/// modes are exact.
#[test]
fn repeated_roots_of_a_chain_are_followed_exactly() {
    let (stiffness, mass, modes) = repeated_chain();
    for spring in 0..6 {
        for size in [-0.2, -1e-3, -1e-9, 0.0, 1e-12, 1e-6, 0.05, 0.3] {
            let mut springs = [0.0; 6];
            springs[spring] = size;
            let [a, b, c, d, e, f] = springs;
            let change = spring_change(&modes, [a, b, c], [d, e, f]);
            let found = solved(&change);
            assert_eq!(found.blocks, [vec![1, 2]], "spring {spring} by {size}");
            let exact = corfem::method::modes::solve(
                &(&stiffness + three_mass_chain([a, b, c], [d, e, f])),
                &mass,
                3,
            )
            .unwrap();
            let omega_squared = found.perturbed.roots.map(f64::recip);
            for i in 0..3 {
                let error = omega_squared[i] / exact.omega_squared[i] - 1.0;
                assert!(
                    error.abs() < EIGEN_ROUND_OFF,
                    "spring {spring} by {size}: mode {i} {error:e}"
                );
            }
            assert!(residual(&found, &change) < EIGEN_ROUND_OFF);
        }
    }
}

/// The plain rules refuse what the blocks solve: a change that leaves the two roots together.
#[test]
fn plain_rules_refuse_a_repeated_root_and_name_it() {
    let (_, _, modes) = repeated_chain();
    let none = spring_change(&modes, [0.0; 3], [0.0; 3]);
    for rule in [
        UpdateRule::default(),
        UpdateRule::FirstOrder,
        UpdateRule::Original,
    ] {
        assert!(matches!(
            perturb(&none.generalized_stiffness, &none.beta, rule),
            Err(Error::CoalescingModes { first: 2, second: 1, separation }) if separation < 1e-9
        ));
    }
    let found = solved(&none).perturbed;
    assert!((found.roots - modes.omega_squared.map(f64::recip)).amax() < ROUND_OFF);
}

/// λ = 1, 4, 8 are apart: no blocks, and Recursive 1 itself.
#[test]
fn chain_with_separate_roots_forms_no_block() {
    let (_, _, modes) = separate_chain();
    let change = spring_change(&modes, [0.1, -0.05, 0.0], [0.0, 0.1, 0.2]);
    let found = solved(&change);
    assert!(found.blocks.is_empty());
    let plain = perturb(
        &change.generalized_stiffness,
        &change.beta,
        UpdateRule::default(),
    )
    .unwrap();
    assert!((found.perturbed.roots - plain.roots).amax() < ROUND_OFF);
}

/// Softening spring 1-3 from 3 to 1 turns λ = 1, 4, 8 into 1, 4, 4: roots that were apart are brought together.
#[test]
fn roots_that_a_change_brings_together_form_a_block() {
    let (_, _, modes) = separate_chain();
    let change = spring_change(&modes, [0.0; 3], [0.0, 0.0, -2.0]);
    assert!(matches!(
        perturb(
            &change.generalized_stiffness,
            &change.beta,
            UpdateRule::default()
        ),
        Err(Error::CoalescingModes { .. })
    ));
    let found = solved(&change);
    assert_eq!(found.blocks, [vec![1, 2]]);
    for (root, expected) in found.perturbed.roots.iter().zip([1.0, 0.25, 0.25]) {
        assert!((root - expected).abs() < ROUND_OFF);
    }
    assert!(residual(&found, &change) < MATRIX_ROUND_OFF);
}

/// Two modes that are solved together may come close to a third that was apart from both: it joins them.
#[test]
fn block_whose_solution_meets_a_third_root_takes_it_in() {
    let change = ModalChange::of_vibrations(
        &dvector![1.0, 1.0, 1.15, 4.0],
        dmatrix![0.0, 0.1, 0.01, 0.02; 0.1, 0.0, 0.03, 0.01; 0.01, 0.03, 0.0, 0.05; 0.02, 0.01, 0.05, 0.0],
        DMatrix::zeros(4, 4),
    );
    let found = solved(&change);
    assert_eq!(found.blocks, [vec![0, 1, 2]]);
    assert!(root_error(&found.perturbed.roots, &change) < EIGEN_ROUND_OFF);
    assert!(residual(&found, &change) < EIGEN_ROUND_OFF);
    // Without their coupling the pair stays where it is, and the third mode stays out.
    let mut apart = change;
    apart.beta[(0, 1)] = 0.0;
    apart.beta[(1, 0)] = 0.0;
    assert_eq!(solved(&apart).blocks, [vec![0, 1]]);
}

/// Blocks need not be neighbors in the order of modes, and there may be several.
#[test]
fn blocks_follow_the_changed_roots_and_not_the_order_of_modes() {
    // The change lifts mode 0 to mode 3 and mode 1 to mode 4.
    let change = ModalChange::of_vibrations(
        &dvector![1.0, 2.0, 3.0, 8.0, 20.0],
        dmatrix![
            7.0, 0.1, 0.05, 0.2, 0.1;
            0.1, 18.1, 0.1, 0.1, 0.3;
            0.05, 0.1, 0.0, 0.1, 0.1;
            0.2, 0.1, 0.1, 0.0, 0.1;
            0.1, 0.3, 0.1, 0.1, 0.0],
        DMatrix::zeros(5, 5),
    );
    let found = solved(&change);
    assert_eq!(found.blocks, [vec![0, 3], vec![1, 4]]);
    assert!(root_error(&found.perturbed.roots, &change) < EIGEN_ROUND_OFF);
    assert!(residual(&found, &change) < EIGEN_ROUND_OFF);
    // The mode outside blocks stays in its place.
    assert!((1.0 / found.perturbed.roots[2] - 3.0).abs() < NEARLY_UNCOUPLED);
}

/// The separation is a fraction of the larger root: just inside it joins, just outside it does not.
#[test]
fn separation_is_a_fraction_of_the_larger_root() {
    for (ratio, joined) in [(0.901, true), (0.899, false)] {
        let change = ModalChange::of_vibrations(
            &dvector![ratio, 1.0, 1.0 / ratio.powi(9)],
            DMatrix::zeros(3, 3),
            DMatrix::zeros(3, 3),
        );
        let blocks = solved(&change).blocks;
        assert_eq!(blocks == [vec![0, 1]], joined, "{ratio}: {blocks:?}");
        let held = first_order_held(
            &ModalChange {
                beta: DMatrix::repeat(3, 3, 1e-6),
                ..change
            },
            0.1,
        )
        .unwrap();
        assert_eq!(held.shapes[(0, 1)] == 0.0, joined);
        assert_eq!(held.shapes[(1, 0)] == 0.0, joined);
        assert!(held.shapes[(0, 2)] != 0.0);
    }
}

/// A fixed order leaves the roots of a block with an error of order 2(r + 1), Rayleigh's quotient on shapes of order
/// r + 1; the others with r + 1 as in Recursive 1.
#[test]
fn roots_of_a_block_gain_two_orders_each_time() {
    let beta = dmatrix![
        0.3, 0.5, -0.4, 0.6;
        0.5, -0.8, 0.9, 0.7;
        -0.4, 0.9, 1.1, -1.3;
        0.6, 0.7, -1.3, 1.7];
    for orders in 1..=2 {
        let errors: Vec<(f64, f64, f64)> = [0.2, 0.14, 0.1]
            .into_iter()
            .map(|size| {
                let change = ModalChange::of_vibrations(
                    &dvector![1.0, 4.0, 4.0, 14.0],
                    size * &beta,
                    DMatrix::zeros(4, 4),
                );
                let settings = CloseRootsSettings {
                    orders,
                    tolerance: -1.0,
                    ..CloseRootsSettings::default()
                };
                let found = close_roots(&change, settings).unwrap();
                assert_eq!(found.blocks, [vec![1, 2]]);
                assert_eq!(found.perturbed.order, orders);
                let exact =
                    corfem::method::modes::solve(&changed(&change).0, &DMatrix::identity(4, 4), 4)
                        .unwrap();
                let error =
                    |i: usize| (found.perturbed.roots[i] * exact.omega_squared[i] - 1.0).abs();
                (size, error(1).max(error(2)), error(0).max(error(3)))
            })
            .collect();
        let slope = |points: Vec<(f64, f64)>| log_log_slope(&points);
        let block = slope(errors.iter().map(|e| (e.0, e.1)).collect());
        let single = slope(errors.iter().map(|e| (e.0, e.2)).collect());
        let expected = orders as f64 + 1.0;
        assert!(
            block > 2.0 * (expected - ORDER_SLACK),
            "order {orders}: block {block}"
        );
        assert!(
            block < 2.0 * expected + 1.0,
            "order {orders}: block {block}"
        );
        assert!(
            (single - expected).abs() < 2.0 * ORDER_SLACK,
            "order {orders}: single {single}"
        );
    }
}

/// The recursion stops at its tolerance and says how far the last order moved a root, in blocks too.
#[test]
fn recursion_with_blocks_stops_at_its_tolerance() {
    let (_, _, modes) = repeated_chain();
    let change = spring_change(&modes, [0.3, 0.0, 0.1], [0.2, 0.0, 0.0]);
    let default = solved(&change).perturbed;
    assert!(default.last_change < 1e-13 && default.order > 3 && default.order < 60);
    let loose = close_roots(
        &change,
        CloseRootsSettings {
            tolerance: 1e-4,
            ..CloseRootsSettings::default()
        },
    )
    .unwrap()
    .perturbed;
    assert!(loose.last_change < 1e-4 && loose.order > 3 && loose.order < default.order);
    // Two quiet orders, and a louder one before them.
    let fewer = |orders| CloseRootsSettings {
        orders,
        tolerance: 1e-4,
        ..CloseRootsSettings::default()
    };
    let last_change = |orders| {
        close_roots(&change, fewer(orders))
            .unwrap()
            .perturbed
            .last_change
    };
    assert!(last_change(loose.order - 1) < 1e-4);
    assert!(last_change(loose.order - 2) >= 1e-4);
    let first = CloseRootsSettings {
        orders: 1,
        ..CloseRootsSettings::default()
    };
    assert_eq!(
        close_roots(&change, first).unwrap().perturbed.last_change,
        f64::INFINITY
    );
    assert_eq!(
        CloseRootsSettings::default(),
        CloseRootsSettings {
            separation: 0.1,
            tolerance: 1e-13,
            orders: 60
        }
    );
}

/// Every shape has its first largest component positive.
#[test]
fn shapes_are_signed_by_their_largest_component() {
    let (_, _, modes) = repeated_chain();
    for size in [-0.3, 0.1, 0.4] {
        let shapes = solved(&spring_change(&modes, [size, 0.0, 0.0], [0.0, 0.0, 0.2]))
            .perturbed
            .shapes;
        assert_eq!(shapes.shape(), (3, 3));
        for shape in shapes.column_iter() {
            assert!(shape.max() >= shape.amax() * (1.0 - EQUALLY_LARGE));
        }
    }
}
