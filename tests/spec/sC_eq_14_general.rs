//! Appendix C in full on real numbers: equal to the plain path where that applies, and mass changes beside stiffness.

use crate::common::appendix_c::errors;
use crate::prelude::*;

properties! {
    /// The general formulae with α = 0, k = 1/λ are the plain ones, order by order.
    #[test]
    fn general_path_is_the_plain_path_for_stiffness_alone(mut change in separate_change(), order in 1..=6_usize) {
        change.alpha.fill(0.0);
        let (k, beta, pencil) = (&change.generalized_stiffness, &change.beta, change.pencil()?);
        for (general, plain) in [
            (pencil.first_order()?, first_order(k, beta)?),
            (pencil.recursive_1(order)?, recursive_1(k, beta, order)?),
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
        let general = change.pencil()?.recursive_1_converged()?;
        let plain = recursive_1_converged(k, beta)?;
        let (root, shape) = errors(&general.perturbed, &plain.perturbed);
        prop_assert!(root < EIGEN_ROUND_OFF && shape < EIGEN_ROUND_OFF, "{root:e} {shape:e}");
        prop_assert!(general.order >= plain.order);
    }

    /// Mass enters through α: carried to convergence, the recursion solves (k + β)p = ω²(I + α)p.
    #[test]
    fn converged_recursion_is_the_exact_eigensolution_with_mass(change in separate_change()) {
        let converged = change.pencil()?.recursive_1_converged()?;
        let exact = eigensolution(&change)?;
        let (root, shape) = errors(&converged.perturbed, &exact);
        prop_assert!(root < EIGEN_ROUND_OFF && shape < EIGEN_ROUND_OFF, "{root:e} {shape:e}");
        prop_assert!(converged.last_change < ROOT_TOLERANCE);
    }

    /// More stiffness and as much more mass everywhere: the modes stay as they are, by every rule.
    #[test]
    fn scaling_stiffness_and_mass_alike_changes_nothing(change in separate_change(), scale in -0.5..1.0_f64) {
        let k = change.generalized_stiffness;
        let size = k.len();
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
        let mut shapes = change.pencil()?.recursive_1_converged()?.perturbed.shapes;
        normalize_with_mass(&mut shapes, &change.alpha)?;
        let size = shapes.nrows();
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
    let modes = solve(&stiffness, &mass, 3).unwrap();
    let base = on_either_side(&modes);
    assert_eq!(base.left, base.right);
    assert_eq!(&base.right, modes.shapes());
    let share_change = three_mass_chain([0.05, 0.0, 0.0], [0.0, 0.1, -0.2]);
    let mass_change = DMatrix::from_diagonal(&dvector![0.0, 0.15, -0.03]);
    let pencil = Pencil::new(&stiffness, &base, &share_change, &mass_change).unwrap();
    let through_modes = |change: &DMatrix<f64>| modes.shapes().tr_mul(&(change * modes.shapes()));
    let (beta, alpha) = (through_modes(&share_change), through_modes(&mass_change));
    let k = DMatrix::from_diagonal(modes.omega_squared());
    assert!((pencil.a() - beta - k).amax() < MATRIX_ROUND_OFF);
    assert!((pencil.g() - &alpha - DMatrix::identity(3, 3)).amax() < MATRIX_ROUND_OFF);
    let converged = pencil.recursive_1_converged().unwrap().perturbed;
    let exact = solve(&(&stiffness + &share_change), &(&mass + &mass_change), 3).unwrap();
    let found = ascending(converged.roots.map(f64::recip).iter());
    for (found, exact) in found.iter().zip(exact.omega_squared().iter()) {
        assert!(
            (found / exact - 1.0).abs() < EIGEN_ROUND_OFF,
            "{found} {exact}"
        );
    }
    let mut shapes = converged.shapes;
    normalize_with_mass(&mut shapes, &alpha).unwrap();
    let mut structural = modes.shapes() * shapes;
    apply_sign_rule(&mut structural);
    assert!((structural - exact.shapes()).amax() < EIGEN_ROUND_OFF);
}

/// A mass added alone: first order is Rayleigh's quotient on the old shapes, (1 + α_ii)/ω_i².
#[test]
fn first_order_is_rayleighs_quotient_on_the_old_shapes() {
    let change = four_modes(0.05);
    let roots = change.pencil().unwrap().first_order().unwrap().roots;
    for i in 0..4 {
        let quotient =
            (1.0 + change.alpha[(i, i)]) / (change.generalized_stiffness[i] + change.beta[(i, i)]);
        assert!((roots[i] / quotient - 1.0).abs() < ROUND_OFF);
    }
}

/// Scaling the left shapes scales k, α and β of a row alike and must not matter.
#[test]
fn scale_of_the_left_shapes_does_not_matter() {
    let ModalChange {
        generalized_stiffness: k,
        beta,
        alpha,
    } = four_modes(0.05);
    let scale = DMatrix::from_diagonal(&dvector![2.0, -3.0, 0.5, 7.0]);
    let seen_from = |left: DMatrix<f64>| {
        let modes = LeftRightModes {
            roots: k.map(f64::recip),
            right: DMatrix::identity(4, 4),
            left,
        };
        Pencil::new(&DMatrix::from_diagonal(&k), &modes, &beta, &alpha).unwrap()
    };
    let (one, other) = (seen_from(DMatrix::identity(4, 4)), seen_from(scale.clone()));
    assert!((other.a() - scale * one.a()).amax() < MATRIX_ROUND_OFF);
    for (one, other) in [
        (one.first_order(), other.first_order()),
        (one.recursive_1(4), other.recursive_1(4)),
        (one.recursive_2(3), other.recursive_2(3)),
        (one.original(), other.original()),
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
