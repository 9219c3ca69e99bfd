//! A pre-flight: what looks wrong with model and test before the first step, each finding with its evidence.
//!
//! The loops fit gages to whatever data they get: with one reversed sensor the gages are silently wrong. So a job's test is judged
//! at its sensors by the modes of the whole model: each common mistake in the readings is undone on trial, and the one that
//! explains the shapes best is named, if it does so well enough (`readings.rs` has the equations). Frequencies tell modes of like shapes
//! apart there, so a factor of all of them is looked for first and taken out.

mod change;
mod frequencies;
mod readings;

pub use change::Change;
pub use frequencies::FACTORS;
pub use readings::SeenModes;

use crate::{
    job::concern::{Check, Concern, NONE},
    method::{
        error::Error,
        linear_algebra::{symmetric_eigen, symmetric_part},
        modes::Modes,
        sorting::pair_modes,
    },
    sparse::{cosines, modal_assurance},
    weighted::{misfit::most_by_noise, noise::Noise},
};
use frequencies::{common_factor, exchanged};
use nalgebra::DMatrix;
use readings::{LEAST, explain};

/// Modal assurance of two test modes from which they are nearly one shape. Two modes of the box, whose masses differ
/// several hundredfold, have 0.75 with noise of 1 %, and a mode measured twice has 0.99. It does not depend on the
/// order and signs of the points, so that a mistake in these does not look like a mode measured twice.
pub const NEARLY_SAME: f64 = 0.9;
/// Singular value of the test shapes, of unit length, below which the points do not distinguish them: orthogonal shapes have one.
pub const LEAST_SINGULAR: f64 = 0.3;

/// Reason why test modes have no partners that could be compared.
pub(in crate::job) const FEWER: &str = "the model has fewer modes than the test";

/// Names of the sensors, their places from one where they have none, and numbers of test modes.
#[derive(Debug, Clone, Default)]
pub struct Names {
    /// The sensors' names.
    pub sensors: Vec<String>,
    /// Places of the test modes in the test's file.
    pub modes: Vec<usize>,
    /// The test's file.
    pub file: String,
}

impl Names {
    fn sensor(&self, place: usize) -> String {
        self.sensors
            .get(place)
            .cloned()
            .unwrap_or_else(|| (place + 1).to_string())
    }

    /// The number of a test mode in the test's file.
    fn mode(&self, place: usize) -> usize {
        self.modes.get(place).map_or(place, |mode| *mode) + 1
    }
}

/// True if noise alone, in all but one of a thousand tests, makes one mode differ so much from itself as two test modes do of a modal
/// assurance $m$. A reading of either differs from the other's by noise of both, so that with the first shape $a$, of unit largest component,
/// and sums of the squares of both deviations
///
/// $$ \chi^2 = \frac{\lvert a \rvert^2 (1 - m)}{\sigma_v^2} + \frac{\ln^2 (f_2/f_1)}{\sigma_f^2} $$
///
/// has as many degrees of freedom as there are sensors: one less for the scale of the shapes, one more for the frequency. None if noise
/// makes one mode of shapes at right angles as well.
fn is_measured_twice(
    test: &Modes,
    [a, b]: [usize; 2],
    assurance: f64,
    noise: [Noise; 2],
) -> Result<Option<bool>, Error> {
    let hertz = test.frequencies_hz();
    let frequency_ratio = hertz[b] / hertz[a];
    let sum = |of: fn(&Noise) -> f64| noise.iter().map(|own| of(own).powi(2)).sum::<f64>();
    let shape = test.shapes.column(a);
    let size = shape.norm_squared() / shape.amax().powi(2);
    let unlike = size / sum(|own| own.shape);
    let chi_squared =
        unlike * (1.0 - assurance) + frequency_ratio.ln().powi(2) / sum(|own| own.frequency);
    let most = most_by_noise(shape.len() as f64)?;
    Ok((unlike > most).then_some(chi_squared <= most))
}

/// The places of test modes without near copies of earlier ones; of modes that were measured twice; and what is said of each copy: a doubt
/// where a mode was measured twice, and else a remark, as few sensors may see two modes alike. At one sensor all do.
fn distinct_shapes(
    test: &Modes,
    noise: &[Noise],
    names: &Names,
) -> Result<([Vec<usize>; 2], Vec<Concern>), Error> {
    let (mut apart, mut twice, mut concerns) = (Vec::<usize>::new(), Vec::new(), Vec::new());
    if test.shapes.nrows() == 1 {
        return Ok(([(0..test.len()).collect(), twice], concerns));
    }
    let assurance = modal_assurance(&test.shapes, &test.shapes)?;
    let own = |mode: usize| noise.get(mode).copied().unwrap_or(LEAST);
    for b in 0..test.len() {
        let Some(&a) = apart.iter().find(|&&a| assurance[(a, b)] >= NEARLY_SAME) else {
            apart.push(b);
            continue;
        };
        let (both, assurance) = ([a, b], assurance[(a, b)]);
        let modes = both.map(|mode| names.mode(mode));
        let words = format!(
            "Test modes {} and {} are nearly the same shape, modal assurance {assurance:.3}",
            modes[0], modes[1]
        );
        let check = Check::ModesMeasuredTwice;
        concerns.push(
            match is_measured_twice(test, both, assurance, both.map(own))? {
                None => Concern::not_checked(check, "by these deviations all shapes are alike"),
                Some(true) => {
                    twice.push(b);
                    Concern::doubt(check, "same-", &modes, words + "; measured twice?")
                }
                Some(false) => Concern::remark(check, "same-", &modes, words + "."),
            },
        );
    }
    Ok(([apart, twice], concerns))
}

