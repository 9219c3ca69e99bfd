//! The paper's Tables 3 to 8 and 13 from runs of its cases, each number beside the published one.

use super::super::words::case_in_words;
use super::stages::{self, ErrorStage};
use super::unlimited::unlimited_table;
use super::{MODE_ERRORS, PERCENT, RMS_PERCENT, remarks};
use corfem::method::analysis::State;
use corfem::method::error_sum::Errors;
use corfem::method::structure::ElementKind;
use corfem::present::PresentError;
use corfem::present::table::{Cell, Digits, Table, numbers, percents};
use corfem::torque_box::published::PublishedTable;
use corfem::torque_box::wing_box::gage_rms;
use corfem::torque_box::{CASES, CaseResult, Grouping};
use corfem::weighted::comparison::ExactResult;

/// The published table of a run, if the paper made that run: by single elements.
fn published(
    numbers: [usize; 3],
    result: &CaseResult,
) -> Result<Option<PublishedTable>, PresentError> {
    match (numbers.get(result.case.number - 1), result.case.grouping) {
        (Some(&number), Grouping::Elements) => Ok(Some(PublishedTable::number(number)?)),
        _ => Ok(None),
    }
}

/// An empty table of a case, named by the paper's number if it has one.
fn named(
    result: &CaseResult,
    paper: Option<&PublishedTable>,
    what: &str,
    label: &'static str,
) -> Table {
    let case = result.case.number;
    let (name, of_paper) = match paper.map(|table| table.number) {
        Some(number) => (format!("table_{number}"), format!(" (Table {number})")),
        None => (format!("case_{case}_{what}"), String::new()),
    };
    Table::new(
        name,
        format!("Case {case}: {what} and errors{of_paper}"),
        label,
    )
}

/// Tables 3, 5, 7 (and the like for Case 4): frequencies and their percent errors, and the RMS errors.
///
/// # Errors
/// [`PresentError::Case`] if the published table were damaged, as for all tables of this module.
pub fn frequency_table(result: &CaseResult) -> Result<Table, PresentError> {
    let (paper, run) = (published([3, 5, 7], result)?, &result.correlation);
    let checks = std::iter::once(&run.initial)
        .chain(run.passes.iter().map(|pass| &pass.check))
        .enumerate();
    let stage = |(pass, check): (usize, &State)| {
        let check = ExactResult::from(check);
        ErrorStage::new(
            "pass",
            pass,
            &check.frequencies_hz,
            &[check.errors.frequency_rms(), check.errors.shape_rms()],
        )
    };
    let table = named(result, paper.as_ref(), "frequencies", "Mode");
    let (test_hz, stages) = (
        result.test.frequencies_hz(),
        checks.map(stage).collect::<Vec<_>>(),
    );
    Ok(stages::fill(
        table,
        &[],
        &test_hz,
        &stages,
        &MODE_ERRORS,
        paper.as_ref(),
    ))
}

/// Tables 4, 6, 8 (and the like for Case 4): gages and their percent errors, RMS per kind of element.
pub fn gage_table(result: &CaseResult) -> Result<Table, PresentError> {
    let (paper, panels) = (published([4, 6, 8], result)?, &result.case.panels);
    let kinds = [
        ("shear RMS", ElementKind::ShearPanel),
        ("membrane RMS", ElementKind::Membrane),
    ];
    let kinds = kinds
        .into_iter()
        .filter(|(_, kind)| panels.iter().any(|panel| panel.kind == *kind));
    let (errors, kinds): (Vec<_>, Vec<_>) =
        kinds.map(|(label, kind)| ((label, PERCENT), kind)).unzip();
    let gages = std::iter::once(result.case.first_gages())
        .chain(result.pass_gages.iter().cloned())
        .enumerate();
    let rms = |gages: &[f64]| {
        kinds
            .iter()
            .map(|&kind| gage_rms(panels, gages, kind))
            .collect::<Vec<_>>()
    };
    let stages: Vec<ErrorStage> = gages
        .map(|(pass, gages)| ErrorStage::new("pass", pass, &gages, &rms(&gages)))
        .collect();
    let table = named(result, paper.as_ref(), "gages", "Element");
    Ok(stages::fill(
        table,
        panels,
        &[],
        &stages,
        &errors,
        paper.as_ref(),
    ))
}

