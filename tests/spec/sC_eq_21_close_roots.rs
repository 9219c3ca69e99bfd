//! Close and repeated roots: three-mass chains with known spectra, and how blocks form.

use crate::common::appendix_c::Rule;
use crate::common::close_roots::separate_chain;
use crate::prelude::*;

#[test]
fn chains_have_the_spectra_they_are_said_to_have() {
    for ((_, _, modes), expected) in [
        (repeated_chain(), [1.0, 4.0, 4.0]),
        (separate_chain(), [1.0, 4.0, 8.0]),
    ] {
        for (found, expected) in modes.omega_squared().iter().zip(expected) {
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
            let omega_squared = found.settled.perturbed.roots.map(f64::recip);
            for i in 0..3 {
                let error = omega_squared[i] / exact.omega_squared()[i] - 1.0;
                assert!(
                    error.abs() < EIGEN_ROUND_OFF,
                    "spring {spring} by {size}: mode {i} {error:e}"
                );
            }
            assert!(residual(&found, &change) < EIGEN_ROUND_OFF);
        }
    }
}

/// The plain formulae refuse what the blocks solve: a change that couples the two modes and leaves their roots together.
#[test]
fn plain_formulae_refuse_a_coupled_repeated_root_and_name_it() {
    let (_, _, modes) = repeated_chain();
    let mut change = spring_change(&modes, [0.0; 3], [0.0; 3]);
    change.beta[(1, 2)] = 0.1;
    change.beta[(2, 1)] = 0.1;
    for rule in FORMULAE {
        for result in [
            (rule.plain)(&change.generalized_stiffness, &change.beta),
            (rule.general)(&change),
        ] {
            assert!(
                matches!(
                    result,
                    Err(Error::CoalescingModes { first: 2, second: 1, separation }) if separation < 1e-9
                ),
                "{}",
                rule.name
            );
        }
    }
    let found = solved(&change).settled.perturbed;
    assert!(root_error(&found.roots, &change) < EIGEN_ROUND_OFF);
    change.beta.fill(0.0);
    let found = solved(&change).settled.perturbed;
    assert!((found.roots - modes.omega_squared().map(f64::recip)).amax() < ROUND_OFF);
}

/// Modes that a change does not couple turn nowhere, however close their roots: first order and Recursive 1 follow them
/// where another mode is coupled to both.
#[test]
fn uncoupled_modes_may_have_equal_roots() {
    let k = dvector![1.0, 4.0, 4.0, 14.0];
    // Modes 1 and 2 rise to 5 together, neither with the other nor with anything else.
    let beta = dmatrix![
        0.1, 0.0, 0.0, 0.05;
        0.0, 1.0, 0.0, 0.0;
        0.0, 0.0, 1.0, 0.0;
        0.05, 0.0, 0.0, 0.2];
    let change = ModalChange::of_vibrations(&k, beta.clone(), DMatrix::zeros(4, 4));
    // Recursive 2 solves a linear system for all other modes from its second order on, which an equal root makes singular.
    let others = |rule: &Rule| rule.name != "Recursive 2, order 3";
    for rule in FORMULAE.into_iter().filter(others) {
        for found in [(rule.plain)(&k, &beta), (rule.general)(&change)] {
            let found = found.unwrap_or_else(|error| panic!("{}: {error}", rule.name));
            for mode in [1, 2] {
                assert!((found.roots[mode] - 0.2).abs() < ROUND_OFF, "{}", rule.name);
                let mut own = found.shapes.column(mode).into_owned();
                own[mode] -= 1.0;
                assert_eq!(own.amax(), 0.0, "{}", rule.name);
            }
            assert!(found.shapes[(0, 3)] > 0.0 && found.shapes[(3, 0)] < 0.0);
        }
    }
    let settled = recursive_1_converged(&k, &beta).unwrap();
    assert!(root_error(&settled.perturbed.roots, &change) < EIGEN_ROUND_OFF);
    // A change of mass that moves the two alike does not part them either.
    let alpha = DMatrix::from_diagonal(&dvector![0.0, 0.1, 0.1, 0.0]);
    let with_mass = ModalChange::of_vibrations(&k, beta, alpha);
    let pencil = with_mass.pencil().unwrap();
    let settled = pencil.recursive_1_converged().unwrap();
    assert!(root_error(&settled.perturbed.roots, &with_mass) < EIGEN_ROUND_OFF);
}

/// λ = 1, 4, 8 are apart: no blocks, and Recursive 1 itself.
#[test]
fn chain_with_separate_roots_forms_no_block() {
    let (_, _, modes) = separate_chain();
    let change = spring_change(&modes, [0.1, -0.05, 0.0], [0.0, 0.1, 0.2]);
    let found = solved(&change);
    assert!(found.blocks.is_empty());
    let (k, beta) = (&change.generalized_stiffness, &change.beta);
    let plain = recursive_1_converged(k, beta).unwrap().perturbed;
    assert!((found.settled.perturbed.roots - plain.roots).amax() < ROUND_OFF);
}

/// Softening spring 1-3 from 3 to 1 turns λ = 1, 4, 8 into 1, 4, 4: roots that were apart are brought together. A ground
/// spring of 0.3 more under mass 1 raises modes 1 and 2 by 0.05 and 0.15 and couples them, so that Recursive 1 refuses them
/// where spring 1-3 makes up for the difference.
#[test]
fn roots_that_a_change_brings_together_form_a_block() {
    let (_, _, modes) = separate_chain();
    let coupled = spring_change(&modes, [0.3, 0.0, 0.0], [0.0, 0.0, -2.05]);
    assert!(matches!(
        recursive_1_converged(&coupled.generalized_stiffness, &coupled.beta),
        Err(Error::CoalescingModes {
            first: 2,
            second: 1,
            ..
        })
    ));
    let found = solved(&coupled);
    assert_eq!(found.blocks, [vec![1, 2]]);
    assert!(root_error(&found.settled.perturbed.roots, &coupled) < EIGEN_ROUND_OFF);
    assert!(residual(&found, &coupled) < EIGEN_ROUND_OFF);
    let change = spring_change(&modes, [0.0; 3], [0.0, 0.0, -2.0]);
    let found = solved(&change);
    assert_eq!(found.blocks, [vec![1, 2]]);
    for (root, expected) in found.settled.perturbed.roots.iter().zip([1.0, 0.25, 0.25]) {
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
    assert!(root_error(&found.settled.perturbed.roots, &change) < EIGEN_ROUND_OFF);
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
    assert!(root_error(&found.settled.perturbed.roots, &change) < EIGEN_ROUND_OFF);
    assert!(residual(&found, &change) < EIGEN_ROUND_OFF);
    // The mode outside blocks stays in its place.
    assert!((1.0 / found.settled.perturbed.roots[2] - 3.0).abs() < 0.01);
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
    }
}

/// Every shape has its first largest component positive.
#[test]
fn shapes_are_signed_by_their_largest_component() {
    let (_, _, modes) = repeated_chain();
    for size in [-0.3, 0.1, 0.4] {
        let shapes = solved(&spring_change(&modes, [size, 0.0, 0.0], [0.0, 0.0, 0.2]))
            .settled
            .perturbed
            .shapes;
        assert_eq!(shapes.shape(), (3, 3));
        for shape in shapes.column_iter() {
            assert!(shape.max() >= shape.amax() * (1.0 - EQUALLY_LARGE));
        }
    }
}
