//! Close and repeated roots: three-mass chains with known spectra, and clusters of roots against exact eigensolutions.

use crate::common::appendix_c::{
    Clustered, ascending, change_of, clustered, separate_change, separate_spectrum,
    three_mass_chain,
};
use crate::common::log_log_slope;
use crate::common::tolerances::{EIGEN_ROUND_OFF, MATRIX_ROUND_OFF, ORDER_SLACK, ROUND_OFF};
use corfem::error::Error;
use corfem::modes::Modes;
use corfem::perturbation::{
    CloseRootsSettings, ModalChange, SolvedInBlocks, UpdateRule, close_roots, first_order_held,
    general, normalize_with_mass, perturb, perturb_with_mass,
};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;

fn solved(change: &ModalChange<f64>) -> SolvedInBlocks {
    close_roots(change, CloseRootsSettings::default()).expect("a change the method can follow")
}

/// Stiffness and mass after the change in the modal coordinates.
fn changed(change: &ModalChange<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let k = &change.generalized_stiffness;
    (
        DMatrix::from_diagonal(k) + &change.beta,
        DMatrix::from_diagonal(&k.component_mul(&change.roots)) + &change.alpha,
    )
}

/// Largest relative distance of sorted ω² from those of the eigensolution of the changed matrices.
fn root_error(roots: &DVector<f64>, change: &ModalChange<f64>) -> f64 {
    let (stiffness, mass) = changed(change);
    let exact = corfem::modes::solve(&stiffness, &mass, roots.len()).expect("vibrations");
    ascending(roots.map(f64::recip).iter())
        .iter()
        .zip(exact.omega_squared.iter())
        .map(|(found, exact)| (found / exact - 1.0).abs())
        .fold(0.0, f64::max)
}

/// (k + β)p γ − (I + α)p, largest entry: zero for exact modes, repeated or not.
fn residual(solved: &SolvedInBlocks, change: &ModalChange<f64>) -> f64 {
    let (stiffness, mass) = changed(change);
    let roots = DMatrix::from_diagonal(&solved.perturbed.roots);
    (stiffness * &solved.perturbed.shapes * roots - mass * &solved.perturbed.shapes).amax()
}

/// λ = 1, 4, 4: masses 1, 4, 1; springs to ground 0, 8, 0; 1-2: 2, 2-3: 2, 1-3: 1.
fn repeated_chain() -> (DMatrix<f64>, DMatrix<f64>, Modes) {
    let stiffness = three_mass_chain([0.0, 8.0, 0.0], [2.0, 2.0, 1.0]);
    let mass = DMatrix::from_diagonal(&dvector![1.0, 4.0, 1.0]);
    let modes = corfem::modes::solve(&stiffness, &mass, 3).unwrap();
    (stiffness, mass, modes)
}

/// λ = 1, 4, 8: unit masses; springs to ground 1, 1, 1; 1-2: 1, 2-3: 1, 1-3: 3.
fn separate_chain() -> (DMatrix<f64>, DMatrix<f64>, Modes) {
    let stiffness = three_mass_chain([1.0, 1.0, 1.0], [1.0, 1.0, 3.0]);
    let mass = DMatrix::identity(3, 3);
    let modes = corfem::modes::solve(&stiffness, &mass, 3).unwrap();
    (stiffness, mass, modes)
}

