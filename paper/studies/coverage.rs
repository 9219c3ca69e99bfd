//! What a weighted correlation says of itself, over noisy tests: how often its 95 % intervals hold the true factors, chi-squared of right
//! models, and how often a test is called explained.

use super::PERCENT;
use crate::common::jobs::of_whole;
use crate::common::jobs::run;
use crate::prelude::*;
use std::error::Error;

/// Seeds of the noise, one test each.
pub const SEEDS: RangeInclusive<u64> = 1..=300;
/// What the data must have learned of a parameter for it to count as seen.
pub const SEEN: f64 = 0.9;
/// Degrees of freedom from which a test with three times the noise is to be flagged.
pub const ENOUGH: f64 = 20.0;
/// Noise so many times the declared, which is to be flagged.
const TOO_LARGE: f64 = 3.0;

/// Upper and lower cover of each bay, inboard to outboard.
const BAYS: [[usize; 2]; 3] = [[2, 15], [9, 11], [4, 8]];

/// How one parameter's intervals did.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Held {
    /// Its name.
    pub parameter: String,
    /// Tests in which it has an interval,
    pub given: usize,
    /// and in which that holds the true factor.
    pub tests: usize,
    /// Mean part of its prior variance that the test took away.
    pub learned: f64,
}

impl Held {
    /// Part of its intervals that hold the truth; none without intervals.
    pub fn part(&self) -> Option<f64> {
        (self.given > 0).then(|| self.tests as f64 / self.given as f64)
    }
}

/// How the correlations of one structure did.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Coverage {
    /// The structure.
    pub name: String,
    /// Number of tests.
    pub tests: usize,
    /// Each parameter's.
    pub parameters: Vec<Held>,
    /// Sums over the tests.
    pub chi_squared: f64,
    /// Sums over the tests.
    pub degrees_of_freedom: f64,
    /// Tests with the declared noise that are called explained; of a job, those that end with status 0.
    pub explained: usize,
    /// Tests with three times the noise that are not.
    pub flagged: usize,
}

impl Coverage {
    /// The parameters that the tests see.
    pub fn seen(&self) -> impl Iterator<Item = &Held> {
        self.parameters.iter().filter(|held| held.learned >= SEEN)
    }

    /// Mean over the parameters seen of the part of their intervals that hold the truth; none where none is seen.
    pub fn overall(&self) -> Option<f64> {
        let parts = self.seen().filter_map(Held::part).collect_vec();
        (!parts.is_empty()).then(|| parts.iter().sum::<f64>() / parts.len() as f64)
    }

    /// That of the parameter seen whose intervals hold the truth least often.
    pub fn least(&self) -> Option<f64> {
        self.seen().filter_map(Held::part).reduce(f64::min)
    }

    /// Part of the intervals of parameters seen that are withheld.
    pub fn withheld(&self) -> Option<f64> {
        let (count, given) = self.seen().fold((0, 0), |(count, given), of| {
            (count + self.tests, given + of.given)
        });
        (count > 0).then(|| 1.0 - given as f64 / count as f64)
    }

    /// Mean chi-squared over its mean degrees of freedom.
    pub fn misfit(&self) -> f64 {
        self.chi_squared / self.degrees_of_freedom
    }
}

/// What one correlation came to.
struct Found {
    intervals: Vec<Option<Bounds>>,
    learned: Vec<f64>,
    misfit: Misfit,
    is_explained: bool,
}

/// What becomes of one test, by the factor on its declared noise and a seed.
type Outcome = Box<dyn Fn(f64, u64) -> Result<Found, Box<dyn Error>>>;

/// Tests of a structure whose truth is known.
struct Subject {
    name: String,
    parameters: Vec<String>,
    truth: Vec<f64>,
    test: Outcome,
}

