//! Doubts about a job before its first step, and remarks.

use super::concern::{Check, Concern, Grade, Trust, some};
use super::preflight::{
    LARGEST_TOLERANCE, Names, SeenModes, check_settings, percent, preflight_at_sensors,
};
use super::sensors::PlacedSensor;
use super::{LoadedJob, Method, PreparedJob};
use crate::files::deck::{Reason, Unread};
use crate::files::error::FileError;
use crate::method::modes::Modes;
use crate::sparse::rigid_bodies::BodyFinding;
use crate::sparse::visibility::visibilities;
use crate::weighted::comparison::Comparison;
use crate::weighted::noise::Noise;
use crate::weighted::residuals::DEVIATIONS;
use nalgebra::{DMatrix, Vector3};

/// Modal phase collinearity below which a complex test mode is doubtful as a real one.
const COLLINEAR: f64 = 0.95;

/// Span of the sensors' places over the model's from which they are in another unit: the least factor between two customary units
/// of length is 2.54, and sensors sit on the structure.
const LARGEST_SPAN: f64 = 2.0;

/// Deviation of a shape's components, over its largest, from which on it must be meant in percent: noise alone does not leave a shape.
const PERCENT: f64 = 5.0;

/// Part of a coordinate that six digits leave open.
const PLACE_DIGITS: f64 = 1e-5;

/// Difference of a factor of length from that of its unit, relative to it, that its digits do not explain: an inch is 39.37 or 39.3701 to
/// a meter.
const UNIT_DIGITS: f64 = 1e-4;

/// Part of a frequency beyond which what digits leave open is said: a fifth of the least deviation that is assumed.
pub(crate) const OPEN: f64 = 1e-3;

/// About nothing in particular.
const NONE: [&str; 0] = [];

/// A remark with a list at its end, if there is anything in it.
pub(super) fn listed(
    check: Check,
    name: &str,
    words: &str,
    about: &[impl ToString],
) -> Option<Concern> {
    let said = || Concern::remark(check, name, about, format!("{words}: {}.", some(about)));
    (!about.is_empty()).then(said)
}

/// Places from zero as numbers from one.
pub(super) fn numbers(places: impl IntoIterator<Item = usize>) -> Vec<usize> {
    places.into_iter().map(|place| place + 1).collect()
}

impl Trust {
    /// Everything that there is reason to say of a job before its first step.
    ///
    /// # Errors
    /// The errors of [`preflight_at_sensors`] and of the analysis that it needs; [`FileError::Refused`] for a mass that is not finite.
    pub fn before(prepared: &PreparedJob) -> Result<Self, FileError> {
        let loaded = &prepared.loaded;
        let mut all = prepared.preflight_concerns()?;
        // Where there are fewer modes than test modes there are no pairs, and no comparison.
        let first = prepared.analyze(&loaded.ones()).ok();
        // A mistake in the readings or in all frequencies says more than each pair that it makes.
        all.extend(match all.iter().any(Concern::stands) {
            true => vec![Concern::not_checked(
                Check::Reach,
                "another doubt is answered first",
            )],
            false => prepared.frequency_concerns(first.as_ref()),
        });
        all.extend(prepared.pairing_concerns());
        if !prepared.is_without_pairs() {
            all.extend(
                first
                    .as_ref()
                    .and_then(|first| prepared.unanswered(first, None)),
            );
        }
        all.extend(prepared.unseen_concerns());
        all.extend(prepared.noise_concerns());
        all.extend(loaded.part_concerns()?);
        all.extend(loaded.data_concerns());
        all.extend(listed(
            Check::Inputs,
            "not-used",
            "Not used of the inputs",
            &loaded.unused(),
        ));
        Ok(Self::new(all))
    }
}

