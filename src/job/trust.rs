//! What lowers the trust in a job's result, collected in one place.

use super::LoadedJob;
use super::loaded::{FLOOR, measured};
use super::preflight::{Finding, FindingNames, LARGEST_TOLERANCE, SeenModes, preflight_at_sensors};
use super::sensors::{PlacedSensor, motion};
use crate::files::deck::{BulkData, Reason, Unread};
use crate::files::error::FileError;
use crate::method::modes::ModeSet;
use crate::method::verdict::Verdict;
use crate::sparse::{Factor, SparseMatrix, WholeShare, modes_at_most};
use crate::weighted::identifiability::Identifiability;
use crate::weighted::noise::Noise;
use crate::weighted::residuals::DEVIATIONS;
use nalgebra::Vector3;
use serde::Serialize;

/// Modal phase collinearity below which a complex test mode is doubtful as a real one.
const COLLINEAR: f64 = 0.95;

/// Span of the sensors' places over the model's from which they are in another unit: the least factor between two customary units
/// of length is 2.54, and sensors sit on the structure.
const LARGEST_SPAN: f64 = 2.0;

/// Something that a reader must know before trusting a result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Concern {
    /// What names it on the command line: lower-case words, numbers and names joined by hyphens.
    pub identifier: String,
    /// Whether it names a mistake; a remark only limits what is known.
    pub is_doubt: bool,
    /// Whether the user answers for it, by its identifier.
    pub is_accepted: bool,
    /// A sentence.
    pub words: String,
}

/// A test mode that resembles no mode of the model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NotCompared {
    /// Its number in the test's file.
    pub mode: usize,
    /// Its largest modal assurance with any mode of the model.
    pub assurance: f64,
}

/// Everything that may lower the trust in a job's result. Every output shows [`Trust::all`] first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trust {
    /// What stands before the first step.
    pub concerns: Vec<Concern>,
    /// Selected test modes that resemble no mode of the best model, and so are not compared.
    pub not_compared: Vec<NotCompared>,
    /// Test modes, by their numbers in the test's file, that several modes of the first model resemble equally.
    pub undecided: Vec<usize>,
    /// Test modes, by their numbers in the test's file, that were left out at first and are compared since.
    pub joined: Vec<usize>,
    /// Whether the run was stopped by request.
    pub is_interrupted: bool,
    /// Test modes of the file that the job does not select.
    pub not_selected: Vec<usize>,
    /// Parameters that the test hardly sees.
    pub blind: Vec<String>,
    /// Groups of parameters that the test cannot tell apart.
    pub parallel: Vec<Vec<String>>,
    /// Parameters at an end of their range.
    pub at_bound: Vec<String>,
    /// Standard deviations that neither test nor job gives.
    pub assumed: Vec<String>,
    /// What of the inputs is not used.
    pub ignored: Vec<String>,
    /// How many modes of the model are taken.
    pub analysis_modes: usize,
    /// How many rigid-body modes the first model has, which are not among them.
    pub rigid_body_modes: usize,
    /// Total mass of a deck and its center, in the deck's units.
    pub mass_and_center: Option<(f64, [f64; 3])>,
}

impl Concern {
    /// A doubt, which names a mistake.
    pub fn doubt(identifier: impl Into<String>, words: impl Into<String>) -> Self {
        Self {
            identifier: identifier.into(),
            is_doubt: true,
            is_accepted: false,
            words: words.into(),
        }
    }

    /// A remark, which limits what is known.
    pub fn remark(identifier: impl Into<String>, words: impl Into<String>) -> Self {
        Self {
            is_doubt: false,
            ..Self::doubt(identifier, words)
        }
    }

    /// Whether it names a mistake that nobody answers for.
    pub fn stands(&self) -> bool {
        self.is_doubt && !self.is_accepted
    }
}

