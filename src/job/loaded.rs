//! What a job names, read and matched: its first value.

use super::{
    Job, ModelSource, PreparedJob,
    matrices::from_matrices,
    model::from_deck,
    read,
    sensors::{PlacedSensor, place},
};
use crate::{
    files::{
        deck::rewrite,
        error::FileError,
        matrices::{write_dmig, write_matrix_market},
        test_data::TestData,
    },
    method::{
        error::{Error, at_least_one},
        modes::Modes,
    },
    sparse::{SparseMatrix, WholeShare, no_modes},
    weighted::{noise::Noise, residuals::DEVIATIONS},
};
use std::{collections::BTreeMap, path::Path};

/// A job with everything it names read and matched.
#[derive(Debug, Clone)]
pub struct LoadedJob {
    /// What the job's file says.
    pub job: Job,
    /// Name of the structure in reports.
    pub title: String,
    /// The model.
    pub source: ModelSource,
    /// The test as its file has it.
    pub data: TestData,
    /// Its sensors on the model.
    pub placed: Vec<PlacedSensor>,
    /// Matrix that reads them off the model (sensors × DOF).
    pub sensors: SparseMatrix,
    /// Numbers of the test modes that the job selects.
    pub(super) numbers: Vec<usize>,
    /// Selected test modes, from zero, of which a frequency alone is known, ascending, with their partners in the first model.
    pub alone: Vec<(usize, usize)>,
}

impl LoadedJob {
    /// Reads a job and what it names, and places the sensors.
    ///
    /// # Errors
    /// The errors of the files; [`FileError::Refused`] for modes that the test does not have or that are named twice, and for partners
    /// that do not fit.
    pub fn new(path: &Path) -> Result<Self, FileError> {
        let job = read(path)?;
        let data = job.measured()?;
        let mut source = load(&job)?;
        let (placed, mut sensors) = place(&job, &data, &source)?;
        // Frequencies alone are paired by their numbers among all modes.
        if data.alone.is_empty()
            && let Some(watched) = source.watched(&sensors)?
        {
            (source, sensors) = watched;
        }
        let parameters = source.whole.parameters().iter();
        job.once(parameters.map(|parameter| &parameter.name), "parameter")?;
        let numbers = selected(&job, &data)?;
        Ok(Self {
            alone: lone_partners(&job, &data, &numbers)?,
            title: job.title.clone().unwrap_or_else(|| {
                let name = path.file_stem().unwrap_or_default();
                name.to_string_lossy().into_owned()
            }),
            job,
            source,
            data,
            placed,
            sensors,
            numbers,
        })
    }

    /// The same job with the first model's modes and the test modes' partners among them.
    ///
    /// # Errors
    /// The errors of the first analysis; [`FileError::Refused`] for settings that do not go together and weights that are not one a
    /// test mode.
    pub fn prepare(self) -> Result<PreparedJob, FileError> {
        PreparedJob::new(self)
    }

    /// Selected test modes with shapes, from zero, ascending in frequency.
    pub(super) fn shaped(&self) -> Vec<usize> {
        let mut modes: Vec<usize> = self
            .numbers
            .iter()
            .map(|mode| mode - 1)
            .filter(|mode| !self.data.alone.contains(mode))
            .collect();
        ascend(&mut modes, &self.data);
        modes
    }

    /// Number of modes to take where the job does not say: half as many again as test modes or partners, and at least four more.
    pub(super) fn usual_modes(&self) -> usize {
        let usual = self
            .alone
            .iter()
            .map(|own| own.1 + 1)
            .fold(self.numbers.len(), usize::max);
        usual + (usual / 2).max(4)
    }

