//! The rest of a run's report: unlimited factors, iterations (Table 13), and the fit of the box.

use super::correlation_tables::{
    RMS_PERCENT, column, frequency_table, gage_table, number, remarks,
};
use super::table::{Cell, Digits, Row, Table};
use crate::cases::fit::Fit;
use crate::cases::published::PublishedTable;
use crate::cases::{CASES, CaseResult, Grouping};
use crate::present::error::PresentError;

const FACTOR: Digits = Digits::Fixed(1);

/// Unlimited stiffness change factors of the first iteration, and the elements they give away.
pub fn factor_table(result: &CaseResult) -> Table {
    let case = result.case.number;
    let range = result.case.settings.inner.factor_range;
    let rows = result
        .parameter_names
        .iter()
        .zip(result.unlimited_factors())
        .map(|(name, &factor)| {
            let anomalous = result
                .anomalies
                .iter()
                .any(|found| found.parameter == *name);
            // The one factor the paper quotes: about 60, for the faulty cover of Case 4.
            let published = (case == 4 && name == "8").then_some(60.0);
            let verdict = match (anomalous, range.contains(factor)) {
                (true, _) => "anomaly",
                (false, true) => "within bounds",
                (false, false) => "limited",
            };
            let factor = Cell::Number {
                computed: factor,
                published,
                digits: FACTOR,
            };
            Row {
                label: name.clone(),
                cells: vec![factor, Cell::Text(verdict.to_owned())],
            }
        })
        .collect();
    let mut notes = vec![format!(
        "Bounds of one iteration: {:.2} to {:.2}.",
        range.lower, range.upper
    )];
    for anomaly in &result.anomalies {
        notes.push(format!(
            "Anomaly: {} {} asks for {:.1} times its stiffness, far outside the bounds: look for a modeling error there.",
            parameter_word(result), anomaly.parameter, anomaly.factor
        ));
    }
    Table {
        name: format!("case_{case}_factors"),
        title: format!("Case {case}: unlimited stiffness change factors, first iteration"),
        label_heading: "Parameter",
        columns: vec![column("Factor", ""), column("Verdict", "")],
        rows,
        notes,
    }
}

/// What a parameter of a run is.
fn parameter_word(result: &CaseResult) -> &'static str {
    match result.case.grouping {
        Grouping::Elements => "element",
        Grouping::Substructures => "group",
    }
}

/// Table 13's iterations per pass (its seconds are a 1980s computer's; benches measure today's).
///
/// # Errors
/// [`Error::Table`] if the published table were damaged.
pub fn iteration_table(results: &[CaseResult]) -> Result<Table, PresentError> {
    let paper = PublishedTable::number(13)?;
    let most = results
        .iter()
        .map(|result| result.correlation.passes.len())
        .max()
        .unwrap_or(0);
    let rows = results
        .iter()
        .map(|result| {
            let label = result.case.number.to_string();
            let cells = (1..=most)
                .map(|pass| match result.correlation.passes.get(pass - 1) {
                    Some(done) => number(
                        done.inner.iterations.len() as f64,
                        Digits::Fixed(0),
                        (result.case.grouping == Grouping::Elements).then_some(&paper),
                        &label,
                        &format!("pass_{pass}_iterations"),
                    ),
                    None => Cell::Blank,
                })
                .collect();
            Row { label, cells }
        })
        .collect();
    Ok(Table {
        name: "table_13".to_owned(),
        title: "Inner loop iterations per pass (Table 13)".to_owned(),
        label_heading: "Case",
        columns: (1..=most)
            .map(|pass| column(&format!("Pass {pass}"), ""))
            .collect(),
        rows,
        notes: remarks(Some(&paper)),
    })
}

/// How well the reconstructed box reproduces the published frequencies, column by column.
pub fn fit_table(fit: &Fit) -> Table {
    let rows = fit
        .columns
        .iter()
        .map(|column| {
            let squares: f64 = column.differences().map(|d| d * d).sum();
            let largest =
                column.differences().fold(
                    0.0,
                    |worst: f64, d| if d.abs() > worst.abs() { d } else { worst },
                );
            let rms = (squares / column.frequencies_hz.len() as f64).sqrt();
            let percent = |value: f64| Cell::Number {
                computed: 100.0 * value,
                published: None,
                digits: RMS_PERCENT,
            };
            Row {
                label: format!("Case {} {}", column.case, column.column.replace('_', " ")),
                cells: vec![percent(rms), percent(largest)],
            }
        })
        .collect();
    let (case, column_name, mode) = &fit.largest_at;
    Table {
        name: "fit".to_owned(),
        title: "The reconstructed box: computed frequencies at published gages against published"
            .to_owned(),
        label_heading: "Column",
        columns: vec![column("RMS", "%"), column("Largest", "%")],
        rows,
        notes: vec![format!(
            "Over all {} frequencies: RMS {:.3} %, largest {:.2} % (Case {case} {}, mode {mode}). The paper printed neither coordinates nor masses: the box was fitted to these frequencies, so agreement with them is calibration and agreement with everything else is evidence.",
            fit.columns
                .iter()
                .map(|c| c.frequencies_hz.len())
                .sum::<usize>(),
            100.0 * fit.rms,
            100.0 * fit.largest,
            column_name.replace('_', " "),
        )],
    }
}

/// Every table of a run, in the order of the report.
///
/// # Errors
/// [`Error::Table`] if published tables were damaged.
pub fn all_tables(results: &[CaseResult], fit: &Fit) -> Result<Vec<Table>, PresentError> {
    let mut tables = Vec::new();
    for result in results {
        tables.push(frequency_table(result)?);
        tables.push(gage_table(result)?);
        if result.case.number == CASES[3] {
            tables.push(factor_table(result));
        }
    }
    tables.push(iteration_table(results)?);
    tables.push(fit_table(fit));
    Ok(tables)
}
