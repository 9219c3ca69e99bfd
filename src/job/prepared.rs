//! A job with the first model's modes and the test modes' partners among them: its second value, from which a correlation starts.

use super::{
    LoadedJob, Method,
    bodies::{explained, with_as_many},
    loaded::ascend,
    pairs::{FLOOR, pairs},
    reach::{LeftOut, TAKEN, UNLIKE},
};
use crate::{
    files::error::FileError,
    method::{error::Error, modes::Modes},
    sparse::{ModeWeight, Pair, Place, SensorModel, moves_of},
    weighted::{
        close_modes::{assurance_of_roots, indistinct_groups},
        comparison::{Comparison, LoneFrequency},
        gauss_newton::WeightedSettings,
        noise::Noise,
    },
};
use nalgebra::DMatrix;
use std::sync::Arc;

/// Deviation of a frequency, relative, by which roots that no solver tells apart are equal: two in a hundred million of a root.
const EQUAL: f64 = 3e-9;

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
    /// Test modes, from zero, that make others worse from this end, and so stay left out.
    pub(super) refused: Vec<usize>,
    /// Groups of the compared test modes with shapes, by place, that the test or the first model does not tell apart.
    pub together: Vec<Vec<usize>>,
    /// Number of modes of the model that are taken.
    pub analysis_modes: usize,
    /// The first analysis, with as many modes as the pre-flight looks at.
    pub(super) first: Arc<Place>,
    /// The first comparison; none where the model has fewer modes than the test.
    pub comparison: Option<Comparison>,
    /// Frequencies of the first model, Hz, with the part of each that the digits of its matrices leave open.
    open: Vec<[f64; 2]>,
}

impl PreparedJob {
    /// Analyses the first model, and pairs the test modes with its modes.
    pub(super) fn new(loaded: LoadedJob) -> Result<Self, FileError> {
        let job = &loaded.job;
        if job.compare.method == Method::Paper {
            let starts = job.compare.starts.unwrap_or(1);
            job.ensure(starts <= 1, || {
                format!("compare.starts is {starts}, but method \"paper\" has one start")
            })?;
            job.ensure(loaded.alone.is_empty(), || {
                format!(
                    "test mode {} has a frequency alone, and compare.method \"paper\" compares shapes; \"gauss_newton\" needs none",
                    loaded.alone[0].0 + 1
                )
            })?;
        }
        let (analysis_modes, first) = first_analysis(&loaded)?;
        let modes = loaded.shaped();
        let mut prepared = Self {
            test: loaded.measured(&modes)?,
            modes,
            unpaired: Vec::new(),
            refused: Vec::new(),
            together: Vec::new(),
            analysis_modes,
            open: first.open_frequencies()?,
            comparison: None,
            loaded: Arc::new(loaded),
            first,
        };
        prepared.leave_out()?;
        prepared.compare()
    }

    /// Leaves out the test modes that resemble no mode of the first model, unless none does: then the pre-flight names the mistake.
    fn leave_out(&mut self) -> Result<(), FileError> {
        let exact = &self.first.modes(self.analysis_modes)?;
        let assurance = assurance_of_roots(exact, &self.test.shapes)?;
        let parts = moves_of(self.first.shares(), exact);
        let costs = self.frequencies(&self.modes).costs(exact, &parts);
        let partners = pairs(&assurance, &exact.shapes, Some(&costs), FLOOR)?;
        let mut kept = Vec::new();
        for (place, partner) in partners.into_iter().enumerate() {
            let mode = self.modes[place];
            let Some(partner) = partner else {
                let assurance = assurance.column(place).max();
                let why = if assurance < FLOOR { UNLIKE } else { TAKEN };
                self.unpaired.push(LeftOut {
                    mode,
                    assurance,
                    why,
                });
                continue;
            };
            kept.push(place);
            let mut alone = self.loaded.alone.iter();
            self.loaded.job.ensure(alone.all(|own| own.1 != partner), || {
                format!(
                    "test.partners: mode {} of the model, a partner of a frequency alone, is by its shape that of test mode {}",
                    partner + 1,
                    mode + 1
                )
            })?;
        }
        if kept.is_empty() {
            // No more than a model of few modes has.
            kept = (0..self.modes.len().min(exact.len())).collect();
        }
        self.test = self.test.select(&kept);
        self.modes = kept.into_iter().map(|place| self.modes[place]).collect();
        Ok(())
    }

