//! Points in another order, found by what each does in all modes.

use crate::method::sorting::pair_modes;
use nalgebra::DMatrix;

/// Most rounds of guessing the order from the pairs and the pairs from the order; it settles after two or three.
pub(super) const ROUNDS: usize = 10;

/// Nonzero shapes scaled to unit largest component.
pub(super) fn unit(mut shapes: DMatrix<f64>) -> DMatrix<f64> {
    for mut shape in shapes.column_iter_mut() {
        let largest = shape.amax();
        shape /= largest;
    }
    shapes
}

/// For every row the nearest row of the other matrix, each taken once, the closest first.
pub(super) fn matched(rows: &DMatrix<f64>, others: &DMatrix<f64>) -> Option<Vec<usize>> {
    let nearness =
        |other: usize, row: usize| 1.0 / (1.0 + (rows.row(row) - others.row(other)).norm_squared());
    let nearness = DMatrix::from_fn(others.nrows(), rows.nrows(), nearness);
    Some(pair_modes(&nearness).ok()?.analysis_mode)
}
