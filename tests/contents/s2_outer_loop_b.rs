//! A new analysis has a new B: the shares that the loops are handed are those of the structure as it is now.

use crate::prelude::*;
use corfem::chain::rods;

/// Five springs in a row from a wall, of which the second and the last joint are measured.
fn condensed_chain(springs: &[f64]) -> (FiniteElementModel, Modes) {
    let mut t = DMatrix::zeros(5, 2);
    (t[(1, 0)], t[(4, 1)]) = (1.0, 1.0);
    let parameters = (1..=5).map(|spring| Parameter::new(spring, &[spring]));
    let structure = rods(springs, [true, false]).unwrap();
    let mass = eye(2);
    let model = FiniteElementModel::new(structure, t, mass, parameters.collect());
    let test = Modes::new(dvector![100.0, 1000.0], dmatrix![0.5, 1.0; 1.0, -0.5]);
    (model.unwrap(), test.unwrap())
}

properties! {
    /// Every element is a parameter, so that their shares V^t B K_e B^t V sum to V^t K_D V = diag(ω²), by the present B alone.
    #[test]
    fn every_analysis_has_its_own_b(
        springs in prop::collection::vec(1000.0..2000.0_f64, 5),
        factors in prop::collection::vec(0.3..3.0_f64, 5),
    ) {
        let (model, test) = condensed_chain(&springs);
        let modal = model.analyze(&factors, &test, None)?;
        let sum: DMatrix<f64> = modal.shares().iter().sum();
        let expected = DMatrix::from_diagonal(modal.exact().modes.omega_squared());
        let error = (sum - &expected).amax();
        prop_assert!(error <= MATRIX_ROUND_OFF * expected.amax(), "{error:e}");
        // The chain between two measured joints is springs in series.
        let series = |part: Range<usize>| 1.0 / part.map(|e| 1.0 / (factors[e] * springs[e])).sum::<f64>();
        let (inner, outer) = (series(0..2), series(2..5));
        let stiffness = dmatrix![inner + outer, -outer; -outer, outer];
        let squares = stiffness.symmetric_eigenvalues();
        let found = modal.exact().modes.omega_squared();
        prop_assert!(relative_error(found.sum(), squares.sum()) <= MATRIX_ROUND_OFF);
        prop_assert!(relative_error(found[0], squares.min()) <= MATRIX_ROUND_OFF);
    }
}
