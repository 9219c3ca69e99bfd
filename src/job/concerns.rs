//! Doubts about a job before its first step.

use super::loaded::measured;
use super::preflight::{Finding, FindingNames, LARGEST_TOLERANCE, SeenModes, preflight_at_sensors};
use super::sensors::{PlacedSensor, motion};
use super::{Concern, LoadedJob, Method};
use crate::files::error::FileError;
use crate::method::modes::Modes;
use crate::sparse::rigid_bodies::BodyFinding;
use crate::weighted::comparison::LoneFrequency;
use crate::weighted::noise::Noise;
use nalgebra::Vector3;

/// Modal phase collinearity below which a complex test mode is doubtful as a real one.
const COLLINEAR: f64 = 0.95;

/// Span of the sensors' places over the model's from which they are in another unit: the least factor between two customary units
/// of length is 2.54, and sensors sit on the structure.
const LARGEST_SPAN: f64 = 2.0;

impl LoadedJob {
    /// Concerns before the first step, from findings of the pre-flight, complex test modes and data that the readers left aside; and the
    /// number of rigid-body modes that the analysis for them has found.
    ///
    /// # Errors
    /// The errors of [`preflight_at_sensors`] and of the analysis that it needs.
    pub fn concerns(&self) -> Result<(Vec<Concern>, usize), FileError> {
        let (mut all, rigid_body_modes) = self.preflight_concerns()?;
        if !self.alone.is_empty() {
            let pair = |(mode, lone): &(usize, LoneFrequency)| {
                format!("{} with the model's {}", mode + 1, lone.partner + 1)
            };
            let pairs: Vec<String> = self.alone.iter().map(pair).collect();
            all.push(Concern::remark(
                "frequencies-alone",
                format!(
                    "Test modes without shapes are paired by number, which nothing checks: {}. The model's modes are followed by shape from there.",
                    pairs.join(", ")
                ),
            ));
        }
        let together = self.together().into_iter().filter(|group| group.len() > 1);
        for group in together.filter(|_| self.job.compare.method == Method::GaussNewton) {
            let numbers: Vec<String> = group
                .iter()
                .map(|&place| (self.modes[place] + 1).to_string())
                .collect();
            all.push(Concern::remark(
                format!("close-modes-{}", numbers.join("-")),
                format!(
                    "The frequencies of test modes {} are no further apart than their deviations tell: their shapes are compared as one subspace.",
                    numbers.join(" and ")
                ),
            ));
        }
        let own = self.own_weights();
        let divides = |weight: f64| ![0.0, 1.0].contains(&weight);
        if self.job.compare.method == Method::GaussNewton
            && own
                .iter()
                .any(|own| divides(own.frequency) || divides(own.shape))
        {
            all.push(Concern::remark(
                "own-weights",
                "The job's weights count as dividing the standard deviations: chi-squared and intervals hold for deviations so divided.",
            ));
        }
        let tests = self.data.scatter.ncols();
        if tests > 0 {
            let used = match self.covariance() {
                Some(_) => "their covariance counts".to_owned(),
                None => format!(
                    "their variances alone count, for a covariance of {} numbers needs {} tests and no weights of the job's own",
                    self.free_numbers(),
                    self.free_numbers() + 3
                ),
            };
            all.push(Concern::remark(
                "repeats",
                format!("The test is the mean of {tests}; {used}. What all of them have wrong does not scatter."),
            ));
        }
        all.extend(self.part_concerns()?);
        all.extend(self.unseen_concerns()?);
        all.extend(self.data_concerns());
        Ok((all, rigid_body_modes))
    }

    /// Remarks on complex test modes and on what the readers of the test left aside or did not convert.
    fn data_concerns(&self) -> Vec<Concern> {
        let mut all = Vec::new();
        for (mode, phase) in self.data.phase_collinearity.iter().enumerate() {
            if *phase < COLLINEAR {
                let mode = mode + 1;
                all.push(Concern::remark(
                    format!("complex-{mode}"),
                    format!("Test mode {mode} is complex: its phase collinearity is {phase:.2}."),
                ));
            }
        }
        if !self.data.incomplete.is_empty() {
            all.push(Concern::remark(
                "not-in-every-mode",
                format!(
                    "Sensors left out because some mode of the file has no value at them: {}.",
                    self.data.incomplete.join(", ")
                ),
            ));
        }
        if !self.data.skipped.is_empty() {
            let numbers: Vec<String> = self.data.skipped.iter().map(usize::to_string).collect();
            all.push(Concern::remark(
                "datasets-not-read",
                format!(
                    "Datasets of the Universal File that are not read: {}.",
                    numbers.join(", ")
                ),
            ));
        }
        all.extend(self.data.units.iter().map(|units| {
            Concern::remark(
                "units-of-test",
                format!("The test's file is in units of {units}; nothing is converted."),
            )
        }));
        all
    }

