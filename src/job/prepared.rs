//! A job with the first model's modes and the test modes' partners among them: its second value, from which a correlation starts.

use super::bodies::explained;
use super::concern::{Check, Concern, Grade};
use super::expansion::mass_by_modes;
use super::likelihood::{decided, pairs};
use super::{LoadedJob, Method};
use crate::files::error::{FileError, ensure};
use crate::method::error::Error;
use crate::method::modes::Modes;
use crate::sparse::{BasisSize, Deflections, FINITE, ModeWeight, Place, SensorModel};
use crate::weighted::close_modes::{assurance_of_roots, indistinct_groups};
use crate::weighted::comparison::{Comparison, LoneFrequency};
use crate::weighted::gauss_newton::WeightedSettings;
use nalgebra::DMatrix;
use std::sync::Arc;

/// Modal assurance below which a test mode counts as without a partner.
pub(super) const FLOOR: f64 = 0.5;

/// Residual vectors a parameter, unless the job says how many: more add less than the lowest mode left out.
const RESIDUAL_VECTORS: usize = 4;

/// Deviation of a frequency, relative, by which roots that no solver tells apart are equal: two in a hundred million of a root.
const EQUAL: f64 = 3e-9;

/// A test mode that is not compared, and why.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftOut {
    /// Its place in the test's file, from zero.
    pub mode: usize,
    /// Its largest modal assurance with any mode of the model.
    pub assurance: f64,
    /// The reason.
    pub why: &'static str,
}

/// Reasons for which a test mode is not compared.
const UNLIKE: &str = "it resembles no mode of the model";
const TAKEN: &str = "the mode of the model that it resembles belongs to another test mode";
const HARM: &str = "compared it makes the others worse";
const OUT_OF_REACH: &str = "no mode of the model that it resembles can have its frequency within the bounds and priors of the parameters";

impl LeftOut {
    /// The concern that says so: a remark before the steps.
    pub(super) fn concern(&self, grade: Grade) -> Concern {
        let Self {
            mode,
            assurance,
            why,
        } = self;
        let mode = mode + 1;
        let words = format!(
            "Test mode {mode} is not compared: {why} (modal assurance {assurance:.2} at most)."
        );
        Concern::new(grade, Check::Pairs, "not-compared-", &[mode], words)
    }
}

/// A job with its first analysis, and its test modes with their partners in it.
#[derive(Debug, Clone)]
pub struct PreparedJob {
    /// What was read.
    pub loaded: Arc<LoadedJob>,
    /// The test modes to compare, at the placed sensors.
    pub test: Modes,
    /// Their places in the test's file, from zero, ascending in frequency.
    pub modes: Vec<usize>,
    /// Test modes, from zero, that resemble no mode of the first model.
    pub unpaired: Vec<LeftOut>,
    /// Test modes, from zero, that were left out at first and are compared since.
    pub joined: Vec<usize>,
    /// Test modes, from zero, that make others worse from this end, and so stay left out.
    pub(super) refused: Vec<usize>,
    /// Test modes, from zero, that several modes of the first model resemble equally, and which are paired in the order of frequencies.
    pub undecided: Vec<usize>,
    /// Groups of the compared test modes with shapes, by place, that the test or the first model does not tell apart.
    together: Vec<Vec<usize>>,
    /// Number of modes of the model that are taken.
    pub analysis_modes: usize,
    /// The first analysis, with as many modes as the pre-flight looks at.
    pub(super) first: Arc<Place>,
    /// Frequencies of the first model, Hz, with the part of each that the digits of its matrices leave open.
    open: Vec<[f64; 2]>,
    /// Shapes of the partners of frequencies alone, as the sensors see them.
    partner_shapes: DMatrix<f64>,
}

