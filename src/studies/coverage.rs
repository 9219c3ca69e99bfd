//! How often the 95 % intervals of a weighted correlation hold the true factors, over noisy tests.

use crate::cases::Case;
use crate::cases::error::CaseError;
use crate::studies::noisy_modes::{NOISY_CASE, Noise, with_noise};
use crate::studies::weighted::comparison::Known;
use crate::studies::weighted::{WeightedSettings, Weights, gauss_newton};
use serde::Serialize;
use std::ops::RangeInclusive;

/// Seeds of the noise, one test each.
pub const SEEDS: RangeInclusive<u64> = 1..=1000;

/// How one parameter's intervals did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Held {
    /// Its name.
    pub parameter: String,
    /// Tests in which its interval holds the true factor.
    pub tests: usize,
    /// Root mean square error of the logarithm of its factor over the tests.
    pub error: f64,
    /// Root mean square of the standard deviations stated.
    pub deviation: f64,
    /// Mean part of its variance that the test took away.
    pub learned: f64,
}

/// How the intervals did on one structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Coverage {
    /// The structure.
    pub name: String,
    /// Number of tests.
    pub tests: usize,
    /// Mean of twice the data's part of the objective per degree of freedom: one when the deviations are those of the noise.
    pub chi_squared: f64,
    /// Each parameter's.
    pub parameters: Vec<Held>,
}

impl Coverage {
    /// Part of all intervals that hold the truth.
    pub fn overall(&self) -> f64 {
        let held: usize = self.parameters.iter().map(|held| held.tests).sum();
        held as f64 / (self.tests * self.parameters.len()) as f64
    }
}

/// Correlates a structure with noisy tests, with weights of that noise, and counts the intervals that hold the truth.
///
/// Bounds on the factors are left out: an estimate at a bound has no interval of its own.
///
/// # Errors
/// Those of [`with_noise`] and [`gauss_newton`].
pub fn coverage(
    known: &Known,
    noise: Noise,
    seeds: RangeInclusive<u64>,
    settings: &WeightedSettings,
) -> Result<Coverage, CaseError> {
    let (count, modes, points) = (known.truth.len(), known.test.len(), known.test.shapes.nrows());
    let held = |parameter: &crate::method::model::Parameter| Held {
        parameter: parameter.name.clone(),
        tests: 0,
        error: 0.0,
        deviation: 0.0,
        learned: 0.0,
    };
    let parameters = known.model.parameters().iter().map(held).collect();
    let mut coverage = Coverage { name: known.name.clone(), tests: 0, chi_squared: 0.0, parameters };
    let weights = Weights::uniform(noise, modes)?;
    for seed in seeds {
        let test = with_noise(&known.test, noise, seed)?;
        let analyze = |factors: &[f64]| known.model.analyze(factors, &test, None);
        let found = gauss_newton(analyze, &vec![1.0; count], &vec![None; count], &weights, settings)?;
        let intervals = found.identifiability.intervals(&found.factors)?;
        coverage.tests += 1;
        let logs: f64 = found.factors.iter().map(|factor| factor.ln().powi(2)).sum();
        // A test mode has its frequency and its components less their scale; each parameter takes away what it learned.
        let freedom = (modes * points) as f64 - found.identifiability.learned.iter().sum::<f64>();
        coverage.chi_squared += (2.0 * found.objective - logs / settings.prior_deviation.powi(2)) / freedom;
        for (e, held) in coverage.parameters.iter_mut().enumerate() {
            held.tests += usize::from(intervals[e].contains(known.truth[e]));
            held.error += (found.factors[e] / known.truth[e]).ln().powi(2);
            held.deviation += found.identifiability.deviations[e].powi(2);
            held.learned += found.identifiability.learned[e];
        }
    }
    let tests = coverage.tests as f64;
    coverage.chi_squared /= tests;
    for held in &mut coverage.parameters {
        (held.error, held.deviation) = ((held.error / tests).sqrt(), (held.deviation / tests).sqrt());
        held.learned /= tests;
    }
    Ok(coverage)
}

/// Coverage on the box with the parameters of [`NOISY_CASE`], then on the delta wing, with noise of [`Noise::USUAL`].
///
/// # Errors
/// Those of the structures and of [`coverage`].
pub fn all_coverages(seeds: RangeInclusive<u64>, settings: &WeightedSettings) -> Result<[Coverage; 2], CaseError> {
    let of = |known: Known| coverage(&known, Noise::USUAL, seeds.clone(), settings);
    Ok([of(Known::of_case(&Case::new(NOISY_CASE)?)?)?, of(Known::delta_wing()?)?])
}