/// Counts over the tests of a structure.
fn coverage(subject: &Subject, seeds: RangeInclusive<u64>) -> Result<Coverage, Box<dyn Error>> {
    let held = |name: &String| Held {
        parameter: name.clone(),
        ..Held::default()
    };
    let mut all = Coverage {
        name: subject.name.clone(),
        parameters: subject.parameters.iter().map(held).collect(),
        ..Coverage::default()
    };
    for seed in seeds {
        let found = (subject.test)(1.0, seed)?;
        all.tests += 1;
        all.chi_squared += found.misfit.chi_squared;
        all.degrees_of_freedom += found.misfit.degrees_of_freedom;
        all.explained += usize::from(found.is_explained);
        all.flagged += usize::from(!(subject.test)(TOO_LARGE, seed)?.is_explained);
        for (e, held) in all.parameters.iter_mut().enumerate() {
            held.given += usize::from(found.intervals[e].is_some());
            let holds = |interval: &Bounds| interval.contains(subject.truth[e]);
            held.tests += usize::from(found.intervals[e].as_ref().is_some_and(holds));
            held.learned += found.learned[e];
        }
    }
    for held in &mut all.parameters {
        held.learned /= all.tests as f64;
    }
    Ok(all)
}

/// A condensed structure, without bounds on its factors.
fn of_known(known: Known) -> Subject {
    let names = known.model.parameters().iter();
    Subject {
        name: known.name.clone(),
        parameters: names.map(|parameter| parameter.name.clone()).collect(),
        truth: known.truth.clone(),
        test: Box::new(move |times, seed| {
            let count = known.truth.len();
            let (ones, ranges) = (vec![1.0; count], vec![None; count]);
            let noise = Noise {
                shape: times * Noise::USUAL.shape,
                frequency: times * Noise::USUAL.frequency,
            };
            let test = with_noise(&known.test, noise, seed)?;
            let weights = equal_weights(Noise::USUAL, test.len());
            let analyze = |factors: &[f64]| {
                let model = known.model.analyze(factors, &test, None)?;
                Ok::<_, corfem::method::error::Error>(Comparison::from(&model))
            };
            let settings = WeightedSettings::default();
            let found = gauss_newton(analyze, &ones, &ranges, &weights, &settings)?;
            let last = analyze(&found.factors)?;
            let misfit = Misfit::of(&last, &weights, &vec![1.0; count], &[])?;
            let widening = misfit.widening();
            // Derivatives leave out what condensation does to mass: steps may become short before the gradient vanishes.
            let is_end = found.stop != WeightedStop::Trials;
            // Condensed, so that no basis of another model tells enough.
            let intervals = match is_end && times == 1.0 {
                true => intervals(
                    &analyze,
                    &found.factors,
                    &ranges,
                    &weights,
                    &settings,
                    widening,
                )?,
                false => vec![Err(Withheld::NoOptimum); count],
            };
            let intervals = intervals.into_iter().map(Result::ok).collect();
            Ok(Found {
                intervals,
                learned: found.identifiability.learned,
                is_explained: misfit.is_by_noise(),
                misfit,
            })
        }),
    }
}

/// A job, run as a user runs it.
fn of_job(name: &str, files: Files, truth: &[f64]) -> Result<Subject, FileError> {
    let (_folder, path) = placed(&files);
    let loaded = prepare(&path)?;
    Ok(Subject {
        name: name.to_owned(),
        parameters: loaded.loaded.parameter_names().map(str::to_owned).collect(),
        truth: truth.to_vec(),
        test: Box::new(move |times, seed| {
            let (_folder, path) = placed(&noisy(&loaded, &files, times, seed)?);
            let JobResult {
                intervals,
                seen,
                misfit,
                verdict,
                trust,
                ..
            } = run(&prepare(&path)?, |_| {}, || true)?;
            Ok(Found {
                intervals: intervals.into_iter().map(Result::ok).collect(),
                learned: seen.learned,
                misfit,
                is_explained: verdict.is_within && !trust.stands_against(),
            })
        }),
    })
}

