//! Appendix C in full on real numbers: equal to the plain path where that applies, and mass changes beside stiffness.

use crate::common::appendix_c::{
    ascending, errors, four_modes, rules, separate_change, three_mass_chain,
};
use crate::common::tolerances::{EIGEN_ROUND_OFF, MATRIX_ROUND_OFF, ROUND_OFF};
use corfem::method::appendix_c::general::complex_modes::LeftRightModes;
use corfem::method::appendix_c::general::{self, ModalChange};
use corfem::method::appendix_c::{eigensolution, normalize_with_mass, recursive};
use nalgebra::{DMatrix, dmatrix, dvector};
use proptest::prelude::*;

properties! {
    #![proptest_config(crate::common::config())]

    /// The general formulae with α = 0, k = 1/λ are the plain ones, order by order.
    #[test]
    fn general_path_is_the_plain_path_for_stiffness_alone(mut change in separate_change(), order in 1..=6_usize) {
        change.alpha.fill(0.0);
        let (k, beta) = (&change.generalized_stiffness, &change.beta);
        for (general, plain) in [
            (general::first_order(&change)?, recursive::first_order(k, beta)?),
            (general::recursive_1(&change, order)?, recursive::recursive_1(k, beta, order)?),
        ] {
            let (root, shape) = errors(&general, &plain);
            prop_assert!(root < ROUND_OFF && shape < MATRIX_ROUND_OFF, "{root:e} {shape:e}");
        }
    }

    /// Carried to convergence they meet too; the general recursion waits for a second quiet order in a row.
    #[test]
    fn both_paths_converge_to_the_same_modes_for_stiffness_alone(mut change in separate_change()) {
        change.alpha.fill(0.0);
        let (k, beta) = (&change.generalized_stiffness, &change.beta);
        let general = general::recursive_1_converged(&change, 1e-13, 60)?;
        let plain = recursive::recursive_1_converged(k, beta, 1e-13, 60)?;
        let (root, shape) = errors(&general.perturbed, &plain.perturbed);
        prop_assert!(root < EIGEN_ROUND_OFF && shape < EIGEN_ROUND_OFF, "{root:e} {shape:e}");
        prop_assert!(general.order >= plain.order);
    }

    /// Mass enters through α: carried to convergence, the recursion solves (k + β)p = ω²(I + α)p.
    #[test]
    fn converged_recursion_is_the_exact_eigensolution_with_mass(change in separate_change()) {
        let converged = general::recursive_1_converged(&change, 1e-13, 60)?;
        let exact = eigensolution(&change)?;
        let (root, shape) = errors(&converged.perturbed, &exact);
        prop_assert!(root < EIGEN_ROUND_OFF && shape < EIGEN_ROUND_OFF, "{root:e} {shape:e}");
        prop_assert!(converged.last_change < 1e-13);
    }

    /// More stiffness and as much more mass everywhere: the modes stay as they are, by every rule.
    #[test]
    fn scaling_stiffness_and_mass_alike_changes_nothing(change in separate_change(), scale in -0.5..1.0_f64) {
        let size = change.roots.len();
        let k = change.generalized_stiffness.clone();
        let alike = ModalChange::of_vibrations(
            &k,
            scale * DMatrix::from_diagonal(&k),
            scale * DMatrix::identity(size, size),
        );
        for rule in rules() {
            let same = (rule.general)(&alike)?;
            let root = same.roots.component_mul(&k).add_scalar(-1.0).amax();
            prop_assert!(root < MATRIX_ROUND_OFF, "{} {root:e}", rule.name);
            prop_assert!((same.shapes - DMatrix::identity(size, size)).amax() < MATRIX_ROUND_OFF);
        }
    }

    /// After normalization the shapes are orthonormal in the changed mass.
    #[test]
    fn normalized_shapes_are_orthonormal_in_the_changed_mass(change in separate_change()) {
        let mut shapes = general::recursive_1_converged(&change, 1e-13, 60)?.perturbed.shapes;
        normalize_with_mass(&mut shapes, &change.alpha)?;
        let size = change.roots.len();
        let mass = DMatrix::identity(size, size) + &change.alpha;
        let product = shapes.tr_mul(&(mass * &shapes));
        prop_assert!((product - DMatrix::identity(size, size)).amax() < EIGEN_ROUND_OFF);
        prop_assert!((0..size).all(|j| shapes[(j, j)] > 0.0));
    }
}

