//! The paper's Tables 3 to 8 from a run: frequencies and gages, each number beside the published one.

use super::table::{Cell, Column, Digits, Row, Table};
use crate::cases::published::PublishedTable;
use crate::cases::torque_box::TEST_GAGE;
use crate::cases::{BUILT_IN, CaseResult, Grouping};
use crate::method::error_sum::Errors;
use crate::method::structure::ElementKind;
use crate::present::error::PresentError;

pub(super) const HERTZ: Digits = Digits::Significant(4);
pub(super) const INCHES: Digits = Digits::Fixed(5);
pub(super) const PERCENT: Digits = Digits::Fixed(1);
pub(super) const RMS_PERCENT: Digits = Digits::Fixed(2);

/// The stages of a run as the tables name them: `initial`, `pass_1`, …
fn stages(result: &CaseResult) -> Vec<(String, String)> {
    let passes = 1..=result.correlation.passes.len();
    std::iter::once(("initial".to_owned(), "Initial".to_owned()))
        .chain(passes.map(|pass| (format!("pass_{pass}"), format!("Pass {pass}"))))
        .collect()
}

/// The published table to stand beside a run's, if the paper made that run: by single elements.
fn published(
    numbers: [usize; 3],
    result: &CaseResult,
) -> Result<Option<PublishedTable>, PresentError> {
    match (numbers.get(result.case.number - 1), result.case.grouping) {
        (Some(&number), Grouping::Elements) => Ok(Some(PublishedTable::number(number)?)),
        _ => Ok(None),
    }
}

pub(super) fn number(
    computed: f64,
    digits: Digits,
    table: Option<&PublishedTable>,
    row: &str,
    heading: &str,
) -> Cell {
    Cell::Number {
        computed,
        published: table.and_then(|table| table.value(row, heading)),
        digits,
    }
}

/// Tables 3, 5, 7 (and the like for Case 4): frequencies and their percent errors, and the RMS errors.
///
/// Rows are the test modes; frequencies of the paired analysis modes, exact solutions all.
///
/// # Errors
/// [`Error::Table`] if the published table were damaged.
pub fn frequency_table(result: &CaseResult) -> Result<Table, PresentError> {
    let case = result.case.number;
    let paper = published([3, 5, 7], result)?;
    let stages = stages(result);
    let checks: Vec<_> = std::iter::once(&result.correlation.initial)
        .chain(result.correlation.passes.iter().map(|pass| &pass.check))
        .collect();
    let mut columns = vec![column("GVT", "Hz")];
    for (_, title) in &stages {
        columns.push(column(title, "Hz"));
        columns.push(column(&format!("{title} error"), "%"));
    }
    let test = result.test.frequencies_hz();
    let mut rows = Vec::new();
    for (mode, &target) in test.iter().enumerate() {
        let label = (mode + 1).to_string();
        let cell =
            |value, digits, heading: &str| number(value, digits, paper.as_ref(), &label, heading);
        let mut cells = vec![cell(target, HERTZ, "gvt_hz")];
        for ((prefix, _), check) in stages.iter().zip(&checks) {
            let frequency = check.frequencies_hz[mode];
            cells.push(cell(frequency, HERTZ, &format!("{prefix}_hz")));
            cells.push(cell(
                100.0 * (frequency / target - 1.0),
                PERCENT,
                &format!("{prefix}_percent"),
            ));
        }
        rows.push(Row { label, cells });
    }
    type Rms = fn(&Errors) -> f64;
    for (label, row, rms) in [
        (
            "frequency RMS",
            "frequency_rms",
            Errors::frequency_rms as Rms,
        ),
        ("shape RMS", "shape_rms", Errors::shape_rms as Rms),
    ] {
        let mut cells = vec![Cell::Blank];
        for ((prefix, _), check) in stages.iter().zip(&checks) {
            let heading = format!("{prefix}_percent");
            cells.push(Cell::Blank);
            cells.push(number(
                100.0 * rms(&check.errors),
                RMS_PERCENT,
                paper.as_ref(),
                row,
                &heading,
            ));
        }
        rows.push(Row {
            label: label.to_owned(),
            cells,
        });
    }
    Ok(Table {
        name: table_name(paper.as_ref(), case, "frequencies"),
        title: format!(
            "Case {case}: frequencies and errors{}",
            numbered(paper.as_ref())
        ),
        label_heading: "Mode",
        columns,
        rows,
        notes: solver(result)
            .into_iter()
            .chain(remarks(paper.as_ref()))
            .collect(),
    })
}