    /// The same job with its first comparison, in which groups of modes are compared that the test or this model does not tell apart: their
    /// frequencies are no further apart than the test's deviations tell, or those of their partners than by others ([`indistinct_groups`]).
    fn compare(mut self) -> Result<Self, FileError> {
        let first = self.analyze(&self.loaded.ones())?;
        if self.loaded.job.compare.method == Method::GaussNewton {
            let exact = &first.model.exact;
            let (hertz, roots) = (self.test.frequencies_hz(), exact.modes.frequencies_hz());
            let deviation = |&mode: &usize| self.loaded.deviations(mode).frequency;
            let deviations: Vec<f64> = self.modes.iter().map(deviation).collect();
            let partners = exact.pairing.analysis_mode.iter();
            let of_model: Vec<f64> = partners.map(|&mode| roots[mode]).collect();
            let mut groups = indistinct_groups(&hertz, &deviations);
            for more in indistinct_groups(&of_model, &vec![EQUAL; hertz.len()]) {
                let meets = |group: &mut Vec<usize>| group.iter().any(|mode| more.contains(mode));
                let meeting = groups.extract_if(.., meets).flatten().collect();
                groups.push(meeting);
            }
            // In ascending frequency, as the modes are.
            groups.iter_mut().for_each(|group| group.sort_unstable());
            groups.sort_unstable();
            self.together = groups;
        }
        self.comparison = Some(first.with_groups(self.together.clone())?);
        Ok(self)
    }

    /// Test modes with shapes, from zero, that the job selects and does not compare.
    pub(super) fn not_compared(&self) -> impl Iterator<Item = usize> {
        self.loaded
            .shaped()
            .into_iter()
            .filter(|mode| !self.modes.contains(mode))
    }

    /// The same job that also compares the test modes left out so far, as many at most, that resemble a mode of this model which can have
    /// their frequency, each one of its own; none where none does.
    pub(super) fn joined_by(
        &self,
        model: &Comparison,
        most: usize,
    ) -> Result<Option<Self>, FileError> {
        let left = self
            .not_compared()
            .filter(|mode| !self.refused.contains(mode));
        let all: Vec<usize> = self.modes.iter().copied().chain(left).collect();
        let (exact, test) = (&model.model.exact.modes, self.loaded.measured(&all)?);
        let assurance = assurance_of_roots(exact, &test.shapes)?;
        let within = self.within(&assurance, &all, &self.reach(model));
        let costs = self.frequencies(&all).costs(exact, &model.model.moves);
        let partners = pairs(&within, &exact.shapes, Some(&costs), FLOOR)?;
        let count = self.modes.len();
        let joined = all.iter().zip(&partners).skip(count);
        let joined = joined.filter(|own| own.1.is_some()).map(|own| *own.0);
        let joined: Vec<usize> = joined.take(most).collect();
        if joined.is_empty() || partners[..count].contains(&None) {
            return Ok(None);
        }
        let mut again = self.comparing_too(&joined)?.compare()?;
        again.refused.clear();
        Ok(Some(again))
    }

    /// A job like this one that also compares these test modes.
    fn comparing_too(&self, left: &[usize]) -> Result<Self, FileError> {
        let mut again = self.clone();
        again.modes.extend(left);
        ascend(&mut again.modes, &self.loaded.data);
        again.test = self.loaded.measured(&again.modes)?;
        again.together.clear();
        again.comparison = None;
        Ok(again)
    }

    /// The same job for a look far from the first model: it compares every selected test mode, those too that resemble no
    /// mode of it, and takes twice as many modes unless the job says how many. Where one parameter is grossly wrong, the modes that
    /// tell of it are neither like those of the model nor made of its lowest.
    ///
    /// A model that has fewer modes is looked at as the job has it.
    ///
    /// # Errors
    /// Those of the test's shapes and of [`PreparedJob::analyze`].
    pub fn far_from_first(&self) -> Result<Self, FileError> {
        let left: Vec<usize> = self.not_compared().collect();
        let mut far = self.comparing_too(&left)?;
        if self.loaded.job.compare.analysis_modes.is_none() {
            let most = self.loaded.source.whole.dof_count();
            far.analysis_modes = (2 * self.analysis_modes).min(most);
        }
        Ok(far.compare().unwrap_or_else(|_| self.clone()))
    }

    /// True if no test mode with a shape has a partner.
    pub fn is_without_pairs(&self) -> bool {
        !self.unpaired.is_empty() && self.unpaired.len() == self.loaded.shaped().len()
    }

    /// Test modes that are compared, from zero: those with shapes, then those without.
    pub fn compared(&self) -> impl Iterator<Item = usize> {
        self.modes
            .iter()
            .copied()
            .chain(self.loaded.alone.iter().map(|own| own.0))
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
        self.weights_by(is_held_out, |mode| self.noise(mode))
    }

    /// Standard deviations of a test mode, with what the digits of the model leave open of its frequency.
    pub(super) fn noise(&self, mode: usize) -> Noise {
        let noise = self.loaded.deviations(mode);
        let frequency = noise.frequency.hypot(self.open_part(mode));
        Noise { frequency, ..noise }
    }

    /// The part of a test mode's frequency that the digits of the model's matrices leave open, as a standard deviation: that of the nearest
    /// mode of the first model.
    pub(super) fn open_part(&self, mode: usize) -> f64 {
        let own = self.loaded.data.frequencies_hz[mode];
        let far = |open: &&[f64; 2]| (open[0] / own).ln().abs();
        let nearest = self.open.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
        nearest.map_or(0.0, |nearest| nearest[1])
    }

