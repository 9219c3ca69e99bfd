//! Whether changes of stiffness add or multiply in an inner loop, asked without any rule of the step: Table 11 prints gages after so many
//! iterations, Table 9 the inner loop's own frequencies there.

use super::RMS_PERCENT;
use super::detection::SIZES;
use crate::prelude::*;

/// Other boxes of each size.
pub const ADDED_BOXES: usize = 10;

/// Mean relative differences of the frequencies of a column of Table 9.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ByBoth {
    /// Analysis modes of the column.
    pub modes: usize,
    /// If changes add.
    pub added: f64,
    /// If they multiply.
    pub multiplied: f64,
    /// The same, of every frequency over that of the test, by which what is wrong with the box cancels.
    pub over_test: [f64; 2],
}

/// Frequencies at Table 11's gages by the inner loop's own frozen model, its steps alike in ratio, against Table 9's.
///
/// # Errors
/// Those of the case and of its modes.
pub fn frequencies_by_both(reconstruction: &Reconstruction) -> Result<Vec<ByBoth>, CaseError> {
    let case = Case::from_reconstruction(PUBLISHED_CASE, reconstruction.clone())?;
    let model = case.model()?.matrices(&[1.0; 15])?;
    let test = case.test_modes()?.frequencies_hz();
    let [gages, frequencies, measured] = [11, 9, 5].map(PublishedTable::number);
    let (gages, frequencies, measured) = (gages?, frequencies?, measured?);
    let of_column = |modes: usize| {
        let steps = gages.required("iterations", &format!("fem_{modes}_percent"))?;
        // In the modes that the run was given.
        let first = solve(&model.stiffness, &model.mass, modes)?;
        let by = |change: &dyn Fn(f64) -> f64| {
            let mut stiffness = model.stiffness.clone();
            for (panel, share) in case.panels.iter().zip(&model.shares) {
                let gage = gages.required(&panel.label.to_string(), &format!("fem_{modes}_in"))?;
                stiffness += (change(gage / panel.gage) - 1.0) * share;
            }
            let reduced = first.shapes().transpose() * stiffness * first.shapes();
            let found = solve(&reduced, &eye(modes), modes)?;
            let mut means = [0.0; 2];
            for (mode, hz) in found.frequencies_hz().iter().enumerate() {
                let row = (mode + 1).to_string();
                let printed = frequencies.required(&row, &format!("fem_{modes}_hz"))?;
                let ratio = hz / printed;
                let of_test = test[mode] / measured.required(&row, "gvt_hz")?;
                means[0] += (ratio - 1.0) / modes as f64;
                means[1] += (ratio / of_test - 1.0) / modes as f64;
            }
            Ok::<_, CaseError>(means)
        };
        let added = by(&|ratio| 1.0 + steps * (ratio.powf(1.0 / steps) - 1.0))?;
        let multiplied = by(&|ratio| ratio)?;
        Ok(ByBoth {
            modes,
            added: added[0],
            multiplied: multiplied[0],
            over_test: [added[1], multiplied[1]],
        })
    };
    [5, 7, 9].into_iter().map(of_column).collect()
}

/// Mean over all 21 frequencies, over those of the test: if changes add, and if they multiply.
pub fn mean_of_ratios(columns: &[ByBoth]) -> (f64, f64) {
    let count: usize = columns.iter().map(|column| column.modes).sum();
    let mean = |of: usize| {
        let parts = columns
            .iter()
            .map(|column| column.modes as f64 * column.over_test[of]);
        parts.sum::<f64>() / count as f64
    };
    (mean(0), mean(1))
}

/// This box and ten other ones, each with both means in percent, then the least and the largest of ten of each size.
///
/// # Errors
/// Those of [`frequencies_by_both`].
pub fn accumulation_table(this: &Reconstruction) -> Result<Table, CaseError> {
    let title = "Mean difference of Table 9's 21 frequencies at Table 11's gages, percent";
    let mut table =
        Table::new("accumulation", title, "Box").headings(["changes add", "they multiply"], "");
    let means =
        |other: &Reconstruction| Ok::<_, CaseError>(mean_of_ratios(&frequencies_by_both(other)?));
    let cells = |(added, multiplied): (f64, f64)| {
        [added, multiplied].map(|mean| Cell::number(100.0 * mean, RMS_PERCENT))
    };
    table.row("this box", cells(means(this)?));
    for (row, (coordinates, masses)) in SIZES.into_iter().enumerate() {
        let boxes = other_boxes(coordinates, masses).take(ADDED_BOXES);
        let found = boxes
            .map(|other| means(&other))
            .collect::<Result<Vec<_>, _>>()?;
        if row == 0 {
            for (number, both) in found.iter().enumerate() {
                table.row(format!("box {}", number + 1), cells(*both));
            }
        }
        let size = format!(
            "{:.0} %, masses {:.0} %",
            100.0 * coordinates,
            100.0 * masses
        );
        for (end, pick) in [
            ("least", f64::min as fn(f64, f64) -> f64),
            ("largest", f64::max),
        ] {
            let both = found
                .iter()
                .copied()
                .reduce(|a, b| (pick(a.0, b.0), pick(a.1, b.1)));
            table.row(
                format!("{size}: {end}"),
                both.map(cells).into_iter().flatten(),
            );
        }
    }
    Ok(table)
}
