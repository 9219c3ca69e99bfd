//! Single changes of the test's shapes.

use nalgebra::DMatrix;

/// One change of the test shapes; places count from zero.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// The sign of one sensor.
    Reversed(usize),
    /// Two sensors exchanged.
    Exchanged([usize; 2]),
    /// A sensor whose readings are so many times too large.
    Gain(usize, f64),
    /// A sensor that reads nothing but noise.
    Dead(usize),
}

/// The test shapes after a change.
pub(super) fn changed(shapes: &DMatrix<f64>, change: &Change) -> DMatrix<f64> {
    let mut changed = shapes.clone();
    match change {
        Change::Reversed(sensor) => changed.row_mut(*sensor).neg_mut(),
        Change::Exchanged([a, b]) => changed.swap_rows(*a, *b),
        Change::Gain(sensor, gain) => changed.row_mut(*sensor).unscale_mut(*gain),
        Change::Dead(_) => {}
    }
    changed
}
