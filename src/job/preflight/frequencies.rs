//! Frequencies that are all wrong by one factor, or that belong to other shapes.

use std::f64::consts::TAU;

/// How far the median ratio may be from a named factor: a first model is up to 30 % wrong.
const MODEL_ERROR: f64 = 1.35;
/// Median ratio beyond which even an unnamed factor is reported: the stiffness would be wrong more than twofold in all modes.
const UNNAMED: f64 = 1.5;
/// Least gain of the mean deviation, times the number of modes, for two frequencies to be exchanged: three times what
/// 0.3 % of noise causes in ten modes.
const LEAST_GAIN: f64 = 0.05;
/// Least part of the deviation that the exchange must mend; in a model with an element a hundred times too thin an
/// exchange mends 0.10 of it.
const LEAST_SHARE: f64 = 0.3;

/// A factor between frequencies of test and model, and the mistake that makes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NamedFactor {
    /// Test over model.
    pub factor: f64,
    /// How the factor is written.
    pub name: &'static str,
    /// The mistake.
    pub mistake: &'static str,
}

const fn named(factor: f64, name: &'static str, mistake: &'static str) -> NamedFactor {
    NamedFactor {
        factor,
        name,
        mistake,
    }
}

/// Square roots of 1000, 386.09 and 9.81.
const THOUSAND: f64 = 31.622_776_601_683_793;
const INCHES: f64 = 19.649_173_010_587_493;
const METERS: f64 = 3.132_091_952_673_165;

/// The known factors, in both directions.
pub const FACTORS: [NamedFactor; 10] = [
    named(TAU, "2π", "the test is in rad/s"),
    named(
        1.0 / TAU,
        "1/2π",
        "the test was divided by 2π, or the model's mass and stiffness are for rad/s",
    ),
    named(60.0, "60", "the test is in rpm"),
    named(1.0 / 60.0, "1/60", "the test was divided by 60"),
    named(
        THOUSAND,
        "√1000",
        "the model's mass is 1000 times too large, as grams for kilograms",
    ),
    named(
        1.0 / THOUSAND,
        "1/√1000",
        "the model's mass is 1000 times too small, as kilograms for grams",
    ),
    named(
        INCHES,
        "√386.09",
        "the model has weight in lbf for mass in lbf·s²/in",
    ),
    named(
        1.0 / INCHES,
        "1/√386.09",
        "the model's mass was divided by 386.09 in/s² twice",
    ),
    named(METERS, "√9.81", "the model has weight in N for mass in kg"),
    named(
        1.0 / METERS,
        "1/√9.81",
        "the model's mass was divided by 9.81 m/s² twice",
    ),
];

/// One factor between all frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CommonFactor {
    /// Median of $f_G/f_F$ of the pairs.
    pub median: f64,
    /// Mean of $\lvert\ln(f_G/f_F) - \ln \text{median}\rvert$.
    pub deviation: f64,
    /// The mistake it suggests, if it is near a known factor.
    pub named: Option<NamedFactor>,
}

/// Median of the logarithms of the ratios, and their mean deviation from it.
fn spread(test: &[f64], analysis: &[f64]) -> (f64, f64) {
    let mut logarithms: Vec<f64> = test
        .iter()
        .zip(analysis)
        .map(|(test, analysis)| (test / analysis).ln())
        .collect();
    logarithms.sort_by(f64::total_cmp);
    let last = logarithms.len().saturating_sub(1);
    let median = 0.5 * (logarithms[last / 2] + logarithms[last.div_ceil(2)]);
    let deviation = logarithms
        .iter()
        .map(|value| (value - median).abs())
        .sum::<f64>()
        / logarithms.len() as f64;
    (median, deviation)
}

/// The factor between paired frequencies, if it is more than a model's error, and the same for all.
pub(super) fn common_factor(test: &[f64], analysis: &[f64]) -> Option<CommonFactor> {
    let (median, deviation) = spread(test, analysis);
    let distance = |factor: f64| (median - factor.ln()).abs();
    if deviation > MODEL_ERROR.ln() || distance(1.0) < UNNAMED.ln() {
        return None;
    }
    let nearest = FACTORS
        .into_iter()
        .min_by(|a, b| distance(a.factor).total_cmp(&distance(b.factor)));
    let named = nearest.filter(|known| distance(known.factor) < MODEL_ERROR.ln());
    Some(CommonFactor {
        median: median.exp(),
        deviation,
        named,
    })
}

/// Two frequencies that would fit better if they were exchanged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrequenciesExchanged {
    /// The test modes, from zero.
    pub modes: [usize; 2],
    /// Mean deviation of the ratios' logarithms from their median, as given.
    pub before: f64,
    /// The same with these two exchanged.
    pub after: f64,
}

/// The exchange of two frequencies that makes the ratios most alike, if it does so enough.
pub(super) fn exchanged(test: &[f64], analysis: &[f64]) -> Option<FrequenciesExchanged> {
    let before = spread(test, analysis).1;
    let mut frequencies = test.to_vec();
    let mut best = FrequenciesExchanged {
        modes: [0; 2],
        before,
        after: before,
    };
    for b in 0..test.len() {
        for a in 0..b {
            frequencies.swap(a, b);
            let after = spread(&frequencies, analysis).1;
            frequencies.swap(a, b);
            if after < best.after {
                best = FrequenciesExchanged {
                    modes: [a, b],
                    before,
                    after,
                };
            }
        }
    }
    let gain = before - best.after;
    (gain * test.len() as f64 >= LEAST_GAIN && gain >= LEAST_SHARE * before).then_some(best)
}
