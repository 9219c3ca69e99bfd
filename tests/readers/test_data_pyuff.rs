//! Universal Files that pyuff wrote, with what pyuff reads in them, and one of the crate's that pyuff has read.

use crate::prelude::*;
use crate::readers::matrices::{assert_written, golden};
use test_data::complex_modes::realize;

#[derive(Deserialize)]
struct Nodes {
    numbers: Vec<usize>,
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
}

#[derive(Deserialize)]
struct Trace {
    nodes: Vec<usize>,
}

#[derive(Deserialize)]
struct Mode {
    analysis: usize,
    kind: usize,
    root: [f64; 2],
    nodes: Vec<usize>,
    real: Vec<Vec<f64>>,
    imaginary: Vec<Vec<f64>>,
}

#[derive(Deserialize)]
struct Answer {
    units: Option<String>,
    nodes: Vec<Nodes>,
    #[serde(default)]
    traces: Vec<Trace>,
    modes: Vec<Mode>,
}

impl Mode {
    fn frequency(&self) -> f64 {
        match (self.analysis, self.root) {
            (2, [hertz, _]) => hertz,
            (_, [real, imaginary]) => real.hypot(imaginary) / TAU,
        }
    }

    /// The component of a node and direction.
    fn at(&self, grid: usize, direction: usize) -> Complex<f64> {
        let place = self.nodes.iter().position(|node| *node == grid).unwrap();
        let [real, imaginary] = [&self.real, &self.imaginary].map(|own| own[direction][place]);
        Complex::new(real, imaginary)
    }

    /// Its components at the sensors of a test; one without a grid has the number behind the others.
    fn shape(&self, data: &TestData) -> Vec<Complex<f64>> {
        let sensors = data.sensors.iter();
        sensors
            .map(|own| self.at(own.grid.unwrap_or(13), own.direction))
            .collect()
    }
}

/// A file's test beside pyuff's answer and those of its modes that are modes: sensors, places, units, wire frame and frequencies are the same.
fn read_with_pyuff(name: &str, is_mode: fn(&Mode) -> bool) -> (TestData, Vec<Mode>) {
    let text = fs::read_to_string(golden("universal_expected.toml")).unwrap();
    let mut answers: BTreeMap<String, Answer> = toml::from_str(&text).unwrap();
    let answer = answers.remove(name).unwrap();
    let file = format!("universal_{name}.unv");
    let data = read(&file, &fs::read(golden(&file)).unwrap()).unwrap();
    let modes = answer.modes.into_iter().filter(is_mode).collect_vec();
    assert_eq!(data.units, answer.units, "{name}");
    let width = modes[0].real.len();
    let nodes = modes[0].nodes.iter();
    let dof = nodes.flat_map(|node| (0..width).map(move |direction| (*node, direction)));
    let moves = |own: &(usize, usize)| modes.iter().any(|mode| mode.at(own.0, own.1).norm() > 0.0);
    let mut expected = dof.filter(moves).collect_vec();
    expected.sort_unstable();
    let found = data
        .sensors
        .iter()
        .map(|own| (own.grid.unwrap(), own.direction));
    assert_eq!(found.collect_vec(), expected, "{name}");
    for sensor in &data.sensors {
        let at = answer.nodes.iter().find_map(|nodes| {
            let row = nodes
                .numbers
                .iter()
                .position(|node| Some(*node) == sensor.grid)?;
            Some([nodes.x[row], nodes.y[row], nodes.z[row]])
        });
        assert_eq!(
            sensor.place.map(<[f64; 3]>::from),
            at,
            "{name}, {}",
            sensor.name
        );
    }
    let pairs = answer
        .traces
        .iter()
        .flat_map(|trace| trace.nodes.windows(2));
    let pairs = pairs
        .filter(|pair| !pair.contains(&0))
        .map(|pair| [pair[0], pair[1]]);
    assert_eq!(data.lines, pairs.collect_vec(), "{name}");
    let hertz = modes.iter().map(Mode::frequency).collect_vec();
    assert_eq!(data.frequencies_hz, hertz, "{name}");
    (data, modes)
}

/// Velocities and accelerations become displacements, and a response is no mode.
#[test]
fn real_modes_are_as_pyuff_reads_them() {
    for (name, skipped) in [
        ("real", &[][..]),
        ("six", &[]),
        ("written", &[]),
        ("moving", &[55]),
    ] {
        let (data, modes) = read_with_pyuff(name, |mode| mode.analysis == 2);
        assert_eq!(data.skipped, skipped, "{name}");
        assert!(data.phase_collinearity.is_empty(), "{name}");
        for (shape, mode) in data.shapes.column_iter().zip(&modes) {
            let omega = TAU * mode.frequency();
            let factor = match mode.kind {
                11 => omega,
                12 => -omega * omega,
                _ => 1.0,
            };
            for (found, expected) in shape.iter().zip(mode.shape(&data)) {
                assert_eq!(expected.im, 0.0, "{name}");
                assert_within(factor * found, expected.re, ROUND_OFF * expected.re.abs());
            }
        }
    }
}

/// A conjugate is in the file. What a shape is made of its phases is in `complex_modes.rs`.
#[test]
fn complex_modes_are_made_real_once_each_and_keep_their_collinearity() {
    let (data, modes) = read_with_pyuff("complex", |mode| mode.root[1] > 0.0);
    assert_eq!(modes.len(), 2);
    for (column, mode) in modes.iter().enumerate() {
        let shape = DMatrix::from_vec(data.sensors.len(), 1, mode.shape(&data));
        let (real, collinearity) = realize(&shape).unwrap();
        assert_eq!(data.shapes.column(column), real.column(0));
        assert_eq!(data.phase_collinearity[column], collinearity[0]);
        assert!(collinearity[0] > 0.5);
    }
}

/// `CORFEM_WRITE=formats cargo test pyuff` writes the file anew; then the script has to read it again.
#[test]
fn the_file_that_pyuff_has_read_is_what_the_crate_writes() {
    let wing = wing_test();
    assert_written("universal_written.unv", write_universal(&wing).as_bytes());
    let (_, modes) = read_with_pyuff("written", |_| true);
    for (mode, shape) in modes.iter().zip(wing.shapes.column_iter()) {
        for (found, value) in mode.shape(&wing).iter().zip(&shape) {
            assert_within(found.re, value, UNIVERSAL_ROUNDING * value.abs());
        }
    }
}

/// Nodes in a coordinate system that stands at (10, 20, 30), its x axis along (0.6, 0.8, 0), and one in the global one.
#[test]
fn axes_that_pyuff_wrote_are_turned() {
    let name = "universal_axes.unv";
    let data = read(name, &fs::read(golden(name)).unwrap()).unwrap();
    let places = [[1.0, 2.0, 3.0], [9.0, 22.0, 33.0], [6.0, 23.0, 30.0]];
    assert_eq!((data.sensors.len(), data.skipped.len()), (7, 0));
    for sensor in &data.sensors {
        let node = sensor.grid.unwrap();
        let place = sensor.place.unwrap() - Vector3::from(places[node - 1]);
        let turned = [[0.6, 0.8, 0.0], [-0.8, 0.6, 0.0], [0.0, 0.0, 1.0]][sensor.direction];
        let own = Vector3::ith(sensor.direction, 1.0);
        let expected = if node == 2 { own } else { turned.into() };
        let axis = sensor.axis.unwrap_or(own) - expected;
        assert!(place.amax().max(axis.amax()) < ROUND_OFF, "{}", sensor.name);
    }
}
