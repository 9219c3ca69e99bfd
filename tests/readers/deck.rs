//! Decks: the identity of writing and reading, and the theorem that NASTRAN's reduction of a deck is Appendix A.

use crate::common::decks::bulk_text as written;
use crate::prelude::*;

properties! {
    #[test]
    fn deck_to_model_to_deck_is_the_identity(model in bulk_data()) {
        let text = written(&model)?;
        let read = deck::read("deck", text.as_bytes(), &[])?;
        prop_assert_eq!(&read.model, &model);
        prop_assert!(read.unread.iter().all(|card| card.reason == deck::Reason::Untouched));
        prop_assert_eq!(written(&read.model)?, text);
    }

    /// $(K_S, T M T^t)$ has d finite roots, those of $(K_D, M)$, for any stiffness, full-rank T and masses.
    #[test]
    fn finite_roots_of_the_singular_pencil_are_those_of_the_dynamic_one(
        (stiffness, _) in positive_definite(6, 3.0),
        directions in orthogonal(6),
        scales in prop::collection::vec(0.1..10.0_f64, 4),
        masses in prop::collection::vec(0.1..10.0_f64, 4),
    ) {
        let t = directions.columns(0, 4) * DMatrix::from_diagonal(&scales.into());
        let mass = DMatrix::from_diagonal(&masses.into());
        let flexibility = t.tr_mul(&stiffness.clone().try_inverse().unwrap()) .clone() * &t;
        let dynamic_stiffness = flexibility.try_inverse().unwrap();
        let dynamic = solve(&symmetric(&dynamic_stiffness), &mass, 4)?;
        let roots = singular_pencil_roots(&stiffness, &(&t * &mass * t.transpose()));
        prop_assert_eq!(roots.len(), 6);
        for (omega_squared, root) in dynamic.omega_squared().iter().zip(&roots) {
            // The condition of the flexibility is that of the stiffness times that of T squared: 1e3 times 1e4.
            prop_assert!((omega_squared * root - 1.0).abs() < SINGULAR_MASS_ROOT, "{} {}", omega_squared, root);
        }
        for root in &roots[4..] {
            prop_assert!(root.abs() < SINGULAR_MASS_ROOT * roots[3], "{:?}", roots);
        }
    }
}

fn symmetric(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    0.5 * (matrix + matrix.transpose())
}

/// All roots $\lambda = 1/\omega^2$ of $\lambda K v = M v$, largest first, by nalgebra: zero where $\omega$ is infinite.
fn singular_pencil_roots(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> Vec<f64> {
    let lower = stiffness.clone().cholesky().unwrap().l();
    let half = lower.solve_lower_triangular(mass).unwrap();
    let reduced = lower.solve_lower_triangular(&half.transpose()).unwrap();
    let mut roots = SymmetricEigen::new(symmetric(&reduced))
        .eigenvalues
        .iter()
        .copied()
        .collect_vec();
    roots.sort_by(|a, b| b.total_cmp(a));
    roots
}

/// The deck of a case at its first gages times `factors`.
fn box_deck(number: usize, factors: &[f64]) -> (BulkData, String) {
    let case = case_of(number);
    let points = dynamic_points(&case.reconstruction).unwrap();
    let bulk = BulkData::from_model(&case.model().unwrap(), factors, &points).unwrap();
    let text = deck::write(&bulk, "box", 9, [5.0, 3000.0]).unwrap();
    (bulk, text)
}

#[test]
fn mpc_cards_are_the_load_distribution() {
    let (_, text) = box_deck(2, &[1.0; 15]);
    let read = deck::read("box", text.as_bytes(), &[]).unwrap().model;
    let structure = read.structure().unwrap();
    let model = case_of(2).model().unwrap();
    assert_eq!(structure.free_dof(), model.structure().free_dof());
    let dynamic = read.mass_dof(&structure).unwrap();
    let loads = dynamic.load_distribution.dense();
    assert_eq!(loads.shape(), (36, 9));
    for (read, meant) in loads.iter().zip(model.load_distribution().clone().iter()) {
        assert_eq!(*read, nearest_in_field(*meant));
    }
    assert_eq!(DMatrix::from_diagonal(&dynamic.mass), *model.mass());
    assert_eq!(read.ties.len(), 9);
    assert!(read.ties.iter().all(|tie| tie.coefficient == -1.0));
}
