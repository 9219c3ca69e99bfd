//! What tests ask of a matrix: how far from another, symmetric, of which rank.

use crate::prelude::*;

/// Largest difference of two matrices of one shape, relative to the largest entry of the second.
pub fn relative_distance(found: &DMatrix<f64>, expected: &DMatrix<f64>) -> f64 {
    assert_eq!(
        found.shape(),
        expected.shape(),
        "shapes of the two matrices"
    );
    let largest = expected.amax();
    assert!(largest > 0.0, "nothing to compare with");
    (found - expected).amax() / largest
}

/// Eigenvalues of a symmetric matrix, descending, by nalgebra; fails if it is not symmetric to the last digit
/// but two.
pub fn spectrum(matrix: &DMatrix<f64>) -> Vec<f64> {
    let asymmetry = (matrix - matrix.transpose()).amax() / matrix.amax();
    assert!(
        asymmetry < super::tolerances::ROUND_OFF,
        "asymmetry {asymmetry:e}"
    );
    let mut values = matrix.symmetric_eigenvalues().iter().copied().collect_vec();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// Rank of a symmetric semidefinite matrix; fails if it is not semidefinite.
pub fn rank_of_semidefinite(matrix: &DMatrix<f64>) -> usize {
    let values = spectrum(matrix);
    let threshold = RANK_THRESHOLD * values[0];
    assert!(
        *values.last().unwrap() > -threshold,
        "a negative eigenvalue: {values:?}"
    );
    values.iter().filter(|&&value| value > threshold).count()
}
