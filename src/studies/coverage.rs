//! How often the 95 % intervals of a weighted correlation hold the true factors, over noisy tests.

use crate::cases::error::CaseError;
use crate::studies::noisy_modes::{Noise, with_noise};
use crate::studies::weighted::comparison::Known;
use crate::studies::weighted::gauss_newton::{WeightedSettings, gauss_newton};
use crate::studies::weighted::residuals::equal_weights;
use serde::Serialize;
use std::ops::RangeInclusive;

/// Seeds of the noise, one test each.
pub const SEEDS: RangeInclusive<u64> = 1..=1000;
/// What the data must have learned of a parameter for it to count as seen.
pub const SEEN: f64 = 0.9;

/// How one parameter's intervals did.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Held {
    /// Its name.
    pub parameter: String,
    /// Tests in which its interval holds the true factor.
    pub tests: usize,
    /// Mean part of its prior variance that the test took away.
    pub learned: f64,
}

/// How the intervals did on one structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Coverage {
    /// The structure.
    pub name: String,
    /// Number of tests.
    pub tests: usize,
    /// Each parameter's.
    pub parameters: Vec<Held>,
}

impl Coverage {
    /// Part of the intervals that hold the truth, of parameters of which the data learned at least so much; zero of none.
    pub fn overall(&self, least_learned: f64) -> f64 {
        let seen = self.parameters.iter().filter(|held| held.learned >= least_learned);
        let (count, held) = seen.fold((0, 0), |(count, held), of| (count + self.tests, held + of.tests));
        held as f64 / count.max(1) as f64
    }
}

/// Correlates a structure with noisy tests and counts the intervals that hold the truth. Bounds on the factors are left out: an
/// estimate at one has no interval of its own.
fn coverage(known: &Known, seeds: RangeInclusive<u64>) -> Result<Coverage, CaseError> {
    let (ones, ranges) = (vec![1.0; known.truth.len()], vec![None; known.truth.len()]);
    let weights = equal_weights(Noise::USUAL, known.test.len())?;
    let names = known.model.parameters().iter().map(|parameter| parameter.name.clone());
    let mut parameters: Vec<Held> = names.map(|parameter| Held { parameter, ..Held::default() }).collect();
    let mut tests = 0;
    for seed in seeds {
        let test = with_noise(&known.test, Noise::USUAL, seed)?;
        let analyze = |factors: &[f64]| known.model.analyze(factors, &test, None);
        let found = gauss_newton(analyze, &ones, &ranges, &weights, &WeightedSettings::default())?;
        let intervals = found.identifiability.intervals(&found.factors)?;
        tests += 1;
        for (e, held) in parameters.iter_mut().enumerate() {
            held.tests += usize::from(intervals[e].contains(known.truth[e]));
            held.learned += found.identifiability.learned[e];
        }
    }
    parameters.iter_mut().for_each(|held| held.learned /= tests as f64);
    Ok(Coverage { name: known.name.clone(), tests, parameters })
}

/// Coverage on Cases 2 and 3, on the delta wing, and on [`Known::case_2_by_bays`], with weights of the noise, [`Noise::USUAL`].
///
/// Where upper and lower cover of a bay are alike, they do the same to every mode: Case 2 leaves their ratio to the prior. In
/// Case 3 they begin unlike, and near the truth modes depend on the ratio by its square alone, which no linear interval describes.
///
/// # Errors
/// Those of the structures, of [`with_noise`] and of [`gauss_newton`].
pub fn all_coverages(seeds: RangeInclusive<u64>) -> Result<Vec<Coverage>, CaseError> {
    let all = [Known::of_case(2)?, Known::of_case(3)?, Known::delta_wing()?, Known::case_2_by_bays()?];
    all.iter().map(|known| coverage(known, seeds.clone())).collect()
}
