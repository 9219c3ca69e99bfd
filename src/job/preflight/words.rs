//! A finding as a sentence; places count from one.

use super::frequencies::{CommonFactor, FrequenciesExchanged, NamedFactor};
use super::shapes::{Change, Mended};
use super::{Finding, SAME_FREQUENCY};
use crate::job::Concern;
use crate::method::model::Bounds;
use std::fmt::{Display, Formatter, Result};

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

impl Display for Change {
    fn fmt(&self, f: &mut Formatter) -> Result {
        match self {
            Self::Reversed(sensor) => write!(f, "sensor {} reversed", sensor + 1),
            Self::Exchanged([a, b]) => write!(f, "sensors {} and {} exchanged", a + 1, b + 1),
            Self::Reordered(order) => write!(f, "points in another order ({})", list(order)),
            Self::Transposed => write!(f, "shapes transposed"),
            Self::Columns(order) => write!(f, "columns of T in another order ({})", list(order)),
        }
    }
}

impl Finding {
    /// The finding as a concern; parameters without bounds alone are no mistake.
    pub fn concern(&self) -> Concern {
        let identifier = match self {
            Self::CommonFactor(_) => "common-factor".to_owned(),
            Self::Mended(Mended { change, .. }) => match change {
                Change::Reversed(sensor) => format!("reversed-{}", sensor + 1),
                Change::Exchanged([a, b]) => format!("exchanged-{}-{}", a + 1, b + 1),
                Change::Reordered(_) => "reordered".to_owned(),
                Change::Transposed => "transposed".to_owned(),
                Change::Columns(_) => "columns".to_owned(),
            },
            Self::FrequenciesExchanged(FrequenciesExchanged { modes: [a, b], .. }) => {
                format!("frequencies-exchanged-{}-{}", a + 1, b + 1)
            }
            Self::NearlySame { modes: [a, b], .. } => format!("same-{}-{}", a + 1, b + 1),
            Self::LowPair { test, .. } => format!("low-pair-{}", test + 1),
            Self::TooManyModes { .. } => "too-many-modes".to_owned(),
            Self::Percent { setting, .. } => format!("percent-{setting}"),
            Self::ExcludesStart { parameter, .. } => format!("excludes-start-{}", parameter + 1),
            Self::Unbounded(_) => return Concern::remark("unbounded", self.to_string()),
        };
        Concern::doubt(identifier, self.to_string())
    }
}

impl Display for Finding {
    fn fmt(&self, f: &mut Formatter) -> Result {
        let words = match self {
            Self::CommonFactor(CommonFactor { median, named, .. }) => {
                let mistake = named.map_or_else(
                    || "by no mistake known here.".to_owned(),
                    |NamedFactor { name, mistake, .. }| format!("near {name}: {mistake}?"),
                );
                format!("Test frequencies are {median:.4} times the model's, {mistake}")
            }
            Self::Mended(Mended {
                change,
                before,
                after,
                next,
            }) => {
                let words = change.to_string();
                let (first, rest) = (words[..1].to_uppercase(), &words[1..]);
                let next = next
                    .iter()
                    .map(|(next, agreement)| format!("; the next best, {next}, to {agreement:.3}"));
                let next: String = next.collect();
                format!(
                    "{first}{rest}? It would raise the mean cross-orthogonality from {before:.3} to {after:.3}{next}."
                )
            }
            Self::FrequenciesExchanged(FrequenciesExchanged {
                modes: [a, b],
                before,
                after,
            }) => {
                let (a, b, before, after) = (a + 1, b + 1, 100.0 * before, 100.0 * after);
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
                    a + 1,
                    b + 1,
                    if is_same { "; measured twice?" } else { "." },
                );
                format!(
                    "Test modes {a} and {b} are nearly the same shape, modal assurance {assurance:.3}{end}"
                )
            }
            Self::LowPair {
                test,
                analysis,
                cross,
            } => {
                let (a, b) = (test + 1, analysis + 1);
                format!(
                    "Test mode {a} and analysis mode {b} have a cross-orthogonality of {cross:.3} only."
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
                    "{setting} is {value}, that is {percent} %: a percentage where a fraction is meant?"
                )
            }
            Self::ExcludesStart {
                parameter,
                range: Bounds { lower, upper },
            } => {
                let parameter = parameter + 1;
                format!(
                    "Bounds on the factor of parameter {parameter}, {lower} to {upper}, exclude its first value."
                )
            }
            Self::Unbounded(parameters) => {
                format!("Parameters without bounds: {}.", list(parameters))
            }
        };
        f.write_str(&words)
    }
}
