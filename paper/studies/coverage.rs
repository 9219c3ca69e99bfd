//! What a weighted correlation says of itself, over noisy tests: how often its 95 % intervals hold the true factors, chi-squared of right
//! models, and how often a test is called explained.

use super::{percents, rows};
use crate::common::jobs;
use crate::prelude::*;

/// Seeds of the noise, one test each.
pub const SEEDS: RangeInclusive<u64> = 1..=300;
/// Part of its prior variance that the data must take away for a parameter to count as seen.
pub const SEEN: f64 = 0.9;
/// Degrees of freedom from which a test with three times the noise is to be flagged.
pub const ENOUGH: f64 = 20.0;

/// What one correlation came to.
struct Found {
    intervals: Vec<Option<Bounds>>,
    learned: Vec<f64>,
    misfit: Misfit,
    is_explained: bool,
}

/// How one parameter's intervals did.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Held {
    /// Its name.
    pub parameter: String,
    /// Part of the tests in which it has an interval,
    pub given: f64,
    /// and of these intervals the part that holds the true factor; NaN without intervals.
    pub held: f64,
    /// Mean part of its prior variance that the test took away.
    pub learned: f64,
}

/// How the correlations of one structure did.
#[derive(Debug, Clone, PartialEq)]
pub struct Coverage {
    /// The structure.
    pub name: String,
    /// Each parameter's.
    pub parameters: Vec<Held>,
    /// Mean degrees of freedom.
    pub degrees_of_freedom: f64,
    /// Mean chi-squared over them.
    pub misfit: f64,
    /// Part of the tests with the declared noise that are called explained; of a job, those that end with status 0.
    pub explained: f64,
    /// Part of the tests with three times the noise that are not.
    pub flagged: f64,
}

impl Coverage {
    /// The parameters that the tests see.
    pub fn seen(&self) -> impl Iterator<Item = &Held> {
        self.parameters.iter().filter(|held| held.learned >= SEEN)
    }

    /// Mean over the parameters seen of the part of their intervals that hold the truth.
    pub fn overall(&self) -> f64 {
        mean(self.seen().map(|held| held.held))
    }

    /// That of the parameter seen whose intervals hold the truth least often.
    pub fn least(&self) -> f64 {
        self.seen().map(|held| held.held).fold(f64::NAN, f64::min)
    }
}

fn mean(all: impl IntoIterator<Item = f64>) -> f64 {
    let all = all.into_iter().collect_vec();
    all.iter().sum::<f64>() / all.len() as f64
}

/// Means over the tests of a structure, by what becomes of one with a factor on its declared noise and a seed.
fn coverage(
    name: &str,
    parameters: Vec<(String, f64)>,
    seeds: RangeInclusive<u64>,
    test: impl Fn(f64, u64) -> Found,
) -> Coverage {
    let all = seeds.clone().map(|seed| test(1.0, seed)).collect_vec();
    let part = |is: &dyn Fn(&Found) -> bool| mean(all.iter().map(|of| f64::from(is(of))));
    let held = |(e, (parameter, truth)): (usize, (String, f64))| {
        let given = all.iter().filter_map(|of| of.intervals[e]);
        let holds = given.map(|own| f64::from(own.contains(truth)));
        Held {
            parameter,
            given: part(&|of| of.intervals[e].is_some()),
            held: mean(holds),
            learned: mean(all.iter().map(|of| of.learned[e])),
        }
    };
    let degrees_of_freedom = mean(all.iter().map(|of| of.misfit.degrees_of_freedom));
    let flagged = seeds.map(|seed| f64::from(!test(3.0, seed).is_explained));
    Coverage {
        name: name.to_owned(),
        degrees_of_freedom,
        misfit: mean(all.iter().map(|of| of.misfit.chi_squared)) / degrees_of_freedom,
        explained: part(&|of| of.is_explained),
        flagged: mean(flagged),
        parameters: parameters.into_iter().enumerate().map(held).collect(),
    }
}

