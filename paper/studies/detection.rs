//! How often a parameter a hundred times too thin is named off the reconstructed box: on other boxes by what the first iteration asks
//! for, on other structures by the fit of a single parameter that `corfem check` prints.

use super::localization::NOISE;
use super::readings::{FAULTY_ELEMENT, READINGS};
use super::readings_rates::{KINDS, Kind, below, unit};
use crate::prelude::*;

/// By how much the coordinates and the masses of other boxes are off, parts of them.
pub const SIZES: [(f64, f64); 3] = [(0.02, 0.05), (0.05, 0.10), (0.12, 0.30)];
/// Boxes of a size.
pub const BOXES: usize = 300;
/// Tests of a structure.
pub const TESTS: u64 = 30;
/// Structures of a job: a truss has more rods than five modes tell apart.
pub const STRUCTURES: usize = 4;
/// Test modes of a job.
const MODES: usize = 5;

/// Other boxes of one size.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxRates {
    /// By how much coordinates and masses are off.
    pub size: (f64, f64),
    /// How many boxes.
    pub boxes: usize,
    /// In how many Case 4 names its faulty element by each of [`READINGS`].
    pub named: [usize; 4],
    /// In how many it names another.
    pub mistaken: [usize; 4],
    /// Runs of Cases 1 to 3 that name an element.
    pub alarms: [usize; 4],
    /// Factor of the faulty element in Case 4 by each reading, box by box.
    pub factors: [Vec<f64>; 4],
}

/// Half and twice the published factor of about 60.
pub const ABOUT_60: RangeInclusive<f64> = 30.0..=120.0;

impl BoxRates {
    /// On how many the factor of the faulty element is half to twice the published one.
    pub fn about_60(&self) -> [usize; 4] {
        let count = |factors: &Vec<f64>| factors.iter().filter(|c| ABOUT_60.contains(c)).count();
        std::array::from_fn(|reading| count(&self.factors[reading]))
    }
}

/// What the first iteration of a case asks for by each of [`READINGS`].
fn demands(case: &Case, model: &Model) -> Result<[Vec<f64>; 4], Error> {
    let (state, relaxation) = (model.exact(), case.settings.inner.first_relaxation);
    let (changes, error_sum) = (model.error_changes(state)?, state.errors.sum());
    Ok(READINGS.map(|reading| {
        let stiffnesses = model.stiffness_changes(state, &[1.0; PANEL_COUNT], reading);
        let pairs = changes.iter().zip(&stiffnesses);
        pairs
            .map(|(error, stiffness)| unlimited_factor(*error, *stiffness, error_sum, relaxation))
            .collect()
    }))
}

/// Case 4 and Cases 1 to 3 on boxes off by this much.
///
/// # Errors
/// Those of the cases.
pub fn box_rates(size: (f64, f64), boxes: usize) -> Result<BoxRates, CaseError> {
    let mut rates = BoxRates {
        size,
        boxes,
        named: [0; 4],
        mistaken: [0; 4],
        alarms: [0; 4],
        factors: [const { Vec::new() }; 4],
    };
    for other in other_boxes(size.0, size.1).take(boxes) {
        for number in CASES {
            let case = Case::from_reconstruction(number, other.clone())?;
            let test = case.test_modes()?;
            let model = case.model()?.analyze(&[1.0; PANEL_COUNT], &test, None)?;
            for (place, demands) in demands(&case, &model)?.iter().enumerate() {
                if number == 4 {
                    rates.factors[place].push(demands[FAULTY_ELEMENT - 1]);
                }
                let found = stands_out(demands).map(|(parameter, _)| parameter + 1);
                let counted = match (number, found) {
                    (_, None) => continue,
                    (4, Some(FAULTY_ELEMENT)) => &mut rates.named,
                    (4, _) => &mut rates.mistaken,
                    _ => &mut rates.alarms,
                };
                counted[place] += 1;
            }
        }
    }
    Ok(rates)
}

/// How many noisy tests of a right model, of as many seeds, name an element by each of [`READINGS`].
///
/// # Errors
/// Those of the case.
pub fn right_model_alarms(number: usize, seeds: u64) -> Result<[usize; 4], CaseError> {
    let case = Case::new(number)?;
    let model = case.model_with(&[TEST_GAGE; PANEL_COUNT])?;
    let exact = case.test_modes()?;
    let mut alarms = [0; 4];
    for seed in 1..=seeds {
        let test = with_noise(&exact, NOISE, seed)?;
        let modal = model.analyze(&[1.0; PANEL_COUNT], &test, None)?;
        for (alarms, demands) in alarms.iter_mut().zip(demands(&case, &modal)?) {
            *alarms += usize::from(stands_out(&demands).is_some());
        }
    }
    Ok(alarms)
}

