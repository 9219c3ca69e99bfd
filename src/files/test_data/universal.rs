//! The Universal File (UFF, UNV) of SDRC, which test systems write: blocks of fixed columns between lines `    -1`.
//!
//! Datasets 15 and 2411 are nodes and their coordinates, 18 and 2420 coordinate systems of these (15) and of what is measured
//! there (both), 55 and 2414 a mode at the nodes, 82 a line of the wire frame, 164 the units (nothing is converted), 151 a header. All
//! others, and datasets 55 and 2414 that are no modes, are named in [`TestData::skipped`]. A sensor's coordinate system must be in
//! the file; 0 is the global one, and so is 1, SDRC's number for it, unless a dataset defines it otherwise.
//!
//! Only a line of these six columns and nothing else ends a block; a data line `        -1` does not. Exponents may be E or D, and
//! full columns touch; where columns do not hold one number each, blanks separate them.
//!
//! Text between datasets is a remark. Coordinate systems are Cartesian or cylindrical, these with angles in degrees, of places and of motions.
//!
//! A mode has all directions at each of its nodes. Those that are zero in all modes count as not measured and are no sensors; the others
//! are in ascending order of node and direction. A value that a mode leaves out was not measured in it, which is not zero: such a
//! sensor is left out of all modes and named in [`TestData::incomplete`].
//! The frequency of a complex eigenvalue is its magnitude over $2 \pi$, that of the undamped structure; of a conjugate pair the one
//! with an imaginary part that is not negative is read. Velocities are divided by the circular frequency and accelerations by its
//! square and minus one. When a shape is complex, all are made real by [`realize`], and how near they were is kept.

use super::universal_axes::{ROTATION, Systems, by_matrices, by_points};
use super::universal_block::{Block, INTEGER, LONG_REAL, REAL, VALUES, integer};
use super::{Sensor, TestData, default_name};
use crate::files::error::{FileError, ensure};
use crate::files::test_data::complex_modes::realize;
use nalgebra::{Complex, DMatrix, Vector3};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::f64::consts::PI;

/// Column widths of a node in dataset 15.
const NODE: [usize; 7] = [INTEGER, INTEGER, INTEGER, INTEGER, REAL, REAL, REAL];
/// Lengths to a meter of the systems of units, by code.
const LENGTHS: [(&[usize], f64); 5] = [
    (&[1, 3], 1.0),
    (&[2, 4], 3.280_84),
    (&[5, 8, 10], 1000.0),
    (&[6], 100.0),
    (&[7], 39.370_1),
];
/// Rounding of a coordinate of six digits.
const PLACE_DIGITS: f64 = 1e-5;
/// Kinds of data that are a mode shape: unknown, general, displacement, velocity, acceleration.
const SHAPES: [usize; 5] = [0, 1, 8, 11, 12];

/// The data read so far, with the modes' values by node and direction.
#[derive(Default)]
struct FoundModes {
    data: TestData,
    /// Nodes by number: position, the coordinate systems of this and of the displacements, and line.
    nodes: HashMap<usize, (Vector3<f64>, [usize; 2], usize)>,
    systems: Systems,
    shapes: Vec<BTreeMap<(usize, usize), Complex<f64>>>,
    complex: bool,
    /// All datasets of the file, and that of its modes.
    datasets: BTreeSet<usize>,
    of_modes: Option<usize>,
}

fn is_mark(line: &str) -> bool {
    line.trim_end() == "    -1"
}