/// The files of a job whose test has so many times the noise that it declares.
fn noisy(
    loaded: &PreparedJob,
    files: &Files,
    times: f64,
    seed: u64,
) -> Result<Files, Box<dyn Error>> {
    let mut data = loaded.loaded.data.clone();
    let exact = Modes::from_measured(&data.frequencies_hz, &data.shapes)?;
    let noise = (0..exact.len()).map(|mode| loaded.loaded.deviations(mode));
    let noise = noise
        .map(|noise| Noise {
            shape: times * noise.shape,
            frequency: times * noise.frequency,
        })
        .collect_vec();
    let noisy = with_noise_by_mode(&exact, &noise, seed)?;
    (data.frequencies_hz, data.shapes) = (noisy.frequencies_hz(), noisy.shapes().clone());
    let mut files = files.clone();
    for (name, text) in &mut files {
        if name == "test.csv" {
            *text = write_csv(&data);
        }
    }
    Ok(files)
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
    let alone = elements.filter(|(element, _)| !BAYS.as_flattened().contains(&element.elements[0]));
    let (mut parameters, mut truth): (Vec<Parameter>, Vec<f64>) = alone
        .map(|(element, truth)| (element.clone(), *truth))
        .unzip();
    for bay in BAYS {
        parameters.push(Parameter::new(format!("{} and {}", bay[0], bay[1]), &bay));
        truth.push(known.truth[bay[0] - 1]);
    }
    let model = FiniteElementModel::new(structure.clone(), t.clone(), mass.clone(), parameters);
    let model = Weighed(model?);
    Ok(Known {
        name: "Case 2 by bays".to_owned(),
        model,
        test: known.test,
        truth,
    })
}

/// Springs and masses in a row with parameters of neighbors: of how many springs each, then of masses one by one. Held at one end or free.
fn chain(springs_at: &[f64], is_held: bool, group: usize, masses_at: &[usize]) -> WholeModel {
    let count = springs_at.len() + usize::from(!is_held);
    let spring = |place: usize| match is_held {
        true => (place, place.checked_sub(1), springs_at[place]),
        false => (place + 1, Some(place), springs_at[place]),
    };
    let all = (0..springs_at.len()).map(spring).collect_vec();
    let of_springs = all
        .chunks(group)
        .enumerate()
        .map(|(place, of)| WholeParameter {
            name: format!("spring {}", place + 1),
            share: WholeShare::Stiffness(springs(count, of)),
            range: None,
        });
    let of_masses = masses_at.iter().map(|&row| {
        let mut one = vec![0.0; count];
        one[row] = MASS;
        WholeParameter {
            name: format!("mass {}", row + 1),
            share: WholeShare::Mass(masses(&one)),
            range: None,
        }
    });
    let parameters = of_springs.chain(of_masses).collect();
    WholeModel::new(springs(count, &all), masses(&vec![MASS; count]), parameters).unwrap()
}

/// Stiffness of a spring, lbf/in, and a mass, lbf·s²/in.
const SPRING: f64 = 1e5;
const MASS: f64 = 60.0;

/// The structures: Cases 2 and 3 of the paper, Case 2 by bays and the delta wing with [`Noise::USUAL`]; the building of ten stories, of
/// which the noise is assumed; and chains.
///
/// Where upper and lower cover of a bay are alike, they do the same to every mode: Case 2 leaves their ratio to the prior. In
/// Case 3 they begin unlike, and near the truth modes depend on the ratio by its square alone, which no slope tells.
fn subjects() -> Result<Vec<Subject>, Box<dyn Error>> {
    let known = [
        Known::of_case(2)?,
        Known::of_case(3)?,
        Known::delta_wing()?,
        case_2_by_bays()?,
    ];
    let mut all = known.into_iter().map(of_known).collect_vec();
    let stories = STORIES;
    all.push(of_job("Building", building(), &stories)?);
    let eight = [0.7, 1.0, 1.2, 0.9, 1.0, 0.8, 1.1, 1.3];
    let fine = Noise {
        shape: 0.003,
        frequency: 0.001,
    };
    let coarse = Noise {
        shape: 0.02,
        frequency: 0.005,
    };
    let equal = shear_building(&[SPRING; 8], MASS, None);
    for (sensors, rows) in [(8, vec![0, 1, 2, 3, 4, 5, 6, 7]), (4, vec![1, 3, 5, 7])] {
        for (words, noise) in [("0.1/0.3 %", fine), ("0.5/2 %", coarse)] {
            let mut files = of_whole(&equal, &eight, &rows, 6, noise);
            if sensors == 4 {
                // From the first model alone some tests end in another minimum.
                files = with(files, "job.toml", "[test]", "[compare]\nstarts = 5\n[test]");
            }
            let name = format!("Chain of 8, {sensors} sensors, {words}");
            all.push(of_job(&name, files, &eight)?);
        }
    }
    let long = chain(&[SPRING; 60], true, 6, &[]);
    let ten = [0.8, 1.0, 1.2, 0.9, 1.0, 0.75, 1.1, 1.0, 0.85, 1.25];
    let every_fourth = (3..60).step_by(4).collect_vec();
    let files = of_whole(&long, &ten, &every_fourth, 8, Noise::USUAL);
    all.push(of_job("60 DOF, truncated", files, &ten)?);
    let free = chain(&[SPRING; 9], false, 3, &[2, 7]);
    let five = [0.8, 1.2, 0.9, 1.3, 0.8];
    let files = of_whole(&free, &five, &(0..10).collect_vec(), 6, Noise::USUAL);
    all.push(of_job("Free chain with masses", files, &five)?);
    let decades = (0..8)
        .map(|place| 1e7 * 10.0_f64.powf(-f64::from(place) * 4.0 / 7.0))
        .collect_vec();
    let files = of_whole(
        &chain(&decades, true, 1, &[]),
        &eight,
        &(0..8).collect_vec(),
        8,
        Noise::USUAL,
    );
    all.push(of_job("Four decades", files, &eight)?);
    Ok(all)
}

