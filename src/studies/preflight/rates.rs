//! How often the pre-flight names mistakes made on purpose, with noise of a hundred seeds.

use super::Finding;
use super::plant::{MISTAKES, Mistake, Naming, plant};
use super::specimen::Specimen;
use crate::cases::Case;
use crate::cases::error::CaseError;
use crate::method::error::Error;
use crate::studies::noise::{Noise, with_noise};
use serde::Serialize;
use std::ops::RangeInclusive;

/// Seeds of noise and of what is drawn.
pub const SEEDS: RangeInclusive<u64> = 1..=100;

/// How often a mistake was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rate {
    /// The mistake.
    pub mistake: Mistake,
    /// Seeds with which it was named first, with all its places right.
    pub named: usize,
    /// Seeds with which it was named first or as the next best.
    pub told: usize,
    /// Seeds with which anything was found that is not found without it.
    pub said: usize,
}

/// What the pre-flight is worth on one structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rates {
    /// The structure.
    pub name: String,
    /// Number of seeds.
    pub seeds: usize,
    /// Findings without noise and without mistakes.
    pub clean: Vec<Finding>,
    /// Seeds with noise and without mistakes with which a mistake is named that is not there.
    pub false_alarms: usize,
    /// Seeds with noise and without mistakes with which a pair is low that is not low without noise.
    pub low_pairs: usize,
    /// One for each mistake that the structure allows.
    pub rates: Vec<Rate>,
}

/// Detection rates and false alarms on one structure.
///
/// # Errors
/// Those of [`with_noise`] and [`super::preflight`].
pub fn rates(specimen: &Specimen, seeds: RangeInclusive<u64>) -> Result<Rates, Error> {
    let clean = specimen.findings(&specimen.test)?;
    let is_low = |finding: &Finding| matches!(finding, Finding::LowPair { .. });
    // A low pair with other digits is the same one.
    let is_new = |finding: &&Finding| match finding {
        Finding::LowPair { test, .. } => {
            !clean.iter().any(|known| matches!(known, Finding::LowPair { test: t, .. } if t == test))
        }
        other => !clean.contains(other),
    };
    let name = specimen.name.clone();
    let mut found = Rates { name, seeds: 0, clean: clean.clone(), false_alarms: 0, low_pairs: 0, rates: Vec::new() };
    for seed in seeds.clone() {
        let findings = specimen.findings(&with_noise(&specimen.test, Noise::USUAL, seed)?)?;
        found.seeds += 1;
        found.false_alarms += usize::from(findings.iter().filter(is_new).any(|finding| !is_low(finding)));
        found.low_pairs += usize::from(findings.iter().filter(is_new).any(is_low));
    }
    for mistake in MISTAKES {
        let mut rate = Rate { mistake, named: 0, told: 0, said: 0 };
        for seed in seeds.clone() {
            let Some((planted, naming)) = plant(specimen, mistake, seed)? else { break };
            let findings = planted.findings(&planted.test)?;
            let naming = findings.iter().map(naming).max().unwrap_or(Naming::Not);
            rate.named += usize::from(naming == Naming::First);
            rate.told += usize::from(naming >= Naming::Next);
            rate.said += usize::from(findings.iter().any(|finding| is_new(&finding)));
        }
        found.rates.extend((rate.said > 0).then_some(rate));
    }
    Ok(found)
}

/// Rates on the paper's Cases 2 and 3, the delta wing and the spring chain.
///
/// # Errors
/// Those of the structures and of [`rates`].
pub fn all_rates(seeds: RangeInclusive<u64>) -> Result<Vec<Rates>, CaseError> {
    let [case_2, case_3] = [2, 3].map(|case| Specimen::of_case(&Case::new(case)?));
    let specimens = [case_2?, case_3?, Specimen::delta_wing()?, Specimen::spring_chain()?];
    specimens.iter().map(|specimen| Ok(rates(specimen, seeds.clone())?)).collect()
}