impl Trust {
    /// Before the first step: what the job, its test and its model give reason to say.
    ///
    /// # Errors
    /// Those of [`LoadedJob::concerns`]; [`FileError::Refused`] for an accepted identifier that names no doubt of this job.
    pub fn before(loaded: &LoadedJob) -> Result<Self, FileError> {
        let mut concerns = loaded.concerns()?;
        let doubts: Vec<String> = concerns
            .iter()
            .filter(|concern| concern.is_doubt)
            .map(|concern| concern.identifier.clone())
            .collect();
        for accepted in &loaded.accepted {
            let unknown = (!doubts.contains(accepted)).then_some(());
            loaded.job.refuse_if(unknown, |()| match &doubts[..] {
                [] => format!("--accept {accepted}: nothing is doubtful"),
                _ => format!("--accept {accepted}: the doubts are {}", doubts.join(", ")),
            })?;
        }
        for concern in &mut concerns {
            concern.is_accepted = loaded.accepted.contains(&concern.identifier);
        }
        let (data, compare) = (&loaded.data, &loaded.job.compare);
        let assumed = [
            (
                "frequencies",
                data.frequency_deviation.is_none() && compare.frequency_deviation.is_none(),
                DEVIATIONS.frequency,
            ),
            (
                "shapes",
                data.shape_deviation.is_none() && compare.shape_deviation.is_none(),
                DEVIATIONS.shape,
            ),
        ];
        let deck = loaded.source.deck.as_ref().map(|(_, deck)| &deck.model);
        let mass_and_center = deck.map(BulkData::mass_and_center).transpose()?.flatten();
        let cards = loaded.source.deck.iter().flat_map(|(_, deck)| &deck.unread);
        let cards = cards.filter(|card| card.reason != Reason::WithoutPart);
        let sensors = loaded.data.sensors.len() - loaded.placed.len();
        Ok(Self {
            concerns,
            not_compared: not_compared(&loaded.unpaired),
            undecided: from_one(&loaded.undecided),
            joined: Vec::new(),
            is_interrupted: false,
            not_selected: (1..=data.frequencies_hz.len())
                .filter(|mode| !loaded.job.selects(*mode))
                .collect(),
            blind: Vec::new(),
            parallel: Vec::new(),
            at_bound: Vec::new(),
            assumed: assumed
                .into_iter()
                .filter(|(_, is_assumed, _)| *is_assumed)
                .map(|(what, _, deviation)| format!("{} % of {what}", 100.0 * deviation))
                .collect(),
            ignored: cards
                .map(Unread::place)
                .chain((sensors > 0).then(|| format!("{sensors} of the test's sensors")))
                .collect(),
            analysis_modes: loaded.analysis_modes,
            rigid_body_modes: loaded
                .source
                .whole
                .modes(&loaded.ones(), 1)?
                .rigid_body
                .ncols(),
            mass_and_center: mass_and_center.map(|(mass, center)| (mass, center.into())),
        })
    }

    /// The same after a run.
    pub(super) fn after(
        self,
        loaded: &LoadedJob,
        unpaired: Vec<(usize, f64)>,
        verdict: &Verdict,
        seen: &Identifiability,
        is_interrupted: bool,
    ) -> Self {
        let names: Vec<&str> = loaded.parameter_names().collect();
        let named = |places: &[usize]| places.iter().map(|&e| names[e].to_owned()).collect();
        let mut blind = [&seen.blind[..], &verdict.unseen].concat();
        blind.sort_unstable();
        blind.dedup();
        let groups = seen.parallel_groups();
        Self {
            blind: named(&blind),
            parallel: groups.iter().map(|group| named(group)).collect(),
            at_bound: named(&verdict.at_bound),
            not_compared: not_compared(&unpaired),
            joined: from_one(&loaded.joined),
            is_interrupted,
            ..self
        }
    }

