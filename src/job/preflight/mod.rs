//! A pre-flight: what looks wrong with model and test before the first step, each finding with its evidence.
//!
//! The loops fit gages to whatever data they get: with one reversed sensor the gages are silently wrong. So a job's test is judged
//! at its sensors by the modes of the whole model: each common mistake in the readings is undone on trial, and the one that
//! explains the shapes best is named, if it does so well enough (`readings.rs` has the equations). Frequencies tell modes of like shapes
//! apart there, so a factor of all of them is looked for first and taken out.

mod frequencies;
mod readings;

pub use frequencies::FACTORS;
pub use readings::SeenModes;

use crate::{
    job::concern::{Check, Concern},
    method::{error::Error, modes::Modes},
    sparse::modal_assurance,
    weighted::{misfit::most_by_noise, noise::Noise},
};
use frequencies::in_units;
use readings::Known;

/// Modal assurance of two test modes from which they are nearly one shape. Two modes of the box, whose masses differ
/// several hundredfold, have 0.75 with noise of 1 %, and a mode measured twice has 0.99. It does not depend on the
/// order and signs of the points, so that a mistake in these does not look like a mode measured twice.
pub const NEARLY_SAME: f64 = 0.9;
/// The places of test modes of these numbers that were not measured twice, and what is said of each near copy of an earlier one: a doubt
/// where a mode was measured twice, and else a remark, as few sensors may see two modes alike. At one sensor all do.
///
/// Two test modes of a modal assurance $m$ are one where noise alone, in all but one of a thousand tests, makes it differ so much from itself.
/// A reading of either differs from the other's by noise of both, so that with the first shape $a$, of unit largest component, and sums of
/// the squares of both deviations
///
/// $$ \chi^2 = \frac{\lvert a \rvert^2 (1 - m)}{\sigma_v^2} + \frac{\ln^2 (f_2/f_1)}{\sigma_f^2} $$
///
/// has as many degrees of freedom as there are sensors: one less for the scale of the shapes, one more for the frequency. Noise must not
/// make one mode of shapes at right angles as well.
///
/// # Errors
/// The errors of the comparison of shapes.
pub fn measured_once(
    (test, noise): (&Modes, &[Noise]),
    numbers: &[usize],
) -> Result<(Vec<usize>, Vec<Concern>), Error> {
    let (check, sensors) = (Check::ModesMeasuredTwice, test.shapes.nrows());
    if sensors == 1 {
        let alike = Concern::not_checked(check, ONE);
        return Ok(((0..test.len()).collect(), vec![alike]));
    }
    let assurance = modal_assurance(&test.shapes, &test.shapes)?;
    let (mut once, mut concerns) = (Vec::<usize>::new(), Vec::new());
    let (hertz, most) = (test.frequencies_hz(), most_by_noise(sensors as f64)?);
    for b in 0..test.len() {
        if let Some(&a) = once.iter().find(|&&a| assurance[(a, b)] >= NEARLY_SAME) {
            let assurance = assurance[(a, b)];
            let sum = |of: fn(&Noise) -> f64| of(&noise[a]).powi(2) + of(&noise[b]).powi(2);
            let shape = test.shapes.column(a);
            let size = shape.norm_squared() / shape.amax().powi(2);
            let unlike = size / sum(|own| own.shape);
            let apart = (hertz[b] / hertz[a]).ln().powi(2) / sum(|own| own.frequency);
            let modes = [numbers[a], numbers[b]];
            let words = format!(
                "Test modes {} and {} are nearly the same shape, modal assurance {assurance:.3}",
                modes[0], modes[1]
            );
            if unlike > most && unlike * (1.0 - assurance) + apart <= most {
                let words = words + "; measured twice?";
                concerns.push(Concern::doubt(check, "same-", &modes, words));
                continue;
            }
            concerns.push(Concern::remark(check, "same-", &modes, words + "."));
        }
        once.push(b);
    }
    Ok((once, concerns))
}

/// Reason why one sensor says nothing of shapes.
const ONE: &str = "at one sensor all shapes are alike";

/// Checks a test of this file, of modes measured once by sensors of these names, with the deviations of each, against a model's modes at its sensors; no condensed model is needed,
/// so structures may hang free.
///
/// # Errors
/// The errors of the comparison of shapes.
pub fn preflight_at_sensors(
    seen: &SeenModes,
    (test, noise): (&Modes, &[Noise]),
    (sensors, file): (&[String], &str),
) -> Result<Vec<Concern>, Error> {
    if sensors.len() == 1 {
        let unchecked = [Check::CommonFactor, Check::Readings];
        return Ok(unchecked
            .map(|check| Concern::not_checked(check, ONE))
            .into());
    }
    // Frequencies tell modes of like shapes apart, in the right units.
    let (frequencies, doubt) = in_units(seen, (test, noise))?;
    let known = Known::new(seen, noise);
    let shapes = seen.modes.shapes.clone();
    let model = known.as_ref().and_then(|known| known.seen_as(shapes));
    let unchecked = |reason| Some(Concern::not_checked(Check::Readings, reason));
    let mistake = match model {
        _ if sensors.len() == 2 => unchecked("two sensors tell no mistake of one"),
        None => unchecked("the sensors do not tell the modes of the model apart"),
        Some(model) => model.mistake(&test.shapes, &frequencies, (sensors, file))?,
    };
    Ok(doubt.into_iter().chain(mistake).collect())
}
