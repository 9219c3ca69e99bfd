//! How often the pre-flight names mistakes made on purpose, with noise of a hundred seeds.

use super::noise_words;
use super::plant::{MISTAKES, Mistake, Naming, plant};
use super::specimen::Specimen;
use corfem::chain::spring_stiffness;
use corfem::job::preflight::Finding;
use corfem::method::error::Error;
use corfem::method::model::DynamicModel;
use corfem::method::modes::solve;
use corfem::method::outer_loop::Settings;
use corfem::present::table::{Cell, Table};
use corfem::torque_box::Case;
use corfem::torque_box::error::CaseError;
use corfem::weighted::noise::{Noise, with_noise};
use nalgebra::{DMatrix, DVector};
use std::ops::RangeInclusive;

/// Seeds of noise and of what is drawn.
pub const SEEDS: RangeInclusive<u64> = 1..=100;

/// How often a mistake was found.
#[derive(Debug, Clone, PartialEq)]
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
#[derive(Debug, Clone, PartialEq)]
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
/// Those of [`with_noise`] and [`Specimen::findings`].
pub fn rates(specimen: &Specimen, seeds: RangeInclusive<u64>) -> Result<Rates, Error> {
    let clean = specimen.findings(&specimen.test)?;
    let is_low = |finding: &Finding| matches!(finding, Finding::LowPair { .. });
    // A low pair with other digits is the same one.
    let is_new = |finding: &&Finding| match finding {
        Finding::LowPair { test, .. } => !clean
            .iter()
            .any(|known| matches!(known, Finding::LowPair { test: t, .. } if t == test)),
        other => !clean.contains(other),
    };
    let name = specimen.name.clone();
    let mut found = Rates {
        name,
        seeds: 0,
        clean: clean.clone(),
        false_alarms: 0,
        low_pairs: 0,
        rates: Vec::new(),
    };
    for seed in seeds.clone() {
        let findings = specimen.findings(&with_noise(&specimen.test, Noise::USUAL, seed)?)?;
        found.seeds += 1;
        found.false_alarms += usize::from(
            findings
                .iter()
                .filter(is_new)
                .any(|finding| !is_low(finding)),
        );
        found.low_pairs += usize::from(findings.iter().filter(is_new).any(is_low));
    }
    for mistake in MISTAKES {
        let mut rate = Rate {
            mistake,
            named: 0,
            told: 0,
            said: 0,
        };
        for seed in seeds.clone() {
            let Some((planted, naming)) = plant(specimen, mistake, seed)? else {
                break;
            };
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

/// Stiffness of the first model's springs over the true one.
const SPRING_ERRORS: [f64; 8] = [0.8, 1.25, 1.0, 0.75, 1.0, 1.3, 0.9, 1.0];

/// Eight masses and eight springs in a row, held at one end, both less toward the other, with springs up to 30 % wrong.
///
/// # Errors
/// Those of [`solve`].
pub fn spring_chain() -> Result<Specimen, Error> {
    let count = SPRING_ERRORS.len();
    let spring =
        |s: usize, error: f64| spring_stiffness(count, s, 1e6 * error * (1.0 - 0.08 * s as f64));
    let right: DMatrix<f64> = (0..count).map(|s| spring(s, 1.0)).sum();
    let wrong = SPRING_ERRORS
        .iter()
        .enumerate()
        .map(|(s, &error)| spring(s, error))
        .sum();
    let mass = DMatrix::from_diagonal(&DVector::from_fn(count, |point, _| {
        1.0 - 0.06 * point as f64
    }));
    Ok(Specimen {
        name: "Spring chain".to_owned(),
        test: solve(&right, &mass, count)?.into(),
        model: DynamicModel {
            stiffness: wrong,
            mass,
            shares: Vec::new(),
        },
        settings: Settings::default(),
        ranges: vec![None; count],
    })
}

/// Rates on the paper's Cases 2 and 3, the delta wing and the spring chain.
///
/// # Errors
/// Those of the structures and of [`rates`].
pub fn all_rates(seeds: RangeInclusive<u64>) -> Result<Vec<Rates>, CaseError> {
    let [case_2, case_3] = [2, 3].map(|case| Specimen::of_case(&Case::new(case)?));
    let specimens = [case_2?, case_3?, Specimen::delta_wing()?, spring_chain()?];
    std::thread::scope(|scope| {
        let found = specimens.each_ref().map(|specimen| {
            let seeds = seeds.clone();
            scope.spawn(|| rates(specimen, seeds))
        });
        let rates = found.map(|rates| rates.join().expect("no panic"));
        rates.into_iter().map(|rates| Ok(rates?)).collect()
    })
}

/// A count over the seeds of one mistake.
type Count = fn(&Rate) -> usize;

/// How often each mistake is named first, named first or as the next best, and not passed over in silence.
pub fn rate_tables(rates: &[Rates]) -> Vec<Table> {
    let seeds = rates.first().map_or(0, |rates| rates.seeds);
    let sides: [(&str, &str, Count); 3] = [
        ("named", "named", |rate| rate.named),
        ("told", "named first or as the next best", |rate| rate.told),
        ("said", "anything said", |rate| rate.said),
    ];
    let mut tables = sides.map(|(name, what, count)| {
        let title = format!("Mistakes made on purpose: {what}, of {seeds} seeds");
        let table =
            Table::new(format!("preflight_{name}"), title, "Mistake").labels(MISTAKES.map(words));
        rates.iter().fold(table, |table, rates| {
            let rate = |mistake| rates.rates.iter().find(|rate| rate.mistake == mistake);
            let counts = MISTAKES
                .map(|mistake| rate(mistake).map_or(Cell::Blank, |rate| Cell::count(count(rate))));
            table.column(&rates.name, "", counts)
        })
    });
    tables[0].row(
        "none: false alarms",
        rates.iter().map(|rates| Cell::count(rates.false_alarms)),
    );
    tables[0].row(
        "none: a low pair by noise",
        rates.iter().map(|rates| Cell::count(rates.low_pairs)),
    );
    tables[0].notes.push(format!(
        "Noise: {}. What a mistake hits is drawn anew with every seed. Named: with all its places right.",
        noise_words(Noise::USUAL)
    ));
    tables.to_vec()
}

fn words(mistake: Mistake) -> &'static str {
    match mistake {
        Mistake::Factor => "common factor of the frequencies",
        Mistake::Reversed => "one sensor reversed",
        Mistake::Exchanged => "two sensors exchanged",
        Mistake::Reordered => "points in another order",
        Mistake::TwoColumns => "two columns of T exchanged",
        Mistake::Columns => "columns of T in another order",
        Mistake::Transposed => "shapes transposed",
        Mistake::Frequencies => "two frequencies exchanged",
        Mistake::Repeated => "a mode measured twice",
        Mistake::FewPoints => "fewer points than modes",
    }
}
