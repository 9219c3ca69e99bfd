//! Doubts about what a job names, before the first analysis, and remarks.

use super::{
    LoadedJob,
    concern::{Check, Concern, Grade, NONE, listed, numbers, some},
    sensors::PlacedSensor,
};
use crate::{
    files::{
        deck::{Reason, Unread},
        error::FileError,
    },
    method::step::Bounds,
    sparse::WholeShare,
    weighted::noise::Noise,
};
use nalgebra::Vector3;

/// Modal phase collinearity below which a complex test mode is doubtful as a real one.
const COLLINEAR: f64 = 0.95;

/// Tolerance beyond which a percentage was probably meant: a fifth of the frequency, or of the largest component.
const LARGEST_TOLERANCE: f64 = 0.2;

/// Deviation of a shape's components, over its largest, from which on it must be meant in percent: noise alone does not leave a shape.
const PERCENT: f64 = 5.0;

/// Span of the sensors' places over the model's from which they are in another unit: the least factor between two customary units
/// of length is 2.54, and sensors sit on the structure.
const LARGEST_SPAN: f64 = 2.0;

/// Part of a coordinate that six digits leave open.
const PLACE_DIGITS: f64 = 1e-5;

/// Difference of a factor of length from that of its unit, relative to it, that its digits do not explain: an inch is 39.37 or 39.3701 to
/// a meter.
const UNIT_DIGITS: f64 = 1e-4;

impl LoadedJob {
    /// Remarks on complex test modes and on what the readers of the test left aside or did not convert.
    pub(super) fn data_concerns(&self) -> Vec<Concern> {
        let (data, check) = (&self.data, Check::Inputs);
        let phases = data.phase_collinearity.iter().enumerate();
        let complex = phases.filter(|own| *own.1 < COLLINEAR);
        let complex = complex.map(|(mode, phase)| format!("{} ({phase:.2})", mode + 1));
        let complex: Vec<String> = complex.collect();
        let words = "Complex test modes, with their phase collinearity";
        let mut all = Vec::from_iter(listed(Check::ComplexShapes, "complex", words, &complex));
        let rigid = numbers(data.rigid.iter().copied());
        all.extend(listed(
            check,
            "rigid-modes",
            "Test modes of 0 Hz, rigid-body modes, are not compared",
            &rigid,
        ));
        all.extend(listed(
            check,
            "not-in-every-mode",
            "Sensors left out because some mode of the file has no value at them",
            &data.incomplete,
        ));
        all.extend(listed(
            check,
            "datasets-not-read",
            "Datasets of the Universal File that are not read",
            &data.skipped,
        ));
        let cards = self.source.deck.iter().flat_map(|(_, deck)| &deck.unread);
        let cards = cards.filter(|card| card.reason != Reason::WithoutPart);
        let cards: Vec<String> = cards.map(Unread::place).collect();
        all.extend(listed(check, "not-used", "Not used of the deck", &cards));
        // The job chooses by number, and the file has other numbers, or another order.
        let given = &data.numbers;
        let is_chosen = self.job.test.modes.is_some() && !given.is_empty();
        if is_chosen || !given.is_sorted() {
            let words = format!(
                "The test's file numbers its modes {}; here they are counted from 1 in the order of the file, in test.modes too.",
                some(given)
            );
            all.push(Concern::doubt(check, "numbered-otherwise", given, words));
        }
        match (&data.units, data.lengths_to_meter) {
            (Some(units), Some([factor, known])) if (factor / known - 1.0).abs() > UNIT_DIGITS => {
                let words = format!(
                    "The test's file says that it is in {units}, of {known:.6} to a meter, but its factor of length is {factor:.6}."
                );
                all.push(Concern::doubt(
                    Check::Units,
                    "units-disagree",
                    &[units],
                    words,
                ));
            }
            (Some(_), None) => {
                all.push(Concern::not_checked(
                    Check::Units,
                    "the length of its unit is not known",
                ));
            }
            _ => (),
        }
        all
    }

    /// Doubts about tolerances and standard deviations that look like percent, and about bounds.
    pub(super) fn setting_concerns(&self) -> Vec<Concern> {
        let own = &self.job.correlation;
        let largest = |of: fn(&Noise) -> f64| {
            self.numbers
                .iter()
                .map(|mode| of(&self.deviations(mode - 1)))
                .fold(0.0, f64::max)
        };
        let tolerance = LARGEST_TOLERANCE;
        let fractions = [
            (
                "frequency_deviation",
                largest(|noise| noise.frequency),
                tolerance,
            ),
            ("shape_deviation", largest(|noise| noise.shape), PERCENT),
            ("inner.tolerance", own.inner.tolerance, tolerance),
            (
                "later_inner_tolerance",
                own.later_inner_tolerance,
                tolerance,
            ),
            ("error_sum_tolerance", own.error_sum_tolerance, tolerance),
            ("frequency_tolerance", own.frequency_tolerance, tolerance),
            ("shape_tolerance", own.shape_tolerance, tolerance),
        ];
        let percent = fractions.into_iter().filter(|own| own.1 > own.2).map(|(setting, value, _)| {
            let words = format!(
                "Setting {setting} is {value}, that is {} %: a percentage where a fraction is meant?",
                100.0 * value
            );
            Concern::doubt(Check::Settings, "percent-", &[setting], words)
        });
        let excluding = self.parameter_names().zip(self.source.whole.ranges()).filter_map(|(name, range)| {
            let Bounds { lower, upper } = range.filter(|range| !range.holds_start())?;
            let words = format!(
                "Bounds on the factor of parameter {name}, {lower} to {upper}, exclude its first value."
            );
            Some(Concern::doubt(Check::Settings, "excludes-start-", &[name], words))
        });
        percent.chain(excluding).collect()
    }