impl PreparedJob {
    /// Remarks on which test modes are compared with which modes of the model.
    fn pairing_concerns(&self) -> Vec<Concern> {
        // What is unlike the first model may be like the corrected one.
        let unpaired = self.unpaired.iter();
        let mut all: Vec<Concern> = unpaired.map(|own| own.concern(Grade::Remark)).collect();
        let open = |name: &str, modes: &[usize], words: &str| {
            let words = format!("Test modes {} {words}", some(modes));
            (!modes.is_empty())
                .then(|| Concern::new(Grade::NotChecked, Check::Pairs, name, modes, words))
        };
        let undecided = numbers(self.undecided.iter().copied());
        all.extend(open(
            "undecided",
            &undecided,
            "are like several modes of the model each; they are paired by their frequencies.",
        ));
        let alone = numbers(self.alone().iter().map(|own| own.0));
        let words = "have no shapes and are paired by number, which nothing checks; the model's modes are followed by shape from there.";
        all.extend(open("frequencies-alone", &alone, words));
        let close = self.together().iter().filter(|group| group.len() > 1);
        let close = close.filter(|_| self.loaded.job.compare.method == Method::GaussNewton);
        all.extend(close.map(|group| {
            let modes = numbers(group.iter().map(|place| self.modes[*place]));
            let words = format!(
                "The frequencies of test modes {}, or of their partners in the first model, are no further apart than the deviations \
                 tell: their shapes are compared as one subspace.",
                some(&modes)
            );
            Concern::remark(Check::Pairs, "close-modes-", &modes, words)
        }));
        all
    }

    /// Remarks on what the test is weighted by.
    fn noise_concerns(&self) -> Vec<Concern> {
        let (loaded, remark) = (&self.loaded, |name: &str, words: String| {
            Concern::remark(Check::Deviations, name, &NONE, words)
        });
        let assumed = self.assumed_deviations();
        let mut all: Vec<Concern> = listed(
            Check::Deviations,
            "assumed-deviations",
            "Standard deviations assumed",
            &assumed,
        )
        .into_iter()
        .collect();
        let open = self.compared().map(|mode| (mode, self.open_part(mode)));
        let (open, parts): (Vec<usize>, Vec<f64>) = open.filter(|own| own.1 > OPEN).unzip();
        let most = parts.into_iter().fold(0.0, f64::max);
        let open = numbers(open);
        let words = format!(
            "The digits of the matrices leave the frequencies of test modes {} open by {:.2} % at most, which is added to their deviations.",
            some(&open),
            100.0 * most
        );
        all.extend(
            (!open.is_empty())
                .then(|| Concern::remark(Check::Deviations, "open-by-digits", &open, words)),
        );
        let own = self.own_weights(false);
        let mut own = own.iter().flat_map(|own| [own.frequency, own.shape]);
        let divides = own.any(|weight| ![0.0, 1.0].contains(&weight));
        let words = "The job's weights count as dividing the standard deviations: chi-squared and intervals hold for deviations so divided.";
        let is_said = divides && loaded.job.compare.method == Method::GaussNewton;
        all.extend(is_said.then(|| remark("own-weights", words.into())));
        let tests = self.loaded.job.test.repeats.len();
        let words = format!(
            "The test is the mean of {tests}; what all of them have wrong does not scatter."
        );
        all.extend((tests > 0).then(|| remark("repeats", words)));
        all
    }

    /// Standard deviations that neither test nor job gives, in words.
    pub fn assumed_deviations(&self) -> Vec<String> {
        let lacks =
            |component: usize, mode: usize| self.loaded.given_deviations(mode)[component].is_none();
        let frequencies = self.compared().any(|mode| lacks(0, mode));
        let shapes = self.modes.iter().any(|&mode| lacks(1, mode));
        let percent = |deviation: f64, what: &str| format!("{} % of {what}", 100.0 * deviation);
        let both = [
            frequencies.then(|| percent(DEVIATIONS.frequency, "frequencies")),
            shapes.then(|| percent(DEVIATIONS.shape, "shapes")),
        ];
        both.into_iter().flatten().collect()
    }

    /// Remarks on parts of the model without a sensor, and on modes of the first model that move none.
    fn unseen_concerns(&self) -> Vec<Concern> {
        let (source, hertz) = (&self.loaded.source, self.first.unseen());
        let hertz: Vec<String> = hertz.iter().map(|hertz| format!("{hertz:.4}")).collect();
        let parts = format!(
            "In parts of the model without a sensor, which are left out, {} degrees of freedom",
            source.left_out.len()
        );
        let modes = format!(
            "Modes of the model that no sensor sees, and that take no part, {}, at Hz",
            hertz.len()
        );
        let loose = "Mechanisms in parts of the model without a sensor, which nothing resists";
        let all = [
            listed(
                Check::Sight,
                "parts-without-sensor",
                &parts,
                &source.left_out,
            ),
            listed(
                Check::FreeMotions,
                "loose-without-sensor",
                loose,
                &source.loose,
            ),
            listed(Check::Sight, "unseen-modes", &modes, &hertz),
        ];
        all.into_iter().flatten().collect()
    }