pub fn read(file: &str, text: &str) -> Result<TestData, FileError> {
    let lines: Vec<&str> = text.lines().collect();
    let wrong = |at, what| FileError::at(file, &lines, at, what);
    let (mut found, mut at) = (FoundModes::default(), 0);
    // Text between datasets is a remark.
    while let Some(remark) = lines[at..].iter().position(|line| line.trim() == "-1") {
        at += remark;
        if !is_mark(lines[at]) {
            return Err(wrong(at, "the mark of a dataset, -1 in columns 5 and 6"));
        }
        let header = lines
            .get(at + 1)
            .and_then(|line| line.split_whitespace().next())
            .unwrap_or_default();
        let (number, binary) = header
            .strip_suffix(['b', 'B'])
            .map_or((header, false), |number| (number, true));
        let dataset: usize = number
            .parse()
            .map_err(|_| wrong(at + 1, "the number of a dataset"))?;
        // Binary data have no last line end: their mark may stand behind them.
        let ends = |line: &&str| is_mark(line) || binary && line.trim_end().ends_with("    -1");
        let count = lines[at + 2..].iter().position(ends);
        let end = at
            + 2
            + count.ok_or_else(|| {
                wrong(
                    lines.len(),
                    "the dataset's last line, -1 in columns 5 and 6",
                )
            })?;
        let mut block = Block::new(file, &lines[at + 2..end], at + 3);
        found.datasets.insert(dataset);
        match dataset {
            15 | 2411 => found.nodes(&mut block, dataset)?,
            18 => by_points(&mut block, &mut found.systems)?,
            55 | 2414 => found.mode(&mut block, dataset)?,
            82 => found.trace(&mut block)?,
            151 => {}
            164 => found.units(&mut block)?,
            2420 => by_matrices(&mut block, &mut found.systems)?,
            _ => found.data.skipped.push(dataset),
        }
        at = end + 1;
    }
    found.into_data(file)
}

impl FoundModes {
    /// Dataset 15 has a line for every node, dataset 2411 two with longer coordinates. A node may come again at its place.
    fn nodes(&mut self, block: &mut Block, dataset: usize) -> Result<(), FileError> {
        let what = "the number of a node, two coordinate systems, a color, and three coordinates";
        while !block.is_done() {
            let mut numbers = block.reals(what, if dataset == 15 { &NODE } else { &NODE[..4] })?;
            let node = integer(numbers[0]).ok_or_else(|| block.is_not(numbers[0], what))?;
            // The coordinates of dataset 2411 are global ones.
            let of_place = if dataset == 15 { numbers[1] } else { 0.0 };
            let (systems, line) = (
                [of_place, numbers[2]].map(|number| integer(number).unwrap_or(0)),
                block.last_number(),
            );
            if dataset == 2411 {
                numbers.extend(block.reals("three coordinates", &[LONG_REAL; 3])?);
            }
            let place = Vector3::from_column_slice(&numbers[4..]);
            let (known, of_known, _) = *self.nodes.entry(node).or_insert((place, systems, line));
            // Dataset 15 has six digits of what dataset 2411 has all of; places in systems of their own cannot be compared here.
            let is_apart = (known - place).amax() > PLACE_DIGITS * known.amax();
            if of_known[0] == systems[0] && is_apart {
                return Err(block.wrong(format!("node {node} was given at another place before")));
            }
            if dataset == 2411 {
                self.nodes.insert(node, (place, [0, of_known[1]], line));
            }
        }
        Ok(())
    }

    /// Dataset 82: nodes that a pen goes through, zero where it is lifted.
    fn trace(&mut self, block: &mut Block) -> Result<(), FileError> {
        while !block.is_done() {
            let mut left =
                block.integers("the number, node count and color of a trace line", 3)?[1];
            block.line("the name of a trace line")?;
            let mut pen = 0;
            while left > 0 {
                for node in block.integers("a line of a trace line's nodes", left.min(8))? {
                    self.data
                        .lines
                        .extend(Some([pen, node]).filter(|ends| !ends.contains(&0)));
                    (pen, left) = (node, left - 1);
                }
            }
        }
        Ok(())
    }

    /// Dataset 164: a code and its description in 20 columns, then factors to SI.
    fn units(&mut self, block: &mut Block) -> Result<(), FileError> {
        let line = block.line("the code of a system of units and its description")?;
        let words: String = line.chars().skip(INTEGER).take(20).collect();
        let words = if words.trim().is_empty() {
            line
        } else {
            &words
        };
        self.data.units = Some(words.trim().to_owned());
        let factors = block.reals("three factors of units", &[LONG_REAL; 3])?;
        let code = line
            .chars()
            .take(INTEGER)
            .collect::<String>()
            .trim()
            .parse::<usize>()
            .unwrap_or_default();
        let known = LENGTHS.iter().find(|(codes, _)| codes.contains(&code));
        self.data.lengths_to_meter = known.map(|(_, length)| [factors[0], *length]);
        Ok(())
    }

