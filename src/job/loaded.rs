//! Model and test joined: the start of a job's correlation.

use super::bodies::explained;
use super::matrices::from_matrices;
use super::model::from_deck;
use super::sensors::{PlacedSensor, place};
use super::unseen::{decided, pairs};
use super::{Job, Method, ModelSource, read};
use crate::files::error::FileError;
use crate::files::read_bytes;
use crate::files::test_data::TestData;
use crate::job::assignment::pair_optimally;
use crate::job::expansion::mass_by_modes;
use crate::method::analysis::State;
use crate::method::error::{Error, at_least_one, check_count};
use crate::method::modes::Modes;
use crate::method::sorting::Pairing;
use crate::sparse::{
    BasisSize, Deflections, FINITE, Pair, SensorModel, SparseMatrix, Whole, modal_assurance,
    no_modes,
};
use crate::weighted::close_modes::{assurance_of_roots, indistinct_groups};
use crate::weighted::comparison::{Comparison, LoneFrequency};
use nalgebra::DMatrix;
use sha2::{Digest, Sha256};
use std::path::Path;
use std::sync::Arc;

/// Modal assurance below which a test mode counts as without a partner.
pub(super) const FLOOR: f64 = 0.5;

/// A job with everything it names read and matched.
#[derive(Debug, Clone)]
pub struct LoadedJob {
    /// What the job's file says.
    pub job: Job,
    /// What reports call the structure.
    pub title: String,
    /// The model, which all samples of a study share.
    pub source: Arc<ModelSource>,
    /// The test as its file has it.
    pub data: TestData,
    /// Its sensors on the model.
    pub placed: Vec<PlacedSensor>,
    /// Reads them off the model (sensors × DOF).
    pub sensors: SparseMatrix,
    /// The test modes to compare, at the placed sensors.
    pub test: Modes,
    /// Their places in the test's file, from zero, ascending in frequency.
    pub modes: Vec<usize>,
    /// Test modes, from zero, of which a frequency alone is compared, ascending, with their partners in the first model.
    pub alone: Vec<(usize, LoneFrequency)>,
    /// Test modes, from zero, that resemble no mode of the first model, with their largest modal assurance.
    pub unpaired: Vec<(usize, f64)>,
    /// Test modes, from zero, that were left out at first and are compared since.
    pub joined: Vec<usize>,
    /// Test modes, from zero, that several modes of the first model resemble equally, and which are paired in the order of frequencies.
    pub undecided: Vec<usize>,
    /// Identifiers of the doubts that the user answers for.
    pub accepted: Vec<String>,
    /// How many modes of the model are taken.
    pub analysis_modes: usize,
    /// The shapes of these partners as the sensors see them; none before the first analysis.
    partner_shapes: Option<DMatrix<f64>>,
    /// The first analysis.
    first: Option<Arc<dyn Whole>>,
}

/// Residual vectors a parameter, unless the job says how many: more add less than the lowest mode left out.
const RESIDUAL_VECTORS: usize = 4;

impl LoadedJob {
    /// Reads a job and what it names, places the sensors, and pairs the test modes with those of the first model.
    ///
    /// # Errors
    /// Those of the files; [`FileError::Refused`] for modes that the test does not have or that are named twice; those of the first analysis and of [`LoadedJob::weights`].
    pub fn new(path: &Path) -> Result<Self, FileError> {
        let job = read(path)?;
        let data = job.measured()?;
        let source = Arc::new(load(&job)?);
        Self::with(job, data, source)
    }

