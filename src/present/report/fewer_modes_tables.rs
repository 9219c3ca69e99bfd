//! Tables 9 to 12: one pass with fewer modes, each number beside the published one.

use super::correlation_tables::{
    HERTZ, INCHES, PERCENT, RMS_PERCENT, column, kind_letter, number, remarks,
};
use super::table::{Cell, Row, Table};
use super::truncation_tables::{iteration_table, truncation_tables};
use crate::cases::Case;
use crate::cases::fewer_modes::{Agreement, FewerModesRun};
use crate::cases::published::PublishedTable;
use crate::cases::torque_box::TEST_GAGE;
use crate::present::error::PresentError;

/// The paper's frequencies with fewer modes are those of five test modes.
const TABLE_9_TEST_MODES: usize = 5;
/// The paper's tables of gages: number, and test modes.
pub(super) const GAGE_TABLES: [(usize, usize); 3] = [(10, 7), (11, 5), (12, 3)];

/// RMS errors: title, row of the published tables, and the number.
type RmsRow = (&'static str, &'static str, fn(&Agreement) -> f64);
const RMS_ROWS: [RmsRow; 2] = [
    ("frequency RMS", "frequency_rms", |found| {
        found.frequency_rms
    }),
    ("shape RMS", "shape_rms", |found| found.shape_rms),
];

/// Tables 9 to 12 and the iterations from the paper's runs, then the truncation tables from all runs.
///
/// # Errors
/// [`Error::Table`] if published tables were damaged.
pub fn fewer_modes_tables(
    case: &Case,
    published: &[FewerModesRun],
    all: &[FewerModesRun],
) -> Result<Vec<Table>, PresentError> {
    let five = with_test_modes(published, TABLE_9_TEST_MODES);
    let mut tables = vec![inner_frequency_table(&five)?, exact_frequency_table(&five)];
    for (paper, test_modes) in GAGE_TABLES {
        let runs = with_test_modes(published, test_modes);
        tables.push(gage_table(case, paper, test_modes, &runs)?);
    }
    tables.push(iteration_table(published)?);
    tables.extend(truncation_tables(all));
    Ok(tables)
}

fn with_test_modes(runs: &[FewerModesRun], test_modes: usize) -> Vec<&FewerModesRun> {
    let like = |run: &&FewerModesRun| run.test_modes == test_modes;
    runs.iter().filter(like).collect()
}

/// Table 9: the inner loop's own frequencies, as the paper prints them.
fn inner_frequency_table(runs: &[&FewerModesRun]) -> Result<Table, PresentError> {
    let paper = PublishedTable::number(9)?;
    let note = "The inner loop's own modes: by perturbation of the analysis modes it was given, with the transformation B it began with. What the paper prints is read as these.";
    Ok(Table {
        name: "table_9".to_owned(),
        title: frequency_title("frequencies and errors by the inner loop (Table 9)"),
        notes: std::iter::once(note.to_owned())
            .chain(remarks(Some(&paper)))
            .collect(),
        ..frequency_table(runs, Some(&paper), |run| &run.inner)
    })
}

/// The same at the gages the inner loop found, by eigensolution.
fn exact_frequency_table(runs: &[&FewerModesRun]) -> Table {
    Table {
        name: "table_9_exact".to_owned(),
        title: frequency_title("frequencies and errors by eigensolution at the gages found"),
        ..frequency_table(runs, None, |run| &run.exact)
    }
}

fn frequency_title(what: &str) -> String {
    format!("Case 2, pass 1, {TABLE_9_TEST_MODES} test modes: {what}")
}