    /// Dataset 55 or 2414, if it is a mode. The latter has a label, a name and a location in front (1, data at nodes), two lines of
    /// integers, and two of reals: the frequency is the second number of the first, a complex eigenvalue begins the second.
    fn mode(&mut self, block: &mut Block, dataset: usize) -> Result<(), FileError> {
        let is_analysis = dataset == 2414;
        let is_at_nodes = !is_analysis || {
            block.line("a label")?;
            block.line("a name")?;
            block.integers("the location of the data", 1)? == [1]
        };
        (0..5).try_for_each(|_| block.line("all five lines of identification").map(drop))?;
        let codes = block.integers("the six codes of a mode", 6)?;
        let [analysis, characteristic, specific, data_type, count] =
            [1, 2, 3, 4, 5].map(|place| codes[place]);
        let is_mode = [2, 3, 7].contains(&analysis) && [2, 3].contains(&characteristic);
        if !is_mode || !SHAPES.contains(&specific) || !is_at_nodes {
            self.data.skipped.push(dataset);
            return Ok(());
        }
        let other = self.of_modes.replace(dataset);
        ensure(other.is_none_or(|other| other == dataset), || {
            block.wrong("the file has modes in datasets 55 and 2414, perhaps the same ones; keep those of one")
        })?;
        ensure(
            count == 3 * (characteristic - 1) && [2, 4, 5, 6].contains(&data_type),
            || {
                block.wrong(format!(
                "a mode has three or six values a node, real (2, or 4 of double precision) or complex (5, 6), not characteristic \
                 {characteristic}, {count} values of type {data_type}"
            ))
            },
        )?;
        let line = block.line("the integers that describe a mode")?;
        // Behind a load case in dataset 55, and behind five sets and cases in 2414.
        let place = if is_analysis { 5 } else { 3 };
        let number = line.split_whitespace().nth(place);
        let number = number.and_then(|number| number.parse().ok());
        let Some(frequency) = frequency(block, is_analysis, analysis == 2)? else {
            return Ok(());
        };
        let omega = 2.0 * PI * frequency;
        // A rigid-body mode has the frequency zero and is not compared: its shape needs no scale.
        let divisor = if frequency == 0.0 {
            1.0
        } else {
            [1.0, omega, -omega * omega][specific.saturating_sub(10)]
        };
        let parts = if data_type > 4 { 2 } else { 1 };
        let columns: &[usize] = match data_type {
            4 | 6 => &[LONG_REAL; 3],
            _ => &VALUES,
        };
        let mut shape = BTreeMap::new();
        while !block.is_done() {
            let node = block.integers("the number of a node", 1)?[0];
            let mut values = Vec::new();
            while values.len() < parts * count {
                let widths = &columns[..(parts * count - values.len()).min(columns.len())];
                values.extend(block.reals("a line of a mode's values", widths)?);
            }
            for (direction, value) in values.chunks(parts).enumerate() {
                let value = Complex::new(value[0], value.get(1).copied().unwrap_or(0.0)) / divisor;
                ensure(shape.insert((node, direction), value).is_none(), || {
                    block.wrong(format!("node {node} is in this mode twice"))
                })?;
            }
        }
        self.complex |= parts == 2;
        self.data.frequencies_hz.push(frequency);
        self.data.numbers.push(number.unwrap_or_default());
        self.shapes.push(shape);
        Ok(())
    }