    /// The same with all files read, for a test that is not on file, such as a sample of a study.
    pub(super) fn with(
        job: Job,
        data: TestData,
        source: Arc<ModelSource>,
    ) -> Result<Self, FileError> {
        let (placed, sensors) = place(&job, &data, &source)?;
        let (source, sensors) = watched(source, sensors, &data)?;
        let available = data.frequencies_hz.len();
        let numbers = job
            .test
            .modes
            .clone()
            .unwrap_or_else(|| (1..=available).collect());
        let unknown = numbers.iter().find(|mode| !(1..=available).contains(*mode));
        job.refuse_if(unknown, |mode| {
            format!("test.modes: there is no mode {mode}; the test has 1 to {available}")
        })?;
        at_least_one("test modes", numbers.len())?;
        job.once(numbers.iter(), "test.modes: mode")?;
        job.once(
            source
                .whole
                .parameters()
                .iter()
                .map(|parameter| &parameter.name),
            "parameter",
        )?;
        let several = job
            .compare
            .starts
            .filter(|&starts| starts > 1 && job.compare.method == Method::Paper);
        job.refuse_if(several, |starts| {
            format!("compare.starts is {starts}, but method \"paper\" has one start")
        })?;
        let mut modes: Vec<usize> = numbers.iter().map(|mode| mode - 1).collect();
        modes.sort_by(|&a, &b| data.frequencies_hz[a].total_cmp(&data.frequencies_hz[b]));
        let alone = lone_frequencies(&job, &data, &numbers)?;
        modes.retain(|mode| !data.alone.contains(mode));
        let test = match &modes[..] {
            [] => no_modes(sensors.rows()),
            modes => measured(&data, &placed, modes)?,
        };
        let partners = alone.iter().map(|(_, lone)| lone.partner + 1);
        let highest = partners.max().unwrap_or(0);
        let usual = numbers.len().max(highest);
        let usual = usual + (usual / 2).max(4);
        let most = source.whole.dof_count();
        let analysis_modes = job.compare.analysis_modes.unwrap_or(usual.min(most));
        let beyond = (highest > analysis_modes).then_some(highest);
        job.refuse_if(beyond, |highest| {
            format!(
                "test.partners: mode {highest} of the model is not among the {analysis_modes} taken; see compare.analysis_modes"
            )
        })?;
        let mut loaded = Self {
            title: job.title.clone().unwrap_or_else(|| job.stem()),
            job,
            source,
            data,
            placed,
            sensors,
            test,
            modes,
            alone,
            unpaired: Vec::new(),
            joined: Vec::new(),
            undecided: Vec::new(),
            accepted: Vec::new(),
            analysis_modes,
            partner_shapes: None,
            first: None,
        };
        loaded.leave_out_unpaired()?;
        loaded.weights()?;
        Ok(loaded)
    }

    /// The first 128 bits, in hexadecimal, of the SHA-256 digest (FIPS 180-4) of the program's version with what the command line
    /// `adds`, of the files that the job names and of its own, each after the number of its bytes.
    ///
    /// # Errors
    /// [`FileError::File`] when one of them cannot be read any more.
    pub fn identity(&self, adds: &str) -> Result<String, FileError> {
        let job = &self.job;
        let named = job.files().map(|file| job.beside(file));
        let program = format!("{} {adds}", env!("CARGO_PKG_VERSION"));
        let mut digest = Sha256::new();
        let mut add = |bytes: &[u8]| {
            digest.update((bytes.len() as u64).to_be_bytes());
            digest.update(bytes);
        };
        add(program.as_bytes());
        for file in named.chain([job.path.clone()]) {
            // A # may choose one matrix of the file.
            let text = file.to_string_lossy();
            let chosen = text.rsplit_once('#').filter(|_| !file.exists());
            let path = chosen.map_or(&*file, |(file, _)| Path::new(file));
            let bytes = read_bytes(path).map_err(FileError::of_file(path, "read"))?;
            add(&bytes);
        }
        let bytes = digest.finalize();
        Ok(bytes
            .iter()
            .take(16)
            .map(|byte| format!("{byte:02x}"))
            .collect())
    }

