//! A job: the model, the test and the settings of a correlation of the user's own structure, as one TOML file names them.
//!
//! Each step makes a value that the next one takes: [`LoadedJob::new`] reads what the file names and places the sensors;
//! [`LoadedJob::prepare`] analyses the first model and pairs the test modes with its modes; [`run`] looks for the factors and judges
//! them. [`TEMPLATE`] is a job with every entry explained.

mod bodies;
pub(crate) mod concerns;
mod inputs;
#[doc(hidden)]
pub mod localization;
mod matrices;
mod model;
mod next_measurement;
#[doc(hidden)]
mod pairs;
#[doc(hidden)]
pub mod preflight;
mod repeats;
mod sensors;
// The four values of a job, in their order, and what is said of them.
pub mod concern;
mod correlated;
mod judged;
mod loaded;
mod prepared;
mod reach;
pub mod verdict;

#[doc(hidden)]
pub use bodies::of_bodies;
pub use concern::{Check, Concern, Trust};
pub use correlated::{CorrelatedJob, History};
pub use judged::{HeldOut, JobResult, run};
pub use loaded::LoadedJob;
#[doc(hidden)]
pub use matrices::matrix_modes;
pub use model::{Members, ModelSource};
pub use next_measurement::{NextMeasurement, mean_deviation};
pub use prepared::PreparedJob;
pub use reach::LeftOut;
pub use sensors::PlacedSensor;

use crate::{
    files::{
        disk::file_of,
        error::{FileError, is_not},
        read_bytes,
        text::decoded,
    },
    method::{
        inner_loop::InnerSettings,
        outer_loop::Settings,
        step::{Bounds, StepRule},
    },
};
use serde::Deserialize;
use std::{
    collections::BTreeSet,
    fmt::Display,
    path::{Path, PathBuf},
};

/// A job that explains its entries.
pub const TEMPLATE: &str = include_str!("template.toml");

/// A test as a table that explains itself.
pub const TEST_TEMPLATE: &str = include_str!("template.csv");

/// Content of a job file; [`TEMPLATE`] explains every entry.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Job {
    #[serde(skip)]
    path: PathBuf,
    /// Text of the job's file.
    #[serde(skip)]
    pub text: String,
    /// Name of the structure in reports; the file's name if not given.
    pub title: Option<String>,
    model: ModelFiles,
    test: TestFile,
    #[serde(default)]
    sensors: SensorRules,
    #[serde(rename = "parameter", default)]
    parameters: Vec<ParameterRule>,
    /// Rules of the comparison.
    #[serde(default)]
    pub compare: Compare,
    /// Settings of the correlation's steps and of its end.
    #[serde(default, with = "CorrelationEntries")]
    pub correlation: Settings,
}

#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct ModelFiles {
    deck: Option<PathBuf>,
    ignore: Vec<String>,
    stiffness: Option<PathBuf>,
    mass: Option<PathBuf>,
    rows: Option<PathBuf>,
    rigid_bodies: Option<usize>,
}

#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct TestFile {
    file: Option<PathBuf>,
    repeats: Vec<PathBuf>,
    modes: Option<Vec<usize>>,
    hold_out: Vec<usize>,
    partners: Option<Vec<usize>>,
}

#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct SensorRules {
    by: SensorRule,
    distance: Option<f64>,
    leave_out: Vec<String>,
    place: Vec<SensorPlace>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
enum SensorRule {
    #[default]
    Grid,
    Nearest,
    Name,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct SensorPlace {
    sensor: String,
    grid: usize,
    direction: String,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct ParameterRule {
    name: String,
    #[serde(default)]
    elements: Vec<Labels>,
    #[serde(default)]
    properties: Vec<usize>,
    #[serde(default)]
    materials: Vec<usize>,
    #[serde(default)]
    masses: Vec<Labels>,
    matrix: Option<PathBuf>,
    /// The whole model's stiffness or mass with the parameter at another factor.
    stiffness: Option<PathBuf>,
    mass: Option<PathBuf>,
    /// Factor that it has there.
    at: Option<f64>,
    #[serde(default)]
    scales: Scales,
    #[serde(default)]
    each: bool,
    lower: Option<f64>,
    upper: Option<f64>,
    prior_deviation: Option<f64>,
}

/// One number, or a range such as `10-19`.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(untagged)]
enum Labels {
    One(usize),
    Range(String),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Scales {
    #[default]
    Stiffness,
    Mass,
}

/// Rules of the comparison with the test.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Compare {
    analysis_modes: Option<usize>,
    /// Method that finds the factors.
    pub method: Method,
    frequency_deviation: Option<f64>,
    shape_deviation: Option<f64>,
    prior_deviation: Option<f64>,
    frequency_weights: Option<Vec<f64>>,
    shape_weights: Option<Vec<f64>>,
    /// Number of first points that Gauss–Newton steps start from; one if not given.
    pub starts: Option<usize>,
    /// The seed of the first points after the model's own.
    pub seed: u64,
}

/// Entries of `[correlation]`; skipped fields keep the library's value.
#[derive(Deserialize)]
#[serde(
    remote = "Settings",
    default = "Settings::default",
    deny_unknown_fields
)]
pub struct CorrelationEntries {
    #[serde(with = "InnerEntries")]
    inner: InnerSettings,
    later_inner_tolerance: f64,
    error_sum_tolerance: f64,
    frequency_tolerance: f64,
    shape_tolerance: f64,
    #[serde(skip)]
    least_passes: usize,
    most_passes: usize,
}

#[derive(Deserialize)]
#[serde(
    remote = "InnerSettings",
    default = "InnerSettings::default",
    deny_unknown_fields
)]
struct InnerEntries {
    #[serde(skip)]
    first_relaxation: f64,
    #[serde(skip)]
    relaxation: f64,
    factor_range: Bounds,
    tolerance: f64,
    #[serde(skip)]
    halvings: usize,
    #[serde(skip)]
    iterations: usize,
    step: StepRule,
}