    /// A remark on the modes of a model between the first and the last frequency of the test that no test mode answers: the test may have
    /// missed them. Their frequencies have deviations by the covariance of the factors' logarithms, where that is known.
    pub(super) fn unanswered(
        &self,
        model: &Comparison,
        covariance: Option<&DMatrix<f64>>,
    ) -> Option<Concern> {
        let exact = &model.model.exact;
        let (hertz, seen) = (
            exact.modes.frequencies_hz(),
            visibilities(&exact.modes.shapes),
        );
        let tested = self
            .compared()
            .map(|mode| self.loaded.data.frequencies_hz[mode]);
        let (first, last) = tested.fold((f64::INFINITY, 0.0_f64), |(first, last), hertz| {
            (first.min(hertz), last.max(hertz))
        });
        let partners = model.partners();
        let is_lacking =
            |mode: &usize| (first..=last).contains(&hertz[*mode]) && !partners.contains(mode);
        let deviation = |mode: usize, covariance: &DMatrix<f64>| {
            let slopes = model.model.couplings(&[mode])[0].row(mode)
                / (2.0 * exact.modes.omega_squared[mode]);
            format!(
                " ± {:.4}",
                hertz[mode] * (&slopes * covariance).dot(&slopes).sqrt()
            )
        };
        let name = |mode: usize| {
            let deviation = covariance.map_or(String::new(), |own| deviation(mode, own));
            format!(
                "mode {} ({:.4}{deviation} Hz, {:.2})",
                mode + 1,
                hertz[mode],
                seen[mode]
            )
        };
        let names: Vec<String> = (0..hertz.len()).filter(is_lacking).map(name).collect();
        let words = "Modes of the model between the first and the last frequency of the test that no test mode answers, and the part of \
                     other modes' motion that sensors see of them";
        listed(Check::Pairs, "unanswered-modes", words, &names)
    }

    /// What the pre-flight finds in all modes of the test.
    fn preflight_concerns(&self) -> Result<Vec<Concern>, FileError> {
        let loaded = &self.loaded;
        let whole = &loaded.source.whole;
        let left_out = self.unpaired.iter().map(|left| left.mode);
        let mut modes: Vec<usize> = left_out.chain(self.modes.iter().copied()).collect();
        modes.sort_unstable();
        modes.dedup();
        let bodies = whole.body_findings(|row| loaded.source.row_name(row))?;
        let lowest = self.first.shapes(1).frequencies_hz().first().copied();
        let bodies = bodies.into_iter().map(|finding| finding.beside(lowest));
        let mut concerns: Vec<Concern> = bodies.map(|finding| of_bodies(&finding)).collect();
        let is_said = loaded.job.model.rigid_bodies.is_some() && whole.rigid_bodies()?.rigid() > 0;
        let said = "model.rigid_bodies says how many there are";
        concerns.extend(is_said.then(|| Concern::not_checked(Check::FreeMotions, said)));
        concerns.extend(loaded.percent_deviations(&modes));
        concerns.extend(loaded.places_concerns());
        let (settings, ranges) = (&loaded.job.correlation, whole.ranges());
        let sensors = loaded.placed.iter();
        let tests = loaded.job.test.file.iter().chain(&loaded.job.test.repeats);
        let tests: Vec<_> = tests.map(|file| file.display()).collect();
        let names = Names {
            sensors: sensors.map(|sensor| sensor.name.clone()).collect(),
            parameters: loaded.parameter_names().map(str::to_owned).collect(),
            modes,
            file: some(&tests),
        };
        let modes = &names.modes;
        if modes.is_empty() {
            concerns.push(Concern::not_checked(
                Check::Readings,
                "the test has no shapes",
            ));
            concerns.extend(check_settings(settings, &ranges, &names));
            return Ok(concerns);
        }
        let test = loaded.measured(modes)?;
        let Modes {
            omega_squared: squares,
            shapes,
        } = self.first.shapes(2 * loaded.usual_modes());
        let seen = SeenModes {
            shares: self.first.shares(shapes.ncols()),
            modes: Modes::new(squares, loaded.sensors.times(&shapes)?)?,
        };
        // Assumed deviations are no less than a test's own, and declare none.
        let declared = |&mode: &usize| {
            let [frequency, shape] = loaded.given_deviations(mode).map(Option::unwrap_or_default);
            Noise { frequency, shape }
        };
        let noise: Vec<Noise> = names.modes.iter().map(declared).collect();
        let test = (&test, &noise[..]);
        concerns.extend(preflight_at_sensors(
            &seen, test, settings, &ranges, &names,
        )?);
        let has_doubt = concerns.iter().any(Concern::stands);
        if self.is_without_pairs() && !has_doubt {
            let words = "No test mode resembles a mode of the model: another structure, other sensors, or several mistakes at once?";
            concerns.push(Concern::doubt(Check::Pairs, "no-pair", &NONE, words.into()));
        }
        Ok(concerns)
    }
}