    /// Everything in sentences, what matters most first.
    pub fn all(&self) -> Vec<Concern> {
        let join = |names: &[String]| names.join(", ");
        let numbers = |modes: &[usize]| {
            let numbers: Vec<String> = modes.iter().map(usize::to_string).collect();
            numbers.join(", ")
        };
        let remark = |is_so: bool, identifier: &str, words: String| {
            is_so.then(|| Concern::remark(identifier, words))
        };
        let (doubts, remarks): (Vec<Concern>, Vec<Concern>) = self
            .concerns
            .iter()
            .cloned()
            .partition(|concern| concern.is_doubt);
        let not_compared = self.not_compared.iter().map(|left| {
            let NotCompared { mode, assurance } = left;
            let why = if *assurance < FLOOR {
                "it resembles no mode of the model"
            } else {
                "the mode of the model that it resembles belongs to another test mode"
            };
            Concern::remark(
                format!("not-compared-{mode}"),
                format!("Test mode {mode} is not compared: {why} (modal assurance {assurance:.2} at most)."),
            )
        });
        let parallel = self.parallel.iter().map(|group| {
            Concern::remark(
                format!(
                    "parallel-{}",
                    group
                        .join("-")
                        .to_lowercase()
                        .replace(char::is_whitespace, "-")
                ),
                format!(
                    "The test cannot tell {} apart; only their combination is known.",
                    group.join(" and ")
                ),
            )
        });
        let others = [
            remark(
                !self.undecided.is_empty(),
                "undecided",
                format!(
                    "Shapes do not decide which modes of the model are those of test modes {}; they are paired in the order of \
                     frequencies.",
                    numbers(&self.undecided)
                ),
            ),
            remark(
                !self.joined.is_empty(),
                "joined",
                format!(
                    "Test modes left out at first and compared since: {}. The passes shown are those since.",
                    numbers(&self.joined)
                ),
            ),
            remark(
                !self.blind.is_empty(),
                "blind",
                format!(
                    "Hardly seen by the test, and so not to be trusted: {}.",
                    join(&self.blind)
                ),
            ),
            remark(
                !self.at_bound.is_empty(),
                "at-bound",
                format!("At a bound: {}.", join(&self.at_bound)),
            ),
            remark(
                !self.assumed.is_empty(),
                "assumed-deviations",
                format!(
                    "Standard deviations assumed: {}.",
                    self.assumed.join(" and ")
                ),
            ),
            remark(
                !self.ignored.is_empty(),
                "not-used",
                format!("Not used of the inputs: {}.", join(&self.ignored)),
            ),
            remark(
                !self.not_selected.is_empty(),
                "not-selected",
                format!(
                    "Test modes that the job does not select: {}.",
                    numbers(&self.not_selected)
                ),
            ),
            Some(Concern::remark(
                "analysis-modes",
                format!(
                    "Modes of the model taken: the lowest {}, beside {} rigid-body modes.",
                    self.analysis_modes, self.rigid_body_modes
                ),
            )),
            self.mass_and_center.map(|(mass, [x, y, z])| {
                let words =
                    format!("Total mass {mass:.6}, center of gravity ({x:.4}, {y:.4}, {z:.4}).");
                Concern::remark("mass-and-center", words)
            }),
        ];
        remark(
            self.is_interrupted,
            "interrupted",
            "Stopped by request; these are the best factors so far.".to_owned(),
        )
        .into_iter()
        .chain(doubts)
        .chain(not_compared)
        .chain(parallel)
        .chain(others.into_iter().flatten())
        .chain(remarks)
        .collect()
    }

    /// Whether a doubt stands that nobody answers for.
    pub fn has_doubt(&self) -> bool {
        self.concerns.iter().any(Concern::stands)
    }

    /// Whether nothing stands against the result: neither a doubt nor a selected mode that is not compared.
    pub fn is_clear(&self) -> bool {
        self.not_compared.is_empty() && !self.has_doubt()
    }
}

fn not_compared(unpaired: &[(usize, f64)]) -> Vec<NotCompared> {
    let of_mode = |&(mode, assurance): &(usize, f64)| NotCompared {
        mode: mode + 1,
        assurance,
    };
    unpaired.iter().map(of_mode).collect()
}

fn from_one(places: &[usize]) -> Vec<usize> {
    places.iter().map(|place| place + 1).collect()
}

impl LoadedJob {
    /// Everything doubtful before the first step: what the pre-flight finds, complex test modes, and what the readers left aside.
    ///
    /// # Errors
    /// Those of [`preflight_at_sensors`] and of the analysis it needs.
    pub fn concerns(&self) -> Result<Vec<Concern>, FileError> {
        let mut all = self.preflight_concerns()?;
        all.extend(self.part_concerns()?);
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
        Ok(all)
    }

