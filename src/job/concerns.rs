//! Doubts about a job before its first step, and remarks.

use super::concern::{Check, Concern, Kind, Trust};
use super::preflight::{LARGEST_TOLERANCE, Names, SeenModes, check_settings, preflight_at_sensors};
use super::prepared::LeftOut;
use super::sensors::{PlacedSensor, motion};
use super::{LoadedJob, Method, PreparedJob};
use crate::files::deck::{Reason, Unread};
use crate::files::error::FileError;
use crate::method::error::Error;
use crate::method::modes::Modes;
use crate::sparse::rigid_bodies::BodyFinding;
use crate::weighted::comparison::LoneFrequency;
use crate::weighted::noise::Noise;
use crate::weighted::residuals::DEVIATIONS;
use nalgebra::Vector3;

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

/// A concern about several things, if there are any.
fn about_any(kind: Kind, about: &[impl ToString]) -> Option<Concern> {
    (!about.is_empty()).then(|| Concern::new(kind, about, &[]))
}

/// Places from zero as numbers from one.
fn numbers(places: impl IntoIterator<Item = usize>) -> Vec<usize> {
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
        all.extend(prepared.pairing_concerns()?);
        // Where there are fewer modes than test modes there are no pairs, and no comparison.
        let first = prepared.analyze(&loaded.ones()).ok();
        // A mistake in the readings or in all frequencies says more than each pair that it makes.
        all.extend(match all.iter().any(Concern::stands) {
            true => vec![Check::skipped(
                &[Check::Reach],
                "another doubt is answered first",
            )],
            false => prepared.frequency_concerns(first.as_ref()),
        });
        if !prepared.is_without_pairs() {
            all.extend(first.as_ref().and_then(|first| prepared.unanswered(first)));
        }
        all.extend(prepared.unseen_concerns());
        all.extend(prepared.noise_concerns());
        all.extend(loaded.part_concerns()?);
        all.extend(loaded.data_concerns());
        all.extend(loaded.mass_concerns());
        all.extend(about_any(Kind::NotUsed, &loaded.unused()));
        Ok(Self::new(all))
    }
}

impl LeftOut {
    /// What is said of the mode.
    pub(super) fn concern(&self) -> Concern {
        Concern::new(self.why, &[self.mode + 1], &[self.assurance])
    }
}

impl PreparedJob {
    /// Remarks on which test modes are compared with which modes of the model.
    fn pairing_concerns(&self) -> Result<Vec<Concern>, Error> {
        let loaded = &self.loaded;
        let mut all: Vec<Concern> = self.unpaired.iter().map(LeftOut::concern).collect();
        let pair = |(mode, lone): &(usize, LoneFrequency)| {
            format!("{} with the model's {}", mode + 1, lone.partner + 1)
        };
        let alone: Vec<String> = self.alone().iter().map(pair).collect();
        let modes = loaded.data.vibrations().into_iter();
        let left: Vec<usize> = modes.filter(|mode| !loaded.job.selects(*mode)).collect();
        let rigid = numbers(loaded.data.rigid.iter().copied());
        all.extend(about_any(Kind::RigidModes, &rigid));
        all.extend(about_any(
            Kind::Undecided,
            &numbers(self.undecided.iter().copied()),
        ));
        all.extend(about_any(Kind::FrequenciesAlone, &alone));
        all.extend(about_any(Kind::NotSelected, &left));
        if loaded.job.compare.method == Method::GaussNewton {
            let close = self.together().iter().filter(|group| group.len() > 1);
            all.extend(close.map(|group| {
                let modes = numbers(group.iter().map(|place| self.modes[*place]));
                Concern::new(Kind::CloseModes, &modes, &[])
            }));
        }
        let rigid = loaded.source.whole.rigid_bodies()?.rigid();
        let measure = [self.analysis_modes as f64, rigid as f64];
        all.push(Concern::plain(Kind::AnalysisModes, &measure));
        Ok(all)
    }