impl LoadedJob {
    /// Remarks on complex test modes and on what the readers of the test left aside or did not convert.
    fn data_concerns(&self) -> Vec<Concern> {
        let data = &self.data;
        let phases = data.phase_collinearity.iter().enumerate();
        let complex = phases.filter(|(_, phase)| **phase < COLLINEAR);
        let mut all: Vec<Concern> = complex
            .map(|(mode, phase)| {
                let words = format!(
                    "Test mode {} is complex: its phase collinearity is {phase:.2}.",
                    mode + 1
                );
                Concern::remark(Check::ComplexShapes, "complex-", &[mode + 1], words)
            })
            .collect();
        let rigid = numbers(data.rigid.iter().copied());
        all.extend(listed(
            Check::Inputs,
            "rigid-modes",
            "Test modes of 0 Hz, rigid-body modes, are not compared",
            &rigid,
        ));
        let lacking = "Sensors left out because some mode of the file has no value at them";
        all.extend(listed(
            Check::Inputs,
            "not-in-every-mode",
            lacking,
            &data.incomplete,
        ));
        let skipped = "Datasets of the Universal File that are not read";
        all.extend(listed(
            Check::Inputs,
            "datasets-not-read",
            skipped,
            &data.skipped,
        ));
        // The job chooses by number, and the file has other numbers, or another order.
        let given = &data.numbers;
        let is_chosen = self.job.test.modes.is_some() && !given.is_empty();
        all.extend((is_chosen || !given.is_sorted()).then(|| {
            let words = format!(
                "The test's file numbers its modes {}; here they are counted from 1 in the order of the file, in test.modes too.",
                some(given)
            );
            Concern::doubt(Check::Inputs, "numbered-otherwise", given, words)
        }));
        if let Some(units) = &data.units {
            let Some([factor, known]) = data.lengths_to_meter else {
                all.push(Concern::not_checked(
                    Check::Units,
                    "the length of its unit is not known",
                ));
                return all;
            };
            let is_other = (factor / known - 1.0).abs() > UNIT_DIGITS;
            let words = format!(
                "The test's file says that it is in {units}, of {known:.6} to a meter, but its factor of length is {factor:.6}."
            );
            all.extend(
                is_other.then(|| Concern::doubt(Check::Units, "units-disagree", &[units], words)),
            );
        }
        all
    }

    /// Cards, sensors and entries of the job's file that nothing uses.
    fn unused(&self) -> Vec<String> {
        let cards = self.source.deck.iter().flat_map(|(_, deck)| &deck.unread);
        let cards = cards.filter(|card| card.reason != Reason::WithoutPart);
        let sensors = self.data.sensors.len() - self.placed.len();
        let sensors = (sensors > 0).then(|| format!("{sensors} of the test's sensors"));
        let entries = self.unused_entries();
        cards
            .map(Unread::place)
            .chain(sensors)
            .chain(entries)
            .collect()
    }