    /// Leaves out the test modes that resemble no mode of the first model.
    fn leave_out_unpaired(&mut self) -> Result<(), FileError> {
        let mut first = self.first_analysis();
        // The usual number may be more than the model has.
        if let Err(Error::Count {
            what: FINITE,
            most: available,
            ..
        }) = first
            && self.job.compare.analysis_modes.is_none()
            && available > 0
        {
            self.analysis_modes = available;
            first = self.first_analysis();
        }
        let first = first.map_err(|error| {
            let name = |row| self.source.row_name(row);
            match explained(&error, self.source.whole.rounding(), name) {
                Some(reason) => self.job.refused(reason),
                None => error.into(),
            }
        })?;
        let modes = first.modes(self.analysis_modes)?;
        self.first = Some(first);
        match self.analyze(&self.ones()) {
            // Even with more test modes than the model has modes, the pairs can be judged.
            Err(Error::Count {
                what: "test modes", ..
            })
            | Ok(_) => (),
            Err(other) => return Err(other.into()),
        }
        let partners = self.alone.iter().map(|(_, lone)| lone.partner);
        let partners: Vec<usize> = partners.filter(|mode| *mode < modes.len()).collect();
        self.partner_shapes = Some(modes.shapes.select_columns(&partners));
        let assurance = decided(&assurance_of_roots(&modes, &self.test.shapes)?);
        self.undecided = (0..assurance.ncols())
            .filter(|&mode| {
                let column = assurance.column(mode);
                let most = column.max();
                column.iter().filter(|close| **close == most).count() > 1
            })
            .map(|mode| self.modes[mode])
            .collect();
        let partners = pairs(&assurance, &modes.shapes, FLOOR)?;
        let kept: Vec<usize> = (0..partners.len())
            .filter(|&mode| partners[mode].is_some())
            .collect();
        let left = (0..partners.len()).filter(|&mode| partners[mode].is_none());
        self.unpaired = left
            .map(|mode| (self.modes[mode], assurance.column(mode).max()))
            .collect();
        let twice = self.alone.iter().find_map(|(mode, lone)| {
            let other = partners.iter().position(|own| *own == Some(lone.partner))?;
            Some((mode + 1, self.modes[other] + 1, lone.partner + 1))
        });
        self.job.refuse_if(twice, |(mode, other, partner)| {
            format!(
                "test.partners: mode {partner} of the model is the partner of test mode {mode}, which has a frequency alone, and by its \
                 shape of test mode {other}"
            )
        })?;
        // Without any pair all stay, for the pre-flight to name the mistake.
        if !kept.is_empty() {
            self.test = self.test.select(&kept);
            self.modes = kept.into_iter().map(|mode| self.modes[mode]).collect();
        }
        Ok(())
    }

    /// Selected test modes, from zero, that are not compared, with their largest modal assurance with these modes.
    pub(super) fn unlike(&self, modes: &Modes) -> Result<Vec<(usize, f64)>, FileError> {
        let left: Vec<usize> = self.unpaired.iter().map(|(mode, _)| *mode).collect();
        let left = left.into_iter().filter(|mode| !self.modes.contains(mode));
        let of_mode = |mode: usize| {
            let test = measured(&self.data, &self.placed, &[mode])?;
            Ok((mode, assurance_of_roots(modes, &test.shapes)?.max()))
        };
        left.map(of_mode).collect()
    }

    /// The same job that also compares the test modes left out so far that resemble a mode of this model, each one of its own; none
    /// where none does.
    pub(super) fn joined_by(&self, modes: &Modes) -> Result<Option<Self>, FileError> {
        let left = self.unlike(modes)?;
        if left.is_empty() {
            return Ok(None);
        }
        let left = left.iter().map(|(mode, _)| mode);
        let all: Vec<usize> = self.modes.iter().chain(left).copied().collect();
        let test = measured(&self.data, &self.placed, &all)?;
        let assurance = assurance_of_roots(modes, &test.shapes)?;
        let partners = pairs(&assurance, &modes.shapes, FLOOR)?;
        let (compared, left) = partners.split_at(self.modes.len());
        let left = left.iter().zip(&all[self.modes.len()..]);
        let joined: Vec<usize> = left
            .filter(|(partner, _)| partner.is_some())
            .map(|(_, mode)| *mode)
            .collect();
        if joined.is_empty() || compared.contains(&None) {
            return Ok(None);
        }
        let mut again = self.comparing_too(&joined)?;
        again.joined.extend(joined);
        Ok(Some(again))
    }

