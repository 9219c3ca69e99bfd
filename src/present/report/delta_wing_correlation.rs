//! What a correlation finds of the delta wing's gages, as tables.

use super::correlation_tables::{PERCENT, RMS_PERCENT, column};
use super::delta_wing_tables::plain;
use super::table::{Cell, Digits, Row, Table};
use crate::cases::BUILT_IN;
use crate::method::inner_loop::Stop;
use crate::method::model::Check;
use crate::studies::delta_wing::correlation::{Recovered, TEST_MODES, WingCorrelation};

const TEST_HERTZ: Digits = Digits::Significant(5);
const FACTOR: Digits = Digits::Fixed(4);

/// Groups with their factors, test modes with their errors, and passes.
pub fn correlation_tables(run: &WingCorrelation) -> Vec<Table> {
    vec![group_table(run), test_mode_table(run), pass_table(run)]
}

fn group_table(run: &WingCorrelation) -> Table {
    let row = |recovered: &Recovered| Row {
        label: recovered.group.name.to_owned(),
        cells: vec![
            plain(100.0 * recovered.first_error(), PERCENT),
            plain(recovered.true_factor(), FACTOR),
            plain(recovered.factor, FACTOR),
            plain(100.0 * recovered.error(), RMS_PERCENT),
            plain(100.0 * recovered.share, RMS_PERCENT),
        ],
    };
    Table {
        name: "delta_wing_groups".to_owned(),
        title: "Delta wing with wrong gages: factors that the correlation finds".to_owned(),
        label_heading: "Group",
        columns: vec![
            column("First gage error", "%"),
            column("True factor", ""),
            column("Found", ""),
            column("Last gage error", "%"),
            column("Largest share", "%"),
        ],
        rows: run.groups.iter().map(row).collect(),
        notes: vec![
            "Coordinates in inches, x outboard from the center and y forward from the trailing edge. Largest share: of the stiffness of any test mode.".to_owned(),
        ],
    }
}

/// The exact solution at the end: of the last pass, or the initial one without any.
fn last_check(run: &WingCorrelation) -> &Check {
    let last = run.correlation.passes.last();
    last.map_or(&run.correlation.initial, |pass| &pass.check)
}

fn test_mode_table(run: &WingCorrelation) -> Table {
    let checks = [&run.correlation.initial, last_check(run)];
    let test = run.test.frequencies_hz();
    let mut rows: Vec<Row> = TEST_MODES
        .iter()
        .zip(&test)
        .enumerate()
        .map(|(row, (mode, &target))| {
            let mut cells = vec![plain(target, TEST_HERTZ)];
            for check in checks {
                let frequency = check.frequencies_hz[row];
                cells.push(plain(frequency, TEST_HERTZ));
                cells.push(plain(100.0 * (frequency / target - 1.0), RMS_PERCENT));
            }
            let label = mode.to_string();
            Row { label, cells }
        })
        .collect();
    let rms = |label: &str, values: [f64; 2]| {
        let mut cells = vec![Cell::Blank];
        for value in values {
            cells.extend([Cell::Blank, plain(100.0 * value, RMS_PERCENT)]);
        }
        let label = label.to_owned();
        Row { label, cells }
    };
    rows.push(rms(
        "frequency RMS",
        checks.map(|check| check.errors.frequency_rms()),
    ));
    rows.push(rms(
        "shape RMS",
        checks.map(|check| check.errors.shape_rms()),
    ));
    Table {
        name: "delta_wing_test_modes".to_owned(),
        title: "Delta wing with wrong gages: frequencies and errors".to_owned(),
        label_heading: "Mode",
        columns: vec![
            column("Test", "Hz"),
            column("Start", "Hz"),
            column("Start error", "%"),
            column("End", "Hz"),
            column("End error", "%"),
        ],
        rows,
        notes: solver(run).into_iter().collect(),
    }
}

/// What did the finite element analyses of the model, when it was not the crate itself.
fn solver(run: &WingCorrelation) -> Option<String> {
    (run.solver != BUILT_IN).then(|| {
        format!(
            "Finite element analyses of the model with wrong gages by {}; test modes and everything else by this program.",
            run.solver
        )
    })
}

fn pass_table(run: &WingCorrelation) -> Table {
    let rows = run
        .correlation
        .passes
        .iter()
        .enumerate()
        .map(|(row, pass)| {
            let iterations = pass.inner.iterations.len() as f64;
            let stop = match pass.inner.stop {
                Stop::Tolerance => "tolerance",
                Stop::LocalMinimum => "local minimum",
                Stop::Iterations => "iterations",
            };
            Row {
                label: (row + 1).to_string(),
                cells: vec![
                    plain(iterations, Digits::Fixed(0)),
                    Cell::Text(stop.to_owned()),
                    plain(100.0 * pass.inner.last.errors.sum(), RMS_PERCENT),
                    plain(100.0 * pass.check.errors.sum(), RMS_PERCENT),
                ],
            }
        });
    Table {
        name: "delta_wing_passes".to_owned(),
        title: "Delta wing with wrong gages: passes".to_owned(),
        label_heading: "Pass",
        columns: vec![
            column("Iterations", ""),
            column("Stopped by", ""),
            column("Error sum inner", "%"),
            column("Error sum exact", "%"),
        ],
        rows: rows.collect(),
        notes: Vec::new(),
    }
}
