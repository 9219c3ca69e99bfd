//! Test modes and measures for Appendix B.

use crate::prelude::*;

/// Test modes from squared circular frequencies and shapes by columns.
pub fn modes(omega_squared: &[f64], shapes: DMatrix<f64>) -> Modes {
    Modes::new(DVector::from_column_slice(omega_squared), shapes).unwrap()
}

/// The mass norm of a shape.
pub fn mass_norm(shape: &DVector<f64>, mass: &DMatrix<f64>) -> f64 {
    shape.dot(&(mass * shape)).sqrt()
}

/// Largest difference of two shape sets, relative to the largest component of the first.
pub fn relative_difference(a: &DMatrix<f64>, b: &DMatrix<f64>) -> f64 {
    assert_eq!(a.shape(), b.shape());
    assert!(!a.is_empty());
    (a - b).amax() / a.amax()
}

/// Unit masses and shapes given by their components; overlaps are then plain products.
pub fn unit_shapes(columns: &[[f64; 4]]) -> DMatrix<f64> {
    DMatrix::from_columns(
        &columns
            .iter()
            .map(|column| DVector::from_column_slice(column).normalize())
            .collect_vec(),
    )
}

/// Two modes of overlap 0.05 at 10 and 20 rad/s, and their movement.
pub fn slight_overlap() -> (Modes, DMatrix<f64>, Vec<Movement>) {
    let raw = modes(
        &[100.0, 400.0],
        unit_shapes(&[[1.0, 0.0, 0.0, 0.0], [0.05, 1.0, 0.0, 0.0]]),
    );
    let mass = eye(4);
    let movement = orthogonalize(&raw, &mass).unwrap().movement;
    (raw, mass, movement)
}
