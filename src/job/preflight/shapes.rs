//! Single changes of the test's shapes.

use nalgebra::DMatrix;

/// One change of the test shapes; places count from zero.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// The sign of one sensor.
    Reversed(usize),
    /// Two sensors exchanged.
    Exchanged([usize; 2]),
    /// All points in another order: the places of the rows given, in the model's order.
    Reordered(Vec<usize>),
    /// A sensor whose readings are so many times too large.
    Gain(usize, f64),
    /// A sensor that reads nothing but noise.
    Dead(usize),
    /// A sensor that measures along another direction of its grid, 0 to 5.
    Direction(usize, usize),
}

/// The test shapes after a change.
pub(super) fn changed(shapes: &DMatrix<f64>, change: &Change) -> DMatrix<f64> {
    let mut changed = shapes.clone();
    match change {
        Change::Reversed(sensor) => changed.row_mut(*sensor).neg_mut(),
        Change::Exchanged([a, b]) => changed.swap_rows(*a, *b),
        Change::Reordered(order) => return shapes.select_rows(order),
        Change::Gain(sensor, gain) => changed.row_mut(*sensor).unscale_mut(*gain),
        Change::Dead(_) | Change::Direction(..) => {}
    }
    changed
}