    /// Remarks on what the test is weighted by.
    fn noise_concerns(&self) -> Vec<Concern> {
        let loaded = &self.loaded;
        let lacks =
            |component: usize, mode: usize| loaded.given_deviations(mode)[component].is_none();
        let percent = |deviation: f64, what: &str| format!("{} % of {what}", 100.0 * deviation);
        let frequencies = self.compared().any(|mode| lacks(0, mode));
        let shapes = self.modes.iter().any(|&mode| lacks(1, mode));
        let assumed: Vec<String> = [
            frequencies.then(|| percent(DEVIATIONS.frequency, "frequencies")),
            shapes.then(|| percent(DEVIATIONS.shape, "shapes")),
        ]
        .into_iter()
        .flatten()
        .collect();
        let mut all: Vec<Concern> = about_any(Kind::AssumedDeviations, &assumed)
            .into_iter()
            .collect();
        let divides = |weight: f64| ![0.0, 1.0].contains(&weight);
        let own = self.own_weights();
        let mut own = own.iter().flat_map(|own| [own.frequency, own.shape]);
        if loaded.job.compare.method == Method::GaussNewton && own.any(divides) {
            all.push(Concern::plain(Kind::OwnWeights, &[]));
        }
        let tests = loaded.data.scatter.ncols() as f64;
        let free = self.free_numbers() as f64;
        if tests > 0.0 {
            all.push(match self.covariance() {
                Some(_) => Concern::plain(Kind::Covariance, &[tests]),
                None => Concern::plain(Kind::Variances, &[tests, free, free + 3.0]),
            });
        }
        all
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
        concerns.extend(is_said.then(|| Check::skipped(&[Check::FreeMotions], said)));
        concerns.extend(loaded.percent_deviations(&modes));
        concerns.extend(loaded.places_concerns());
        let (settings, ranges) = (&loaded.job.correlation, whole.ranges());
        let sensors = loaded.placed.iter();
        let names = Names {
            sensors: sensors.map(|sensor| sensor.name.clone()).collect(),
            parameters: loaded.parameter_names().map(str::to_owned).collect(),
            modes,
        };
        let modes = &names.modes;
        if modes.is_empty() {
            use Check::*;
            let none = [
                Readings,
                Directions,
                Copies,
                CommonFactor,
                OrderOfFrequencies,
            ];
            concerns.push(Check::skipped(&none, "the test has no shapes"));
            concerns.extend(check_settings(settings, &ranges, &names));
            return Ok(concerns);
        }
        let test = loaded.measured(modes)?;
        let Modes {
            omega_squared: squares,
            shapes,
        } = self.first.shapes(2 * loaded.usual_modes());
        let along = |(place, sensor): (usize, &PlacedSensor)| {
            let own = sensor.direction;
            let others = (own / 3 * 3..own / 3 * 3 + 3).filter(move |other| *other != own);
            let read = |other: usize| {
                let axis = Vector3::ith(other % 3, 1.0);
                let motion = motion(&loaded.source, sensor.grid, other, axis);
                let rows = motion.map(|(row, coefficient)| shapes.row(row) * coefficient);
                rows.reduce(|sum, row| sum + row)
                    .map(|readings| (place, other, readings))
            };
            others.filter_map(read).collect::<Vec<_>>()
        };
        let seen = SeenModes {
            directions: loaded.placed.iter().enumerate().flat_map(along).collect(),
            shares: self.first.shares(shapes.ncols()),
            modes: Modes::new(squares, loaded.sensors.times(&shapes)?)?,
        };
        let one = "the model moves in no other direction there";
        let is_open = seen.directions.is_empty();
        concerns.extend(is_open.then(|| Check::skipped(&[Check::Directions], one)));
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
            concerns.push(Concern::plain(Kind::NoPair, &[]));
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
        let complex =
            complex.map(|(mode, phase)| Concern::new(Kind::Complex, &[mode + 1], &[*phase]));
        let mut all: Vec<Concern> = complex.collect();
        all.extend(data.drift.map(|lag| {
            let wider = ((1.0 + lag) / (1.0 - lag)).sqrt();
            Concern::plain(Kind::Drift, &[lag, wider])
        }));
        all.extend(about_any(Kind::NotInEveryMode, &data.incomplete));
        all.extend(about_any(Kind::DatasetsNotRead, &data.skipped));
        all.extend(self.numbers_concern());
        if let (Some(units), Some([factor, known])) = (&data.units, data.lengths_to_meter) {
            let is_other = (factor / known - 1.0).abs() > UNIT_DIGITS;
            let doubt = || Concern::new(Kind::UnitsDisagree, &[units], &[factor, known]);
            all.extend(is_other.then(doubt));
        } else if data.units.is_some() {
            let own = "its file has a system of units of its own";
            all.push(Check::skipped(&[Check::Units], own));
        }
        let units = data.units.iter();
        all.extend(units.map(|units| Concern::new(Kind::UnitsOfTest, &[units], &[])));
        all
    }