    /// Test modes (from zero, by their places in the file) at the placed sensors.
    ///
    /// # Errors
    /// The errors of [`Modes::from_measured`].
    pub(super) fn measured(&self, modes: &[usize]) -> Result<Modes, Error> {
        if modes.is_empty() {
            return Ok(no_modes(self.sensors.rows()));
        }
        let rows: Vec<usize> = self.placed.iter().map(|sensor| sensor.row).collect();
        let mut shapes = self.data.shapes.select_rows(&rows).select_columns(modes);
        for (mut row, sensor) in shapes.row_iter_mut().zip(&self.placed) {
            row *= sensor.sign;
        }
        Modes::from_measured(
            &modes
                .iter()
                .map(|&mode| self.data.frequencies_hz[mode])
                .collect::<Vec<_>>(),
            &shapes,
        )
    }

    /// Standard deviations of a mode of the test's file, from zero: the test's own, else the job's, else 0.5 % and 2 %.
    pub fn deviations(&self, mode: usize) -> Noise {
        let [frequency, shape] = self.given_deviations(mode);
        Noise {
            frequency: frequency.unwrap_or(DEVIATIONS.frequency),
            shape: shape.unwrap_or(DEVIATIONS.shape),
        }
    }

    /// Those of its frequency and of its shape that the test or the job gives; of components' own the root of their mean square.
    pub(super) fn given_deviations(&self, mode: usize) -> [Option<f64>; 2] {
        let (data, compare) = (&self.data, &self.job.compare);
        let own = |own: &Option<Vec<f64>>| own.as_ref().and_then(|own| own.get(mode).copied());
        let mean = data
            .component_deviation
            .get(&mode)
            .map(|all| (all.norm_squared() / all.len() as f64).sqrt());
        [
            own(&data.frequency_deviation).or(compare.frequency_deviation),
            mean.or(own(&data.shape_deviation))
                .or(compare.shape_deviation),
        ]
    }

    /// The corrected model's files, by name: the deck with elements and point masses scaled by `factors` and every other byte as it was, or
    /// stiffness and mass of all rows, as DMIG where they came so and else in the Matrix Market's format.
    ///
    /// A factor on stiffness changes an element's size and takes its density down by as much; one on mass changes its density.
    ///
    /// # Errors
    /// Those of [`rewrite`] and of [`WholeModel::at`](crate::sparse::WholeModel::at).
    pub fn corrected_model(&self, factors: &[f64]) -> Result<Vec<(String, Vec<u8>)>, FileError> {
        let ModelSource {
            all, labels, dmig, ..
        } = &self.source;
        let Some((bytes, _)) = &self.source.deck else {
            let (stiffness, mass) = all.at(factors)?;
            let both = [("stiffness", stiffness), ("mass", mass)].into_iter();
            let written = both.zip(dmig).map(|((file, matrix), name)| {
                let (end, text) = match name {
                    Some(name) if !labels.is_empty() => ("pch", write_dmig(name, labels, &matrix)?),
                    _ => ("mtx", write_matrix_market(&matrix)),
                };
                Ok((format!("{file}.{end}"), text.into_bytes()))
            });
            return written.collect();
        };
        let (mut elements, mut masses) = (BTreeMap::new(), BTreeMap::new());
        let parameters = self.source.whole.parameters().iter();
        let parameters = parameters.zip(&self.source.members).zip(factors);
        for ((own, members), factor) in parameters {
            for label in &members.masses {
                *masses.entry(*label).or_insert(1.0) *= factor;
            }
            for label in &members.elements {
                let [size, density] = elements.entry(*label).or_insert([1.0; 2]);
                if matches!(own.share, WholeShare::Stiffness(_)) {
                    (*size, *density) = (*size * factor, *density / factor);
                } else {
                    *density *= factor;
                }
            }
        }
        let name = self.job.model.deck.iter().map(|path| path.display());
        let name: String = name.map(|name| name.to_string()).collect();
        let deck = rewrite(&name, bytes, &elements, &masses)?;
        Ok(vec![("corrected.bdf".to_owned(), deck)])
    }

    /// Names of the parameters.
    pub fn parameter_names(&self) -> impl Iterator<Item = &str> {
        self.source
            .whole
            .parameters()
            .iter()
            .map(|parameter| &parameter.name[..])
    }

