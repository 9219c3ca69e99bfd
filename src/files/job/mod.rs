//! A job: the model, the test and the settings of a correlation of the user's own structure, as one TOML file names them.
//!
//! [`read`] reads the file alone; [`Prepared::new`] reads what it names, puts model and test together, and is what a correlation
//! starts from. [`TEMPLATE`] is a job with every entry explained.

mod matrices;
mod model;
mod prepare;
mod run;
mod samples;
mod sensors;
mod study;

pub use model::{Geometry, ModelSource};
pub use prepare::Prepared;
pub use run::{Finished, History, run};
pub use samples::{Samples, Spread, Summary};
pub use sensors::PlacedSensor;
pub use study::{Study, Vary};

use crate::files::error::FileError;
use crate::method::outer_loop::Settings;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// A job that explains its entries.
pub const TEMPLATE: &str = include_str!("template.toml");

/// A test as a table that explains itself.
pub const TEST_TEMPLATE: &str = include_str!("template.csv");

/// What a job file says.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Job {
    /// What reports call the structure; the file's name if not given.
    pub title: Option<String>,
    /// The model's files.
    pub model: ModelFiles,
    /// The test's file, and what is taken of it.
    pub test: TestFile,
    /// Where the sensors are on the model.
    #[serde(default)]
    pub sensors: SensorRules,
    /// What may change.
    #[serde(rename = "parameter", default)]
    pub parameters: Vec<ParameterRule>,
    /// What is compared.
    #[serde(default)]
    pub compare: Compare,
    /// How the correlation steps and stops.
    #[serde(default)]
    pub correlation: Settings,
}

/// The model: a NASTRAN deck, or matrices.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelFiles {
    /// The deck.
    pub deck: Option<PathBuf>,
    /// Cards of the deck that are left out although they are not understood.
    #[serde(default)]
    pub ignore: Vec<String>,
    /// $K$ as Matrix Market, DMIG or OUTPUT4.
    pub stiffness: Option<PathBuf>,
    /// $M$ in the same way.
    pub mass: Option<PathBuf>,
    /// Which row of the matrices is which grid and direction, and where the grid is: a table `grid,direction,x,y,z`, of which the
    /// coordinates may be missing. Matrices that name their rows need none.
    pub rows: Option<PathBuf>,
}

/// The test.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TestFile {
    /// A Universal File or a table.
    pub file: PathBuf,
    /// Which of its modes, counted from one; all if not given.
    pub modes: Option<Vec<usize>>,
    /// Whether Appendix B makes them fit: orthogonalized with the mass at the sensors, and those deleted that move too much.
    #[serde(default)]
    pub orthogonalize: bool,
}

/// How sensors are found on the model.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SensorRules {
    /// By what they are matched.
    #[serde(default)]
    pub by: SensorRule,
    /// Largest distance of a sensor from its grid, in units of length.
    pub distance: Option<f64>,
    /// Names of sensors that are not used.
    #[serde(default)]
    pub leave_out: Vec<String>,
    /// Sensors whose place is given here, whatever the rule.
    #[serde(default)]
    pub place: Vec<SensorPlace>,
}

/// By what sensors are matched with the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SensorRule {
    /// The test's grid numbers are the model's.
    #[default]
    Grid,
    /// The nearest grid of the model that moves in the sensor's direction.
    Nearest,
    /// Only sensors with a place of their own in the job are used.
    Name,
}

/// The place of one sensor.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SensorPlace {
    /// Its name in the test.
    pub sensor: String,
    /// The model's grid.
    pub grid: usize,
    /// `x`, `y` or `z`, with a minus sign in front where the sensor points the other way.
    pub direction: String,
}

/// What one parameter scales.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ParameterRule {
    /// What it is called; with `each`, what stands in front of every element's number.
    pub name: String,
    /// Numbers of elements, or ranges of them such as `"10-19"`.
    #[serde(default)]
    pub elements: Vec<Labels>,
    /// Numbers of properties whose elements belong to it.
    #[serde(default)]
    pub properties: Vec<usize>,
    /// Numbers of materials whose elements belong to it.
    #[serde(default)]
    pub materials: Vec<usize>,
    /// Numbers of point masses.
    #[serde(default)]
    pub masses: Vec<Labels>,
    /// A file with its part of the first stiffness or mass, where the model is given by matrices.
    pub matrix: Option<PathBuf>,
    /// Whether the stiffness or the mass of what is named is scaled.
    #[serde(default)]
    pub scales: Scales,
    /// Whether every element named is a parameter of its own.
    #[serde(default)]
    pub each: bool,
    /// Least factor.
    pub lower: Option<f64>,
    /// Largest factor.
    pub upper: Option<f64>,
    /// Least gage or area of each of its elements, of a deck.
    pub lower_size: Option<f64>,
    /// Largest.
    pub upper_size: Option<f64>,
}