    /// The same job that also compares these test modes.
    fn comparing_too(&self, left: &[usize]) -> Result<Self, FileError> {
        let mut again = self.clone();
        again.modes.extend(left);
        let hertz = &self.data.frequencies_hz;
        again.modes.sort_by(|&a, &b| hertz[a].total_cmp(&hertz[b]));
        again.test = measured(&self.data, &self.placed, &again.modes)?;
        Ok(again)
    }

    /// The same job for a look far from the first model, with that model: it compares every selected test mode, those too that resemble no
    /// mode of it, and takes twice as many modes unless the job says how many. Where one parameter is grossly wrong, the modes that
    /// tell of it are neither like those of the model nor made of its lowest.
    ///
    /// A model that has fewer modes is looked at as the job has it.
    ///
    /// # Errors
    /// Those of the test's shapes and of [`LoadedJob::analyze`].
    pub fn far_from_first(&self) -> Result<(Self, Comparison), FileError> {
        let left = self.unpaired.iter().map(|(mode, _)| *mode);
        let left: Vec<usize> = left.filter(|mode| !self.modes.contains(mode)).collect();
        let mut far = match left.is_empty() {
            true => self.clone(),
            false => self.comparing_too(&left)?,
        };
        if self.job.compare.analysis_modes.is_none() {
            let most = self.source.whole.dof_count();
            far.analysis_modes = (2 * self.analysis_modes).min(most);
        }
        far.first = far
            .first
            .filter(|first| first.modes(far.analysis_modes).is_ok());
        match far.analyze(&far.ones()) {
            Ok(first) => Ok((far, first)),
            Err(Error::Count { .. }) => Ok((self.clone(), self.analyze(&self.ones())?)),
            Err(other) => Err(other.into()),
        }
    }

    /// Whether no test mode with a shape has a partner.
    pub(super) fn is_without_pairs(&self) -> bool {
        let is_unpaired = |mode: &usize| self.unpaired.iter().any(|(other, _)| other == mode);
        !self.modes.is_empty() && self.modes.iter().all(is_unpaired)
    }

    /// Refuses a correlation in which no test mode has a partner.
    ///
    /// # Errors
    /// [`FileError::Refused`].
    pub(super) fn check_paired(&self) -> Result<(), FileError> {
        let best = self.unpaired.iter().map(|(_, best)| *best);
        let best = best.reduce(f64::max).filter(|_| self.is_without_pairs());
        self.job.refuse_if(best, |best| {
            format!(
                "no mode of the model is like a test mode: their modal assurance is {best:.3} at most, less than {FLOOR}; \
                 corfem check looks for the mistake"
            )
        })
    }

    /// The mass at the sensors that cross-orthogonality is to be measured with: that of the modes of a model that the test modes are
    /// paired with, whatever other modes are taken; none where these are too alike at the sensors, or a test shape has no part of them.
    pub fn mass_at_sensors(&self, comparison: &Comparison) -> Option<DMatrix<f64>> {
        let (exact, test) = (&comparison.model.exact, &comparison.model.test);
        let paired = exact
            .modes
            .shapes
            .select_columns(&exact.pairing.analysis_mode);
        if !self.is_invertible(&paired, &test.shapes) {
            return None;
        }
        let mass = mass_by_modes(&paired).ok()?;
        test.scaled_with(&mass).ok().map(|_| mass)
    }

    /// True if what the test's noise adds to a cross-orthogonality with these modes is below one by two deviations. A reading's deviation
    /// over the length of its shape is over the least singular value of the modes, of unit length, in the part of a mode of the test
    /// that they hardly tell apart.
    fn is_invertible(&self, paired: &DMatrix<f64>, test: &DMatrix<f64>) -> bool {
        let mut unit = paired.clone();
        unit.column_iter_mut().for_each(|mut shape| {
            shape.normalize_mut();
        });
        let least = match unit.is_empty() {
            true => None,
            false => unit.try_svd(false, false, f64::EPSILON, 10_000),
        };
        let least = least.map_or(0.0, |found| found.singular_values.min());
        let noise = test.column_iter().zip(&self.modes);
        let noise =
            noise.map(|(shape, &mode)| self.deviations(mode).shape * shape.amax() / shape.norm());
        2.0 * noise.fold(0.0, f64::max) < least
    }