    /// Standard deviations that are given in percent.
    fn percent_deviations(&self, modes: &[usize]) -> Vec<Concern> {
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
        let concern = |(setting, value): (&str, f64)| match setting == "shape_deviation"
            && value < PERCENT
        {
            true => {
                let words = format!(
                    "Setting {setting} is {value}: a standard deviation of {} % of a shape's largest component?",
                    100.0 * value
                );
                Concern::remark(Check::Settings, "large-", &[setting], words)
            }
            false => percent(setting, value),
        };
        large.map(concern).collect()
    }

    /// Doubts about places of sensors that span much more than the model does, or that are twice as near to another grid as to the one
    /// that the test names, unless the job says how far a sensor may be.
    pub fn places_concerns(&self) -> Vec<Concern> {
        let known = || self.placed.iter().filter(|own| own.distance.is_some());
        if known().next().is_none() {
            let reason = "the places of sensors or of their grids are not given";
            return vec![Concern::not_checked(Check::PlacesOfSensors, reason)];
        }
        let is_elsewhere = |own: &&PlacedSensor| {
            let sensor = &self.data.sensors[own.row];
            let (Some(at), Some(distance)) = (sensor.place, own.distance) else {
                return false;
            };
            // Grids may be close, and sensors stand on a skin.
            let is_nearer = |place: &Vector3<f64>| 2.0 * (place - at).norm() < distance;
            let is_off = distance > PLACE_DIGITS * at.amax() && sensor.grid == Some(own.grid);
            is_off
                && self.job.sensors.distance.is_none()
                && self.source.geometry.places.values().any(is_nearer)
        };
        let elsewhere: Vec<&String> = known().filter(is_elsewhere).map(|own| &own.name).collect();
        let words = format!(
            "By their places sensors {} are nearer to other grids than to those that they name; is a place, a grid or a unit of length \
             wrong? sensors.distance says how far a sensor may be.",
            some(&elsewhere)
        );
        let doubt = || Concern::doubt(Check::PlacesOfSensors, "other-grid", &elsewhere, words);
        let other = (!elsewhere.is_empty()).then(doubt);
        other.into_iter().chain(self.unit_of_places()).collect()
    }

    /// A doubt about the unit of the sensors' places where they span much more than the model does.
    fn unit_of_places(&self) -> Option<Concern> {
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
        let words = format!(
            "The sensors' places span {ratio:.1} times what the model's do: another unit of length?"
        );
        (ratio > LARGEST_SPAN)
            .then(|| Concern::doubt(Check::PlacesOfSensors, "unit-of-places", &NONE, words))
    }
}

/// What the digits of a stiffness leave open, as a concern.
pub fn of_bodies(finding: &BodyFinding) -> Concern {
    let check = Check::FreeMotions;
    match finding {
        BodyFinding::Mechanisms(rows) => {
            let words = format!(
                "Motions of {} are none of a rigid body, and the digits of the stiffness do not tell that anything resists them: \
                 mechanisms, or springs too soft for it. They count as free; model.rigid_bodies decides.",
                some(rows)
            );
            Concern::doubt(check, "mechanisms", rows, words)
        }
        BodyFinding::Held { row, free } => {
            let words = format!(
                "Motions of a rigid body that are free: {free}; one that is not meets most force at {row}: held on purpose?"
            );
            Concern::remark(check, "held-direction", &[row], words)
        }
        BodyFinding::ByDigits {
            count,
            digits,
            if_held,
            hidden_hz,
            is_sure,
        } => {
            let hertz = |[own, open]: &[f64; 2]| format!("{own:.1e} ± {open:.0e}");
            let held: Vec<String> = if_held.iter().map(hertz).collect();
            let held = match &held[..] {
                [] => "taken as held".to_owned(),
                held => format!("at {} Hz if held", held.join(", ")),
            };
            let words = format!(
                "Not told from free by {digits} of the stiffness: {count}, {held}; a suspension below {hidden_hz:.0e} Hz would not show. \
                 Places of the rows, or model.rigid_bodies, decide."
            );
            let grade = if *is_sure {
                Grade::NotChecked
            } else {
                Grade::Doubt
            };
            Concern::new(grade, check, "free-by-digits", &NONE, words)
        }
    }
}