/// What did the finite element analyses, when it was not the crate itself.
fn solver(result: &CaseResult) -> Option<String> {
    (result.solver != BUILT_IN).then(|| {
        format!(
            "Finite element analyses by {}, of the test configuration too; everything else by this program.",
            result.solver
        )
    })
}

/// What the paper's print of a table gets wrong.
pub(super) fn remarks(paper: Option<&PublishedTable>) -> Vec<String> {
    paper.map_or_else(Vec::new, |table| {
        let remark = |text: &String| format!("The print: {text}");
        table.remarks.iter().map(remark).collect()
    })
}

/// Tables 4, 6, 8 (and the like for Case 4): gages and their percent errors, RMS per kind of element.
///
/// # Errors
/// [`Error::Table`] if the published table were damaged.
pub fn gage_table(result: &CaseResult) -> Result<Table, PresentError> {
    let case = result.case.number;
    let paper = published([4, 6, 8], result)?;
    let stages = stages(result);
    let gages: Vec<Vec<f64>> = std::iter::once(result.case.first_gages())
        .chain(result.pass_gages.iter().cloned())
        .collect();
    let percent = |gage: f64| 100.0 * (gage / TEST_GAGE - 1.0);
    let mut columns = vec![column("Type", ""), column("GVT", "in")];
    for (_, title) in &stages {
        columns.push(column(title, "in"));
        columns.push(column(&format!("{title} error"), "%"));
    }
    let mut rows = Vec::new();
    for (e, panel) in result.case.panels.iter().enumerate() {
        let label = panel.label.to_string();
        let cell =
            |value, digits, heading: &str| number(value, digits, paper.as_ref(), &label, heading);
        let mut cells = vec![
            Cell::Text(kind_letter(panel.kind).to_owned()),
            cell(TEST_GAGE, INCHES, "gvt_in"),
        ];
        for ((prefix, _), gages) in stages.iter().zip(&gages) {
            cells.push(cell(gages[e], INCHES, &format!("{prefix}_in")));
            cells.push(cell(
                percent(gages[e]),
                PERCENT,
                &format!("{prefix}_percent"),
            ));
        }
        rows.push(Row { label, cells });
    }
    for (label, row, kind) in [
        ("shear RMS", "shear_rms", ElementKind::ShearPanel),
        ("membrane RMS", "membrane_rms", ElementKind::Membrane),
    ] {
        if !result.case.panels.iter().any(|panel| panel.kind == kind) {
            continue;
        }
        let mut cells = vec![Cell::Blank, Cell::Blank];
        for ((prefix, _), gages) in stages.iter().zip(&gages) {
            let heading = format!("{prefix}_percent");
            cells.push(Cell::Blank);
            let rms = gage_rms(result, gages, kind);
            cells.push(number(100.0 * rms, PERCENT, paper.as_ref(), row, &heading));
        }
        rows.push(Row {
            label: label.to_owned(),
            cells,
        });
    }
    Ok(Table {
        name: table_name(paper.as_ref(), case, "gages"),
        title: format!("Case {case}: gages and errors{}", numbered(paper.as_ref())),
        label_heading: "Element",
        columns,
        rows,
        notes: std::iter::once("S shear panel, M membrane.".to_owned())
            .chain(remarks(paper.as_ref()))
            .collect(),
    })
}

/// RMS relative gage error of one kind of panel.
pub fn gage_rms(result: &CaseResult, gages: &[f64], kind: ElementKind) -> f64 {
    crate::cases::torque_box::gage_rms(&result.case.panels, gages, kind)
}

pub(super) fn column(name: &str, unit: &'static str) -> Column {
    Column {
        name: name.to_owned(),
        unit,
    }
}

fn table_name(paper: Option<&PublishedTable>, case: usize, otherwise: &str) -> String {
    paper.map_or_else(
        || format!("case_{case}_{otherwise}"),
        |table| format!("table_{}", table.number),
    )
}

fn numbered(paper: Option<&PublishedTable>) -> String {
    paper.map_or_else(String::new, |table| format!(" (Table {})", table.number))
}

pub(super) fn kind_letter(kind: ElementKind) -> &'static str {
    match kind {
        ElementKind::Rod => "R",
        ElementKind::ShearPanel => "S",
        ElementKind::Membrane => "M",
        ElementKind::Triangle => "T",
    }
}