impl PreparedJob {
    /// Analyses the first model, and pairs the test modes with its modes.
    pub(super) fn new(loaded: LoadedJob) -> Result<Self, FileError> {
        let job = &loaded.job;
        if job.compare.method == Method::Paper {
            let starts = job.compare.starts.unwrap_or(1);
            ensure(starts <= 1, || {
                job.refused(format!(
                    "compare.starts is {starts}, but method \"paper\" has one start"
                ))
            })?;
            if let Some((mode, _)) = loaded.alone().first() {
                return Err(job.refused(format!(
                    "test mode {} has a frequency alone, and compare.method \"paper\" compares shapes; \"gauss_newton\" needs none",
                    mode + 1
                )));
            }
        }
        let (analysis_modes, first) = first_analysis(&loaded)?;
        let exact = first.modes(analysis_modes)?;
        let partners = loaded.alone().iter().map(|(_, lone)| lone.partner);
        let partners: Vec<usize> = partners.filter(|mode| *mode < exact.len()).collect();
        let modes = loaded.shaped();
        let prepared = Self {
            test: loaded.measured(&modes)?,
            modes,
            unpaired: Vec::new(),
            joined: Vec::new(),
            refused: Vec::new(),
            undecided: Vec::new(),
            together: Vec::new(),
            analysis_modes,
            open: first.open_frequencies()?,
            first,
            partner_shapes: exact.shapes.select_columns(&partners),
            loaded: Arc::new(loaded),
        };
        match prepared.analyze(&prepared.loaded.ones()) {
            // Even with more test modes than the model has modes, the pairs can be judged.
            Err(Error::Count {
                what: "test modes", ..
            }) => prepared.paired_with(&exact, None),
            Ok(model) => {
                let frequencies = prepared.frequencies(&prepared.modes);
                let costs = frequencies.costs(&exact, &model.model.parts());
                prepared.paired_with(&exact, Some(&costs))
            }
            Err(other) => Err(other.into()),
        }
    }

    /// The same job without the test modes that resemble no mode of the first model; `by_frequency` is what frequencies cost pairs, where
    /// the model has enough modes for all.
    fn paired_with(
        mut self,
        exact: &Modes,
        by_frequency: Option<&DMatrix<f64>>,
    ) -> Result<Self, FileError> {
        let assurance = decided(&assurance_of_roots(exact, &self.test.shapes)?);
        let is_tied = |mode: &usize| {
            let column = assurance.column(*mode);
            let most = column.max();
            column.iter().filter(|close| **close == most).count() > 1
        };
        let tied = (0..assurance.ncols()).filter(is_tied);
        self.undecided = tied.map(|mode| self.modes[mode]).collect();
        let partners = pairs(&assurance, &exact.shapes, by_frequency, FLOOR)?;
        let (kept, left): (Vec<usize>, Vec<usize>) =
            (0..partners.len()).partition(|&mode| partners[mode].is_some());
        let left_out = |mode: usize| {
            let assurance = assurance.column(mode).max();
            let why = match assurance < FLOOR {
                true => UNLIKE,
                false => TAKEN,
            };
            let mode = self.modes[mode];
            LeftOut {
                mode,
                assurance,
                why,
            }
        };
        self.unpaired = left.into_iter().map(left_out).collect();
        for (mode, lone) in self.alone() {
            let other = partners.iter().position(|own| *own == Some(lone.partner));
            if let Some(other) = other {
                let (mode, other, partner) = (mode + 1, self.modes[other] + 1, lone.partner + 1);
                return Err(self.loaded.job.refused(format!(
                    "test.partners: mode {partner} of the model is the partner of test mode {mode}, which has a frequency alone, and by \
                     its shape of test mode {other}"
                )));
            }
        }
        // Without any pair all stay, for the pre-flight to name the mistake.
        if !kept.is_empty() {
            self.test = self.test.select(&kept);
            self.modes = kept.into_iter().map(|mode| self.modes[mode]).collect();
        }
        self.together = self.indistinct(exact)?;
        Ok(self)
    }

    /// Groups of the test modes with shapes, by place, whose frequencies are no further apart than the test's deviations tell, or those of
    /// their partners among these modes than by other relative deviations ([`indistinct_groups`]).
    fn indistinct(&self, exact: &Modes) -> Result<Vec<Vec<usize>>, FileError> {
        let hertz: Vec<f64> = self
            .modes
            .iter()
            .map(|&mode| self.loaded.data.frequencies_hz[mode])
            .collect();
        let deviations = self
            .modes
            .iter()
            .map(|&mode| self.loaded.deviations(mode).frequency);
        let deviations: Vec<f64> = deviations.collect();
        let assurance = decided(&assurance_of_roots(exact, &self.test.shapes)?);
        let partners = pairs(&assurance, &exact.shapes, None, FLOOR)?;
        let roots = exact.frequencies_hz();
        let of_model = partners.iter().zip(&hertz);
        let of_model = of_model.map(|(partner, own)| partner.map_or(*own, |mode| roots[mode]));
        let mut groups = indistinct_groups(&hertz, &deviations);
        let of_root = vec![EQUAL; deviations.len()];
        for more in indistinct_groups(&of_model.collect::<Vec<_>>(), &of_root) {
            let (meeting, mut apart): (Vec<_>, Vec<_>) = groups
                .into_iter()
                .partition(|group: &Vec<usize>| group.iter().any(|mode| more.contains(mode)));
            let mut joined = meeting.concat();
            joined.sort_by(|&a, &b| hertz[a].total_cmp(&hertz[b]));
            apart.push(joined);
            groups = apart;
        }
        groups.sort_by(|a, b| hertz[a[0]].total_cmp(&hertz[b[0]]));
        Ok(groups)
    }

