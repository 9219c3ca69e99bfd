//! Whether changes of stiffness add or multiply in an inner loop, asked without any rule of the step: Table 11 prints gages after so many
//! iterations, Table 9 the inner loop's own frequencies there.

use super::detection::{SIZES, size_name};
use super::{percents, rows};
use crate::prelude::*;

/// Other boxes of each size.
pub const ADDED_BOXES: usize = 10;

/// Mean over Table 9's 21 frequencies of their relative differences, each over that of the test, by which what is wrong with the box
/// cancels: if changes add, and if they multiply. The frequencies are those of the inner loop's own frozen model at Table 11's gages.
pub fn added_and_multiplied(reconstruction: &Reconstruction) -> [f64; 2] {
    let case = Case::from_reconstruction(PUBLISHED_CASE, reconstruction.clone()).unwrap();
    let model = case.model().unwrap().matrices(&[1.0; PANEL_COUNT]).unwrap();
    let test = case.test_modes().unwrap().frequencies_hz();
    let [gages, frequencies, measured] = [11, 9, 5].map(|of| PublishedTable::number(of).unwrap());
    let mut sums = [0.0; 2];
    for modes in [5, 7, 9] {
        let number = |table: &PublishedTable, row: usize, unit: &str| {
            let heading = format!("fem_{modes}_{unit}");
            table.required(&row.to_string(), &heading).unwrap()
        };
        let steps = gages
            .value("iterations", &format!("fem_{modes}_percent"))
            .unwrap();
        // In the modes that the run was given, its steps alike in ratio.
        let first = solve(&model.stiffness, &model.mass, modes).unwrap();
        let added = |ratio: f64| 1.0 + steps * (ratio.powf(1.0 / steps) - 1.0);
        for (sum, change) in sums
            .iter_mut()
            .zip([&added as &dyn Fn(f64) -> f64, &|ratio| ratio])
        {
            let mut stiffness = model.stiffness.clone();
            for (panel, share) in case.panels.iter().zip(&model.shares) {
                let ratio = number(&gages, panel.label, "in") / panel.gage;
                stiffness += (change(ratio) - 1.0) * share;
            }
            let reduced = first.shapes().transpose() * stiffness * first.shapes();
            let found = solve(&reduced, &eye(modes), modes).unwrap();
            for (mode, hz) in found.frequencies_hz().iter().enumerate() {
                let printed_test = measured
                    .required(&(mode + 1).to_string(), "gvt_hz")
                    .unwrap();
                let printed = number(&frequencies, mode + 1, "hz");
                *sum += hz / printed / (test[mode] / printed_test) - 1.0;
            }
        }
    }
    sums.map(|sum| sum / 21.0)
}

/// This box, then the least and the largest of ten other ones of each size.
pub fn accumulation_table() -> Table {
    let this = added_and_multiplied(&Reconstruction::embedded().unwrap());
    let mut found = vec![("this box".to_owned(), percents(this))];
    for size in SIZES {
        let boxes = other_boxes(size.0, size.1).take(ADDED_BOXES);
        let both = boxes
            .map(|other| added_and_multiplied(&other))
            .collect_vec();
        for (end, pick) in [
            ("least", f64::min as fn(f64, f64) -> f64),
            ("largest", f64::max),
        ] {
            let ends = [0, 1].map(|of| both.iter().map(|both| both[of]).reduce(pick).unwrap());
            found.push((format!("{}: {end}", size_name(size)), percents(ends)));
        }
    }
    rows("accumulation", &["changes add", "they multiply"], found)
}