    /// Doubts about parameters' matrices that have negative energy or exceed the first stiffness or mass; remarks where
    /// the signs of pivots do not tell.
    ///
    /// # Errors
    /// Errors of the first matrices and of a factorization's plan.
    pub(super) fn part_concerns(&self) -> Result<Vec<Concern>, FileError> {
        let (whole, check) = (&self.source.whole, Check::PartsOfTheModel);
        let (stiffness, mass) = whole.at(&self.ones())?;
        let mut all = Vec::new();
        for (what, first) in [("stiffness", &stiffness), ("mass", &mass)] {
            let mut parts = Vec::new();
            for own in whole.parameters() {
                match &own.share {
                    // Elements of a deck are parts of its stiffness.
                    WholeShare::Stiffness(_) if self.source.deck.is_some() => (),
                    WholeShare::Stiffness(part) if what == "stiffness" => {
                        parts.push((&own.name, part))
                    }
                    WholeShare::Mass(part) if what == "mass" => parts.push((&own.name, part)),
                    _ => (),
                }
            }
            for (name, part) in parts {
                let found = [
                    (
                        "negative-",
                        whole.is_negative(what, first, &[(1.0, part)]),
                        "has negative energy, more than its digits explain",
                    ),
                    (
                        "not-part-",
                        whole.is_negative(what, first, &[(1.0, first), (-1.0, part)]),
                        "is not part of the first model's, which without it has negative energy",
                    ),
                ];
                for (kind, found, what) in found {
                    all.push(match found {
                        Ok(false) => continue,
                        Ok(true) => {
                            let words = format!("The matrix of parameter \"{name}\" {what}.");
                            Concern::doubt(check, kind, &[name], words)
                        }
                        Err(error) => {
                            let words = format!(
                                "Whether parameter \"{name}\" is part of the first model was not checked: {error}."
                            );
                            Concern::new(Grade::NotChecked, check, "part-not-checked-", &[name], words)
                        }
                    });
                }
            }
        }
        Ok(all)
    }

    /// Doubts about places of sensors that span much more than the model does, or that are twice as near to another grid as to the one
    /// that the test names, unless the job says how far a sensor may be.
    pub fn places_concerns(&self) -> Vec<Concern> {
        let check = Check::PlacesOfSensors;
        let known: Vec<&PlacedSensor> = self
            .placed
            .iter()
            .filter(|own| own.distance.is_some())
            .collect();
        if known.is_empty() {
            return vec![Concern::not_checked(
                check,
                "the places of sensors or of their grids are not given",
            )];
        }
        let (mut all, places) = (Vec::new(), self.source.places.values());
        let is_elsewhere = |own: &&&PlacedSensor| {
            let sensor = &self.data.sensors[own.row];
            let (Some(at), Some(distance)) = (sensor.place, own.distance) else {
                return false;
            };
            // Grids may be close, and sensors stand on a skin.
            let is_nearer = |place: &Vector3<f64>| 2.0 * (place - at).norm() < distance;
            let is_off = distance > PLACE_DIGITS * at.amax() && sensor.grid == Some(own.grid);
            is_off && self.job.sensors.distance.is_none() && places.clone().any(is_nearer)
        };
        let elsewhere: Vec<&String> = known
            .iter()
            .filter(is_elsewhere)
            .map(|own| &own.name)
            .collect();
        if !elsewhere.is_empty() {
            let words = format!(
                "By their places sensors {} are nearer to other grids than to those that they name; is a place, a grid or a unit of length \
                 wrong? sensors.distance says how far a sensor may be.",
                some(&elsewhere)
            );
            all.push(Concern::doubt(check, "other-grid", &elsewhere, words));
        }
        // The diagonal of the box about some places.
        let span = |places: &[Vector3<f64>]| {
            let end = |of: fn(&Vector3<f64>, &Vector3<f64>) -> Vector3<f64>| {
                places
                    .iter()
                    .copied()
                    .reduce(|a, b| of(&a, &b))
                    .unwrap_or_default()
            };
            (end(Vector3::sup) - end(Vector3::inf)).norm()
        };
        let test = known
            .iter()
            .filter_map(|own| self.data.sensors[own.row].place);
        let [test, model]: [Vec<_>; 2] = [test.collect(), places.copied().collect()];
        let ratio = span(&test) / span(&model);
        if ratio > LARGEST_SPAN {
            let words = format!(
                "The sensors' places span {ratio:.1} times what the model's do: another unit of length?"
            );
            all.push(Concern::doubt(check, "unit-of-places", &NONE, words));
        }
        all
    }
}