/// Frequencies and their errors at the start and at the end of every run; the caller names the table.
fn frequency_table(
    runs: &[&FewerModesRun],
    paper: Option<&PublishedTable>,
    end: fn(&FewerModesRun) -> &Agreement,
) -> Table {
    // The run with the most analysis modes knows the most initial frequencies.
    let most = runs.iter().max_by_key(|run| run.analysis_modes);
    let test = most.map_or(&[][..], |run| &run.test_frequencies_hz);
    let mut stages: Vec<(String, &Agreement)> = most
        .map(|run| ("initial".to_owned(), &run.initial))
        .into_iter()
        .collect();
    stages.extend(
        runs.iter()
            .map(|run| (format!("fem_{}", run.analysis_modes), end(run))),
    );
    let mut columns = vec![column("GVT", "Hz")];
    for (prefix, _) in &stages {
        let title = stage_title(prefix);
        columns.push(column(&title, "Hz"));
        columns.push(column(&format!("{title} error"), "%"));
    }
    let mut rows = Vec::new();
    for mode in 0..most.map_or(0, |run| run.initial.frequencies_hz.len()) {
        let label = (mode + 1).to_string();
        let cell = |value: Option<f64>, digits, heading: &str| {
            value.map_or(Cell::Blank, |value| {
                number(value, digits, paper, &label, heading)
            })
        };
        let target = test.get(mode).copied();
        let mut cells = vec![cell(target, HERTZ, "gvt_hz")];
        for (prefix, stage) in &stages {
            let found = stage.frequencies_hz.get(mode).copied();
            let error = found.zip(target).map(|(f, t)| 100.0 * (f / t - 1.0));
            cells.push(cell(found, HERTZ, &format!("{prefix}_hz")));
            cells.push(cell(error, PERCENT, &format!("{prefix}_percent")));
        }
        rows.push(Row { label, cells });
    }
    for (title, row, rms) in RMS_ROWS {
        let mut cells = vec![Cell::Blank];
        for (prefix, stage) in &stages {
            let heading = format!("{prefix}_percent");
            cells.push(Cell::Blank);
            cells.push(number(
                100.0 * rms(stage),
                RMS_PERCENT,
                paper,
                row,
                &heading,
            ));
        }
        rows.push(Row {
            label: title.to_owned(),
            cells,
        });
    }
    Table {
        name: String::new(),
        title: String::new(),
        label_heading: "Mode",
        columns,
        rows,
        notes: Vec::new(),
    }
}

/// `initial` and `fem_5` as a reader's headings.
fn stage_title(prefix: &str) -> String {
    match prefix.strip_prefix("fem_") {
        Some(count) => format!("FEM {count}"),
        None => "Initial".to_owned(),
    }
}

/// Tables 10, 11, 12: gages and their errors, and RMS errors of gages, frequencies and shapes.
fn gage_table(
    case: &Case,
    paper: usize,
    test_modes: usize,
    runs: &[&FewerModesRun],
) -> Result<Table, PresentError> {
    let paper = PublishedTable::number(paper)?;
    let first = case.first_gages();
    let mut stages = vec![("initial".to_owned(), &first)];
    stages.extend(
        runs.iter()
            .map(|run| (format!("fem_{}", run.analysis_modes), &run.gages_in)),
    );
    let mut columns = vec![column("Type", ""), column("GVT", "in")];
    for (prefix, _) in &stages {
        let title = stage_title(prefix);
        columns.push(column(&title, "in"));
        columns.push(column(&format!("{title} error"), "%"));
    }
    let mut rows = Vec::new();
    for (e, panel) in case.panels.iter().enumerate() {
        let label = panel.label.to_string();
        let cell =
            |value, digits, heading: &str| number(value, digits, Some(&paper), &label, heading);
        let mut cells = vec![
            Cell::Text(kind_letter(panel.kind).to_owned()),
            cell(TEST_GAGE, INCHES, "gvt_in"),
        ];
        for (prefix, gages) in &stages {
            let percent = 100.0 * (gages[e] / TEST_GAGE - 1.0);
            cells.push(cell(gages[e], INCHES, &format!("{prefix}_in")));
            cells.push(cell(percent, PERCENT, &format!("{prefix}_percent")));
        }
        rows.push(Row { label, cells });
    }
    let blanks = columns.len() - 2 * runs.len();
    let rms_row = |title: &str, row, paper, digits, value: &dyn Fn(&FewerModesRun) -> f64| {
        let mut cells = vec![Cell::Blank; blanks];
        for run in runs {
            let heading = format!("fem_{}_percent", run.analysis_modes);
            cells.push(Cell::Blank);
            cells.push(number(100.0 * value(run), digits, paper, row, &heading));
        }
        Row {
            label: title.to_owned(),
            cells,
        }
    };
    let printed = Some(&paper);
    rows.push(rms_row(
        "shear RMS",
        "shear_rms",
        printed,
        PERCENT,
        &|run| run.shear_gage_rms,
    ));
    rows.push(rms_row(
        "membrane RMS",
        "membrane_rms",
        printed,
        PERCENT,
        &|run| run.membrane_gage_rms,
    ));
    for (title, row, rms) in RMS_ROWS {
        let (inner, exact) = (format!("inner {title}"), format!("exact {title}"));
        rows.push(rms_row(&inner, row, printed, RMS_PERCENT, &|run| {
            rms(&run.inner)
        }));
        rows.push(rms_row(&exact, row, None, RMS_PERCENT, &|run| {
            rms(&run.exact)
        }));
    }
    let number = paper.number;
    Ok(Table {
        name: format!("table_{number}"),
        title: format!(
            "Case 2, pass 1, {test_modes} test modes: gages and errors (Table {number})"
        ),
        label_heading: "Element",
        columns,
        rows,
        notes: std::iter::once("S shear panel, M membrane.".to_owned())
            .chain(remarks(Some(&paper)))
            .collect(),
    })
}
