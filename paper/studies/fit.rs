//! How well the reconstructed box reproduces the published frequencies.

use super::RMS_PERCENT;
use crate::prelude::*;

/// The published columns: case, table of frequencies, table of gages, column prefixes.
///
/// Case 3's test column is Case 2's, so it is not counted again.
const COLUMNS: [(usize, usize, usize, [&str; 4]); 3] = [
    (1, 3, 4, ["gvt", "initial", "pass_1", "pass_2"]),
    (2, 5, 6, ["gvt", "initial", "pass_1", "pass_2"]),
    (3, 7, 8, ["initial", "pass_1", "pass_2", "pass_3"]),
];

/// Exact solution of the box at one published set of gages, beside the published frequencies.
#[derive(Debug, Clone)]
pub struct FitColumn {
    /// Case number.
    pub case: usize,
    /// Column of the published table: `gvt`, `initial`, `pass_1`, …
    pub column: String,
    /// Computed frequencies, ascending, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Published frequencies, Hz.
    pub published_hz: Vec<f64>,
    /// Computed RMS frequency error against the box's own test modes, a fraction.
    pub frequency_rms: f64,
    /// Computed RMS shape error against the box's own test modes, a fraction.
    pub shape_rms: f64,
}

impl FitColumn {
    /// Relative differences of the computed frequencies from the published.
    pub fn differences(&self) -> impl Iterator<Item = f64> + '_ {
        self.frequencies_hz
            .iter()
            .zip(&self.published_hz)
            .map(|(computed, published)| computed / published - 1.0)
    }
}

/// The fit over all published frequencies at published gages.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The twelve columns of nine frequencies.
    pub columns: Vec<FitColumn>,
    /// Root mean square of the relative differences.
    pub rms: f64,
    /// Largest relative difference, in magnitude.
    pub largest: f64,
    /// Case, column and mode of the largest.
    pub largest_at: (usize, String, usize),
}

/// Solves the box exactly at each published set of gages and compares the frequencies.
///
/// # Errors
/// Those of the model and its analysis; [`CaseError::Table`] for damaged tables.
pub fn fit(reconstruction: &Reconstruction) -> Result<Fit, CaseError> {
    let mut columns = Vec::new();
    for (number, frequency_table, gage_table, prefixes) in COLUMNS {
        let (frequencies, gages) = (
            PublishedTable::number(frequency_table)?,
            PublishedTable::number(gage_table)?,
        );
        let case = Case::from_reconstruction(number, reconstruction.clone())?;
        let test = case.test_modes()?;
        for prefix in prefixes {
            let rows = |table: &PublishedTable, count: usize, unit: &str| {
                let heading = format!("{prefix}_{unit}");
                (1..=count)
                    .map(|row| table.required(&row.to_string(), &heading))
                    .collect::<Result<Vec<_>, _>>()
            };
            let model = case.model_with(&rows(&gages, PANEL_COUNT, "in")?)?;
            let model = model.analyze(&vec![1.0; model.parameters().len()], &test, None)?;
            let solution = model.exact();
            columns.push(FitColumn {
                case: number,
                column: prefix.to_owned(),
                frequencies_hz: solution.modes.frequencies_hz(),
                published_hz: rows(&frequencies, test.len(), "hz")?,
                frequency_rms: solution.errors.frequency_rms(),
                shape_rms: solution.errors.shape_rms(),
            });
        }
    }
    let at = |column: &FitColumn, mode| (column.case, column.column.clone(), mode + 1);
    let of = |column| {
        FitColumn::differences(column)
            .enumerate()
            .map(move |(mode, off)| (off.abs(), at(column, mode)))
    };
    let all = columns.iter().flat_map(of).collect_vec();
    let rms = rms(&all.iter().map(|(off, _)| *off).collect_vec());
    let (largest, largest_at) = all
        .into_iter()
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or_default();
    Ok(Fit {
        columns,
        rms,
        largest,
        largest_at,
    })
}

/// How well the reconstructed box reproduces the published frequencies, column by column.
pub fn fit_table(fit: &Fit) -> Table {
    let (case, stage, mode) = &fit.largest_at;
    let count: usize = fit.columns.iter().map(|c| c.frequencies_hz.len()).sum();
    let note = format!(
        "Over all {count} frequencies: RMS {:.3} %, largest {:.2} % (Case {case} {}, mode {mode}). The paper printed neither \
        coordinates nor masses: the box was fitted to these frequencies, so agreement with them is calibration and agreement \
        with everything else is evidence.",
        100.0 * fit.rms,
        100.0 * fit.largest,
        stage.replace('_', " "),
    );
    let title = "The reconstructed box: computed frequencies at published gages against published";
    let mut table = Table::new("fit", title, "Column")
        .headings(["RMS", "Largest"], "%")
        .notes([note]);
    for column in &fit.columns {
        let differences = column.differences().collect_vec();
        let largest = differences
            .iter()
            .copied()
            .max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let label = format!("Case {} {}", column.case, column.column.replace('_', " "));
        table.row(
            label,
            percents([Some(rms(&differences)), largest], RMS_PERCENT),
        );
    }
    table
}