/// The paper's iterations for every pass of a run, where it made that run (Table 13).
pub fn published_iterations(result: &CaseResult) -> Result<Vec<Option<f64>>, PresentError> {
    let paper = PublishedTable::number(13)?;
    let (row, is_papers) = (
        result.case.number.to_string(),
        result.case.grouping == Grouping::Elements,
    );
    let printed = |pass: usize| {
        paper
            .value(&row, &format!("pass_{pass}_iterations"))
            .filter(|_| is_papers)
    };
    Ok((1..=result.correlation.passes.len()).map(printed).collect())
}

/// The last exact solution.
fn last(result: &CaseResult) -> &State {
    let run = &result.correlation;
    run.passes.last().map_or(&run.initial, |pass| &pass.check)
}

/// Iterations of every pass.
fn iterations(result: &CaseResult) -> impl Iterator<Item = usize> {
    result
        .correlation
        .passes
        .iter()
        .map(|pass| pass.inner.iterations.len())
}

/// Table 13's iterations per pass (its seconds are a 1980s computer's; benches measure today's).
pub fn iteration_table(results: &[CaseResult]) -> Result<Table, PresentError> {
    let most = results
        .iter()
        .map(|result| result.correlation.passes.len())
        .max()
        .unwrap_or(0);
    let title = "Inner loop iterations per pass (Table 13)";
    let mut table = Table::new("table_13", title, "Case")
        .headings((1..=most).map(|pass| format!("Pass {pass}")), "");
    for result in results {
        let counts = iterations(result)
            .map(|count| count as f64)
            .zip(published_iterations(result)?);
        let cells = counts.map(|(count, printed)| Cell::beside(count, Digits::Fixed(0), printed));
        table.row(result.case.number, cells);
    }
    Ok(table.notes(remarks(Some(&PublishedTable::number(13)?))))
}

/// The settings that each case was run with.
pub fn settings_table(results: &[CaseResult]) -> Table {
    let mut table = Table::new("settings", "Settings of the loops", "Case")
        .headings(
            [
                "Step",
                "R",
                "Limits",
                "TOLI",
                "TOLO",
                "Iterations",
                "Passes",
            ],
            "",
        )
        .notes(["R and TOLI: first, and after. Iterations and passes: at most."]);
    for CaseResult { case, .. } in results {
        let (settings, inner) = (&case.settings, &case.settings.inner);
        let words = [
            inner.step.name().to_owned(),
            format!("{} {}", inner.first_relaxation, inner.relaxation),
            format!("{} {}", inner.factor_range.lower, inner.factor_range.upper),
            format!("{} {}", inner.tolerance, settings.later_inner_tolerance),
            settings.error_sum_tolerance.to_string(),
            inner.iterations.to_string(),
            settings.most_passes.to_string(),
        ];
        table.row(case.number, words.map(Cell::text));
    }
    table
}

/// The outcome of every case, one line each.
pub fn outcome_table(results: &[CaseResult]) -> Table {
    let note = "Correlated: the exact error sum is within the tolerance TOLO. Case 4 as published is one iteration that is to \
        detect a modeling error; its gages are not corrected.";
    let verdict = |result: &CaseResult| {
        (!result.is_detection())
            .then(|| format!("Case {}: {}", result.case.number, case_in_words(result)))
    };
    let sums = |of: fn(&CaseResult) -> f64| numbers(results.iter().map(of), Digits::Fixed(4));
    Table::new("outcome", "What became of every case", "Case")
        .labels(results.iter().map(|result| result.case.number))
        .column(
            "Passes",
            "",
            results
                .iter()
                .map(|result| Cell::count(result.correlation.passes.len())),
        )
        .column("Error sum", "", sums(|result| last(result).errors.sum()))
        .column(
            "Tolerance",
            "",
            sums(|result| result.case.settings.error_sum_tolerance),
        )
        .column(
            "Outcome",
            "",
            results.iter().map(|result| Cell::text(outcome(result))),
        )
        .notes([note])
        .notes(results.iter().filter_map(verdict))
}