    /// The first factors.
    pub(crate) fn ones(&self) -> Vec<f64> {
        vec![1.0; self.source.whole.parameters().len()]
    }
}

/// Numbers of the test modes that the job selects.
fn selected(job: &Job, data: &TestData) -> Result<Vec<usize>, FileError> {
    let (test, compare, available) = (&job.test, &job.compare, data.frequencies_hz.len());
    let numbers = test.modes.clone().unwrap_or_else(|| data.vibrations());
    for mode in &numbers {
        job.ensure((1..=available).contains(mode), || {
            format!("test.modes: there is no mode {mode}; the test has 1 to {available}")
        })?;
        job.ensure(!data.rigid.contains(&(mode - 1)), || {
            format!(
                "test.modes: mode {mode} has a frequency of 0 Hz; a rigid-body mode is not compared"
            )
        })?;
    }
    at_least_one("test modes", numbers.len())?;
    job.once(numbers.iter(), "test.modes: mode")?;
    job.once(test.hold_out.iter(), "test.hold_out: mode")?;
    for mode in &test.hold_out {
        job.ensure(numbers.contains(mode), || {
            format!("test.hold_out: mode {mode} is none of the test modes that are compared")
        })?;
    }
    let named = numbers.len();
    job.ensure(
        test.hold_out.len() != named,
        || "test.hold_out: a mode at least must be left to fit",
    )?;
    let count = |list: &Option<Vec<f64>>| list.as_ref().map_or(named, Vec::len);
    for (what, count) in [
        (
            "compare.frequency_weights",
            count(&compare.frequency_weights),
        ),
        ("compare.shape_weights", count(&compare.shape_weights)),
        (
            "test.partners",
            test.partners.as_ref().map_or(named, Vec::len),
        ),
    ] {
        job.ensure(count == named, || {
            format!("{what}: {count} given for {named} test modes")
        })?;
    }
    Ok(numbers)
}

/// Puts test modes in ascending frequency.
pub fn ascend(modes: &mut [usize], data: &TestData) {
    let hertz = &data.frequencies_hz;
    modes.sort_by(|&a, &b| hertz[a].total_cmp(&hertz[b]));
}

/// The selected test modes without shapes, ascending in frequency, with their partners: those that the job names, else of the same place.
fn lone_partners(
    job: &Job,
    data: &TestData,
    numbers: &[usize],
) -> Result<Vec<(usize, usize)>, FileError> {
    let partners = job.test.partners.iter().flatten().copied();
    let named: Vec<(usize, usize)> = numbers.iter().map(|mode| mode - 1).zip(partners).collect();
    for (mode, partner) in &named {
        job.ensure(data.alone.contains(mode) == (*partner > 0), || {
            let what = match partner {
                0 => "has a frequency alone; name its mode of the model, from 1",
                _ => "is paired by its shape; 0 stands for it",
            };
            format!("test.partners: test mode {} {what}", mode + 1)
        })?;
    }
    let partners = named.iter().map(|own| own.1).filter(|partner| *partner > 0);
    job.once(partners, "test.partners: mode")?;
    let vibrations = data.vibrations().into_iter();
    let mut ascending: Vec<usize> = vibrations.map(|number| number - 1).collect();
    ascend(&mut ascending, data);
    let alone = ascending.into_iter().enumerate();
    let alone = alone.filter(|own| data.alone.contains(&own.1) && job.selects(own.1 + 1));
    let partner = |(place, mode): (usize, usize)| {
        let own = named.iter().find(|own| own.0 == mode);
        (mode, own.map_or(place, |own| own.1 - 1))
    };
    Ok(alone.map(partner).collect())
}

/// Reads the model of a job.
fn load(job: &Job) -> Result<ModelSource, FileError> {
    match (&job.model.deck, &job.model.stiffness, &job.model.mass) {
        (Some(deck), None, None) => from_deck(job, &job.beside(deck)),
        (None, Some(stiffness), Some(mass)) => from_matrices(job, stiffness, mass),
        _ => Err(job.refused("[model] must name either a deck, or both stiffness and mass")),
    }
}
