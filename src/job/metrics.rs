//! Measures of the agreement of analysis and test modes, beside modal assurance and cross-orthogonality.

use nalgebra::{DMatrix, DVector};

/// Coordinate modal assurance (COMAC) of every DOF over paired modes of analysis and test (d × g each), d numbers from 0 to 1:
///
/// $$ c_p = \frac{(\sum_l |v_{pl} w_{pl}|)^2}{\sum_l v_{pl}^2 \sum_l w_{pl}^2} $$
///
/// for shapes of unit length. A DOF that does not move on either side has 1, one that moves on one side only has 0. Source: Lieven and
/// Ewins, *Proc. 6th International Modal Analysis Conference* (1988), 690.
pub fn coordinate_assurance(analysis: &DMatrix<f64>, test: &DMatrix<f64>) -> DVector<f64> {
    let unit = |shapes: &DMatrix<f64>| {
        let mut shapes = shapes.clone();
        shapes.column_iter_mut().for_each(|mut shape| {
            shape.normalize_mut();
        });
        shapes
    };
    let (v, w) = (unit(analysis), unit(test));
    let assurance = |p: usize| match (v.row(p).norm(), w.row(p).norm()) {
        (0.0, 0.0) => 1.0,
        (0.0, _) | (_, 0.0) => 0.0,
        (one, other) => (v.row(p).abs().dot(&w.row(p).abs()) / (one * other))
            .powi(2)
            .min(1.0),
    };
    DVector::from_fn(v.nrows(), |p, _| assurance(p))
}
