//! The text that `corfem` alone prints: the paper's cases on less than a page of a terminal.

use super::tables::cases::{frequency_table, gage_table, outcome_table, published_iterations};
use super::tables::unlimited::unlimited_table;
use corfem::present::PresentError;
use corfem::present::render::{lines, text};
use corfem::present::table::{Cell, Table};
use corfem::torque_box::CaseResult;
use corfem::torque_box::wing_box::TEST_GAGE;

/// Length of the longest line, characters.
const WIDTH: usize = 80;
/// Length of a bar to either side of zero, characters.
const BAR: f64 = 10.0;
/// The case whose gages are drawn.
const DRAWN: usize = 2;

/// Root mean squares of the errors of the cases that correlate and their iterations, with the published ones in parentheses.
///
/// # Errors
/// [`PresentError::Case`] if a published table were damaged.
pub fn rms_table(results: &[CaseResult]) -> Result<Table, PresentError> {
    let title = "RMS errors, % (published)";
    let rows = [
        "frequency, start",
        "frequency, end",
        "mode shape, start",
        "mode shape, end",
        "shear panel gage, end",
        "membrane gage, end",
        "iterations per pass",
    ];
    let mut table = Table::new("rms", title, "").labels(rows);
    for result in results.iter().filter(|result| !result.is_detection()) {
        let (frequencies, gages) = (frequency_table(result)?, gage_table(result)?);
        // The errors of the start, and of the last pass.
        let ends = |table: &Table, label: &str| {
            let mut rows = table.rows.iter();
            let cells = rows.find(|row| row.label == label);
            let cells = cells.map(|row| row.cells.iter().filter(|cell| **cell != Cell::Blank));
            let cells: Vec<&Cell> = cells.into_iter().flatten().collect();
            [cells.first(), cells.last()].map(|end| end.map_or("none".to_owned(), |end| end.both()))
        };
        let [frequency, last_frequency] = ends(&frequencies, "frequency RMS");
        let [shape, last_shape] = ends(&frequencies, "shape RMS");
        let [[_, shear], [_, membrane]] =
            ["shear RMS", "membrane RMS"].map(|row| ends(&gages, row));
        let counts = result.correlation.passes.iter();
        let counts: Vec<_> = counts
            .map(|pass| pass.inner.iterations.len().to_string())
            .collect();
        let printed: Option<Vec<f64>> = published_iterations(result)?.into_iter().collect();
        let printed = printed.map(|counts| counts.iter().map(f64::to_string).collect::<Vec<_>>());
        let printed =
            printed.map_or_else(String::new, |counts| format!(" ({})", counts.join(", ")));
        let iterations = counts.join(", ") + &printed;
        let cells = [
            frequency,
            last_frequency,
            shape,
            last_shape,
            shear,
            membrane,
            iterations,
        ];
        let case = format!("Case {}", result.case.number);
        table = table.column(case, "", cells.map(Cell::text));
    }
    Ok(table)
}

/// The panels' gage errors as bars, two panels a line: of the first model, and over them of the last.
fn bars(result: &CaseResult) -> Vec<String> {
    let last = result.pass_gages.last().cloned();
    let gages = result.case.first_gages().into_iter();
    let errors = gages.zip(last.unwrap_or_else(|| result.case.first_gages()));
    let errors = errors.map(|(first, last)| [first, last].map(|gage| gage / TEST_GAGE - 1.0));
    let errors: Vec<[f64; 2]> = errors.collect();
    let most = errors
        .iter()
        .flatten()
        .fold(f64::MIN_POSITIVE, |most, error| most.max(error.abs()));
    let panel = |(label, [first, last]): (&String, &[f64; 2])| {
        let covers = |error: f64, at: f64| {
            at * error > 0.0 && at.abs() <= (BAR * error.abs() / most).round()
        };
        let mark = |at: i32| match f64::from(at) {
            0.0 => '│',
            at if covers(*last, at) => '█',
            at if covers(*first, at) => '░',
            _ => ' ',
        };
        let bar: String = (-BAR as i32..=BAR as i32).map(mark).collect();
        format!("{label:>2} {:>+6.1} {bar}", 100.0 * last)
    };
    let labels = result
        .case
        .panels
        .iter()
        .map(|panel| panel.label.to_string())
        .collect::<Vec<_>>();
    let panels: Vec<String> = labels.iter().zip(&errors).map(panel).collect();
    let (left, right) = panels.split_at(panels.len().div_ceil(2));
    let line = |(row, left): (usize, &String)| {
        let right = right.get(row).map_or("", String::as_str);
        format!("{left}       {right}").trim_end().to_owned()
    };
    left.iter().enumerate().map(line).collect()
}

/// The outcome of every case, the RMS errors beside the published ones, the finding of Case 4, and the gages of Case 2.
///
/// # Errors
/// [`PresentError::Case`] if a published table were damaged, as in [`rms_table`].
pub fn overview(results: &[CaseResult]) -> Result<String, PresentError> {
    let outcome = Table {
        notes: Vec::new(),
        ..outcome_table(results)
    };
    let mut out = text(&[outcome, rms_table(results)?]);
    for result in results.iter().filter(|result| result.is_detection()) {
        let found = unlimited_table(result).notes;
        let words = found.iter().find_map(|note| note.strip_prefix("Anomaly: "));
        let words = words.unwrap_or("no modeling error was detected.");
        let words = format!("Case {}: {words}", result.case.number);
        out += &format!("\n{}\n", lines(words.split(' '), WIDTH).join("\n"));
    }
    for result in results.iter().filter(|result| result.case.number == DRAWN) {
        let title = format!(
            "Case {DRAWN}, errors of panel gages, %: ░ at the start, █ and number at the end"
        );
        out += &format!("\n{title}\n{}\n", bars(result).join("\n"));
    }
    let rest = "
corfem cases --all               every frequency, gage and setting of the cases
corfem tables                    Table 1 computed anew, and the paper's others
corfem report -o report.html     the page with all of it, and figures
corfem init --example wing DIR   a structure of your own to begin with
";
    Ok(out + rest)
}