/// Errors of the fifteen gages where the loop of a correlated case ended, and after one weighted step from there; none by
/// substructures.
pub fn next_step_table(result: &CaseResult) -> Option<Table> {
    let (next, errors) = (result.next_step.as_ref()?, result.gage_errors()?);
    let case = result.case.number;
    let title = format!("Case {case}: gage errors at the end, and after one weighted step");
    let column = |stage: usize| percents(errors.iter().map(move |error| error[stage]), PERCENT);
    Some(
        Table::new(format!("case_{case}_next_step"), title, "Element")
            .labels(&result.parameter_names)
            .column("Error at the end", "%", column(0))
            .column("Error after the step", "%", column(1))
            .column(
                "Deviation",
                "%",
                percents(next.seen.deviations.iter().copied(), PERCENT),
            )
            .notes(["The step is linear and keeps no bounds. Deviations are those of the gages' logarithms, before the test 100 %."]),
    )
}

/// Every table of a run, in the order of the report.
pub fn all_tables(results: &[CaseResult]) -> Result<Vec<Table>, PresentError> {
    let mut tables = vec![outcome_table(results)];
    for result in results {
        tables.extend(tables_of(result)?);
    }
    tables.extend([iteration_table(results)?, settings_table(results)]);
    Ok(tables)
}

/// The tables of one case: frequencies, gages, and these after one weighted step; in Case 4 also what its single iteration asks for.
pub fn tables_of(result: &CaseResult) -> Result<Vec<Table>, PresentError> {
    let mut tables = vec![frequency_table(result)?, gage_table(result)?];
    tables.extend(next_step_table(result));
    if result.case.number == CASES[3] {
        tables.push(unlimited_table(result));
    }
    Ok(tables)
}

/// First and last RMS errors and the iterations of every case, with the published ones.
pub fn summary(results: &[CaseResult]) -> Result<Table, PresentError> {
    let title = "RMS errors over nine modes, first and last model";
    let mut table = Table::new("summary", title, "Case")
        .headings(
            [
                "Frequency, first",
                "Frequency, last",
                "Shape, first",
                "Shape, last",
            ],
            "%",
        )
        .headings(["Iterations by pass", "Outcome"], "");
    for result in results {
        let paper = published([3, 5, 7], result)?;
        let name = format!("pass_{}", result.correlation.passes.len());
        let ends = [
            ("initial", &result.correlation.initial.errors),
            (&name, &last(result).errors),
        ];
        let rms = |row: &str, value: fn(&Errors) -> f64| {
            ends.map(|(stage, errors)| {
                let printed = paper
                    .as_ref()
                    .and_then(|paper| paper.value(row, &format!("{stage}_percent")));
                Cell::beside(100.0 * value(errors), RMS_PERCENT, printed)
            })
        };
        let counts: Vec<String> = iterations(result).map(|count| count.to_string()).collect();
        let words = [counts.join(", "), outcome(result)].map(Cell::text);
        let [frequency, shape] = [
            rms("frequency_rms", Errors::frequency_rms),
            rms("shape_rms", Errors::shape_rms),
        ];
        table.row(
            result.case.number,
            frequency.into_iter().chain(shape).chain(words),
        );
    }
    Ok(table)
}

/// The outcome of a case, in a few words.
pub fn outcome(result: &CaseResult) -> String {
    let kind = if result.case.grouping == Grouping::Elements {
        "element "
    } else {
        ""
    };
    let detected = result
        .anomaly
        .as_ref()
        .map(|found| format!("modeling error detected in {kind}{}", found.parameter));
    let (state, joint) = match (result.is_detection(), result.correlation.converged) {
        (true, _) => return detected.unwrap_or_else(|| "no modeling error detected".to_owned()),
        (_, true) => ("correlated", " but "),
        (_, false) => ("not converged", "; "),
    };
    detected.map_or_else(
        || state.to_owned(),
        |detected| format!("{state}{joint}{detected}"),
    )
}