/// Method that finds factors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// The paper's two loops.
    Paper,
    /// Bounded Gauss–Newton steps on residuals weighted by their standard deviations.
    #[default]
    GaussNewton,
}

/// Most numbers in one list, against a slip of the finger that fills the memory.
const MOST_LABELS: usize = 10_000_000;

/// Files of a result, those of the corrected model last.
pub const FILES: [&str; 11] = [
    "report.html",
    "factors.csv",
    "shapes.csv",
    "shapes.unv",
    "modes.csv",
    "correlation.json",
    "corrected.bdf",
    "stiffness.mtx",
    "mass.mtx",
    "stiffness.pch",
    "mass.pch",
];

/// Refuses a report and a folder of [`FILES`] over what a run reads: files that are named, or those of a job. One that cannot be read is
/// refused where it is needed. A file of two names keeps the other one when it is replaced.
///
/// # Errors
/// [`FileError::Refused`] naming the file.
pub fn spare(
    job: Option<&PathBuf>,
    named: [Option<&PathBuf>; 4],
    [file, folder]: [Option<&PathBuf>; 2],
) -> Result<(), FileError> {
    let job = job.and_then(|job| read(job).ok());
    let named = named.into_iter().flatten().cloned();
    let inputs = named.chain(job.iter().flat_map(Job::inputs));
    let read: Vec<_> = inputs
        .flat_map(|own| file_of(&own).canonicalize())
        .collect();
    let results = folder
        .into_iter()
        .flat_map(|own| FILES.map(|name| own.join(name)));
    for path in results.chain(file.cloned()) {
        if path.canonicalize().is_ok_and(|own| read.contains(&own)) {
            return Err(FileError::refused(
                path.display(),
                "this run reads it and would overwrite it; name another folder or file",
            ));
        }
    }
    Ok(())
}

/// Reads a job file.
///
/// # Errors
/// [`FileError::File`] when it cannot be read; [`FileError::Refused`] for an entry that jobs no longer have, and
/// naming line and entry that are not understood.
pub fn read(path: &Path) -> Result<Job, FileError> {
    let text = decoded(&read_bytes(path).map_err(FileError::of_file(path, "read"))?).into_owned();
    match toml::from_str(&text) {
        Ok(job) => Ok(Job {
            path: path.to_owned(),
            text,
            ..job
        }),
        Err(error) => Err(FileError::refused(
            path.display(),
            format!(
                "{}\n(corfem init explains every entry)",
                error.to_string().trim_end()
            ),
        )),
    }
}

impl Job {
    /// A path that the job names, from the job's own folder.
    fn beside(&self, named: &Path) -> PathBuf {
        self.path
            .parent()
            .map_or_else(|| named.to_owned(), |folder| folder.join(named))
    }

    /// Paths of all that it reads, its own last.
    pub fn inputs(&self) -> impl Iterator<Item = PathBuf> {
        let ModelFiles {
            deck,
            stiffness,
            mass,
            rows,
            ..
        } = &self.model;
        let named = [deck, stiffness, mass, rows, &self.test.file]
            .into_iter()
            .flatten();
        let parts = self
            .parameters
            .iter()
            .flat_map(|rule| [&rule.matrix, &rule.stiffness, &rule.mass])
            .flatten();
        named
            .chain(parts)
            .chain(&self.test.repeats)
            .map(|file| self.beside(file))
            .chain([self.path.clone()])
    }

    /// True if the job selects the test mode of this number.
    fn selects(&self, mode: usize) -> bool {
        self.test
            .modes
            .as_ref()
            .is_none_or(|modes| modes.contains(&mode))
    }

    /// The bytes of a file that an entry names.
    fn bytes(&self, file: &Path, entry: &str) -> Result<Vec<u8>, FileError> {
        let job = self.path.file_name().unwrap_or_default();
        read_bytes(file).map_err(|source| FileError::File {
            path: file.to_owned(),
            action: "read",
            named: format!(" ({entry} in {})", job.display()),
            source,
        })
    }

    fn refused(&self, reason: impl Into<String>) -> FileError {
        FileError::refused(self.path.display(), reason)
    }

    /// Refuses what is not met.
    fn ensure<S: Into<String>>(
        &self,
        is_met: bool,
        reason: impl FnOnce() -> S,
    ) -> Result<(), FileError> {
        if is_met {
            Ok(())
        } else {
            Err(self.refused(reason()))
        }
    }

    /// Refuses a second entry of the same name.
    fn once(
        &self,
        mut all: impl Iterator<Item = impl Copy + Ord + Display>,
        what: &str,
    ) -> Result<(), FileError> {
        let mut seen = BTreeSet::new();
        all.try_for_each(|one| {
            self.ensure(seen.insert(one), || format!("{what} {one} is named twice"))
        })
    }

    /// The numbers that a list names.
    fn labels(&self, list: &[Labels]) -> Result<BTreeSet<usize>, FileError> {
        let mut all = BTreeSet::new();
        for labels in list {
            let (first, last) = match labels {
                Labels::One(label) => (*label, *label),
                Labels::Range(text) => {
                    let number = |text: &str| text.trim().parse::<usize>().ok();
                    let ends = text.split_once('-');
                    ends.and_then(|(first, last)| number(first).zip(number(last)))
                        .filter(|(first, last)| first <= last && last - first < MOST_LABELS)
                        .ok_or_else(|| {
                            let what = "a range of at most ten million numbers such as \"10-19\"";
                            self.refused(is_not(text, what))
                        })?
                }
            };
            all.extend(first..=last);
        }
        Ok(all)
    }
}