    /// The job's own weights of the test modes, ones where it has none, over deviations, of those that are held out or of the others; zeros
    /// of the rest.
    fn weights_by(&self, is_held_out: bool, noise: impl Fn(usize) -> Noise) -> Vec<ModeWeight> {
        let job = &self.loaded.job;
        let weight = |mode: usize| {
            if job.test.hold_out.contains(&(mode + 1)) != is_held_out {
                return ModeWeight::NONE;
            }
            let mut numbers = self.loaded.numbers.iter();
            let place = numbers.position(|number| *number == mode + 1);
            let of = |list: &Option<Vec<f64>>| {
                let own = list.as_ref().zip(place);
                own.map_or(1.0, |(list, place)| list[place])
            };
            let noise = noise(mode);
            ModeWeight {
                frequency: of(&job.compare.frequency_weights) / noise.frequency,
                shape: of(&job.compare.shape_weights) / noise.shape,
            }
        };
        self.compared().map(weight).collect()
    }

    /// The modal model of the loops at the given parameter factors.
    ///
    /// # Errors
    /// The errors of [`crate::sparse::WholeModel::analyze`].
    pub fn analyze(&self, factors: &[f64]) -> Result<Comparison, Error> {
        match &self.comparison {
            Some(first) if factors == self.loaded.ones() => Ok(first.clone()),
            _ => self.analyze_near(factors, None, self.pair(self.loaded.job.compare.method)),
        }
    }

    /// The modal model at factors, its modes sought from shapes `near` them, and paired by a rule.
    pub(super) fn analyze_near(
        &self,
        factors: &[f64],
        near: Option<&DMatrix<f64>>,
        pair: Pair,
    ) -> Result<Comparison, Error> {
        let (whole, modes) = (&self.loaded.source.whole, self.analysis_modes);
        // Exact slopes want more modes than the basis has.
        let most = modes.max(2 * self.test.len());
        let place = match factors == self.loaded.ones() {
            true => Arc::clone(&self.first),
            false => whole.exactly(factors, &self.loaded.sensors, modes..=most, near)?,
        };
        self.beside(place, self.loaded.job.compare.method, pair)
    }

    /// An analysis beside the test, as a method compares them, paired by a rule.
    pub(super) fn beside(
        &self,
        place: Arc<Place>,
        method: Method,
        pair: Pair,
    ) -> Result<Comparison, Error> {
        let model = SensorModel::of_whole(place, self.analysis_modes, &self.test, pair)?;
        if method == Method::Paper {
            let one = |_| Noise {
                frequency: 1.0,
                shape: 1.0,
            };
            return Ok(model.weighted(&self.weights_by(false, one))?.into());
        }
        let lone = |&(mode, partner): &(usize, usize)| LoneFrequency {
            frequency_hz: self.loaded.data.frequencies_hz[mode],
            partner,
        };
        let alone = self.loaded.alone.iter();
        let comparison = Comparison::from(model)
            .with_groups(self.together.clone())?
            .with_component_weights(self.component_weights())?
            .with_lone_frequencies(alone.clone().map(lone).collect())?;
        if self.loaded.alone.is_empty() {
            return Ok(comparison);
        }
        let first = self.first.modes(self.analysis_modes)?.shapes;
        comparison.followed_by_shape(first.select_columns(alone.map(|own| &own.1)))
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
}

/// The whole model's first analysis, and how many modes the job takes of it: its number, else the usual one, or fewer where the model has no
/// more, and as many more as are nearer to the last of them than modes whose shapes a change mixes. It has those that the pre-flight looks
/// at too, twice the usual number, and some more than the job takes, so that the root of the last of them is there with all its modes.
fn first_analysis(loaded: &LoadedJob) -> Result<(usize, Arc<Place>), FileError> {
    let (whole, usual) = (&loaded.source.whole, loaded.usual_modes());
    let modes = loaded.job.compare.analysis_modes;
    let modes = modes.unwrap_or(usual.min(whole.dof_count()));
    let highest = loaded.alone.iter().map(|own| own.1 + 1);
    let highest = highest.max().unwrap_or(0);
    loaded.job.ensure(highest <= modes, || {
        format!(
            "test.partners: mode {highest} of the model is not among the {modes} taken; see compare.analysis_modes"
        )
    })?;
    let first = with_as_many(modes, |modes: usize| {
        let twice = 2 * usual;
        let most = if modes + 2 < twice { twice } else { modes + 8 };
        whole.exactly(&loaded.ones(), &loaded.sensors, modes..=most, None)
    });
    let name = |row| loaded.source.row_name(row);
    let file = loaded.job.path.display();
    let (modes, first) = first.map_err(|error| explained(error, file, whole.half_unit(), name))?;
    Ok((first.whole_roots(modes), first))
}