    /// What the pre-flight finds, in all modes of the test.
    fn preflight_concerns(&self) -> Result<Vec<Concern>, FileError> {
        let whole = &self.source.whole;
        let left_out = self.unpaired.iter().map(|(mode, _)| mode);
        let mut modes: Vec<usize> = left_out.chain(&self.modes).copied().collect();
        modes.sort_unstable();
        modes.dedup();
        let test = measured(&self.data, &self.placed, &modes)?;
        let (stiffness, mass) = whole.at(&self.ones())?;
        let found = modes_at_most(&stiffness, &mass, 2 * self.analysis_modes)?.vibrations;
        let (squares, shapes) = found.into_parts();
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
            modes: ModeSet::new(squares, self.sensors.times(&shapes)?)?,
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
        let concerns = found.iter().map(|finding| finding.concern(&names));
        Ok(concerns.chain(self.places_concern()).collect())
    }

    /// Parameters' matrices that are not part of the first stiffness or mass, or given twice.
    ///
    /// A part leaves a semidefinite rest, which has no negative pivots (Sylvester's law of inertia). Entries rounded to single
    /// precision, by at most $\epsilon$ of each, move no eigenvalue below
    /// $-\epsilon \max_i \sum_j (\lvert K_{ij} \rvert + \lvert K_{e,ij} \rvert)$ (Gershgorin), which is added to the diagonal.
    fn part_concerns(&self) -> Result<Vec<Concern>, FileError> {
        let (stiffness, mass) = self.source.whole.at(&self.ones())?;
        let parts: Vec<(&str, &SparseMatrix, &SparseMatrix)> = self
            .source
            .whole
            .parameters()
            .iter()
            .filter_map(|parameter| match &parameter.share {
                WholeShare::Stiffness(part) => Some((&parameter.name[..], part, &stiffness)),
                WholeShare::Mass(part) => Some((&parameter.name[..], part, &mass)),
                WholeShare::Elements(_) => None,
            })
            .collect();
        let mut all = Vec::new();
        for (place, (name, part, whole)) in parts.iter().enumerate() {
            let identifier = name.replace(' ', "-");
            if !is_part(part, whole)? {
                all.push(Concern::doubt(
                    format!("not-part-{identifier}"),
                    format!("parameter \"{name}\": its matrix is not part of the first model's, which without it has negative energy"),
                ));
            }
            for (other, twin, _) in &parts[..place] {
                let is_same =
                    |sign: f64| twin.times_number(sign).eq(part.entries().iter().copied());
                let how = [
                    (1.0, "the same matrix"),
                    (-1.0, "matrices of opposite sign"),
                ];
                for (_, how) in how.into_iter().filter(|(sign, _)| is_same(*sign)) {
                    all.push(Concern::doubt(
                        format!("twin-{}-{identifier}", other.replace(' ', "-")),
                        format!("parameters \"{other}\" and \"{name}\" have {how}"),
                    ));
                }
            }
        }
        Ok(all)
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

    /// Sensors placed by where they are cannot span much more than the model does.
    fn places_concern(&self) -> Option<Concern> {
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

/// Whether the whole without a part is semidefinite.
fn is_part(part: &SparseMatrix, whole: &SparseMatrix) -> Result<bool, FileError> {
    let count = whole.rows();
    let mut sums = vec![0.0; count];
    for &(row, _, entry) in whole.entries().iter().chain(part.entries()) {
        sums[row] += entry.abs();
    }
    let shift = f64::from(f32::EPSILON) * sums.iter().copied().fold(0.0, f64::max);
    let entries = whole
        .entries()
        .iter()
        .copied()
        .chain(part.times_number(-1.0));
    let entries = entries.chain((0..count).map(|row| (row, row, shift)));
    let rest = SparseMatrix::new("rest", count, count, entries.collect())?;
    // A rest that cannot be factorized accuses nobody.
    Ok(!Factor::new("rest", &rest).is_ok_and(|factor| factor.negative_count() > 0))
}
