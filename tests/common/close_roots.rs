//! Chains with known spectra, and how far modes solved in blocks are from the exact ones.

use crate::prelude::*;

pub fn solved(change: &ModalChange) -> SolvedInBlocks {
    close_roots(change, CloseRootsSettings::default()).expect("a change the method can follow")
}

/// Stiffness and mass after the change in the modal coordinates.
pub fn changed(change: &ModalChange) -> (DMatrix<f64>, DMatrix<f64>) {
    let k = &change.generalized_stiffness;
    (
        DMatrix::from_diagonal(k) + &change.beta,
        DMatrix::identity(k.len(), k.len()) + &change.alpha,
    )
}

/// Largest relative distance of sorted ω² from those of the eigensolution of the changed matrices.
pub fn root_error(roots: &DVector<f64>, change: &ModalChange) -> f64 {
    let (stiffness, mass) = changed(change);
    let exact = solve(&stiffness, &mass, roots.len()).expect("vibrations");
    ascending(roots.map(f64::recip).iter())
        .iter()
        .zip(exact.omega_squared().iter())
        .map(|(found, exact)| (found / exact - 1.0).abs())
        .fold(0.0, f64::max)
}

/// (k + β)p γ − (I + α)p, largest entry: zero for exact modes, repeated or not.
pub fn residual(solved: &SolvedInBlocks, change: &ModalChange) -> f64 {
    let (stiffness, mass) = changed(change);
    let Perturbed { roots, shapes } = &solved.settled.perturbed;
    (stiffness * shapes * DMatrix::from_diagonal(roots) - mass * shapes).amax()
}

/// λ = 1, 4, 4: masses 1, 4, 1; springs to ground 0, 8, 0; 1-2: 2, 2-3: 2, 1-3: 1.
pub fn repeated_chain() -> (DMatrix<f64>, DMatrix<f64>, Modes) {
    let stiffness = three_mass_chain([0.0, 8.0, 0.0], [2.0, 2.0, 1.0]);
    let mass = DMatrix::from_diagonal(&dvector![1.0, 4.0, 1.0]);
    let modes = solve(&stiffness, &mass, 3).unwrap();
    (stiffness, mass, modes)
}

/// λ = 1, 4, 8: unit masses; springs to ground 1, 1, 1; 1-2: 1, 2-3: 1, 1-3: 3.
pub fn separate_chain() -> (DMatrix<f64>, DMatrix<f64>, Modes) {
    let stiffness = three_mass_chain([1.0, 1.0, 1.0], [1.0, 1.0, 3.0]);
    let mass = DMatrix::identity(3, 3);
    let modes = solve(&stiffness, &mass, 3).unwrap();
    (stiffness, mass, modes)
}

/// A change of springs seen through a chain's modes.
pub fn spring_change(modes: &Modes, ground: [f64; 3], between: [f64; 3]) -> ModalChange {
    let beta = modes
        .shapes()
        .tr_mul(&(three_mass_chain(ground, between) * modes.shapes()));
    ModalChange::of_vibrations(modes.omega_squared(), beta, DMatrix::zeros(3, 3))
}