/// A condensed structure, without bounds on its factors.
fn of_known(known: &Known, seeds: RangeInclusive<u64>) -> Coverage {
    let (ones, ranges) = (vec![1.0; known.truth.len()], vec![None; known.truth.len()]);
    let settings = WeightedSettings::default();
    let names = known.model.parameters().iter().map(|own| own.name.clone());
    let parameters = names.zip(known.truth.iter().copied()).collect();
    coverage(&known.name, parameters, seeds, |times, seed| {
        let noise = Noise {
            shape: times * Noise::USUAL.shape,
            frequency: times * Noise::USUAL.frequency,
        };
        let test = with_noise(&known.test, noise, seed).unwrap();
        let weights = equal_weights(Noise::USUAL, test.len());
        let analyze = |factors: &[f64]| {
            let model = known.model.analyze(factors, &test)?;
            Ok::<_, Error>(Comparison::from(&model))
        };
        let found = gauss_newton(analyze, &ones, &ranges, &weights, &settings).unwrap();
        let last = analyze(&found.factors).unwrap();
        let misfit = Misfit::of(&last, &weights, &ones, &[]).unwrap();
        // Derivatives leave out what condensation does to mass: steps may become short before the gradient vanishes.
        let is_end = found.stop != WeightedStop::Trials && times == 1.0;
        let (place, widening) = (&found.factors, misfit.widening());
        // Condensed, so that no basis of another model tells enough.
        let given = || intervals(&analyze, place, &ranges, &weights, &settings, widening);
        let none = || Ok(vec![Err(Withheld::NoOptimum); ones.len()]);
        let given = if is_end { given() } else { none() }.unwrap();
        Found {
            intervals: given.into_iter().map(Result::ok).collect(),
            learned: found.identifiability.learned,
            is_explained: misfit.is_by_noise(),
            misfit,
        }
    })
}

/// The building of ten stories, run as a user runs a job.
fn of_building(seeds: RangeInclusive<u64>) -> Coverage {
    let files = building();
    let (_folder, path) = placed(&files);
    let loaded = prepare(&path).unwrap();
    let names = loaded.loaded.parameter_names().map(str::to_owned);
    coverage(
        "Building",
        names.zip(STORIES).collect(),
        seeds,
        |times, seed| {
            let mut data = loaded.loaded.data.clone();
            let exact = Modes::from_measured(&data.frequencies_hz, &data.shapes).unwrap();
            let noise = (0..exact.len()).map(|mode| {
                let declared = loaded.loaded.deviations(mode);
                Noise {
                    shape: times * declared.shape,
                    frequency: times * declared.frequency,
                }
            });
            let noisy = with_noise_by_mode(&exact, &noise.collect_vec(), seed).unwrap();
            (data.frequencies_hz, data.shapes) = (noisy.frequencies_hz(), noisy.shapes().clone());
            let mut files = files.clone();
            let test = files.iter_mut().find(|(name, _)| name == "test.csv");
            test.unwrap().1 = write_csv(&data);
            let (_folder, path) = placed(&files);
            let found = jobs::run(&prepare(&path).unwrap(), |_| {}, || true).unwrap();
            Found {
                intervals: found.intervals.into_iter().map(Result::ok).collect(),
                learned: found.seen.learned,
                misfit: found.misfit,
                is_explained: found.verdict.is_within && !found.trust.stands_against(),
            }
        },
    )
}

/// Coverage on Case 3 of the paper and the delta wing with [`Noise::USUAL`], and the building of ten stories, of which the noise is assumed.
///
/// Where upper and lower cover of a bay are alike, they do the same to every mode. In Case 3 they begin unlike, and near the truth modes
/// depend on their ratio by its square alone, which no slope tells.
pub fn all_coverages(seeds: RangeInclusive<u64>) -> [Coverage; 3] {
    [
        of_known(&Known::of_case(3), seeds.clone()),
        of_known(&Known::delta_wing(), seeds.clone()),
        of_building(seeds),
    ]
}

/// How often 95 % intervals hold the truth: a line for each structure, then each parameter of Case 3.
pub fn tables(seeds: RangeInclusive<u64>) -> Vec<Table> {
    let all = all_coverages(seeds);
    let lines = all.iter().map(|of| {
        let counts = [of.parameters.len(), of.seen().count()].map(|count| count as f64);
        let withheld = 1.0 - mean(of.seen().map(|held| held.given));
        let mut line = counts.to_vec();
        line.extend(percents([of.overall(), of.least(), withheld]));
        line.extend([of.degrees_of_freedom, of.misfit]);
        line.extend(percents([of.explained, of.flagged]));
        (&of.name, line)
    });
    let columns = [
        "Parameters",
        "Seen",
        "Held %",
        "Least held %",
        "Withheld %",
        "Degrees of freedom",
        "Chi-squared",
        "Explained %",
        "Flagged %",
    ];
    let case_3 = all[0].parameters.iter();
    let case_3 = case_3.map(|of| (&of.parameter, percents([of.held, of.given, of.learned])));
    vec![
        rows("coverage", &columns, lines),
        rows(
            "coverage_case_3",
            &["Held %", "Given %", "Learned %"],
            case_3,
        ),
    ]
}
