//! Universal Files that pyuff wrote, with what pyuff reads in them, and one of the crate's that pyuff has read.

use crate::prelude::*;

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

fn path(name: &str) -> PathBuf {
    in_root("golden/formats").join(name)
}

fn answers() -> BTreeMap<String, Answer> {
    toml::from_str(&fs::read_to_string(path("universal_expected.toml")).unwrap()).unwrap()
}

fn file(name: &str) -> TestData {
    let name = format!("universal_{name}.unv");
    read(&name, &fs::read(path(&name)).unwrap()).unwrap()
}

impl Mode {
    fn frequency(&self) -> f64 {
        let [real, imaginary] = self.root;
        if self.analysis == 2 {
            real
        } else {
            real.hypot(imaginary) / (2.0 * PI)
        }
    }

    /// The component of a node and direction.
    fn at(&self, grid: usize, direction: usize) -> Complex<f64> {
        let place = self.nodes.iter().position(|node| *node == grid).unwrap();
        Complex::new(
            self.real[direction][place],
            self.imaginary[direction][place],
        )
    }

    fn moves(&self, grid: usize, direction: usize) -> bool {
        self.at(grid, direction).norm() > 0.0
    }
}

/// Sensors, places, units and wire frame beside pyuff's answer.
fn assert_frame(name: &str, data: &TestData, answer: &Answer, modes: &[&Mode]) {
    assert_eq!(data.units, answer.units, "{name}");
    let width = modes[0].real.len();
    let mut expected = modes[0]
        .nodes
        .iter()
        .flat_map(|node| (0..width).map(move |direction| (*node, direction)))
        .collect_vec();
    expected.retain(|(node, direction)| modes.iter().any(|mode| mode.moves(*node, *direction)));
    expected.sort_unstable();
    let found = data
        .sensors
        .iter()
        .map(|sensor| (sensor.grid.unwrap(), sensor.direction))
        .collect_vec();
    assert_eq!(found, expected, "{name}");
    for sensor in &data.sensors {
        let at = |nodes: &Nodes| {
            nodes
                .numbers
                .iter()
                .position(|node| Some(*node) == sensor.grid)
        };
        let expected = answer
            .nodes
            .iter()
            .find_map(|nodes| at(nodes).map(|row| [nodes.x[row], nodes.y[row], nodes.z[row]]));
        assert_eq!(
            sensor.place.map(<[f64; 3]>::from),
            expected,
            "{name}, {}",
            sensor.name
        );
    }
    let pairs = answer
        .traces
        .iter()
        .flat_map(|trace| trace.nodes.windows(2))
        .filter(|pair| !pair.contains(&0));
    assert_eq!(
        data.lines,
        pairs.map(|pair| [pair[0], pair[1]]).collect_vec(),
        "{name}"
    );
}

#[test]
fn real_modes_of_three_and_six_components_are_as_pyuff_reads_them() {
    let answers = answers();
    for name in ["real", "six", "written"] {
        let (data, answer) = (file(name), &answers[name]);
        let modes = answer.modes.iter().collect_vec();
        assert_frame(name, &data, answer, &modes);
        assert_eq!(
            data.frequencies_hz,
            modes.iter().map(|mode| mode.frequency()).collect_vec(),
            "{name}"
        );
        for (shape, mode) in data.shapes.column_iter().zip(&modes) {
            for (sensor, value) in data.sensors.iter().zip(shape.iter()) {
                let expected = mode.at(sensor.grid.unwrap(), sensor.direction);
                assert_eq!(
                    (*value, 0.0),
                    (expected.re, expected.im),
                    "{name}, {}",
                    sensor.name
                );
            }
        }
        assert!(
            data.phase_collinearity.is_empty() && data.skipped.is_empty(),
            "{name}"
        );
    }
    assert_eq!(
        file("six")
            .sensors
            .iter()
            .filter(|sensor| sensor.direction > 2)
            .count(),
        8
    );
}

#[test]
fn velocities_and_accelerations_become_displacements_and_a_response_is_no_mode() {
    let (data, answers) = (file("moving"), answers());
    let modes = answers["moving"]
        .modes
        .iter()
        .filter(|mode| mode.analysis == 2)
        .collect_vec();
    assert_eq!(data.skipped, [55]);
    assert_frame("moving", &data, &answers["moving"], &modes);
    for (mode, expected) in modes.into_iter().enumerate() {
        let omega = 2.0 * PI * expected.frequency();
        for (row, sensor) in data.sensors.iter().enumerate() {
            let measured = expected.at(sensor.grid.unwrap(), sensor.direction).re;
            let factor = if expected.kind == 11 {
                omega
            } else {
                -omega * omega
            };
            assert_within(
                factor * data.shapes[(row, mode)],
                measured,
                ROUND_OFF * measured.abs(),
            );
        }
    }
}

