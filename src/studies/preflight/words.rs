//! A finding as a sentence; places count from one.

use super::frequencies::{CommonFactor, FrequenciesExchanged};
use super::shapes::{Change, Mended};
use super::{Finding, SAME_FREQUENCY};
use std::fmt::{Display, Formatter, Result};

/// Places from one: the first and the last of them when none is missing between.
fn list(places: &[usize]) -> String {
    match places {
        [first, .., last] if places.windows(2).all(|two| two[1] == two[0] + 1) => {
            format!("{} to {}", first + 1, last + 1)
        }
        _ => places.iter().map(|place| (place + 1).to_string()).collect::<Vec<_>>().join(", "),
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

impl Display for Finding {
    fn fmt(&self, f: &mut Formatter) -> Result {
        match self {
            Self::CoarseCondensation { mode, error } => write!(
                f,
                "Condensation to the measured points raises mode {} by {:.1} %, from {:.4} Hz: measure more points, or \
                leave the mode out.",
                mode + 1,
                100.0 * error.frequency,
                error.whole_hz
            ),
            Self::CommonFactor(CommonFactor { median, named: Some(known), .. }) => {
                let said = known.mistake;
                write!(f, "Test frequencies are {median:.4} times the model's, near {}: {said}?", known.name)
            }
            Self::CommonFactor(CommonFactor { median, .. }) => {
                write!(f, "Test frequencies are {median:.4} times the model's, by no mistake known here.")
            }
            Self::Mended(Mended { change, before, after, next }) => {
                let words = change.to_string();
                let (first, rest) = (words[..1].to_uppercase(), &words[1..]);
                write!(f, "{first}{rest}? It would raise the mean cross-orthogonality from {before:.3} to {after:.3}")?;
                match next {
                    Some((next, agreement)) => write!(f, "; the next best, {next}, to {agreement:.3}."),
                    None => write!(f, "."),
                }
            }
            Self::FrequenciesExchanged(FrequenciesExchanged { modes: [a, b], before, after }) => write!(
                f,
                "Frequencies of test modes {} and {} exchanged? It would lower the mean deviation of the ratios \
                from {:.1} to {:.1} %.",
                a + 1,
                b + 1,
                100.0 * before,
                100.0 * after
            ),
            Self::NearlySame { modes: [a, b], assurance, frequency_ratio } => {
                let twice = (frequency_ratio - 1.0).abs() < SAME_FREQUENCY;
                let twice = if twice { "; measured twice?" } else { "." };
                let (a, b) = (a + 1, b + 1);
                write!(f, "Test modes {a} and {b} are nearly the same shape, modal assurance {assurance:.3}{twice}")
            }
            Self::LowPair { test, analysis, cross } => {
                let (test, analysis) = (test + 1, analysis + 1);
                write!(
                    f,
                    "Test mode {test} and analysis mode {analysis} have a cross-orthogonality of {cross:.3} only."
                )
            }
            Self::TooManyModes { modes, points, distinct, smallest } => write!(
                f,
                "{modes} test modes at {points} points: only {distinct} are told apart, the smallest singular value is \
                {smallest:.3}."
            ),
            Self::Percent { setting, value } => {
                write!(f, "{setting} is {value}, that is {} %: a percentage where a fraction is meant?", 100.0 * value)
            }
            Self::ExcludesStart { parameter, range } => write!(
                f,
                "Bounds on the factor of parameter {}, {} to {}, exclude its first value.",
                parameter + 1,
                range.lower,
                range.upper
            ),
            Self::Unbounded(parameters) => write!(f, "Parameters without bounds: {}.", list(parameters)),
        }
    }
}