/// Checks a test, with the deviations of every mode or none, against a model's modes at its sensors; no condensed model is needed, so structures
/// may hang free.
///
/// # Errors
/// The errors of the comparison of shapes.
pub fn preflight_at_sensors(
    seen: &SeenModes,
    (test, noise): (&Modes, &[Noise]),
    names: &Names,
) -> Result<Vec<Concern>, Error> {
    // A mode measured twice has no second partner. A sensor that drowns all others makes shapes alike, but not frequencies.
    let ([_, twice], _) = distinct_shapes(test, noise, names)?;
    let once: Vec<usize> = (0..test.len())
        .filter(|mode| !twice.contains(mode))
        .collect();
    let of_once: Vec<Noise> = once
        .iter()
        .filter_map(|&mode| noise.get(mode).copied())
        .collect();
    // At one sensor all shapes are alike, and say nothing of partners.
    let is_one = test.shapes.nrows() == 1;
    let is_paired = !is_one && once.len() <= seen.modes.len();
    let mut test = test.clone();
    let mut concerns: Vec<Concern> = Vec::new();
    let mut told = explain(seen, (&test.select(&once), &of_once))?;
    if is_paired
        && let Some((factor, doubt)) = common_factor(seen, (&test.select(&once), &of_once))?
    {
        let mut other = test.clone();
        other.omega_squared /= factor.powi(2);
        let in_units = explain(seen, (&other.select(&once), &of_once))?;
        // A mistake in the readings may explain as much.
        if in_units.least <= told.least {
            (test, told) = (other, in_units);
            concerns.push(doubt);
        }
    }
    let suspected = told.mistake;
    if let Some((change, _)) = &suspected {
        test.shapes = change.of(&test.shapes);
    }
    concerns.extend(
        told.silent
            .map(|reason| Concern::not_checked(Check::Readings, reason)),
    );
    let alike = "at one sensor all shapes are alike";
    let ([places, _], copies) = distinct_shapes(&test, noise, names)?;
    concerns.extend(is_one.then(|| Concern::not_checked(Check::ModesMeasuredTwice, alike)));
    concerns.extend(copies);
    if is_paired {
        let own = test.select(&once);
        let judge = |partners: &[usize]| {
            exchanged(
                &own.frequencies_hz(),
                &seen.modes.select(partners).frequencies_hz(),
                |mode| names.mode(once[mode]),
            )
        };
        // Shapes of two modes may be one at the sensors: what the likely partners do not say too is their mistake.
        let is_told = told.partners.is_none_or(|likely| judge(&likely).is_some());
        concerns.extend(
            judge(&pair_modes(&modal_assurance(&seen.modes.shapes, &own.shapes)?)?.analysis_mode)
                .filter(|_| is_told),
        );
    } else {
        let reason = if is_one { alike } else { FEWER };
        concerns.extend(
            [Check::CommonFactor, Check::OrderOfFrequencies]
                .map(|check| Concern::not_checked(check, reason)),
        );
    }
    concerns.extend(suspected.map(|(change, evidence)| change.concern(evidence, names)));
    let distinct = test.select(&places).shapes;
    if distinct.ncols() > distinct.nrows() {
        concerns.extend(too_many_modes(&distinct)?);
    }
    Ok(concerns)
}

/// A remark on test modes whose shapes the points do not distinguish.
fn too_many_modes(shapes: &DMatrix<f64>) -> Result<Option<Concern>, Error> {
    let (points, modes) = shapes.shape();
    let (squares, _) = symmetric_eigen(
        "overlap of test modes",
        &symmetric_part(&cosines(shapes, shapes)?),
    )?;
    let smallest = squares[0].max(0.0).sqrt();
    let is_distinct = |square: &&f64| **square >= LEAST_SINGULAR.powi(2);
    let distinct = squares.iter().filter(is_distinct).count();
    let words = format!(
        "{modes} test modes at {points} points: only {distinct} are told apart, the smallest singular value is {smallest:.3}."
    );
    Ok((distinct < modes)
        .then(|| Concern::remark(Check::NumberOfModes, "too-many-modes", &NONE, words)))
}
