//! Frequencies that are all wrong by one factor, or that belong to other shapes.

use super::{
    SeenModes,
    readings::{FALSE_ALARMS, frequency_costs},
};
use crate::{
    job::{
        assignment::pair_cheaply,
        concern::{Check, Concern, NONE},
        likelihood::costs,
    },
    method::{error::Error, modes::Modes},
    sparse::modal_assurance,
    weighted::noise::Noise,
};
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

/// Square roots of 1000, 386.09 and 9.81.
const THOUSAND: f64 = 31.622_776_601_683_793;
const INCHES: f64 = 19.649_173_010_587_493;
const METERS: f64 = 3.132_091_952_673_165;

/// Known factors between frequencies of test and model in both directions, with how they are written and the mistakes that make them.
pub const FACTORS: [(f64, &str, &str); 10] = [
    (TAU, "2π", "the test is in rad/s"),
    (
        1.0 / TAU,
        "1/2π",
        "the test was divided by 2π, or the model's mass and stiffness are for rad/s",
    ),
    (60.0, "60", "the test is in rpm"),
    (1.0 / 60.0, "1/60", "the test was divided by 60"),
    (
        THOUSAND,
        "√1000",
        "the model's mass is 1000 times too large, as grams for kilograms",
    ),
    (
        1.0 / THOUSAND,
        "1/√1000",
        "the model's mass is 1000 times too small, as kilograms for grams",
    ),
    (
        INCHES,
        "√386.09",
        "the model has weight in lbf for mass in lbf·s²/in",
    ),
    (
        1.0 / INCHES,
        "1/√386.09",
        "the model's mass was divided by 386.09 in/s² twice",
    ),
    (METERS, "√9.81", "the model has weight in N for mass in kg"),
    (
        1.0 / METERS,
        "1/√9.81",
        "the model's mass was divided by 9.81 m/s² twice",
    ),
];

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

/// The factor between the frequencies of test modes and of their partners, and a doubt about it, if the median ratio is more than a model's
/// error, and that of half of them at least: some pairs may be wrong.
///
/// Partners hang on the units: they are the most likely ones in those of the test or, where that makes it likelier by enough, in those that
/// a known factor leads to, or the median ratio of partners by shapes alone.
///
/// # Errors
/// Errors of [`modal_assurance`] and [`pair_cheaply`].
pub fn common_factor(
    seen: &SeenModes,
    (test, noise): (&Modes, &[Noise]),
) -> Result<Option<(f64, Concern)>, Error> {
    let seen_shapes = &seen.modes.shapes;
    let assurance = modal_assurance(seen_shapes, &test.shapes)?;
    let test = test.frequencies_hz();
    let by = |factor: f64| {
        let hertz: Vec<f64> = test.iter().map(|own| own / factor).collect();
        pair_cheaply(&costs(
            &assurance,
            seen_shapes,
            Some(&frequency_costs(seen, &hertz, noise)),
        ))
    };
    let of = |partners: Vec<Option<usize>>| {
        let partners: Vec<usize> = partners.into_iter().flatten().collect();
        let own = seen.modes.select(&partners).frequencies_hz();
        (spread(&test, &own).0, own)
    };
    let unnamed = of(pair_cheaply(&costs(&assurance, seen_shapes, None))?.0)
        .0
        .exp();
    let (mut best, mut least) = by(1.0)?;
    // Markov's inequality, as of readings.
    least -= (FACTORS.len() as f64 / FALSE_ALARMS).ln();
    for factor in FACTORS.map(|known| known.0).into_iter().chain([unnamed]) {
        let (partners, cost) = by(factor)?;
        if cost < least {
            (best, least) = (partners, cost);
        }
    }
    let (median, analysis) = of(best);
    let distance = |factor: f64| (median - factor.ln()).abs();
    let alike = test
        .iter()
        .zip(&analysis)
        .map(|(test, own)| test / own)
        .filter(|ratio| distance(*ratio) < MODEL_ERROR.ln());
    if 2 * alike.count() < test.len() || distance(1.0) < UNNAMED.ln() {
        return Ok(None);
    }
    let (factor, why) = match FACTORS
        .into_iter()
        .min_by(|a, b| distance(a.0).total_cmp(&distance(b.0)))
        .filter(|known| distance(known.0) < MODEL_ERROR.ln())
    {
        Some((factor, name, mistake)) => (factor, format!("near {name}: {mistake}?")),
        None => (median.exp(), "by no mistake known here.".to_owned()),
    };
    Ok(Some((
        factor,
        Concern::doubt(
            Check::CommonFactor,
            "common-factor",
            &NONE,
            format!(
                "Test frequencies are {:.4} times the model's, {why}",
                median.exp()
            ),
        ),
    )))
}

/// A doubt about the two frequencies, of modes that have numbers, whose exchange makes the ratios most alike, if it does so enough.
pub fn exchanged(
    test: &[f64],
    analysis: &[f64],
    number: impl Fn(usize) -> usize,
) -> Option<Concern> {
    let deviation = |test: &[f64]| spread(test, analysis).1;
    let before = deviation(test);
    let after = |&[a, b]: &[usize; 2]| {
        let mut test = test.to_vec();
        test.swap(a, b);
        deviation(&test)
    };
    let both = (0..test.len())
        .flat_map(|b| (0..b).map(move |a| [a, b]))
        .min_by(|one, other| after(one).total_cmp(&after(other)))?;
    let gain = before - after(&both);
    let is_enough = gain * test.len() as f64 >= LEAST_GAIN && gain >= LEAST_SHARE * before;
    // Modes are numbered as their frequencies ascend: only where these do not may two be exchanged.
    if !is_enough || test[both[0]] <= test[both[1]] {
        return None;
    }
    let modes = both.map(number);
    let words = format!(
        "Frequencies of test modes {} and {} exchanged? It would lower the mean deviation of the ratios from {:.1} to {:.1} %.",
        modes[0],
        modes[1],
        100.0 * before,
        100.0 * (before - gain)
    );
    Some(Concern::doubt(
        Check::OrderOfFrequencies,
        "frequencies-exchanged-",
        &modes,
        words,
    ))
}