    /// Names of the parameters.
    pub fn parameter_names(&self) -> impl Iterator<Item = &str> {
        let parameters = self.source.whole.parameters().iter();
        parameters.map(|parameter| &parameter.name[..])
    }

    /// Refuses a job without parameters, which can be looked at but not correlated.
    pub(super) fn require_parameters(&self) -> Result<(), FileError> {
        let none = self.source.whole.parameters().is_empty().then_some(());
        self.job.refuse_if(none, |()| {
            "a job needs at least one [[parameter]]".to_owned()
        })
    }

    /// The first factors.
    pub(super) fn ones(&self) -> Vec<f64> {
        vec![1.0; self.source.whole.parameters().len()]
    }

    /// The first analysis, with as many modes as the pre-flight looks at.
    pub(super) fn first_analysis(&self) -> Result<Arc<dyn Whole>, Error> {
        let anew = || {
            let (least, most) = (self.analysis_modes, 2 * self.analysis_modes);
            let whole = &self.source.whole;
            whole.exactly(&self.ones(), &self.sensors, least, most)
        };
        self.first.clone().map_or_else(anew, Ok)
    }

    /// The modal model of the loops at the given parameter factors.
    ///
    /// # Errors
    /// Those of [`crate::sparse::WholeModel::analyze`].
    pub fn analyze(&self, factors: &[f64]) -> Result<Comparison, Error> {
        let (whole, test) = (&self.source.whole, (&self.test, pair_by_assignment as Pair));
        let size = BasisSize {
            modes: self.analysis_modes,
            residual_vectors: self.residual_vectors(),
        };
        let model = if factors.iter().all(|&factor| factor == 1.0) {
            let deflections = Deflections::Each(size.residual_vectors);
            SensorModel::of_whole(self.first_analysis()?, size.modes, test, deflections)
        } else {
            whole.analyze(factors, &self.sensors, test, size)
        }?;
        // Gauss-Newton steps have weights of their own.
        match self.job.compare.method {
            Method::Paper => Ok(model.weighted(&self.own_weights())?.into()),
            Method::GaussNewton => {
                let lone = self.followed(&model.exact)?;
                let comparison = Comparison::from(model)
                    .with_groups(self.together())?
                    .with_component_weights(self.component_weights())?
                    .with_lone_frequencies(lone)?;
                match self.covariance() {
                    Some(covariance) => comparison.with_covariance(&covariance),
                    None => Ok(comparison),
                }
            }
        }
    }

    /// Residual vectors a parameter behind the modes, in which the paper's loops follow changes. Weighted steps have deflections of their own.
    fn residual_vectors(&self) -> usize {
        match self.job.compare.method {
            Method::Paper => self
                .job
                .compare
                .residual_vectors
                .unwrap_or(RESIDUAL_VECTORS),
            Method::GaussNewton => 0,
        }
    }

    /// One over the deviations of components where the test gives them, times the mode's ([`LoadedJob::deviations`]), else one. They are
    /// fractions of the largest component of all sensors, which need not be among those placed.
    fn component_weights(&self) -> DMatrix<f64> {
        let rows: Vec<usize> = self.placed.iter().map(|sensor| sensor.row).collect();
        let mut weights = DMatrix::from_element(self.sensors.rows(), self.modes.len(), 1.0);
        for (mut weights, mode) in weights.column_iter_mut().zip(&self.modes) {
            if let Some(deviations) = self.data.component_deviation.get(mode) {
                let shape = self.data.shapes.column(*mode);
                let largest = shape.select_rows(&rows).amax() / shape.amax();
                let scale = self.deviations(*mode).shape * largest;
                weights.copy_from(&deviations.select_rows(&rows).map(|own| scale / own));
            }
        }
        weights
    }

