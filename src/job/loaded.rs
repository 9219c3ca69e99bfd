//! What a job names, read and matched: its first value.

use super::matrices::from_matrices;
use super::model::from_deck;
use super::sensors::{PlacedSensor, place};
use super::{Job, Method, ModelSource, PreparedJob, read};
use crate::files::deck::rewrite;
use crate::files::error::{FileError, ensure};
use crate::files::matrices::{write_dmig, write_matrix_market};
use crate::files::test_data::TestData;
use crate::method::error::{Error, at_least_one};
use crate::method::modes::Modes;
use crate::sparse::{Place, SparseMatrix, WholeParameter, WholeShare, no_modes};
use crate::weighted::comparison::LoneFrequency;
use crate::weighted::noise::Noise;
use crate::weighted::residuals::DEVIATIONS;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// A job with everything it names read and matched.
#[derive(Debug, Clone)]
pub struct LoadedJob {
    /// What the job's file says.
    pub job: Job,
    /// Name of the structure in reports.
    pub title: String,
    /// The model, which all samples of a study share.
    pub source: Arc<ModelSource>,
    /// The test as its file has it.
    pub data: TestData,
    /// Its sensors on the model.
    pub placed: Vec<PlacedSensor>,
    /// Matrix that reads them off the model (sensors × DOF).
    pub sensors: SparseMatrix,
    /// Numbers of the test modes that the job selects.
    numbers: Vec<usize>,
    /// Selected test modes, from zero, of which a frequency alone is known, ascending, with their partners in the first model.
    alone: Vec<(usize, LoneFrequency)>,
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
        let source = Arc::new(load(&job)?);
        Self::with(job, data, source)
    }

    /// A job whose files are read, for a test that is not on file, such as a sample of a study.
    pub(super) fn with(
        job: Job,
        data: TestData,
        source: Arc<ModelSource>,
    ) -> Result<Self, FileError> {
        let (placed, sensors) = place(&job, &data, &source)?;
        let (source, sensors) = watched(source, sensors, &data)?;
        let available = data.frequencies_hz.len();
        let numbers = job.test.modes.clone().unwrap_or_else(|| data.vibrations());
        let refused = |reason: String| job.refused(format!("test.{reason}"));
        for mode in &numbers {
            ensure((1..=available).contains(mode), || {
                refused(format!(
                    "modes: there is no mode {mode}; the test has 1 to {available}"
                ))
            })?;
        }
        for mode in &numbers {
            ensure(!data.rigid.contains(&(mode - 1)), || {
                refused(format!(
                    "modes: mode {mode} has a frequency of 0 Hz; a rigid-body mode is not compared"
                ))
            })?;
        }
        at_least_one("test modes", numbers.len())?;
        job.once(numbers.iter(), "test.modes: mode")?;
        let held = &job.test.hold_out;
        job.once(held.iter(), "test.hold_out: mode")?;
        for mode in held {
            ensure(numbers.contains(mode), || {
                refused(format!(
                    "hold_out: mode {mode} is none of the test modes that are compared"
                ))
            })?;
        }
        ensure(held.len() != numbers.len(), || {
            refused("hold_out: a mode at least must be left to fit".into())
        })?;
        let parameters = source.whole.parameters().iter();
        job.once(parameters.map(|parameter| &parameter.name), "parameter")?;
        let named = numbers.len();
        let lists = [
            ("frequency_weights", &job.compare.frequency_weights),
            ("shape_weights", &job.compare.shape_weights),
        ];
        for (what, list) in lists {
            let count = list.as_ref().map_or(named, Vec::len);
            ensure(count == named, || {
                job.refused(format!(
                    "compare.{what}: {count} given for {named} test modes"
                ))
            })?;
        }
        let alone = lone_frequencies(&job, &data, &numbers)?;
        Ok(Self {
            title: job.title.clone().unwrap_or_else(|| job.stem()),
            job,
            source,
            data,
            placed,
            sensors,
            numbers,
            alone,
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
        let hertz = &self.data.frequencies_hz;
        let selected = self.numbers.iter().map(|mode| mode - 1);
        let mut modes: Vec<usize> = selected
            .filter(|mode| !self.data.alone.contains(mode))
            .collect();
        modes.sort_by(|&a, &b| hertz[a].total_cmp(&hertz[b]));
        modes
    }

    /// Selected test modes without shapes, from zero, ascending, with their partners in the first model.
    pub(super) fn alone(&self) -> &[(usize, LoneFrequency)] {
        &self.alone
    }

    /// Number of modes to take where the job does not say: half as many again as test modes or partners, and at least four more.
    pub(super) fn usual_modes(&self) -> usize {
        let partners = self.alone.iter().map(|(_, lone)| lone.partner + 1);
        let usual = self.numbers.len().max(partners.max().unwrap_or(0));
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
        shapes
            .row_iter_mut()
            .zip(&self.placed)
            .for_each(|(mut row, sensor)| row *= sensor.sign);
        let hertz = modes.iter().map(|&mode| self.data.frequencies_hz[mode]);
        Modes::from_measured(&hertz.collect::<Vec<_>>(), &shapes)
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
        let components = data.component_deviation.get(&mode);
        let mean = components.map(|all| (all.norm_squared() / all.len() as f64).sqrt());
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
        } = &*self.source;
        let Some((bytes, _)) = &self.source.deck else {
            let (stiffness, mass) = all.at(factors)?;
            let both = [("stiffness", stiffness), ("mass", mass)].into_iter();
            let written = both.zip(dmig).map(|((file, matrix), name)| {
                let (end, text) = match name {
                    Some(name) => ("pch", write_dmig(name, labels, &matrix)?),
                    None => ("mtx", write_matrix_market(&matrix)),
                };
                Ok((format!("{file}.{end}"), text.into_bytes()))
            });
            return written.collect();
        };
        let (mut elements, mut masses) = (BTreeMap::new(), BTreeMap::new());
        let parameters = self.source.whole.parameters().iter();
        let parameters = parameters.zip(&self.source.members).zip(factors);
        for ((WholeParameter { share, .. }, members), factor) in parameters {
            for label in &members.masses {
                *masses.entry(*label).or_insert(1.0) *= factor;
            }
            for label in &members.elements {
                let [size, density] = elements.entry(*label).or_insert([1.0; 2]);
                match share {
                    WholeShare::Stiffness(_) => {
                        (*size, *density) = (*size * factor, *density / factor)
                    }
                    WholeShare::Mass(_) => *density *= factor,
                }
            }
        }
        let name = self
            .job
            .model
            .deck
            .as_ref()
            .map_or_else(String::new, |path| path.display().to_string());
        let deck = rewrite(&name, bytes, &elements, &masses)?;
        Ok(vec![("corrected.bdf".to_owned(), deck)])
    }

    /// Names of the parameters.
    pub fn parameter_names(&self) -> impl Iterator<Item = &str> {
        let parameters = self.source.whole.parameters().iter();
        parameters.map(|parameter| &parameter.name[..])
    }

    /// Refuses a job without parameters, which can be looked at but not correlated.
    pub(super) fn require_parameters(&self) -> Result<(), FileError> {
        ensure(!self.source.whole.parameters().is_empty(), || {
            self.job.refused("a job needs at least one [[parameter]]")
        })
    }

    /// The whole model's first analysis, with these modes and those that the pre-flight looks at, which are twice the usual number whatever
    /// the job takes, and some more than it takes, so that the root of the last of them is there with all its modes.
    pub(super) fn analyzed(&self, modes: usize) -> Result<Arc<Place>, Error> {
        let (whole, twice) = (&self.source.whole, 2 * self.usual_modes());
        let most = if modes + 2 < twice { twice } else { modes + 8 };
        whole.exactly(&self.ones(), &self.sensors, modes..=most, None)
    }

    /// The first factors.
    pub(crate) fn ones(&self) -> Vec<f64> {
        vec![1.0; self.source.whole.parameters().len()]
    }

    /// Entries that the job's file gives and that nothing uses, each with what it is of.
    pub(super) fn unused_entries(&self) -> Vec<String> {
        let (job, data) = (&self.job, &self.data);
        let is_deck = self.source.deck.is_some();
        let is_weighted = job.compare.method == Method::GaussNewton;
        let far = self.placed.iter().all(|sensor| sensor.distance.is_none());
        let unused = [
            ("model.ignore", !is_deck, "of decks"),
            ("model.rows", is_deck, "of matrices"),
            ("sensors.distance", far, "of sensors whose place is known"),
            (
                "compare.seed",
                job.compare.starts.is_none_or(|starts| starts == 1),
                "of several starts",
            ),
            (
                "compare.frequency_deviation",
                data.frequency_deviation.is_some(),
                "of a test without its own",
            ),
            (
                "compare.shape_deviation",
                data.shape_deviation.is_some(),
                "of a test without its own",
            ),
            ("correlation.error_sum_tolerance", is_weighted, PAPER),
            ("correlation.frequency_tolerance", is_weighted, PAPER),
            ("correlation.shape_tolerance", is_weighted, PAPER),
            ("correlation.later_inner_tolerance", is_weighted, PAPER),
            ("correlation.most_passes", is_weighted, PAPER),
            ("correlation.inner.step", is_weighted, PAPER),
            ("correlation.inner.factor_range", is_weighted, PAPER),
            ("correlation.inner.tolerance", is_weighted, PAPER),
        ];
        let given = |(entry, is_unused, _): &(&str, bool, &str)| *is_unused && job.gives(entry);
        unused
            .into_iter()
            .filter(given)
            .map(|(entry, _, of)| format!("{entry} ({of})"))
            .collect()
    }
}