/// Jobs of one structure, in each of which the real one has one parameter a hundred times too thin.
#[derive(Debug, Clone, PartialEq)]
pub struct JobRates {
    /// The structure.
    pub name: &'static str,
    /// In how many the culprit is the first suspect, and in how many one of the first three.
    pub fit: [usize; 2],
    /// In how many it has the largest change by the paper's factor with the reading matrix.
    pub factor: usize,
}

/// The suspects of so many jobs of a structure.
///
/// # Panics
/// If a job cannot be looked at.
pub fn job_rates(kind: Kind, tests: u64) -> JobRates {
    let (mut state, mut rates) = (
        11,
        JobRates {
            name: kind.name,
            fit: [0; 2],
            factor: 0,
        },
    );
    for seed in 0..tests {
        let (parts, mass, _) = (kind.build)(&mut state);
        let culprit = below(&mut state, parts.len());
        let mut real: DMatrix<f64> = parts.iter().sum();
        real -= 0.99 * &parts[culprit];
        let exact = solve(&real, &mass, MODES).unwrap();
        let shapes = unit(exact.shapes().clone());
        let exact = Modes::new(exact.omega_squared().clone(), shapes).unwrap();
        let test = with_noise(&exact, NOISE, seed).unwrap();
        let loaded = prepared(&of_matrices(&parts, &mass, &test));
        let table = suspects_table(&loaded);
        let name = format!("p{}", culprit + 1);
        let place = table.rows.iter().position(|row| row.label == name);
        rates.fit[0] += usize::from(place == Some(0));
        rates.fit[1] += usize::from(place.is_some_and(|place| place < 3));
        let first = loaded.analyze(&vec![1.0; parts.len()]).unwrap();
        let settings = loaded.loaded.job.correlation.for_modes(MODES).inner;
        let largest = by_factor(first.model(), &settings).unwrap();
        rates.factor += usize::from(largest[0].parameter == culprit);
    }
    rates
}

/// Every structure's.
pub fn all_job_rates(tests: u64) -> Vec<JobRates> {
    KINDS[..STRUCTURES]
        .iter()
        .map(|kind| job_rates(*kind, tests))
        .collect()
}

/// Alarms by each reading in noisy tests of right models of Cases 1 and 2, so many of each.
///
/// # Errors
/// Those of [`right_model_alarms`].
pub fn alarms(tests: u64) -> Result<[usize; 4], CaseError> {
    let (one, two) = (right_model_alarms(1, tests)?, right_model_alarms(2, tests)?);
    Ok(std::array::from_fn(|reading| one[reading] + two[reading]))
}

/// Boxes by how far they differ, alarms by each reading, and jobs.
type Rates = (Vec<BoxRates>, [usize; 4], Vec<JobRates>);

/// All of them.
///
/// # Errors
/// Those of [`box_rates`] and [`alarms`].
pub fn all_rates() -> Result<Rates, CaseError> {
    let boxes = SIZES.map(|size| box_rates(size, BOXES));
    let boxes = boxes.into_iter().collect::<Result<_, _>>()?;
    Ok((boxes, alarms(100)?, all_job_rates(TESTS)))
}

/// How often what is a hundred times too thin is named, on other boxes and in jobs.
pub fn detection_tables(boxes: &[BoxRates], alarms: [usize; 4], jobs: &[JobRates]) -> Vec<Table> {
    let place = |reading| READINGS.iter().position(|other| *other == reading);
    let by = [StepRule::Gage, StepRule::Own, StepRule::Matrix].map(place);
    let pick = |counts: &[usize; 4]| by.map(|place| Cell::count(counts[place.unwrap_or(0)]));
    let title = "Case 4 and Cases 1 to 3 on other boxes: how many name an element";
    let mut table =
        Table::new("detection_boxes", title, "Boxes").headings(["gage", "own", "matrix"], "");
    for rates in boxes {
        let label = format!(
            "{:.0} %, masses {:.0} %, of {}",
            100.0 * rates.size.0,
            100.0 * rates.size.1,
            rates.boxes
        );
        table.row(&label, pick(&rates.named));
        table.row(
            format!("{label}: factor of 30 to 120"),
            pick(&rates.about_60()),
        );
        table.row(format!("{label}: another element"), pick(&rates.mistaken));
        table.row(format!("{label}: Cases 1 to 3"), pick(&rates.alarms));
    }
    table.row("right models with noise", pick(&alarms));
    let title =
        format!("One parameter of a structure a hundred times too thin: first of {TESTS} jobs");
    let mut others = Table::new("detection_jobs", title, "Structure")
        .headings(["Fit first", "Fit in three", "Factor first"], "");
    for rates in jobs {
        let counts = [rates.fit[0], rates.fit[1], rates.factor];
        others.row(rates.name, counts.map(Cell::count));
    }
    vec![table, others]
}
