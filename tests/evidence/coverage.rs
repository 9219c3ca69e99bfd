//! How often the 95 % intervals of a weighted correlation hold the true factors, over noisy tests.

use super::{PERCENT, noise_words};
use crate::common::known::Known;
use crate::common::measured::equal_weights;
use corfem::method::model::Parameter;
use corfem::present::table::{Cell, Table, percents};
use corfem::sparse::LargeModel;
use corfem::torque_box::error::CaseError;
use corfem::weighted::gauss_newton::{WeightedSettings, gauss_newton};
use corfem::weighted::noise::{Noise, with_noise};
use std::ops::RangeInclusive;

/// Seeds of the noise, one test each.
pub const SEEDS: RangeInclusive<u64> = 1..=1000;
/// What the data must have learned of a parameter for it to count as seen.
pub const SEEN: f64 = 0.9;

/// Upper and lower cover of each bay, inboard to outboard.
const BAYS: [[usize; 2]; 3] = [[2, 15], [9, 11], [4, 8]];

/// How one parameter's intervals did.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Held {
    /// Its name.
    pub parameter: String,
    /// Tests in which its interval holds the true factor.
    pub tests: usize,
    /// Mean part of its prior variance that the test took away.
    pub learned: f64,
}

/// How the intervals did on one structure.
#[derive(Debug, Clone, PartialEq)]
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
        let seen = self
            .parameters
            .iter()
            .filter(|held| held.learned >= least_learned);
        let (count, held) = seen.fold((0, 0), |(count, held), of| {
            (count + self.tests, held + of.tests)
        });
        held as f64 / count.max(1) as f64
    }
}

/// Correlates a structure with noisy tests and counts the intervals that hold the truth. Bounds on the factors are left out: an
/// estimate at one has no interval of its own.
fn coverage(known: &Known, seeds: RangeInclusive<u64>) -> Result<Coverage, CaseError> {
    let (ones, ranges) = (vec![1.0; known.truth.len()], vec![None; known.truth.len()]);
    let weights = equal_weights(Noise::USUAL, known.test.len());
    let names = known
        .model
        .parameters()
        .iter()
        .map(|parameter| parameter.name.clone());
    let mut parameters: Vec<Held> = names
        .map(|parameter| Held {
            parameter,
            ..Held::default()
        })
        .collect();
    let mut tests = 0;
    for seed in seeds {
        let test = with_noise(&known.test, Noise::USUAL, seed)?;
        let analyze = |factors: &[f64]| known.model.analyze(factors, &test, None);
        let found = gauss_newton(
            analyze,
            &ones,
            &ranges,
            &weights,
            &WeightedSettings::default(),
        )?;
        let intervals = found.identifiability.intervals(&found.factors)?;
        tests += 1;
        for (e, held) in parameters.iter_mut().enumerate() {
            held.tests += usize::from(intervals[e].contains(known.truth[e]));
            held.learned += found.identifiability.learned[e];
        }
    }
    parameters
        .iter_mut()
        .for_each(|held| held.learned /= tests as f64);
    Ok(Coverage {
        name: known.name.clone(),
        tests,
        parameters,
    })
}

/// Case 2 with the two covers of each bay, which its modes do not tell apart, as one parameter.
///
/// # Errors
/// Those of the case and its model.
fn case_2_by_bays() -> Result<Known, CaseError> {
    let known = Known::of_case(2)?;
    let (structure, t, mass) = (
        known.model.structure(),
        known.model.load_distribution(),
        known.model.mass(),
    );
    let elements = known.model.parameters().iter().zip(&known.truth);
    let alone = elements.filter(|(element, _)| !BAYS.as_flattened().contains(&element.members[0]));
    let (mut parameters, mut truth): (Vec<Parameter>, Vec<f64>) = alone
        .map(|(element, truth)| (element.clone(), *truth))
        .unzip();
    for bay in BAYS {
        parameters.push(Parameter::group(
            &format!("{} and {}", bay[0], bay[1]),
            &bay,
        ));
        truth.push(known.truth[bay[0] - 1]);
    }
    let model = LargeModel::new(structure.clone(), t.clone(), mass.clone(), parameters)?;
    Ok(Known {
        name: "Case 2 by bays".to_owned(),
        model,
        test: known.test,
        truth,
    })
}

/// Coverage on Cases 2 and 3, on the delta wing, and on [`case_2_by_bays`], with weights of the noise, [`Noise::USUAL`].
///
/// Where upper and lower cover of a bay are alike, they do the same to every mode: Case 2 leaves their ratio to the prior. In
/// Case 3 they begin unlike, and near the truth modes depend on the ratio by its square alone, which no linear interval describes.
///
/// # Errors
/// Those of the structures, of [`with_noise`] and of [`gauss_newton`].
pub fn all_coverages(seeds: RangeInclusive<u64>) -> Result<Vec<Coverage>, CaseError> {
    let all = [
        Known::of_case(2)?,
        Known::of_case(3)?,
        Known::delta_wing()?,
        case_2_by_bays()?,
    ];
    all.iter()
        .map(|known| coverage(known, seeds.clone()))
        .collect()
}

/// How often 95 % intervals hold the truth: a line for each structure, then a table of each one's parameters.
pub fn coverage_tables(coverages: &[Coverage]) -> Vec<Table> {
    let tests = coverages.first().map_or(0, |of| of.tests);
    let title = format!("95 % intervals that hold the true factor, over {tests} noisy tests");
    let note = format!(
        "Noise: {}. Seen: parameters of whose prior variance the test takes away {:.0} % or more. Least held: of the one of them \
        whose intervals hold the truth least often.",
        noise_words(Noise::USUAL),
        100.0 * SEEN
    );
    let mut all = Table::new("coverage", title, "Structure")
        .headings(["Parameters", "Seen"], "")
        .headings(["Held, seen", "Least held, seen", "Held, all"], "%")
        .notes([note]);
    let mut tables = Vec::new();
    for of in coverages {
        let held = |tests: usize| tests as f64 / of.tests.max(1) as f64;
        let seen = || of.parameters.iter().filter(|held| held.learned >= SEEN);
        let least = seen().map(|seen| seen.tests).min();
        let fractions = [
            least.map(|_| of.overall(SEEN)),
            least.map(held),
            Some(of.overall(f64::NEG_INFINITY)),
        ];
        let counts = [of.parameters.len(), seen().count()].map(Cell::count);
        all.row(
            &of.name,
            counts.into_iter().chain(percents(fractions, PERCENT)),
        );
        let name = format!("coverage_{}", of.name.to_lowercase().replace(' ', "_"));
        let title = format!(
            "{}: intervals that hold the truth, and what the test says",
            of.name
        );
        let parameters = || of.parameters.iter();
        tables.push(
            Table::new(name, title, "Parameter")
                .labels(parameters().map(|of| &of.parameter))
                .column(
                    "Held",
                    "%",
                    percents(parameters().map(|of| held(of.tests)), PERCENT),
                )
                .column(
                    "Learned",
                    "%",
                    percents(parameters().map(|of| of.learned), PERCENT),
                ),
        );
    }
    tables.insert(0, all);
    tables
}
