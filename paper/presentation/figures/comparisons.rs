//! The figure of the cost of fewer modes.

use super::super::tables::fewer_modes::COSTS;
use super::matrices::{HeatMap, draw_by_twos};
use super::{Figure, numbers};
use corfem::present::PresentError;
use corfem::present::table::{Digits, counted};
use corfem::torque_box::fewer_modes::FewerModesRun;
use nalgebra::DMatrix;

/// The figure of a case with fewer modes.
///
/// # Errors
/// [`PresentError::Drawing`].
pub fn comparison_figures(
    case: usize,
    runs: &[FewerModesRun],
) -> Result<Vec<Figure>, PresentError> {
    let title = format!("Case {case}: errors with fewer modes");
    let note =
        "RMS error in percent after one pass, solved exactly; every matrix has its own scale.";
    let maps = truncation(runs);
    let costs = COSTS.map(|(.., cost)| cost);
    let of = |cost: fn(&FewerModesRun) -> f64, run: &FewerModesRun| {
        Digits::Fixed(1).write(100.0 * cost(run))
    };
    let whole = runs
        .iter()
        .max_by_key(|run| (run.test_modes, run.analysis_modes));
    let worst = runs
        .iter()
        .max_by(|a, b| costs[1](a).total_cmp(&costs[1](b)));
    let said = whole.zip(worst).map(|(whole, worst)| {
        format!(
            " With all modes the membranes are {} % off, at worst {} %, with {} and {}.",
            of(costs[1], whole),
            of(costs[1], worst),
            counted(worst.test_modes, "test mode", "test modes"),
            counted(worst.analysis_modes, "analysis mode", "analysis modes"),
        )
    });
    let caption = format!(
        "Case {case} with fewer modes: what is left of the errors after the first pass, for every number of test modes and of \
        analysis modes.{}",
        said.unwrap_or_default()
    );
    let drawn = draw_by_twos("truncation", &title, &maps, &[note])?;
    Ok(vec![Figure::drawn("truncation", caption, &drawn)])
}

/// Titles of the [`COSTS`].
const TITLES: [&str; 4] = [
    "Gages of the shear panels",
    "Gages of the membranes",
    "Frequencies of all nine test modes",
    "Shapes of all nine test modes",
];

/// Errors of runs with fewer modes, fractions, those of gages first: by test modes (rows) and analysis modes (columns)
/// from one up; nothing where no run was made.
pub fn truncation(runs: &[FewerModesRun]) -> Vec<HeatMap> {
    let most = |count: fn(&FewerModesRun) -> usize| runs.iter().map(count).max().unwrap_or(0);
    let (tests, analyses) = (most(|run| run.test_modes), most(|run| run.analysis_modes));
    let map = |(title, cost): (&str, fn(&FewerModesRun) -> f64)| {
        let mut values = DMatrix::from_element(tests, analyses, None);
        for run in runs {
            values[(run.test_modes - 1, run.analysis_modes - 1)] = Some(cost(run));
        }
        HeatMap {
            title: title.to_owned(),
            rows: ("number of test modes".to_owned(), numbers(tests)),
            columns: ("number of analysis modes".to_owned(), numbers(analyses)),
            full: values.iter().flatten().copied().fold(0.0, f64::max),
            values,
            written: (100.0, 1),
        }
    };
    TITLES
        .into_iter()
        .zip(COSTS.map(|(.., cost)| cost))
        .map(map)
        .collect()
}