    /// Test modes, from zero, of which a frequency alone is compared, ascending, with their partners in the first model.
    pub fn alone(&self) -> &[(usize, LoneFrequency)] {
        self.loaded.alone()
    }

    /// Selected test modes that are not compared, with their largest modal assurance with the modes of this model.
    pub(super) fn unlike(&self, model: &Comparison) -> Result<Vec<LeftOut>, FileError> {
        let (modes, reach) = (&model.model.exact.modes, self.reach(model));
        let of_mode = |mode: usize| {
            let test = self.loaded.measured(&[mode])?;
            let close = assurance_of_roots(modes, &test.shapes)?;
            let assurance = close.max();
            let why = match self.within(&close, &[mode], &reach).max() < FLOOR {
                _ if self.refused.contains(&mode) => HARM,
                _ if assurance < FLOOR => UNLIKE,
                true => OUT_OF_REACH,
                false => TAKEN,
            };
            Ok(LeftOut {
                mode,
                assurance,
                why,
            })
        };
        self.not_compared().map(of_mode).collect()
    }

    /// Test modes with shapes, from zero, that the job selects and does not compare.
    fn not_compared(&self) -> impl Iterator<Item = usize> {
        let left = self.unpaired.iter().map(|left| left.mode);
        left.filter(|mode| !self.modes.contains(mode))
    }

    /// The same job that also compares the test modes left out so far, as many at most, that resemble a mode of this model which can have
    /// their frequency, each one of its own; none where none does.
    pub(super) fn joined_by(
        &self,
        model: &Comparison,
        most: usize,
    ) -> Result<Option<Self>, FileError> {
        let left = self.not_compared();
        let left = left.filter(|mode| !self.refused.contains(mode));
        let all: Vec<usize> = self.modes.iter().copied().chain(left).collect();
        if all.len() == self.modes.len() {
            return Ok(None);
        }
        let test = self.loaded.measured(&all)?;
        let assurance = assurance_of_roots(&model.model.exact.modes, &test.shapes)?;
        let within = self.within(&assurance, &all, &self.reach(model));
        let readings = &model.model.exact.modes.shapes;
        let frequencies = self.frequencies(&all);
        let costs = frequencies.costs(&model.model.exact.modes, &model.model.parts());
        let partners = pairs(&within, readings, Some(&costs), FLOOR)?;
        let (compared, left) = partners.split_at(self.modes.len());
        let left = left.iter().zip(&all[self.modes.len()..]);
        let joined: Vec<usize> = left
            .filter(|(partner, _)| partner.is_some())
            .map(|(_, mode)| *mode)
            .take(most)
            .collect();
        if joined.is_empty() || compared.contains(&None) {
            return Ok(None);
        }
        let mut again = self.comparing_too(&joined)?;
        again.joined.extend(joined);
        again.refused.clear();
        Ok(Some(again))
    }

    /// A job like this one that also compares these test modes.
    fn comparing_too(&self, left: &[usize]) -> Result<Self, FileError> {
        let mut again = self.clone();
        again.modes.extend(left);
        let hertz = &self.loaded.data.frequencies_hz;
        again.modes.sort_by(|&a, &b| hertz[a].total_cmp(&hertz[b]));
        again.test = self.loaded.measured(&again.modes)?;
        again.together = again.indistinct(&self.first.modes(self.analysis_modes)?)?;
        Ok(again)
    }

    /// The same job for a look far from the first model, with that model: it compares every selected test mode, those too that resemble no
    /// mode of it, and takes twice as many modes unless the job says how many. Where one parameter is grossly wrong, the modes that
    /// tell of it are neither like those of the model nor made of its lowest.
    ///
    /// A model that has fewer modes is looked at as the job has it.
    ///
    /// # Errors
    /// Those of the test's shapes and of [`PreparedJob::analyze`].
    pub fn far_from_first(&self) -> Result<(Self, Comparison), FileError> {
        let left: Vec<usize> = self.not_compared().collect();
        let mut far = match left.is_empty() {
            true => self.clone(),
            false => self.comparing_too(&left)?,
        };
        if self.loaded.job.compare.analysis_modes.is_none() {
            let most = self.loaded.source.whole.dof_count();
            far.analysis_modes = (2 * self.analysis_modes).min(most);
        }
        let ones = self.loaded.ones();
        match far.analyze(&ones) {
            Ok(first) => Ok((far, first)),
            Err(Error::Count { .. }) => Ok((self.clone(), self.analyze(&ones)?)),
            Err(other) => Err(other.into()),
        }
    }

