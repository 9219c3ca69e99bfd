//! How often a parameter a hundred times too thin is named on other boxes than the reconstructed one by what the first iteration asks for.

use super::readings::FAULTY_ELEMENT;
use super::rows;
use crate::prelude::*;

/// By how much the coordinates and the masses of other boxes are off, parts of them.
pub const SIZES: [(f64, f64); 3] = [(0.02, 0.05), (0.05, 0.10), (0.12, 0.30)];
/// Boxes of a size.
pub const BOXES: usize = 300;
/// Half and twice the published factor of about 60.
const ABOUT_60: RangeInclusive<f64> = 30.0..=120.0;

/// What tables call a size.
pub fn size_name((coordinates, masses): (f64, f64)) -> String {
    format!(
        "{:.0} %, masses {:.0} %",
        100.0 * coordinates,
        100.0 * masses
    )
}

/// Counts over boxes of one size, by each of [`StepRule::ALL`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BoxRates {
    /// Boxes on which Case 4 names its faulty element.
    pub named: [usize; 4],
    /// Boxes on which the factor of the faulty element is half to twice the published one.
    pub about_60: [usize; 4],
    /// Boxes on which it names another.
    pub mistaken: [usize; 4],
    /// Runs of Cases 1 to 3 that name an element.
    pub alarms: [usize; 4],
}

/// Case 4 and Cases 1 to 3 on boxes off by this much.
pub fn box_rates(size: (f64, f64), boxes: usize) -> BoxRates {
    let mut rates = BoxRates::default();
    for other in other_boxes(size.0, size.1).take(boxes) {
        for number in CASES {
            let case = Case::from_reconstruction(number, other.clone()).unwrap();
            let modal = problem_of(&case);
            for (place, step) in StepRule::ALL.into_iter().enumerate() {
                let demands = first_factors(&modal, &case.settings_by(step).inner).unwrap();
                let faulty = demands[FAULTY_ELEMENT - 1];
                rates.about_60[place] += usize::from(number == 4 && ABOUT_60.contains(&faulty));
                let counted = match (number, stands_out(&demands)) {
                    (_, None) => continue,
                    (4, Some((found, _))) if found + 1 == FAULTY_ELEMENT => &mut rates.named,
                    (4, _) => &mut rates.mistaken,
                    _ => &mut rates.alarms,
                };
                counted[place] += 1;
            }
        }
    }
    rates
}

/// How often what is a hundred times too thin is named on other boxes.
pub fn tables() -> Vec<Table> {
    let pick = |counts: [usize; 4]| [3, 1, 0].map(|reading| counts[reading] as f64).to_vec();
    let mut found = Vec::new();
    for size in SIZES {
        let (rates, label) = (
            box_rates(size, BOXES),
            format!("{}, of {BOXES}", size_name(size)),
        );
        found.extend([
            (label.clone(), pick(rates.named)),
            (
                format!("{label}: factor of 30 to 120"),
                pick(rates.about_60),
            ),
            (format!("{label}: another element"), pick(rates.mistaken)),
            (format!("{label}: Cases 1 to 3"), pick(rates.alarms)),
        ]);
    }
    vec![rows("detection_boxes", &["gage", "own", "matrix"], found)]
}
