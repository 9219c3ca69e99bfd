//! A ground vibration test as files hold it: frequencies, sensors, and every sensor's reading in every mode.
//!
//! [`read`] knows two formats: `universal`, the Universal File of test systems, and `csv`, a table that a spreadsheet writes.

#[doc(hidden)]
pub mod complex_modes;
mod csv;
mod universal;
mod universal_axes;
mod universal_block;

pub(crate) use csv::{cells, quoted, separator};

use crate::files::deck::number::real;
use crate::files::error::{FileError, ensure};
use crate::files::text::{decoded, readable};
use crate::method::error::{Error, at_least_one, positive};
use crate::method::modes::Modes;
use crate::method::structure::StructuralDof;
use nalgebra::{DMatrix, DVector, Vector3};
use std::collections::{BTreeMap, HashSet};

/// Names of directions 0 to 5.
#[doc(hidden)]
pub const DIRECTIONS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// Forms of a direction, in errors.
pub(crate) const DIRECTION: &str = "a direction x, y, z, rx, ry or rz, 1 to 6, or UX to UZ and RX to RZ or ROTX to ROTZ, with a sign or without";

/// Direction 0 to 5 of a word and its sign: `z`, `-z`, `+Z`, `3` or `UZ`.
pub(crate) fn direction(word: &str) -> Option<(usize, f64)> {
    let word = word.trim().to_lowercase();
    let bare = word.trim_start_matches(['+', '-']).trim_start();
    let sign = if word.starts_with('-') { -1.0 } else { 1.0 };
    let is_signed_once = word.len() - word.trim_start_matches(['+', '-']).len() < 2;
    let letters = bare.strip_prefix('u').unwrap_or(bare).replace("rot", "r");
    let by_name = DIRECTIONS.iter().position(|name| *name == letters);
    let by_number = bare.parse().ok().filter(|own| (1..=6).contains(own));
    by_name
        .or(by_number.map(|own: usize| own - 1))
        .filter(|_| is_signed_once)
        .map(|own| (own, sign))
}

/// Name of a row of a matrix: its grid and direction, or its number where rows have no names.
#[doc(hidden)]
pub fn row_name(row: usize, dof: &[StructuralDof]) -> String {
    dof.get(row).map_or_else(
        || format!("row {}", row + 1),
        |dof| format!("{} {}", dof.grid, DIRECTIONS[dof.direction]),
    )
}

/// One sensor: it measures a displacement along an axis at a grid or point of the test.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Name of the sensor; `12 z` when the file has none.
    pub name: String,
    /// The grid or node number of the test, if the file has one.
    pub grid: Option<usize>,
    /// 0, 1, 2 for displacements along x, y, z; 3, 4, 5 for rotations about them.
    pub direction: usize,
    /// The unit vector along that axis, if it is one of a coordinate system of the test's own; it is not written.
    pub axis: Option<Vector3<f64>>,
    /// Position in the model's units of length, if the file gives it.
    pub place: Option<Vector3<f64>>,
}

/// The measured modes of a ground vibration test.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TestData {
    /// Natural frequencies, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Rows of the shapes.
    pub sensors: Vec<Sensor>,
    /// Real mode shapes in the positive sense of each sensor's axis, of any scale, one per column (sensors × modes).
    pub shapes: DMatrix<f64>,
    /// Modes, from zero, of which the test has a frequency alone; their columns of the shapes mean nothing.
    pub alone: Vec<usize>,
    /// Standard deviation of every frequency, a fraction of it, if known.
    pub frequency_deviation: Option<Vec<f64>>,
    /// Standard deviation of every mode's shape, a fraction of its largest component, if known.
    pub shape_deviation: Option<Vec<f64>>,
    /// Standard deviation of every component of a shape, a fraction of its largest, by mode, from zero, where a mode has them.
    pub component_deviation: BTreeMap<usize, DVector<f64>>,
    /// Modal phase collinearity of every mode that was complex before it was made real; empty when all were real.
    pub phase_collinearity: Vec<f64>,
    /// Lines of the wire frame of the test, as pairs of grid numbers.
    pub lines: Vec<[usize; 2]>,
    /// The numbers that the file gives its modes, in its order, if they differ and are not 1, 2, 3 and so on.
    pub numbers: Vec<usize>,
    /// Lengths to a meter by the file's factor, and by the unit that it names, if both are known.
    pub lengths_to_meter: Option<[f64; 2]>,
    /// The file's units in its own words, if it says; nothing is converted.
    pub units: Option<String>,
    /// Modes, from zero, of a frequency of zero: the structure moves as a rigid body, and nothing of them is compared.
    pub rigid: Vec<usize>,
    /// Names of the sensors that are left out because some mode has no value at them; of a table, each with the first such mode.
    pub incomplete: Vec<String>,
    /// Numbers of the datasets of a Universal File that were not read, ascending.
    pub skipped: Vec<usize>,
}