/// A change of springs seen through a chain's modes.
fn spring_change(modes: &Modes, ground: [f64; 3], between: [f64; 3]) -> ModalChange<f64> {
    let beta = modes
        .shapes
        .tr_mul(&(three_mass_chain(ground, between) * &modes.shapes));
    ModalChange::of_vibrations(&modes.omega_squared, beta, DMatrix::zeros(3, 3))
}

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
            let exact = corfem::modes::solve(
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

proptest! {
    #![proptest_config(crate::common::config())]

    /// Clusters of roots down to exact repetition, stiffness and mass changed: roots and shapes are those of the
    /// eigensolution, shapes orthonormal in the changed mass, and the blocks are the clusters.
    #[test]
    fn clusters_of_roots_are_followed_exactly(Clustered { change, blocks } in clustered()) {
        let found = solved(&change);
        prop_assert_eq!(&found.blocks, &blocks);
        let (roots, shapes) = (&found.perturbed.roots, &found.perturbed.shapes);
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
    fn without_close_modes_it_is_recursive_1(change in separate_change(), orders in 1..6_usize) {
        let settings = CloseRootsSettings { orders, tolerance: 1e-6, ..CloseRootsSettings::default() };
        let found = close_roots(&change, settings)?;
        let mut plain = general::recursive_1_converged(&change, 1e-6, orders)?;
        prop_assert!(found.blocks.is_empty());
        prop_assert_eq!(found.perturbed.order, plain.order);
        prop_assert!((&found.perturbed.roots - &plain.roots).amax() < ROUND_OFF);
        prop_assert!(
            found.perturbed.last_change == plain.last_change
                || (found.perturbed.last_change - plain.last_change).abs() < ROUND_OFF
        );
        normalize_with_mass(&mut plain.shapes, &change.alpha)?;
        prop_assert!((found.perturbed.shapes - plain.shapes).amax() < MATRIX_ROUND_OFF);
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
                let perturbed = &found.perturbed;
                prop_assert!(perturbed.roots.iter().all(|root| *root > 0.0 && root.is_finite()));
                prop_assert!(perturbed.shapes.iter().all(|value| value.is_finite()));
            }
            Err(error) => prop_assert!(
                matches!(
                    error,
                    Error::LostRoot { .. }
                        | Error::LostStiffness { .. }
                        | Error::NotPositiveDefinite { .. }
                        | Error::CoalescingModes { .. }
                        | Error::NotFinite { .. }
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
        prop_assert!(root_error(&found.perturbed.roots, &change) < EIGEN_ROUND_OFF);
        prop_assert!(residual(&found, &change) < EIGEN_ROUND_OFF);
        prop_assert_eq!(found.perturbed.order, 3);
        prop_assert_eq!(found.perturbed.last_change, 0.0);
    }

    /// Through the dispatchers, with mass and without.
    #[test]
    fn update_rule_is_the_function(Clustered { mut change, .. } in clustered()) {
        let rule = UpdateRule::CloseRoots(CloseRootsSettings::default());
        prop_assert_eq!(&perturb_with_mass(&change, rule)?, &solved(&change).perturbed);
        change.alpha.fill(0.0);
        prop_assert_eq!(
            &perturb(&change.generalized_stiffness, &change.beta, rule)?,
            &solved(&change).perturbed
        );
    }

    /// Apart, the held first order is first order; in a cluster it is finite, and no mode of one turns another.
    #[test]
    fn held_first_order_turns_no_close_mode(Clustered { change, blocks } in clustered()) {
        let held = first_order_held(&change, 0.1)?;
        let (stiffness, mass) = changed(&change);
        let together = |i: usize, j: usize| blocks.iter().any(|block| block.contains(&i) && block.contains(&j));
        for j in 0..change.len() {
            prop_assert!((held.roots[j] * stiffness[(j, j)] / mass[(j, j)] - 1.0).abs() < ROUND_OFF);
            for i in 0..change.len() {
                let row = stiffness[(i, j)] * held.roots[j] - mass[(i, j)];
                let own = stiffness[(i, i)] * held.roots[j] - mass[(i, i)];
                let expected = if i == j { 1.0 } else if together(i, j) { 0.0 } else { -row / own };
                prop_assert!((held.shapes[(i, j)] - expected).abs() < MATRIX_ROUND_OFF);
            }
        }
        prop_assert_eq!(held.order, 1);
        prop_assert_eq!(held.last_change, f64::INFINITY);
    }

    /// With all roots apart the held first order is first order.
    #[test]
    fn held_first_order_is_first_order_where_roots_are_apart(change in separate_change()) {
        let (held, plain) = (first_order_held(&change, 0.1)?, general::first_order(&change)?);
        prop_assert!((held.roots - plain.roots).amax() < ROUND_OFF);
        prop_assert!((held.shapes - plain.shapes).amax() < MATRIX_ROUND_OFF);
    }
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
    assert!((1.0 / found.perturbed.roots[2] - 3.0).abs() < 0.01);
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
                    corfem::modes::solve(&changed(&change).0, &DMatrix::identity(4, 4), 4).unwrap();
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
            assert!(shape.max() >= shape.amax() * (1.0 - 1e-6));
        }
    }
}

#[test]
fn settings_out_of_range_are_refused() {
    let (_, _, modes) = separate_chain();
    let change = spring_change(&modes, [0.1, 0.0, 0.0], [0.0; 3]);
    for separation in [-0.1, 1.1, f64::NAN] {
        assert!(matches!(
            close_roots(&change, CloseRootsSettings { separation, ..CloseRootsSettings::default() }),
            Err(Error::Setting { name: "separation", expected: "between 0 and 1", found }) if found.to_bits() == separation.to_bits()
        ));
    }
    assert!(matches!(
        close_roots(
            &change,
            CloseRootsSettings {
                orders: 0,
                ..CloseRootsSettings::default()
            }
        ),
        Err(Error::Setting { name: "order", .. })
    ));
    for separation in [0.0, 1.0] {
        assert!(
            close_roots(
                &change,
                CloseRootsSettings {
                    separation,
                    ..CloseRootsSettings::default()
                }
            )
            .is_ok()
        );
    }
}

#[test]
fn changes_that_are_no_vibrations_are_refused() {
    let good = ModalChange::of_vibrations(
        &dvector![1.0, 1.0, 3.0],
        DMatrix::zeros(3, 3),
        DMatrix::zeros(3, 3),
    );
    let error = |edit: fn(&mut ModalChange<f64>)| {
        let mut change = good.clone();
        edit(&mut change);
        close_roots(&change, CloseRootsSettings::default()).expect_err("no vibrations")
    };
    assert!(matches!(
        error(|change| change.beta[(2, 0)] = 0.1),
        Error::NotSymmetric {
            what: "generalized stiffness change",
            row: 2,
            column: 0,
            ..
        }
    ));
    assert!(matches!(
        error(|change| change.alpha[(0, 1)] = 0.1),
        Error::NotSymmetric {
            what: "generalized mass change",
            row: 1,
            column: 0,
            ..
        }
    ));
    assert!(matches!(
        error(|change| change.alpha[(1, 1)] = -1.1),
        Error::NotPositiveDefinite {
            what: "changed generalized mass",
            dof: 1
        }
    ));
    assert!(matches!(
        error(|change| change.beta[(2, 2)] = -4.0),
        Error::LostRoot {
            mode: 2,
            value: -1.0
        }
    ));
    assert!(matches!(
        error(|change| change.beta[(1, 1)] = -1.0),
        Error::LostStiffness { mode: 1, .. }
    ));
    assert!(matches!(
        error(|change| change.beta[(0, 0)] = f64::NAN),
        Error::NotFinite {
            what: "generalized stiffness change",
            row: 0,
            column: 0,
            ..
        }
    ));
    assert!(matches!(
        error(|change| change.roots = DVector::zeros(0)),
        Error::Empty { what: "modes" }
    ));
    // The pair's own problem loses a root: [[1, 1.5], [1.5, 1]] has eigenvalues −0.5 and 2.5.
    let mut coupled = good.clone();
    coupled.generalized_stiffness = dvector![3.0, 1.0, 1.0];
    coupled.roots = dvector![1.0 / 3.0, 1.0, 1.0];
    coupled.beta[(1, 2)] = 1.5;
    coupled.beta[(2, 1)] = 1.5;
    assert!(matches!(
        close_roots(&coupled, CloseRootsSettings::default()),
        Err(Error::LostRoot { mode: 1, value }) if (value + 2.0).abs() < ROUND_OFF
    ));
    let mut held = good.clone();
    held.alpha[(1, 1)] = -1.5;
    assert!(matches!(
        first_order_held(&held, 0.1),
        Err(Error::LostRoot { mode: 1, value }) if (value + 0.5).abs() < ROUND_OFF
    ));
    held.alpha[(1, 1)] = f64::NAN;
    assert!(matches!(
        first_order_held(&held, 0.1),
        Err(Error::NotFinite {
            row: 1,
            column: 1,
            ..
        })
    ));
}

/// With separation zero nothing is a block, and a repeated root is the typed error of Recursive 1.
#[test]
fn without_blocks_a_repeated_root_is_refused_and_named() {
    let (_, _, modes) = repeated_chain();
    let mut change = spring_change(&modes, [0.0; 3], [0.0; 3]);
    change.generalized_stiffness = dvector![1.0, 4.0, 4.0];
    change.roots = dvector![1.0, 0.25, 0.25];
    change.beta.fill(0.0);
    let settings = CloseRootsSettings {
        separation: 0.0,
        ..CloseRootsSettings::default()
    };
    assert!(matches!(
        close_roots(&change, settings),
        Err(Error::CoalescingModes {
            first: 2,
            second: 1,
            separation: 0.0
        })
    ));
    assert!(matches!(
        first_order_held(&change, 0.0),
        Err(Error::CoalescingModes {
            first: 2,
            second: 1,
            separation: 0.0
        })
    ));
    // Two parts in a thousand million are enough for the denominator; a tenth of that is not.
    change.generalized_stiffness[2] = 4.0 * (1.0 + 2e-9);
    change.roots[2] = 0.25 / (1.0 + 2e-9);
    assert!(close_roots(&change, settings).is_ok());
    change.generalized_stiffness[2] = 4.0 * (1.0 + 2e-10);
    change.roots[2] = 0.25 / (1.0 + 2e-10);
    assert!(matches!(
        close_roots(&change, settings),
        Err(Error::CoalescingModes { first: 2, second: 1, separation }) if (separation / 2e-10 - 1.0).abs() < 1e-3
    ));
}