#[test]
fn complex_modes_are_made_real_once_each_and_keep_their_collinearity() {
    let (data, answers) = (file("complex"), answers());
    let modes = answers["complex"]
        .modes
        .iter()
        .filter(|mode| mode.root[1] > 0.0)
        .collect_vec();
    assert_eq!(
        (modes.len(), answers["complex"].modes.len()),
        (2, 3),
        "a conjugate is in the file"
    );
    assert_frame("complex", &data, &answers["complex"], &modes);
    assert_eq!(
        data.frequencies_hz,
        modes.iter().map(|mode| mode.frequency()).collect_vec()
    );
    for (column, mode) in modes.into_iter().enumerate() {
        let at = |row: usize| mode.at(data.sensors[row].grid.unwrap(), data.sensors[row].direction);
        let shape = DVector::from_fn(data.sensors.len(), |row, _| at(row));
        // The largest real part of any phase, found by trying a thousand.
        let part = |angle: f64| shape.map(|value| (value * Complex::from_polar(1.0, angle)).re);
        let angle = |step: usize| PI * step as f64 / 1000.0;
        let best = (0..1000).map(|step| part(angle(step)).norm()).largest();
        let found = data.shapes.column(column);
        assert!(found.norm() >= best && found.norm() <= shape.norm());
        // It is itself the real part at some phase: what is left of it at all phases is round-off.
        let (real, imaginary) = (part(0.0), part(0.5 * PI));
        let plane = DMatrix::from_columns(&[real, imaginary]);
        let (q, _) = plane.qr().unpack();
        assert!((found - &q * q.tr_mul(&found)).norm() < ROUND_OFF * found.norm());
        let ratio = (found.norm() / shape.norm()).powi(2);
        let expected = (2.0 * ratio - 1.0).powi(2);
        assert_within(data.phase_collinearity[column], expected, ROUND_OFF);
        assert!(data.phase_collinearity[column] > 0.5);
    }
}

/// `CORFEM_FORMATS=write cargo test pyuff` writes the file anew; then the script has to read it again.
#[test]
fn the_file_that_pyuff_has_read_is_what_the_crate_writes() {
    let (written, path) = (write_universal(&wing_test()), path("universal_written.unv"));
    if std::env::var("CORFEM_FORMATS").is_ok_and(|wish| wish == "write") {
        fs::write(&path, &written).unwrap();
    }
    assert_eq!(fs::read_to_string(path).unwrap(), written);
    let (answer, data) = (&answers()["written"], wing_test());
    for (mode, expected) in answer.modes.iter().enumerate() {
        for (row, sensor) in data.sensors.iter().enumerate() {
            let (found, value) = (
                expected.at(sensor.grid.unwrap_or(13), sensor.direction).re,
                data.shapes[(row, mode)],
            );
            assert_within(found, value, UNIVERSAL_ROUNDING * value.abs());
        }
    }
}

/// Nodes in a coordinate system that stands at (10, 20, 30), its x axis along (0.6, 0.8, 0).
#[test]
fn axes_that_pyuff_wrote_are_turned() {
    let data = file("axes");
    let places = data
        .sensors
        .iter()
        .filter_map(|sensor| sensor.place)
        .collect_vec();
    let expected = [
        Vector3::new(1.0, 2.0, 3.0),
        Vector3::new(9.0, 22.0, 33.0),
        Vector3::new(6.0, 23.0, 30.0),
    ];
    for (sensor, place) in data.sensors.iter().zip(&places) {
        let node = sensor.grid.unwrap();
        assert!(
            (place - expected[node - 1]).amax() < ROUND_OFF,
            "{node}: {place}"
        );
        let axis = sensor
            .axis
            .unwrap_or_else(|| Vector3::ith(sensor.direction, 1.0));
        let [x, y] = if node == 2 {
            [[1.0, 0.0], [0.0, 1.0]]
        } else {
            [[0.6, 0.8], [-0.8, 0.6]]
        };
        let axes = [
            Vector3::new(x[0], x[1], 0.0),
            Vector3::new(y[0], y[1], 0.0),
            Vector3::z(),
        ];
        assert!(
            (axis - axes[sensor.direction]).amax() < ROUND_OFF,
            "{}: {axis}",
            sensor.name
        );
    }
    assert_eq!((data.sensors.len(), data.skipped.len()), (7, 0));
}
