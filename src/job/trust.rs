//! What lowers the trust in a job's result, collected in one place.

use super::loaded::FLOOR;
use super::verdict::Verdict;
use super::{LoadedJob, Method};
use crate::files::deck::{Reason, Unread};
use crate::files::error::FileError;
use crate::weighted::identifiability::Identifiability;
use crate::weighted::misfit::Misfit;
use crate::weighted::residuals::DEVIATIONS;
use serde::Serialize;

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

impl NotCompared {
    /// What names it among the concerns.
    pub fn identifier(&self) -> String {
        format!("not-compared-{}", self.mode)
    }
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
    /// Parameters of which the prior says more than the test.
    pub mostly_prior: Vec<String>,
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
    /// How much mass moves along x, y and z, in the model's units.
    pub mass: [f64; 3],
    /// Its center, if all of it has a place.
    pub center: Option<[f64; 3]>,
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
        let (mut concerns, rigid_body_modes) = loaded.concerns()?;
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
        let data = &loaded.data;
        let lacks = |of: fn(&[Option<f64>; 2]) -> Option<f64>, mode: usize| {
            of(&loaded.given_deviations(mode)).is_none()
        };
        let assumed = [
            (
                "frequencies",
                loaded.compared().any(|mode| lacks(|given| given[0], mode)),
                DEVIATIONS.frequency,
            ),
            (
                "shapes",
                loaded
                    .modes
                    .iter()
                    .any(|&mode| lacks(|given| given[1], mode)),
                DEVIATIONS.shape,
            ),
        ];
        let (mass, center) = loaded.source.mass;
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
            mostly_prior: Vec::new(),
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
                .chain(loaded.unused_entries())
                .collect(),
            analysis_modes: loaded.analysis_modes,
            rigid_body_modes,
            mass: mass.into(),
            center: center.map(Into::into),
        })
    }

    /// The same after a run.
    pub(super) fn after(
        self,
        loaded: &LoadedJob,
        unpaired: &[(usize, f64)],
        verdict: &Verdict,
        seen: &Identifiability,
        misfit: &Misfit,
    ) -> Self {
        let chi_squared = Concern::remark("chi-squared", misfit.in_numbers());
        let names: Vec<&str> = loaded.parameter_names().collect();
        let named = |places: &[usize]| places.iter().map(|&e| names[e].to_owned()).collect();
        let mut blind = [&seen.blind[..], &verdict.unseen].concat();
        blind.sort_unstable();
        blind.dedup();
        let all = 0..names.len();
        let mostly_prior: Vec<usize> = all.filter(|&e| seen.is_mostly_prior(e)).collect();
        let groups = seen.parallel_groups();
        Self {
            concerns: [vec![chi_squared], self.concerns].concat(),
            blind: named(&blind),
            mostly_prior: named(&mostly_prior),
            parallel: groups.iter().map(|group| named(group)).collect(),
            at_bound: named(&verdict.at_bound),
            not_compared: not_compared(unpaired),
            joined: from_one(&loaded.joined),
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
                left.identifier(),
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
                !self.mostly_prior.is_empty(),
                "mostly-prior",
                format!(
                    "Known more from the prior than from the test: {}.",
                    join(&self.mostly_prior)
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
            remark(self.mass != [0.0; 3], "mass", self.mass_in_words()),
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

    fn mass_in_words(&self) -> String {
        let [x, y, z] = self.mass.map(six_digits);
        let mass = if x == y && y == z {
            format!("Total mass {x}")
        } else {
            format!("Mass that moves along x {x}, along y {y}, along z {z}")
        };
        let center = self.center.map(|center| {
            let far = center.map(f64::abs).into_iter().fold(0.0, f64::max);
            // What is left of sums that cancel is no distance.
            let rounded = |part: f64| if part.abs() < 1e-9 * far { 0.0 } else { part };
            let center = center.map(|part| six_digits(rounded(part)));
            format!(", center of gravity ({})", center.join(", "))
        });
        mass + &center.unwrap_or_default() + "."
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

impl LoadedJob {
    /// Entries that the job's file gives and that nothing uses, each with what it is of.
    fn unused_entries(&self) -> Vec<String> {
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

/// Six significant digits in the shortest form that keeps them.
fn six_digits(value: f64) -> String {
    format!("{value:.5e}").parse().unwrap_or(value).to_string()
}

/// What takes the entries of `[correlation]`.
const PAPER: &str = "of the paper's loops";

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