/// One number or a range of them.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(untagged)]
pub enum Labels {
    /// One.
    One(usize),
    /// From the first to the last, such as `10-19`.
    Range(String),
}

/// What a parameter scales.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scales {
    /// The stiffness.
    #[default]
    Stiffness,
    /// The mass.
    Mass,
}

/// What is compared, and how.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Compare {
    /// Which modes of the model.
    #[serde(default)]
    pub modes: ComparedModes,
    /// How many modes of the model; if not given, as many as the test has and half as many again, at least four more.
    pub analysis_modes: Option<usize>,
    /// How they are paired.
    #[serde(default)]
    pub pairing: PairingRule,
    /// Modal assurance below which a test mode has no partner at the start and is left out; one half if not given.
    pub floor: Option<f64>,
    /// How the factors are found.
    #[serde(default)]
    pub method: Method,
    /// Standard deviation of every frequency, a fraction, where the test has none of its own.
    pub frequency_deviation: Option<f64>,
    /// Standard deviation of every shape, a fraction of its largest component, where the test has none of its own.
    pub shape_deviation: Option<f64>,
    /// Weights of the frequencies, one a test mode: on top of their deviations, or of the paper's frequency errors.
    pub frequency_weights: Option<Vec<f64>>,
    /// Weights of the shapes in the same way.
    pub shape_weights: Option<Vec<f64>>,
    /// How many first points are tried by Gauss–Newton steps.
    pub starts: Option<usize>,
    /// The seed of the first points after the model's own.
    #[serde(default)]
    pub seed: u64,
}

/// Which modes of the model are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ComparedModes {
    /// Those of the whole model, as the sensors see them: no condensation, and a structure may hang free.
    #[default]
    Whole,
    /// Those of the model condensed to the sensors, as in the paper: faster where there are few sensors, and right when all mass
    /// is there.
    Condensed,
}

/// How test modes are paired with the model's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PairingRule {
    /// The paper's: the closest pair first, then the closest of what is left.
    Closest,
    /// The pairs with the largest sum of modal assurance.
    #[default]
    Optimal,
}

/// How factors are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// The paper's two loops.
    #[default]
    Paper,
    /// Bounded Gauss–Newton steps on residuals weighted by their standard deviations.
    GaussNewton,
}

/// Reads a job file.
///
/// # Errors
/// [`FileError::File`] when it cannot be read; [`FileError::Job`] naming line and entry that are not understood.
pub fn read(path: &Path) -> Result<Job, FileError> {
    let text = std::fs::read_to_string(path).map_err(FileError::of_file(path, "read"))?;
    let wrong = |error: toml::de::Error| FileError::job(path, "a job as corfem init explains it", error.to_string());
    toml::from_str(&text).map_err(wrong)
}

/// The numbers that a list names.
///
/// # Errors
/// [`FileError::Job`] for a range that is none.
pub(crate) fn labels(path: &Path, list: &[Labels]) -> Result<Vec<usize>, FileError> {
    let mut all = Vec::new();
    for labels in list {
        match labels {
            Labels::One(label) => all.push(*label),
            Labels::Range(text) => {
                let ends = text
                    .split_once('-')
                    .map(|(first, last)| (first.trim().parse::<usize>(), last.trim().parse::<usize>()));
                match ends {
                    Some((Ok(first), Ok(last)))
                        if first <= last && last - first < MOST_LABELS.saturating_sub(all.len()) =>
                    {
                        all.extend(first..=last)
                    }
                    _ => return Err(FileError::job(path, "a range of numbers such as \"10-19\"", text.clone())),
                }
            }
        }
    }
    Ok(all)
}

/// Most numbers in one list, against a slip of the finger that fills the memory.
const MOST_LABELS: usize = 10_000_000;