/// What takes the entries of `[correlation]`.
const PAPER: &str = "of the paper's loops";

/// The selected test modes without shapes with their partners: those that the job names, else of the same place in ascending order.
fn lone_frequencies(
    job: &Job,
    data: &TestData,
    numbers: &[usize],
) -> Result<Vec<(usize, LoneFrequency)>, FileError> {
    let alone: Vec<usize> = data
        .alone
        .iter()
        .copied()
        .filter(|mode| job.selects(mode + 1))
        .collect();
    let named = job.test.partners.as_deref();
    let (all, count) = (numbers.len(), named.map_or(numbers.len(), <[usize]>::len));
    ensure(count == all, || {
        job.refused(format!("test.partners: {count} given for {all} test modes"))
    })?;
    let pairs = || numbers.iter().zip(named.into_iter().flatten());
    for (mode, &partner) in pairs() {
        ensure(alone.contains(&(mode - 1)) == (partner > 0), || {
            let what = match partner {
                0 => "has a frequency alone; name its mode of the model, from 1",
                _ => "is paired by its shape; 0 stands for it",
            };
            job.refused(format!("test.partners: test mode {mode} {what}"))
        })?;
    }
    job.once(
        pairs()
            .map(|(_, partner)| partner)
            .filter(|partner| **partner > 0),
        "test.partners: mode",
    )?;
    let vibrations = data.vibrations().into_iter();
    let mut ascending: Vec<usize> = vibrations.map(|number| number - 1).collect();
    ascending.sort_by(|&a, &b| data.frequencies_hz[a].total_cmp(&data.frequencies_hz[b]));
    let of_mode = |(place, mode): (usize, usize)| {
        let named = pairs().find(|(number, _)| **number == mode + 1);
        let lone = LoneFrequency {
            frequency_hz: data.frequencies_hz[mode],
            partner: named.map_or(place, |(_, partner)| partner - 1),
        };
        (mode, lone)
    };
    let ascending = ascending.into_iter().enumerate();
    Ok(ascending
        .filter(|(_, mode)| alone.contains(mode))
        .map(of_mode)
        .collect())
}

/// The model without parts that no sensor sees; the whole where frequencies alone are paired by their numbers among all modes.
fn watched(
    source: Arc<ModelSource>,
    sensors: SparseMatrix,
    data: &TestData,
) -> Result<(Arc<ModelSource>, SparseMatrix), FileError> {
    let watched = match data.alone.is_empty() {
        true => source.watched(&sensors)?,
        false => None,
    };
    Ok(match watched {
        Some((watched, sensors)) => (Arc::new(watched), sensors),
        None => (source, sensors),
    })
}

/// Reads the model of a job.
fn load(job: &Job) -> Result<ModelSource, FileError> {
    let mut source = match (&job.model.deck, &job.model.stiffness, &job.model.mass) {
        (Some(deck), None, None) => from_deck(job, &job.beside(deck)),
        (None, Some(stiffness), Some(mass)) => from_matrices(job, stiffness, mass),
        _ => Err(job.refused("[model] must name either a deck, or both stiffness and mass")),
    }?;
    (source.mass, source.mass_center) = source.mass_and_center()?;
    Ok(source)
}