    /// Remarks on the total mass and its center.
    fn mass_concerns(&self) -> Vec<Concern> {
        let mass: [f64; 3] = self.source.mass.into();
        let said = mass.map(|along| format!("{along:.5e}"));
        let kind = match said.iter().all(|along| *along == said[0]) {
            true => Kind::Mass,
            false => Kind::MassByDirection,
        };
        let mass = (mass != [0.0; 3]).then(|| Concern::plain(kind, &mass));
        let center = self.source.mass_center.map(|center| {
            let far = center.amax();
            // What is left of sums that cancel is no distance.
            let rounded = center.map(|part| if part.abs() < 1e-9 * far { 0.0 } else { part });
            Concern::plain(Kind::CenterOfMass, rounded.as_slice())
        });
        mass.into_iter().chain(center).collect()
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
        let concern =
            |(setting, value): (&str, f64)| match setting == "shape_deviation" && value < PERCENT {
                true => Concern::new(Kind::LargeDeviation, &[setting], &[value, 100.0 * value]),
                false => Concern::percent(setting, value),
            };
        large.map(concern).collect()
    }

    /// A doubt about the numbers that the test's file gives its modes, where they are in another order, or the job chooses by number.
    fn numbers_concern(&self) -> Option<Concern> {
        let numbers = &self.data.numbers;
        let chooses = self.job.test.modes.is_some() && !numbers.is_empty();
        (chooses || !numbers.is_sorted())
            .then(|| Concern::new(Kind::NumberedOtherwise, numbers, &[]))
    }

    /// Doubts about places of sensors that span much more than the model does, or that are twice as near to another grid as to the one
    /// that the test names, unless the job says how far a sensor may be.
    pub fn places_concerns(&self) -> Vec<Concern> {
        let known = || self.placed.iter().filter(|own| own.distance.is_some());
        if known().next().is_none() {
            let reason = "the places of sensors or of their grids are not given";
            return vec![Check::skipped(&[Check::Places], reason)];
        }
        let grids = &self.source.geometry.places;
        let is_elsewhere = |own: &&PlacedSensor| {
            let at = self.data.sensors[own.row].place;
            let (Some(at), Some(distance)) = (at, own.distance) else {
                return false;
            };
            // Grids may be close, and sensors stand on a skin.
            let is_nearer = |place: &Vector3<f64>| 2.0 * (place - at).norm() < distance;
            let is_off = distance > PLACE_DIGITS * at.amax();
            is_off
                && self.data.sensors[own.row].grid == Some(own.grid)
                && grids.values().any(is_nearer)
        };
        let elsewhere = known().filter(is_elsewhere).map(|own| &own.name);
        let elsewhere: Vec<&String> = match self.job.sensors.distance {
            None => elsewhere.collect(),
            Some(_) => Vec::new(),
        };
        let unit = self.unit_of_places();
        about_any(Kind::OtherGrid, &elsewhere)
            .into_iter()
            .chain(unit)
            .collect()
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
        (ratio > LARGEST_SPAN).then(|| Concern::plain(Kind::UnitOfPlaces, &[ratio]))
    }
}

/// What the digits of a stiffness leave open, as a concern.
pub fn of_bodies(finding: &BodyFinding) -> Concern {
    match finding {
        BodyFinding::Mechanisms(rows) => Concern::new(Kind::Mechanisms, rows, &[]),
        BodyFinding::Held { row, free } => {
            Concern::new(Kind::HeldDirection, &[row], &[*free as f64])
        }
        BodyFinding::ByDigits {
            count,
            digits,
            hidden_hz,
            is_sure,
        } => {
            let kind = match is_sure {
                true => Kind::SuspensionHidden,
                false => Kind::FreeByDigits,
            };
            Concern::new(kind, &[digits], &[*count as f64, *hidden_hz])
        }
    }
}
