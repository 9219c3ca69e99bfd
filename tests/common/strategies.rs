//! Proptest strategies: every random number is drawn here, within bounds that are explained, and shrinks.

use crate::prelude::*;

/// A point within 100 inches of the origin along each axis: a structure's size.
pub fn point() -> impl Strategy<Value = Vector3<f64>> {
    (-100.0..100.0, -100.0..100.0, -100.0..100.0).prop_map(|(x, y, z)| Vector3::new(x, y, z))
}

/// A rotation by any angle about any axis; shrinks to the identity.
pub fn rotation() -> impl Strategy<Value = Rotation3<f64>> {
    (-3.2..3.2, -1.6..1.6, -3.2..3.2).prop_map(|(roll, pitch, yaw): (f64, f64, f64)| {
        Rotation3::from_euler_angles(roll, pitch, yaw)
    })
}

/// An orthogonal matrix from n(n−1)/2 Givens angles; shrinks to the identity.
pub fn orthogonal(size: usize) -> impl Strategy<Value = DMatrix<f64>> {
    prop::collection::vec(-3.2..3.2_f64, size * (size - 1) / 2).prop_map(move |angles| {
        let mut q = eye(size);
        let mut angle = angles.into_iter();
        for a in 0..size {
            for b in a + 1..size {
                let (sin, cos) = angle.next().unwrap_or(0.0).sin_cos();
                for row in 0..size {
                    let (x, y) = (q[(row, a)], q[(row, b)]);
                    q[(row, a)] = cos * x - sin * y;
                    q[(row, b)] = sin * x + cos * y;
                }
            }
        }
        q
    })
}

/// A symmetric positive definite matrix Q·diag(10^e)·Qᵗ with its exponents e: the spectrum is known, the condition
/// number at most 10^`decades`.
pub fn positive_definite(
    size: usize,
    decades: f64,
) -> impl Strategy<Value = (DMatrix<f64>, Vec<f64>)> {
    (orthogonal(size), prop::collection::vec(0.0..=decades, size)).prop_map(|(q, exponents)| {
        let diagonal = DMatrix::from_diagonal(&DVector::from_iterator(
            exponents.len(),
            exponents.iter().map(|e| 10f64.powf(*e)),
        ));
        let matrix = &q * diagonal * q.transpose();
        (0.5 * (&matrix + matrix.transpose()), exponents)
    })
}

/// A symmetric matrix with entries between −1 and 1.
pub fn symmetric(size: usize) -> impl Strategy<Value = DMatrix<f64>> {
    prop::collection::vec(-1.0..1.0_f64, size * (size + 1) / 2).prop_map(move |entries| {
        let mut matrix = zero_square(size);
        let mut entry = entries.into_iter();
        for column in 0..size {
            for row in 0..=column {
                let value = entry.next().unwrap_or(0.0);
                matrix[(row, column)] = value;
                matrix[(column, row)] = value;
            }
        }
        matrix
    })
}
