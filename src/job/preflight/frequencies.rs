//! Frequencies that are all wrong by the factor of a unit.

use super::{
    SeenModes,
    readings::{FALSE_ALARMS, LEAST, MODEL_ERROR},
};
use crate::{
    job::{
        concern::{Check, Concern, NONE},
        pairs::{Frequencies, costs},
    },
    method::{error::Error, modes::Modes},
    sparse::{modal_assurance, moves_of, pair_cheaply},
    weighted::noise::Noise,
};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// Most that a first model is up to 30 % wrong by, as a factor on a frequency.
const NEAR: f64 = 1.35;

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

/// What the frequency of every test mode (columns) costs if it came from each mode of the model, in the units in which the test is most
/// likely, and a doubt if these are not its own: a factor that makes it likelier by enough, by which half of the pairs at least are
/// off but for a model's error.
///
/// # Errors
/// Errors of [`modal_assurance`] and [`pair_cheaply`].
pub fn in_units(
    seen: &SeenModes,
    (test, noise): (&Modes, &[Noise]),
) -> Result<(DMatrix<f64>, Option<Concern>), Error> {
    let (hertz, own_hertz) = (test.frequencies_hz(), seen.modes.frequencies_hz());
    let readings = &seen.modes.shapes;
    let shapes = costs(&modal_assurance(readings, &test.shapes)?, readings, None);
    let parts = moves_of(&seen.shares, &seen.modes);
    let of_units = |factor: f64| {
        let own = hertz.iter().zip(noise);
        let frequencies = Frequencies {
            test: own
                .map(|(hertz, noise)| [hertz / factor, noise.frequency.max(LEAST.frequency)])
                .collect(),
            spreads: vec![MODEL_ERROR; seen.shares.len()],
        };
        frequencies.costs(&seen.modes, &parts)
    };
    let (mut best, mut doubt) = (of_units(1.0), None);
    let own = pair_cheaply(&(&shapes + &best))?.1;
    // Markov's inequality, as of readings.
    let mut least = own - (FACTORS.len() as f64 / FALSE_ALARMS).ln();
    for (factor, name, mistake) in FACTORS {
        let costs = of_units(factor);
        let (partners, cost) = pair_cheaply(&(&shapes + &costs))?;
        let is_near = |(hertz, partner): &(&f64, Option<usize>)| {
            partner.is_some_and(|mode| (*hertz / factor / own_hertz[mode]).ln().abs() < NEAR.ln())
        };
        let near = hertz.iter().zip(partners).filter(is_near).count();
        if cost < least && 2 * near >= hertz.len() {
            let evidence = (own - cost) / std::f64::consts::LN_10;
            let words = format!(
                "Test frequencies are near {name} times the model's: {mistake}? The test would be 10^{evidence:.1} times as likely."
            );
            doubt = Some(Concern::doubt(
                Check::CommonFactor,
                "common-factor",
                &NONE,
                words,
            ));
            (best, least) = (costs, cost);
        }
    }
    Ok((best, doubt))
}
