//! Close and repeated roots: three-mass chains with known spectra, which formulae follow them, and which refuse.

use crate::common::appendix_c::{FORMULAE, Rule, ascending, three_mass_chain};
use crate::common::tolerances::{EIGEN_ROUND_OFF, ROUND_OFF};
use corfem::method::appendix_c::general::{self, ModalChange};
use corfem::method::appendix_c::{eigensolution, recursive_1_converged};
use corfem::method::error::Error;
use corfem::method::modes::{Modes, solve};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

/// λ = 1, 4, 4: masses 1, 4, 1; springs to ground 0, 8, 0; 1-2: 2, 2-3: 2, 1-3: 1.
fn repeated_chain() -> (DMatrix<f64>, DMatrix<f64>, Modes) {
    let stiffness = three_mass_chain([0.0, 8.0, 0.0], [2.0, 2.0, 1.0]);
    let mass = DMatrix::from_diagonal(&dvector![1.0, 4.0, 1.0]);
    let modes = solve(&stiffness, &mass, 3).unwrap();
    (stiffness, mass, modes)
}

/// λ = 1, 4, 8: unit masses; springs to ground 1, 1, 1; 1-2: 1, 2-3: 1, 1-3: 3.
fn separate_chain() -> (DMatrix<f64>, DMatrix<f64>, Modes) {
    let stiffness = three_mass_chain([1.0, 1.0, 1.0], [1.0, 1.0, 3.0]);
    let mass = DMatrix::identity(3, 3);
    let modes = solve(&stiffness, &mass, 3).unwrap();
    (stiffness, mass, modes)
}

/// A change of springs seen through a chain's modes.
fn spring_change(modes: &Modes, ground: [f64; 3], between: [f64; 3]) -> ModalChange<f64> {
    let beta = modes.shapes.tr_mul(&(three_mass_chain(ground, between) * &modes.shapes));
    ModalChange::of_vibrations(&modes.omega_squared, beta, DMatrix::zeros(3, 3))
}

/// Largest relative distance of sorted ω² from those of the changed matrices in the modal coordinates.
fn root_error(roots: &DVector<f64>, change: &ModalChange<f64>) -> f64 {
    let k = &change.generalized_stiffness;
    let stiffness = DMatrix::from_diagonal(k) + &change.beta;
    let mass = DMatrix::from_diagonal(&k.component_mul(&change.roots)) + &change.alpha;
    let exact = &solve(&stiffness, &mass, roots.len()).expect("vibrations").omega_squared;
    let found = ascending(roots.map(f64::recip).iter());
    found.iter().zip(exact.iter()).map(|(found, exact)| (found / exact - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn chains_have_the_spectra_they_are_said_to_have() {
    for ((_, _, modes), expected) in [(repeated_chain(), [1.0, 4.0, 4.0]), (separate_chain(), [1.0, 4.0, 8.0])] {
        for (found, expected) in modes.omega_squared.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < ROUND_OFF, "{found} {expected}");
        }
    }
}

/// Each spring of the chain with λ = 1, 4, 4 changed alone, by little and by much: the eigensolution in the modal coordinates
/// has the roots of the changed chain.
#[test]
fn repeated_roots_of_a_chain_are_followed_exactly() {
    let (stiffness, mass, modes) = repeated_chain();
    for spring in 0..6 {
        for size in [-0.2, -1e-3, -1e-9, 0.0, 1e-12, 1e-6, 0.05, 0.3] {
            let mut springs = [0.0; 6];
            springs[spring] = size;
            let [a, b, c, d, e, f] = springs;
            let found = eigensolution(&spring_change(&modes, [a, b, c], [d, e, f])).unwrap();
            let exact = solve(&(&stiffness + three_mass_chain([a, b, c], [d, e, f])), &mass, 3).unwrap();
            let omega_squared = ascending(found.roots.map(f64::recip).iter());
            for (found, exact) in omega_squared.iter().zip(exact.omega_squared.iter()) {
                assert!((found / exact - 1.0).abs() < EIGEN_ROUND_OFF, "spring {spring} by {size}: {found} {exact}");
            }
        }
    }
}

/// The formulae refuse what the eigensolution solves: a change that couples the two modes and leaves their roots together.
#[test]
fn formulae_refuse_a_coupled_repeated_root_and_name_it() {
    let (_, _, modes) = repeated_chain();
    let mut change = spring_change(&modes, [0.0; 3], [0.0; 3]);
    change.beta[(1, 2)] = 0.1;
    change.beta[(2, 1)] = 0.1;
    for rule in FORMULAE {
        for result in [(rule.plain)(&change.generalized_stiffness, &change.beta), (rule.general)(&change)] {
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
    let found = eigensolution(&change).unwrap();
    assert!(root_error(&found.roots, &change) < EIGEN_ROUND_OFF);
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
    let settled = recursive_1_converged(&k, &beta, 1e-13, 60).unwrap();
    assert!(root_error(&settled.perturbed.roots, &change) < EIGEN_ROUND_OFF);
    // A change of mass that moves the two alike does not part them either.
    let alpha = DMatrix::from_diagonal(&dvector![0.0, 0.1, 0.1, 0.0]);
    let with_mass = ModalChange::of_vibrations(&k, beta, alpha);
    let settled = general::recursive_1_converged(&with_mass, 1e-13, 60).unwrap();
    assert!(root_error(&settled.perturbed.roots, &with_mass) < EIGEN_ROUND_OFF);
}

/// Softening spring 1-3 from 3 to 1 turns λ = 1, 4, 8 into 1, 4, 4: roots that were apart are brought together. A ground
/// spring of 0.3 more under mass 1 raises modes 1 and 2 by 0.05 and 0.15 and couples them, so that Recursive 1 refuses them
/// where spring 1-3 makes up for the difference.
#[test]
fn roots_that_a_change_brings_together_are_known() {
    let (_, _, modes) = separate_chain();
    let coupled = spring_change(&modes, [0.3, 0.0, 0.0], [0.0, 0.0, -2.05]);
    assert!(matches!(
        recursive_1_converged(&coupled.generalized_stiffness, &coupled.beta, 1e-13, 60),
        Err(Error::CoalescingModes { first: 2, second: 1, .. })
    ));
    assert!(root_error(&eigensolution(&coupled).unwrap().roots, &coupled) < EIGEN_ROUND_OFF);
    let found = eigensolution(&spring_change(&modes, [0.0; 3], [0.0, 0.0, -2.0])).unwrap();
    for (root, expected) in found.roots.iter().zip([1.0, 0.25, 0.25]) {
        assert!((root - expected).abs() < ROUND_OFF);
    }
}
