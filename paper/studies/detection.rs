//! How often a parameter a hundred times too thin is named on other boxes than the reconstructed one by what the first iteration asks for.

use super::localization::NOISE;
use super::readings::{FAULTY_ELEMENT, READINGS};
use crate::prelude::*;

/// By how much the coordinates and the masses of other boxes are off, parts of them.
pub const SIZES: [(f64, f64); 3] = [(0.02, 0.05), (0.05, 0.10), (0.12, 0.30)];
/// Boxes of a size.
pub const BOXES: usize = 300;

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

/// Alarms by each reading in noisy tests of right models of Cases 1 and 2, so many of each.
///
/// # Errors
/// Those of [`right_model_alarms`].
pub fn alarms(tests: u64) -> Result<[usize; 4], CaseError> {
    let (one, two) = (right_model_alarms(1, tests)?, right_model_alarms(2, tests)?);
    Ok(std::array::from_fn(|reading| one[reading] + two[reading]))
}

/// Boxes by how far they differ, and alarms by each reading.
///
/// # Errors
/// Those of [`box_rates`] and [`alarms`].
pub fn all_rates() -> Result<(Vec<BoxRates>, [usize; 4]), CaseError> {
    let boxes = SIZES.map(|size| box_rates(size, BOXES));
    let boxes = boxes.into_iter().collect::<Result<_, _>>()?;
    Ok((boxes, alarms(100)?))
}

/// How often what is a hundred times too thin is named on other boxes.
pub fn detection_table(boxes: &[BoxRates], alarms: [usize; 4]) -> Table {
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
    table
}