    /// Groups of the test modes with shapes that their frequencies' deviations do not tell apart ([`indistinct_groups`]), by place.
    pub fn together(&self) -> Vec<Vec<usize>> {
        let hertz = self
            .modes
            .iter()
            .map(|&mode| self.data.frequencies_hz[mode]);
        let deviations = self
            .modes
            .iter()
            .map(|&mode| self.deviations(mode).frequency);
        indistinct_groups(&hertz.collect::<Vec<_>>(), &deviations.collect::<Vec<_>>())
    }

    /// The frequencies without shapes, each with the mode of this model that its partner in the first has become: those of the largest
    /// sum of modal assurance with the partners, except modes that a test mode's shape has chosen.
    fn followed(&self, exact: &State) -> Result<Vec<LoneFrequency>, Error> {
        let mut all: Vec<LoneFrequency> = self.alone.iter().map(|(_, lone)| *lone).collect();
        if let Some(first) = self
            .partner_shapes
            .as_ref()
            .filter(|first| first.ncols() > 0)
        {
            let mut assurance = decided(&modal_assurance(&exact.modes.shapes, first)?);
            for &mode in &exact.pairing.analysis_mode {
                assurance.row_mut(mode).fill(-1.0);
            }
            for (lone, partner) in all.iter_mut().zip(pair_optimally(&assurance, 0.0)?) {
                lone.partner = partner.unwrap_or(lone.partner);
            }
        }
        Ok(all)
    }
}

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
    let of_paper = alone
        .first()
        .filter(|_| job.compare.method == Method::Paper);
    job.refuse_if(of_paper, |mode| {
        format!(
            "test mode {} has a frequency alone, and compare.method \"paper\" compares shapes; \"gauss_newton\" needs none",
            mode + 1
        )
    })?;
    let named = job.test.partners.as_deref();
    let other = named
        .map(<[usize]>::len)
        .filter(|&count| count != numbers.len());
    job.refuse_if(other, |count| {
        let all = numbers.len();
        format!("test.partners: {count} given for {all} test modes")
    })?;
    let pairs = || numbers.iter().zip(named.into_iter().flatten());
    let wrong = pairs().find(|&(mode, &partner)| alone.contains(&(mode - 1)) != (partner > 0));
    job.refuse_if(wrong, |(mode, partner)| match partner {
        0 => format!("test.partners: test mode {mode} has a frequency alone; name its mode of the model, from 1"),
        _ => format!("test.partners: test mode {mode} is paired by its shape; 0 stands for it"),
    })?;
    job.once(
        pairs()
            .map(|(_, partner)| partner)
            .filter(|partner| **partner > 0),
        "test.partners: mode",
    )?;
    let mut ascending: Vec<usize> = (0..data.frequencies_hz.len()).collect();
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
    source.mass = source.mass_and_center()?;
    Ok(source)
}

/// The test modes at the sensors placed.
pub(super) fn measured(
    data: &TestData,
    placed: &[PlacedSensor],
    modes: &[usize],
) -> Result<Modes, Error> {
    let rows: Vec<usize> = placed.iter().map(|sensor| sensor.row).collect();
    let mut shapes = data.shapes.select_rows(&rows).select_columns(modes);
    shapes
        .row_iter_mut()
        .zip(placed)
        .for_each(|(mut row, sensor)| row *= sensor.sign);
    let frequencies: Vec<f64> = modes
        .iter()
        .map(|&mode| data.frequencies_hz[mode])
        .collect();
    Modes::from_measured(&frequencies, &shapes)
}

/// The pairs of largest closeness, less what modes that are hardly seen pay, every test mode with one.
fn pair_by_assignment(cross: &DMatrix<f64>, readings: &DMatrix<f64>) -> Result<Pairing, Error> {
    let partners = pairs(&cross.component_mul(cross), readings, 0.0)?;
    check_count("test modes", cross.ncols(), 0, cross.nrows())?;
    let analysis_mode = partners.into_iter().flatten().collect();
    Ok(Pairing::signed(analysis_mode, cross))
}