/// Coverage on all the structures.
///
/// # Errors
/// Those of the structures and their correlations.
pub fn all_coverages(seeds: RangeInclusive<u64>) -> Result<Vec<Coverage>, Box<dyn Error>> {
    let all = subjects()?;
    let counted = |subject: &Subject| {
        let of = coverage(subject, seeds.clone())?;
        eprintln!("{of:?}");
        Ok(of)
    };
    all.iter().map(counted).collect()
}

/// How often 95 % intervals hold the truth: a line for each structure, then a table of each one's parameters.
pub fn coverage_tables(coverages: &[Coverage]) -> Vec<Table> {
    let tests = coverages.first().map_or(0, |of| of.tests);
    let title = format!("95 % intervals that hold the true factor, over {tests} noisy tests");
    let note = format!(
        "Seen: parameters of whose prior variance the test takes away {:.0} % or more. Held: of the intervals given, the mean over the \
         parameters seen. Least held: of the one of them whose intervals hold the truth least often. Explained: tests called as good as the \
         noise allows; of a job, those that end with status 0. Flagged: tests with three times the noise that are not.",
        100.0 * SEEN
    );
    let mut all = Table::new("coverage", title, "Structure")
        .headings(["Parameters", "Seen"], "")
        .headings(["Held", "Least held", "Withheld"], "%")
        .headings(["Degrees of freedom", "Chi-squared"], "")
        .headings(["Explained", "Flagged"], "%")
        .notes([note]);
    let mut tables = Vec::new();
    for of in coverages {
        let part = |count: usize| Some(count as f64 / of.tests.max(1) as f64);
        let counts = [of.parameters.len(), of.seen().count()].map(Cell::count);
        let degrees = of.degrees_of_freedom / of.tests.max(1) as f64;
        all.row(
            &of.name,
            counts
                .into_iter()
                .chain(percents([of.overall(), of.least(), of.withheld()], PERCENT))
                .chain(numbers([degrees], Digits::Fixed(1)))
                .chain(numbers([of.misfit()], Digits::Fixed(3)))
                .chain(percents([part(of.explained), part(of.flagged)], PERCENT)),
        );
        let name = of
            .name
            .to_lowercase()
            .replace(|letter: char| !letter.is_ascii_alphanumeric(), "_");
        let title = format!(
            "{}: intervals that hold the truth, and what the test says",
            of.name
        );
        let parameters = || of.parameters.iter();
        tables.push(
            Table::new(format!("coverage_{name}"), title, "Parameter")
                .labels(parameters().map(|of| &of.parameter))
                .column("Held", "%", percents(parameters().map(Held::part), PERCENT))
                .column(
                    "Given",
                    "%",
                    percents(parameters().map(|of| part(of.given)), PERCENT),
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
