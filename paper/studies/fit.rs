//! How well the reconstructed box reproduces the published frequencies.

use super::{percents, rows};
use crate::prelude::*;

/// Stages of the published columns; Case 3's test column is Case 2's, so it is not counted again, and the others have two passes.
const STAGES: [&str; 5] = ["gvt", "initial", "pass_1", "pass_2", "pass_3"];

/// Exact solution of the box at one published set of gages, beside the published frequencies.
#[derive(Debug, Clone)]
pub struct FitColumn {
    /// Case number.
    pub case: usize,
    /// Column of the published table: `gvt`, `initial`, `pass_1`, …
    pub stage: &'static str,
    /// Computed frequencies, ascending, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Relative differences of the computed frequencies from the published.
    pub differences: Vec<f64>,
    /// Errors beside the box's own test modes.
    pub errors: Errors,
}

/// The box solved exactly at each published set of gages: twelve columns of nine frequencies.
pub fn fit() -> Vec<FitColumn> {
    let stages = (1..=3).flat_map(|case| {
        STAGES[case / 3..4 + case / 3]
            .iter()
            .map(move |stage| (case, *stage))
    });
    let of = |(number, stage)| {
        let column = |table: usize, count: usize, unit: &str| {
            let (table, heading) = (
                PublishedTable::number(table).unwrap(),
                format!("{stage}_{unit}"),
            );
            let cell = |row: usize| table.required(&row.to_string(), &heading).unwrap();
            (1..=count).map(cell).collect_vec()
        };
        let (case, ones) = (case_of(number), [1.0; PANEL_COUNT]);
        let model = case
            .model_with(&column(2 * number + 2, PANEL_COUNT, "in"))
            .unwrap();
        let modal = model
            .analyze(&ones, &case.test_modes().unwrap(), None)
            .unwrap();
        let frequencies_hz = modal.exact().modes.frequencies_hz();
        let published = column(2 * number + 1, frequencies_hz.len(), "hz");
        let pairs = frequencies_hz.iter().zip(published);
        FitColumn {
            case: number,
            stage,
            differences: pairs
                .map(|(own, published)| own / published - 1.0)
                .collect(),
            frequencies_hz,
            errors: modal.exact().errors,
        }
    };
    stages.map(of).collect()
}

/// How far computed frequencies at published gages are from the published ones, column by column.
pub fn tables() -> Vec<Table> {
    let found = fit().into_iter().map(|of| {
        let off = &of.differences;
        let largest = off
            .iter()
            .copied()
            .max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let label = format!("Case {} {}", of.case, of.stage.replace('_', " "));
        (label, percents([rms(off), largest.unwrap()]))
    });
    vec![rows("fit", &["RMS %", "Largest %"], found)]
}