    /// Findings of the pre-flight in all modes of the test, and the number of the model's rigid-body modes.
    fn preflight_concerns(&self) -> Result<(Vec<Concern>, usize), FileError> {
        let whole = &self.source.whole;
        let left_out = self.unpaired.iter().map(|(mode, _)| mode);
        let mut modes: Vec<usize> = left_out.chain(&self.modes).copied().collect();
        modes.sort_unstable();
        modes.dedup();
        let first = self.first_analysis()?;
        let rigid_body_modes = whole.rigid_bodies()?.rigid();
        let bodies = whole.body_findings(|row| self.source.row_name(row))?;
        let concern = |BodyFinding {
                           identifier,
                           is_doubt,
                           words,
                       }| Concern {
            is_doubt,
            ..Concern::remark(identifier, words)
        };
        let mut concerns: Vec<Concern> = bodies.into_iter().map(concern).collect();
        if modes.is_empty() {
            return Ok((concerns, rigid_body_modes));
        }
        let test = measured(&self.data, &self.placed, &modes)?;
        let Modes {
            omega_squared: squares,
            shapes,
        } = first.shapes(2 * self.analysis_modes);
        let along = |(place, sensor): (usize, &PlacedSensor)| {
            let own = sensor.direction;
            let others = (own / 3 * 3..own / 3 * 3 + 3).filter(move |other| *other != own);
            let read = |other: usize| {
                let axis = Vector3::ith(other % 3, 1.0);
                let motion = motion(&self.source, sensor.grid, other, axis);
                let rows = motion.map(|(row, coefficient)| shapes.row(row) * coefficient);
                rows.reduce(|sum, row| sum + row)
                    .map(|readings| (place, other, readings))
            };
            others.filter_map(read).collect::<Vec<_>>()
        };
        let seen = SeenModes {
            directions: self.placed.iter().enumerate().flat_map(along).collect(),
            shares: whole.shares(&self.ones(), &shapes)?,
            modes: Modes::new(squares, self.sensors.times(&shapes)?)?,
        };
        let ranges = whole.ranges();
        let mut found = preflight_at_sensors(&seen, &test, &self.job.correlation, &ranges)?;
        found.extend(self.percent_deviations(&modes));
        let names = FindingNames {
            sensors: self
                .placed
                .iter()
                .map(|sensor| sensor.name.clone())
                .collect(),
            parameters: self.parameter_names().map(str::to_owned).collect(),
            modes,
        };
        concerns.extend(found.iter().map(|finding| finding.concern(&names)));
        concerns.extend(self.places_concern());
        let has_doubt = concerns.iter().any(|concern| concern.is_doubt);
        if self.is_without_pairs() && !has_doubt {
            concerns.push(Concern::doubt(
                "no-pair",
                "No test mode resembles a mode of the model: another structure, other sensors, or several mistakes at once?",
            ));
        }
        Ok((concerns, rigid_body_modes))
    }

    /// Standard deviations that are given in percent.
    fn percent_deviations(&self, modes: &[usize]) -> Vec<Finding> {
        let largest = |of: fn(&Noise) -> f64| {
            let all = modes.iter().map(|&mode| of(&self.deviations(mode)));
            all.fold(0.0, f64::max)
        };
        let both = [
            ("frequency_deviation", largest(|noise| noise.frequency)),
            ("shape_deviation", largest(|noise| noise.shape)),
        ];
        let large = both
            .into_iter()
            .filter(|(_, value)| *value > LARGEST_TOLERANCE);
        large
            .map(|(setting, value)| Finding::Percent { setting, value })
            .collect()
    }

    /// A doubt about the unit of the sensors' places where they span much more than the model does.
    pub fn places_concern(&self) -> Option<Concern> {
        let extent = |places: Vec<Vector3<f64>>| {
            let first = places.first()?;
            let (low, high) = places.iter().fold((*first, *first), |(low, high), place| {
                (low.inf(place), high.sup(place))
            });
            Some((high - low).norm())
        };
        let measured = self
            .placed
            .iter()
            .filter(|sensor| sensor.distance.is_some());
        let measured = measured.filter_map(|sensor| self.data.sensors[sensor.row].place);
        let (test, model) = (
            extent(measured.collect())?,
            extent(self.source.geometry.places.values().copied().collect())?,
        );
        let ratio = test / model;
        (ratio > LARGEST_SPAN).then(|| {
            Concern::doubt(
                "unit-of-places",
                format!("The sensors' places span {ratio:.1} times what the model's do: another unit of length?"),
            )
        })
    }
}
