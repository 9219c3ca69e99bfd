//! A ground vibration test as files hold it: frequencies, sensors, and what each of them measured in every mode.

use nalgebra::{DMatrix, Vector3};

/// One sensor: it measures a displacement along an axis at a grid or point of the test.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// What it is called; `12 z` when the file has no name.
    pub name: String,
    /// The grid or node number of the test, if the file has one.
    pub grid: Option<usize>,
    /// 0, 1, 2 for displacements along x, y, z; 3, 4, 5 for rotations about them.
    pub direction: usize,
    /// Where it is, in the model's units of length, if the file says so.
    pub place: Option<Vector3<f64>>,
}

/// The measured modes of a ground vibration test.
#[derive(Debug, Clone, PartialEq)]
pub struct TestData {
    /// Natural frequencies, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Rows of the shapes.
    pub sensors: Vec<Sensor>,
    /// Real mode shapes in the positive sense of each sensor's axis, of any scale, one per column (sensors × modes).
    pub shapes: DMatrix<f64>,
    /// Standard deviation of every frequency, a fraction of it, if known.
    pub frequency_deviation: Option<Vec<f64>>,
    /// Standard deviation of every mode's shape, a fraction of its largest component, if known.
    pub shape_deviation: Option<Vec<f64>>,
    /// Modal phase collinearity of every mode that was complex before it was made real; empty when all were real.
    pub phase_collinearity: Vec<f64>,
    /// Lines of the wire frame of the test, as pairs of grid numbers.
    pub lines: Vec<[usize; 2]>,
}
