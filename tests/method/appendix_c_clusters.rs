//! Clusters of roots down to exact repetition, against exact eigensolutions.

use crate::common::appendix_c::{
    Clustered, change_of, clustered, separate_change, separate_spectrum,
};
use crate::common::close_roots::{changed, residual, root_error, solved};
use crate::common::tolerances::{EIGEN_ROUND_OFF, MATRIX_ROUND_OFF, ROUND_OFF};
use corfem::method::appendix_c::{
    CloseRootsSettings, UpdateRule, close_roots, first_order_held, general, normalize_with_mass,
    perturb, perturb_with_mass,
};
use corfem::method::error::Error;
use nalgebra::DMatrix;
use proptest::prelude::*;

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