    fn into_data(mut self, file: &str) -> Result<TestData, FileError> {
        ensure(!self.shapes.is_empty(), || {
            let of_other = |dataset: &usize| match dataset {
                55 | 2414 => format!("{dataset} of other data than modes at nodes"),
                _ => dataset.to_string(),
            };
            let datasets: Vec<String> = self.datasets.iter().map(of_other).collect();
            let datasets = datasets.join(", ");
            let reason = format!(
                "no mode shapes; they are in datasets 55 or 2414, and this file has {datasets}"
            );
            FileError::refused(file, reason)
        })?;
        let measured: BTreeSet<(usize, usize)> = self
            .shapes
            .iter()
            .flatten()
            .filter(|(_, value)| **value != Complex::default())
            .map(|(key, _)| *key)
            .collect();
        let is_complete = |key: &_| self.shapes.iter().all(|shape| shape.contains_key(key));
        let (keys, incomplete): (Vec<_>, Vec<_>) = measured.into_iter().partition(is_complete);
        ensure(!keys.is_empty() || incomplete.is_empty(), || {
            FileError::refused(
                file,
                "no node and direction is in every mode; remove the modes with other nodes",
            )
        })?;
        let incomplete = incomplete.into_iter();
        self.data.incomplete = incomplete.map(|(node, d)| default_name(node, d)).collect();
        let value = |row: usize, mode: usize| self.shapes[mode][&keys[row]];
        let shapes = DMatrix::from_fn(keys.len(), self.shapes.len(), value);
        let (shapes, phases) = if self.complex {
            realize(&shapes)?
        } else {
            (shapes.map(|value| value.re), Vec::new())
        };
        let sensors = keys
            .iter()
            .map(|(node, direction)| self.sensor(file, *node, *direction));
        self.data.sensors = sensors.collect::<Result<_, _>>()?;
        let data = &mut self.data;
        (data.shapes, data.phase_collinearity) = (shapes, phases);
        // Numbers that are no others than the places, or that do not tell modes apart, say nothing.
        let once: BTreeSet<usize> = data.numbers.iter().copied().collect();
        let are_places = data.numbers.iter().copied().eq(1..=data.numbers.len());
        if are_places || once.len() < data.numbers.len() || once.contains(&0) {
            data.numbers.clear();
        }
        data.skipped.sort_unstable();
        data.skipped.dedup();
        Ok(self.data)
    }

    /// The sensor of a node and a direction: its place and its axis in the global coordinate system.
    fn sensor(&self, file: &str, node: usize, direction: usize) -> Result<Sensor, FileError> {
        let mut sensor = Sensor {
            name: default_name(node, direction),
            grid: Some(node),
            direction,
            axis: None,
            place: None,
        };
        let Some((place, systems, line)) = self.nodes.get(&node) else {
            return Ok(sensor);
        };
        let wrong = |reason: String| FileError::line(file, *line, format!("node {node} {reason}"));
        let [of_place, of_motion] = systems.map(|number| self.systems.get(&number));
        for number in systems {
            let own = self.systems.get(number);
            ensure(own.map_or(*number < 2, |own| own.kind < 2), || {
                wrong(format!(
                    "has coordinate system {number}, which is no Cartesian or cylindrical one of a dataset 18 or 2420 of the file"
                ))
            })?;
        }
        let place = of_place.map_or(*place, |axes| axes.place(*place));
        sensor.place = Some(place);
        if let Some(axes) = of_motion {
            let on_axis =
                || wrong("is on the axis of its cylindrical coordinate system".to_owned());
            let own = axes.directions(place, ROTATION).ok_or_else(on_axis)?;
            let axis = own.column(direction % 3);
            // Components below the file's six digits are round-off: snap them to zero.
            let snapped = axis.map(|own| if own.abs() < ROTATION { 0.0 } else { own });
            sensor.axis = Some(snapped.normalize());
        }
        Ok(sensor)
    }
}

/// The frequency of a mode, from its own number or from a complex eigenvalue; none of an eigenvalue whose conjugate is read.
fn frequency(
    block: &mut Block,
    is_analysis: bool,
    is_real: bool,
) -> Result<Option<f64>, FileError> {
    let what = "a frequency, or a complex eigenvalue";
    let mut root;
    if is_analysis {
        block.line("the integers that describe a mode")?;
        root = block.reals(what, &VALUES[..2])?;
        let second = block.reals(what, &VALUES[..2])?;
        root = if is_real { vec![root[1]] } else { second };
    } else {
        root = block.reals(what, &VALUES[..if is_real { 1 } else { 2 }])?;
    }
    let frequency = match root[..] {
        [_, imaginary] if imaginary < 0.0 => return Ok(None),
        [real, imaginary] => real.hypot(imaginary) / (2.0 * PI),
        _ => root[0],
    };
    ensure(frequency >= 0.0, || {
        block.is_not(frequency, "a frequency, zero of a rigid-body mode")
    })?;
    Ok(Some(frequency))
}