impl TestData {
    /// Refuses what a file can say and no test can have: negative frequencies and deviations, shapes that are zero, no mode, and a sensor twice.
    fn check(&self) -> Result<(), Error> {
        let of_mode = |mode: usize| move || format!("test mode {mode} (from zero)");
        let (vibrations, shaped) = (self.vibrations(), self.shaped());
        for mode in vibrations.iter().map(|number| number - 1) {
            positive("frequency", of_mode(mode), self.frequencies_hz[mode])?;
        }
        if !shaped.is_empty() {
            let hertz = shaped.iter().map(|&mode| self.frequencies_hz[mode]);
            let shapes = self.shapes.select_columns(&shaped);
            Modes::from_measured(&hertz.collect::<Vec<_>>(), &shapes)?;
        }
        at_least_one("test modes", vibrations.len())?;
        let mut seen = HashSet::new();
        for sensor in &self.sensors {
            if let Some(label) = sensor.grid {
                let owner = format!("test, direction {}", DIRECTIONS[sensor.direction]);
                let what = "sensor at grid";
                let twice = Error::Duplicate { owner, what, label };
                ensure(seen.insert((label, sensor.direction)), || twice)?;
            }
        }
        for (what, list) in [
            ("frequency deviation", &self.frequency_deviation),
            ("shape deviation", &self.shape_deviation),
        ] {
            for (mode, &value) in list.iter().flatten().enumerate() {
                positive(what, of_mode(mode), value)?;
            }
        }
        for (mode, deviations) in &self.component_deviation {
            for (sensor, &value) in deviations.iter().enumerate() {
                let owner = || format!("test mode {mode} at sensor {sensor} (from zero)");
                positive("component deviation", owner, value)?;
            }
        }
        Ok(())
    }

    /// Numbers of the modes, from one, that are no rigid-body modes.
    pub(crate) fn vibrations(&self) -> Vec<usize> {
        let all = 1..=self.frequencies_hz.len();
        all.filter(|number| !self.rigid.contains(&(number - 1)))
            .collect()
    }

    /// Places of the vibrations that have shapes.
    pub(crate) fn shaped(&self) -> Vec<usize> {
        let all = 0..self.frequencies_hz.len();
        let has_none = |mode: &usize| self.alone.contains(mode) || self.rigid.contains(mode);
        all.filter(|mode| !has_none(mode)).collect()
    }
}

/// Reads a test from the bytes of a file that errors call `name`: a Universal File when its first line is `-1`, otherwise CSV.
///
/// # Errors
/// [`FileError::DeckLine`] names file and line; [`Error::Value`], [`Error::Count`] and [`Error::Duplicate`] for what no test can have: a
/// negative frequency or deviation, a shape that is zero, no mode, a sensor twice.
pub fn read(name: &str, bytes: &[u8]) -> Result<TestData, FileError> {
    // A Universal File may hold datasets in binary.
    let is_marked = bytes.trim_ascii_start().starts_with(b"-1");
    let text = if is_marked {
        decoded(bytes)
    } else {
        readable(name, bytes)?
    };
    let first = text.lines().map(str::trim).find(|line| !line.is_empty());
    let mut data = if first == Some("-1") {
        universal::read(name, &text)?
    } else {
        csv::read(name, &text)?
    };
    let hertz = data.frequencies_hz.iter().enumerate();
    let still = hertz.filter(|(_, hertz)| **hertz == 0.0);
    data.rigid = still.map(|(mode, _)| mode).collect();
    data.alone.retain(|mode| !data.rigid.contains(mode));
    data.check()?;
    Ok(data)
}

/// A name for a sensor that has none.
fn default_name(grid: usize, direction: usize) -> String {
    format!("{grid} {}", DIRECTIONS.get(direction).unwrap_or(&"?"))
}