    /// True if no test mode with a shape has a partner.
    pub fn is_without_pairs(&self) -> bool {
        let is_unpaired = |mode: &usize| self.unpaired.iter().any(|left| left.mode == *mode);
        !self.modes.is_empty() && self.modes.iter().all(is_unpaired)
    }

    /// Refuses a correlation in which no test mode has a partner.
    ///
    /// # Errors
    /// [`FileError::Refused`].
    pub(super) fn check_paired(&self) -> Result<(), FileError> {
        ensure(!self.is_without_pairs(), || {
            let best = self.unpaired.iter().map(|left| left.assurance);
            let best = best.fold(0.0, f64::max);
            self.loaded.job.refused(format!(
                "no mode of the model is like a test mode: their modal assurance is {best:.3} at most, less than {FLOOR}; \
                 corfem check looks for the mistake"
            ))
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
        let mass = mass_by_modes(&paired)?;
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
        let noise = test
            .column_iter()
            .zip(&self.modes)
            .map(|(shape, &mode)| self.loaded.deviations(mode).shape * shape.amax() / shape.norm());
        2.0 * noise.fold(0.0, f64::max) < least
    }

    /// Test modes that are compared, from zero: those with shapes, then those without.
    pub fn compared(&self) -> impl Iterator<Item = usize> {
        let alone = self.alone().iter().map(|(mode, _)| *mode);
        self.modes.iter().copied().chain(alone)
    }

    /// Settings of weighted steps with the job's priors.
    pub(crate) fn weighted_settings(&self) -> WeightedSettings {
        WeightedSettings {
            prior_deviations: self.loaded.source.priors.clone(),
            ..WeightedSettings::default()
        }
    }

    /// The weights of the test modes that are fitted, of those without shapes last: one over the standard deviation of each, times the job's
    /// weight; zeros of those that are held out.
    pub fn weights(&self) -> Vec<ModeWeight> {
        self.weights_of(false)
    }

    /// The weight of every test mode, of those without shapes last: one over its standard deviation, times the job's weight; of those that
    /// are held out alone, or of those that are fitted.
    pub(super) fn weights_of(&self, is_held_out: bool) -> Vec<ModeWeight> {
        let weight = |(own, mode): (ModeWeight, usize)| {
            let noise = self.loaded.deviations(mode);
            ModeWeight {
                frequency: own.frequency / noise.frequency.hypot(self.open_part(mode)),
                shape: own.shape / noise.shape,
            }
        };
        let own = self.own_weights(is_held_out).into_iter();
        own.zip(self.compared()).map(weight).collect()
    }

    /// The part of a test mode's frequency that the digits of the model's matrices leave open, as a standard deviation: that of the nearest
    /// mode of the first model.
    pub(super) fn open_part(&self, mode: usize) -> f64 {
        let own = self.loaded.data.frequencies_hz[mode];
        let far = |hertz: f64| (hertz / own).ln().abs();
        let nearest = self.open.iter();
        let nearest = nearest.min_by(|a, b| far(a[0]).total_cmp(&far(b[0])));
        nearest.map_or(0.0, |nearest| nearest[1])
    }

    /// The job's own weights of the test modes, ones where it has none, of those that are held out or of the others; zeros of the rest.
    pub(super) fn own_weights(&self, is_held_out: bool) -> Vec<ModeWeight> {
        let (numbers, compare) = (&self.loaded.job.test.modes, &self.loaded.job.compare);
        let of = |list: &Option<Vec<f64>>, mode: usize| {
            let place = numbers.as_ref().map_or(Some(mode), |all| {
                all.iter().position(|number| *number == mode + 1)
            });
            list.as_ref()
                .zip(place)
                .and_then(|(list, place)| list.get(place).copied())
                .unwrap_or(1.0)
        };
        let held = &self.loaded.job.test.hold_out;
        let weight = |mode: usize| match held.contains(&(mode + 1)) == is_held_out {
            true => ModeWeight {
                frequency: of(&compare.frequency_weights, mode),
                shape: of(&compare.shape_weights, mode),
            },
            false => ModeWeight::NONE,
        };
        self.compared().map(weight).collect()
    }

    /// The modal model of the loops at the given parameter factors.
    ///
    /// # Errors
    /// The errors of [`crate::sparse::WholeModel::analyze`].
    pub fn analyze(&self, factors: &[f64]) -> Result<Comparison, Error> {
        self.analyze_near(factors, None)
    }

    /// The modal model at factors, its modes sought from shapes `near` them.
    pub(super) fn analyze_near(
        &self,
        factors: &[f64],
        near: Option<&DMatrix<f64>>,
    ) -> Result<Comparison, Error> {
        let (whole, pair) = (&self.loaded.source.whole, self.pair());
        let size = BasisSize {
            modes: self.analysis_modes,
            // Weighted steps have deflections of their own.
            residual_vectors: match self.loaded.job.compare.method {
                Method::Paper => RESIDUAL_VECTORS,
                Method::GaussNewton => 0,
            },
        };
        let model = match factors == self.loaded.ones() {
            true => {
                let deflections = Deflections::Each(size.residual_vectors);
                let first = Arc::clone(&self.first);
                SensorModel::of_whole(first, size.modes, &self.test, pair, deflections)
            }
            false => {
                let sensors = &self.loaded.sensors;
                whole.analyze_near(factors, sensors, &self.test, pair, size, near)
            }
        }?;
        // Gauss-Newton steps have weights of their own.
        match self.loaded.job.compare.method {
            Method::Paper => Ok(model.weighted(&self.own_weights(false))?.into()),
            Method::GaussNewton => {
                let lone = self.alone().iter().map(|(_, lone)| *lone);
                let mut comparison = Comparison::from(model)
                    .with_groups(self.together.clone())?
                    .with_component_weights(self.component_weights())?
                    .with_lone_frequencies(lone.collect())?;
                if self.partner_shapes.ncols() > 0 {
                    comparison = comparison.followed_by_shape(self.partner_shapes.clone())?;
                }
                Ok(comparison)
            }
        }
    }

    /// One over the deviations of components where the test gives them, times the mode's ([`LoadedJob::deviations`]), else one. They are
    /// fractions of the largest component of all sensors, which need not be among those placed.
    fn component_weights(&self) -> DMatrix<f64> {
        let rows: Vec<usize> = self.loaded.placed.iter().map(|sensor| sensor.row).collect();
        let mut weights = DMatrix::from_element(self.loaded.sensors.rows(), self.modes.len(), 1.0);
        for (mut weights, mode) in weights.column_iter_mut().zip(&self.modes) {
            if let Some(deviations) = self.loaded.data.component_deviation.get(mode) {
                let shape = self.loaded.data.shapes.column(*mode);
                let largest = shape.select_rows(&rows).amax() / shape.amax();
                let scale = self.loaded.deviations(*mode).shape * largest;
                weights.copy_from(&deviations.select_rows(&rows).map(|own| scale / own));
            }
        }
        weights
    }

    /// Groups of the test modes with shapes, by place, that are compared as subspaces.
    pub fn together(&self) -> &[Vec<usize>] {
        &self.together
    }
}

/// The first analysis with twice as many modes as the job takes, and how many it takes: the job's number, else the usual one, or fewer where
/// the model has no more, and as many more as are nearer to the last of them than modes whose shapes a change mixes.
fn first_analysis(loaded: &LoadedJob) -> Result<(usize, Arc<Place>), FileError> {
    let asked = loaded.job.compare.analysis_modes;
    let most = loaded.source.whole.dof_count();
    let modes = asked.unwrap_or_else(|| loaded.usual_modes().min(most));
    let partners = loaded.alone().iter().map(|(_, lone)| lone.partner + 1);
    let highest = partners.max().unwrap_or(0);
    ensure(highest <= modes, || {
        loaded.job.refused(format!(
            "test.partners: mode {highest} of the model is not among the {modes} taken; see compare.analysis_modes"
        ))
    })?;
    let (modes, first) = match loaded.analyzed(modes) {
        Err(Error::Count {
            what: FINITE,
            most: available,
            ..
        }) if asked.is_none() && available > 0 => (available, loaded.analyzed(available)?),
        first => {
            let refused = |error| {
                let name = |row| loaded.source.row_name(row);
                match explained(&error, loaded.source.whole.half_unit(), name) {
                    Some(reason) => loaded.job.refused(reason),
                    None => error.into(),
                }
            };
            (modes, first.map_err(refused)?)
        }
    };
    Ok((first.whole_roots(modes), first))
}