/// Point masses on a chain of springs: from matrices through the modes to the exact modes of the changed chain.
#[test]
fn mass_added_to_a_chain_lowers_its_frequencies_as_the_eigensolution_says() {
    let stiffness = three_mass_chain([1.0, 1.0, 1.0], [1.0, 1.0, 3.0]);
    let mass = DMatrix::from_diagonal(&dvector![1.0, 1.5, 0.8]);
    let modes = corfem::method::modes::solve(&stiffness, &mass, 3).unwrap();
    let base = LeftRightModes::from(&modes);
    assert_eq!(base.left, base.right);
    assert_eq!(&base.right, modes.shapes());
    let share_change = three_mass_chain([0.05, 0.0, 0.0], [0.0, 0.1, -0.2]);
    let mass_change = DMatrix::from_diagonal(&dvector![0.0, 0.15, -0.03]);
    let change = ModalChange::new(&stiffness, &base, &share_change, &mass_change).unwrap();
    assert!((&change.generalized_stiffness - modes.omega_squared()).amax() < MATRIX_ROUND_OFF);
    let converged = general::recursive_1_converged(&change, 1e-13, 60)
        .unwrap()
        .perturbed;
    let exact =
        corfem::method::modes::solve(&(&stiffness + &share_change), &(&mass + &mass_change), 3)
            .unwrap();
    let found = ascending(converged.roots.map(f64::recip).iter());
    for (found, exact) in found.iter().zip(exact.omega_squared().iter()) {
        assert!(
            (found / exact - 1.0).abs() < EIGEN_ROUND_OFF,
            "{found} {exact}"
        );
    }
    let mut shapes = converged.shapes;
    normalize_with_mass(&mut shapes, &change.alpha).unwrap();
    let mut structural = modes.shapes() * shapes;
    corfem::method::modes::apply_sign_rule(&mut structural);
    assert!((structural - exact.shapes()).amax() < EIGEN_ROUND_OFF);
}

/// A mass added alone: first order is Rayleigh's quotient on the old shapes, (1 + α_ii)/ω_i².
#[test]
fn first_order_is_rayleighs_quotient_on_the_old_shapes() {
    let change = four_modes(0.05);
    let roots = general::first_order(&change).unwrap().roots;
    for i in 0..4 {
        let quotient =
            (1.0 + change.alpha[(i, i)]) / (change.generalized_stiffness[i] + change.beta[(i, i)]);
        assert!((roots[i] / quotient - 1.0).abs() < ROUND_OFF);
    }
}

/// Scaling the left shapes scales k, α and β of a row alike and must not matter.
#[test]
fn scale_of_the_left_shapes_does_not_matter() {
    let change = four_modes(0.05);
    let scale = DMatrix::from_diagonal(&dvector![2.0, -3.0, 0.5, 7.0]);
    let scaled = ModalChange {
        generalized_stiffness: &scale * &change.generalized_stiffness,
        roots: change.roots.clone(),
        beta: &scale * &change.beta,
        alpha: &scale * &change.alpha,
    };
    for (one, other) in [
        (general::first_order(&change), general::first_order(&scaled)),
        (
            general::recursive_1(&change, 4),
            general::recursive_1(&scaled, 4),
        ),
        (
            general::recursive_2(&change, 3),
            general::recursive_2(&scaled, 3),
        ),
        (general::original(&change), general::original(&scaled)),
    ] {
        let (root, shape) = errors(&one.unwrap(), &other.unwrap());
        assert!(
            root < ROUND_OFF && shape < MATRIX_ROUND_OFF,
            "{root:e} {shape:e}"
        );
    }
}

/// The eigensolution keeps each mode in its place with unit own component, with mass as without.
#[test]
fn eigensolution_with_mass_continues_every_mode() {
    let change = four_modes(0.1);
    let exact = eigensolution(&change).unwrap();
    assert_eq!(exact.shapes.shape(), (4, 4));
    assert!((0..4).all(|j| exact.shapes[(j, j)] == 1.0));
    let stiffness = DMatrix::from_diagonal(&change.generalized_stiffness) + &change.beta;
    let mass = DMatrix::identity(4, 4) + &change.alpha;
    let residual =
        stiffness * &exact.shapes * DMatrix::from_diagonal(&exact.roots) - mass * &exact.shapes;
    assert!(residual.amax() < EIGEN_ROUND_OFF);
    let without_mass = ModalChange {
        alpha: DMatrix::zeros(4, 4),
        ..change
    };
    let without_mass = eigensolution(&without_mass).unwrap();
    assert!((without_mass.roots - exact.roots).amax() > 1e-3);
}

/// One mode has no others: every rule gives Rayleigh's quotient, (1 + 0.2)/(2 + 0.5), and the shape itself.
#[test]
fn one_mode_alone_is_exact_with_mass_too() {
    let change = ModalChange::of_vibrations(&dvector![2.0], dmatrix![0.5], dmatrix![0.2]);
    for rule in rules() {
        let found = (rule.general)(&change).unwrap();
        assert!((found.roots[0] - 0.48).abs() < ROUND_OFF, "{}", rule.name);
        assert_eq!(found.shapes, dmatrix![1.0], "{}", rule.name);
    }
}
