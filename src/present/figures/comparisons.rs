//! The figures of what is compared with the cases: steps by other formulae, fewer modes, and corrections of matrices.

use super::bars::{BarFigure, BarSeries, Bars};
use super::matrices::{HeatMap, draw_by_twos};
use super::{Figure, growth, linearization, numbers};
use crate::present::PresentError;
use crate::present::tables::fewer_modes::COSTS;
use crate::studies::linearization::{Exact, both_structures};
use crate::studies::matrix_comparison::{COVER_DOUBLER, MatrixComparison, Prediction, TRUTH};
use crate::torque_box::fewer_modes::FewerModesRun;
use nalgebra::DMatrix;

/// Figures of what is compared with the cases: steps by other formulae, fewer modes, then corrections of matrices.
pub fn comparison_figures(
    case: usize,
    runs: &[FewerModesRun],
    comparison: &MatrixComparison,
) -> Result<Vec<Figure>, PresentError> {
    let (corrected, given) = (comparison.case, comparison.test_modes);
    let title = format!("Case {case}: errors with fewer modes");
    let note = "RMS error in percent after one pass, by exact solution; each matrix has a scale of its own.";
    let truncated = draw_by_twos("truncation", &title, &truncation(runs), &[note])?;
    let title = format!("Case {corrected}: change of the dynamic stiffness, entry by entry");
    let notes = [
        "Percent of the root of the two diagonal entries before; an empty cell rounds to zero.",
        "Blue is positive, red negative.",
    ];
    let stiffness = draw_by_twos(
        "matrices_stiffness",
        &title,
        &stiffness_changes(comparison),
        &notes,
    )?;
    let title = format!("Case {corrected}: frequency errors of the corrected models");
    let frequencies = predictions(comparison).draw("matrices_frequencies", &title)?;
    let truncation_caption = format!(
        "Case {case} with fewer modes: what is left of the errors after the first pass, for every number of test modes and of \
        analysis modes."
    );
    let corrections = format!("Case {corrected} corrected with {given} test modes");
    let stiffness_caption = format!(
        "{corrections}: change of the dynamic stiffness entry by entry, the right one, by element factors, and by closed forms \
        on the matrices."
    );
    let frequency_caption = format!(
        "{corrections}: frequency errors of the box as tested and with every cover thicker, a set of gages that no correction \
        was fitted to."
    );
    let title = "Case 2 and delta wing: errors of predicted modes against the size of the step";
    let steps = linearization::draw(
        "linearization",
        title,
        &both_structures(Exact::SameCondensation)?,
    )?;
    let steps_caption = "Case 2 and delta wing: frequencies and shapes predicted for a step toward the right gages, by perturbation and by linear Taylor \
        steps, beside the exact ones of the same condensed model.";
    let caption = "Wings of 1,458 to 1,002,000 DOF: milliseconds of every stage, and the exponents of their growth.";
    Ok(vec![
        Figure::new(
            "growth",
            caption,
            growth::draw(
                "growth",
                "Wings of 1,458 to 1,002,000 DOF: time of every stage",
            )?,
        ),
        Figure::new("linearization", steps_caption, steps),
        Figure::new("truncation", truncation_caption, truncated),
        Figure::new("matrices_stiffness", stiffness_caption, stiffness),
        Figure::new("matrices_frequencies", frequency_caption, frequencies),
    ])
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

/// Changes of the stiffness, the truth's and every correction's: $\Delta K_{ij}/\sqrt{K_{ii} K_{jj}}$ with the
/// stiffness before (d × d), all on one scale, so that a pale matrix is a small change.
pub fn stiffness_changes(comparison: &MatrixComparison) -> Vec<HeatMap> {
    // The first prediction is the start, which changes nothing.
    let models = comparison.predictions.iter().skip(1);
    let entries = models
        .clone()
        .flat_map(|model| model.stiffness_change.iter().flatten());
    let full = entries.fold(0.0, |most: f64, entry| most.max(entry.abs()));
    let map = |model: &Prediction| {
        let rows = &model.stiffness_change;
        let labels = ("dynamic point".to_owned(), numbers(rows.len()));
        HeatMap {
            title: model.model.to_owned(),
            rows: labels.clone(),
            columns: labels,
            values: DMatrix::from_fn(rows.len(), rows.len(), |i, j| Some(rows[i][j])),
            full,
            written: (100.0, 0),
        }
    };
    models.map(map).collect()
}

/// Frequency errors of the start and the corrections, as tested and after the design change.
pub fn predictions(comparison: &MatrixComparison) -> BarFigure {
    let chart = |heading: &str, errors: fn(&Prediction) -> &[f64]| {
        let models = comparison.predictions.iter().filter(|p| p.model != TRUTH);
        let series = models.map(|model| BarSeries {
            name: model.model.to_owned(),
            values: errors(model)
                .iter()
                .map(|error| (100.0 * error, None))
                .collect(),
        });
        Bars {
            heading: heading.to_owned(),
            groups: numbers(comparison.as_tested_hz.len()),
            series: series.collect(),
            divided: Some((
                comparison.test_modes,
                ["test modes", "not shown to any model"],
            )),
        }
    };
    let changed = format!("Every cover {COVER_DOUBLER:.3} in thicker, untested");
    BarFigure {
        charts: vec![
            chart("As tested", |model| &model.as_tested),
            chart(&changed, |model| &model.after_change),
        ],
        across: "mode".to_owned(),
        up: "frequency error, percent".to_owned(),
        marked: String::new(),
    }
}
