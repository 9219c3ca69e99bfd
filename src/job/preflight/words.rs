//! A finding as a sentence; places count from one.

use super::frequencies::{CommonFactor, FrequenciesExchanged, NamedFactor};
use super::shapes::Change;
use super::{Finding, SAME_FREQUENCY};
use crate::files::test_data::DIRECTIONS;
use crate::job::Concern;
use crate::method::step::Bounds;

/// Places from one: the first and the last of them when none is missing between.
fn list(places: &[usize]) -> String {
    match places {
        [first, .., last] if places.is_sorted_by(|a, b| a + 1 == *b) => {
            format!("{} to {}", first + 1, last + 1)
        }
        _ => places
            .iter()
            .map(|place| (place + 1).to_string())
            .collect::<Vec<_>>()
            .join(", "),
    }
}

/// What sensors and parameters are called: their places from one where they have no names.
#[derive(Debug, Clone, Default)]
pub struct FindingNames {
    /// Of the sensors.
    pub sensors: Vec<String>,
    /// Of the parameters.
    pub parameters: Vec<String>,
    /// Places of the test modes in the test's file.
    pub modes: Vec<usize>,
}

/// A name as a part of an identifier.
pub(in crate::job) fn hyphened(name: &str) -> String {
    name.replace(' ', "-")
}

fn name(names: &[String], place: usize) -> String {
    let number = || (place + 1).to_string();
    names.get(place).cloned().unwrap_or_else(number)
}

impl FindingNames {
    /// The number of a test mode.
    fn mode(&self, place: usize) -> usize {
        self.modes.get(place).copied().unwrap_or(place) + 1
    }
}

impl Change {
    /// The change in words.
    fn words(&self, names: &FindingNames) -> String {
        let sensor = |place: &usize| name(&names.sensors, *place);
        match self {
            Self::Reversed(place) => format!("sensor {} reversed", sensor(place)),
            Self::Exchanged([a, b]) => format!("sensors {} and {} exchanged", sensor(a), sensor(b)),
            Self::Reordered(order) => format!("points in another order ({})", list(order)),
            Self::Gain(place, gain) => {
                format!("sensor {} reads {gain:.3} times too much", sensor(place))
            }
            Self::Dead(place) => format!("sensor {} dead", sensor(place)),
            Self::Direction(place, along) => {
                let along = DIRECTIONS[*along];
                format!("sensor {} measures along {along}", sensor(place))
            }
        }
    }

    /// The change as a question.
    fn question(&self, names: &FindingNames) -> String {
        let words = self.words(names);
        words[..1].to_uppercase() + &words[1..] + "?"
    }

    /// What names it on the command line.
    fn identifier(&self, names: &FindingNames) -> String {
        let sensor = |place: &usize| hyphened(&name(&names.sensors, *place));
        match self {
            Self::Reversed(place) => format!("reversed-{}", sensor(place)),
            Self::Exchanged([a, b]) => format!("exchanged-{}-{}", sensor(a), sensor(b)),
            Self::Reordered(_) => "reordered".to_owned(),
            Self::Gain(place, _) => format!("gain-{}", sensor(place)),
            Self::Dead(place) => format!("dead-{}", sensor(place)),
            Self::Direction(place, _) => format!("direction-{}", sensor(place)),
        }
    }
}

impl Finding {
    /// The finding as a concern; parameters without bounds alone are no mistake.
    pub fn concern(&self, names: &FindingNames) -> Concern {
        let words = self.words(names);
        let identifier = match self {
            Self::CommonFactor(_) => "common-factor".to_owned(),
            Self::Suspected { change, .. } => change.identifier(names),
            Self::FrequenciesExchanged(FrequenciesExchanged { modes: [a, b], .. }) => {
                format!(
                    "frequencies-exchanged-{}-{}",
                    names.mode(*a),
                    names.mode(*b)
                )
            }
            Self::NearlySame {
                modes: [a, b],
                frequency_ratio,
                ..
            } => {
                let identifier = format!("same-{}-{}", names.mode(*a), names.mode(*b));
                // Few sensors may see two modes alike.
                if (frequency_ratio - 1.0).abs() >= SAME_FREQUENCY {
                    return Concern::remark(identifier, words);
                }
                identifier
            }
            Self::TooManyModes { .. } => return Concern::remark("too-many-modes", words),
            Self::Percent { setting, .. } => format!("percent-{setting}"),
            Self::ExcludesStart { parameter, .. } => {
                let parameter = name(&names.parameters, *parameter);
                format!("excludes-start-{}", hyphened(&parameter))
            }
            Self::Unbounded(_) => return Concern::remark("unbounded", words),
        };
        Concern::doubt(identifier, words)
    }

    fn words(&self, names: &FindingNames) -> String {
        match self {
            Self::CommonFactor(CommonFactor { median, named, .. }) => {
                let mistake = named.map_or_else(
                    || "by no mistake known here.".to_owned(),
                    |NamedFactor { name, mistake, .. }| format!("near {name}: {mistake}?"),
                );
                format!("Test frequencies are {median:.4} times the model's, {mistake}")
            }
            Self::Suspected { change, evidence } => {
                let question = change.question(names);
                format!(
                    "{question} The test's shapes would be 10^{evidence:.0} times as likely, with noise of 1 % and a model 30 % wrong."
                )
            }
            Self::FrequenciesExchanged(FrequenciesExchanged {
                modes: [a, b],
                before,
                after,
            }) => {
                let (a, b) = (names.mode(*a), names.mode(*b));
                let (before, after) = (100.0 * before, 100.0 * after);
                format!(
                    "Frequencies of test modes {a} and {b} exchanged? It would lower the mean deviation of the ratios from \
                    {before:.1} to {after:.1} %."
                )
            }
            Self::NearlySame {
                modes: [a, b],
                assurance,
                frequency_ratio,
            } => {
                let is_same = (frequency_ratio - 1.0).abs() < SAME_FREQUENCY;
                let (a, b, end) = (
                    names.mode(*a),
                    names.mode(*b),
                    if is_same { "; measured twice?" } else { "." },
                );
                format!(
                    "Test modes {a} and {b} are nearly the same shape, modal assurance {assurance:.3}{end}"
                )
            }
            Self::TooManyModes {
                modes,
                points,
                distinct,
                smallest,
            } => format!(
                "{modes} test modes at {points} points: only {distinct} are told apart, the smallest singular value is \
                {smallest:.3}."
            ),
            Self::Percent { setting, value } => {
                let percent = 100.0 * value;
                format!(
                    "Setting {setting} is {value}, that is {percent} %: a percentage where a fraction is meant?"
                )
            }
            Self::ExcludesStart {
                parameter,
                range: Bounds { lower, upper },
            } => {
                let parameter = name(&names.parameters, *parameter);
                format!(
                    "Bounds on the factor of parameter {parameter}, {lower} to {upper}, exclude its first value."
                )
            }
            Self::Unbounded(parameters) => {
                format!("Parameters without bounds: {}.", list(parameters))
            }
        }
    }
}
