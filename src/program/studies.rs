//! `corfem tables`, `fewer-modes`, `readings`, `matrices`, `check` and `delta-wing`.

use super::output::{OutputArguments, say};
use super::progress::during;
use super::settings::SettingsArguments;
use super::solver::{Solver, SolverArguments};
use clap::Args;
use corfem::job::preflight::preflight_of;
use corfem::present::{PresentError, json, tables};
use corfem::studies::delta_wing::DeltaWing;
use corfem::studies::delta_wing::correlation::{correlate_wing_with, first_model, settings};
use corfem::studies::known::Known;
use corfem::studies::matrix_comparison::{USUAL_CASE, USUAL_TEST_MODES, compare_matrices};
use corfem::torque_box::fewer_modes::{PUBLISHED_CASE, all_runs, published_runs};
use corfem::torque_box::readings::{READINGS, all_columns, detection};
use corfem::torque_box::wing_box::Reconstruction;
use corfem::torque_box::{CASES, Case};
use serde_json::json;

#[derive(Debug, Args)]
pub struct TablesArguments {
    /// Which tables; all thirteen if none is named
    #[arg(value_name = "TABLE", value_parser = clap::value_parser!(u8).range(1..=13))]
    numbers: Vec<u8>,
    #[command(flatten)]
    output: OutputArguments,
}

#[derive(Debug, Args)]
pub struct MatricesArguments {
    /// Which case
    #[arg(value_name = "CASE", default_value_t = USUAL_CASE)]
    case: usize,
    /// How many test modes, the lowest, the corrections are given
    #[arg(long, value_name = "N", default_value_t = USUAL_TEST_MODES)]
    test_modes: usize,
    #[command(flatten)]
    output: OutputArguments,
}

#[derive(Debug, Args)]
pub struct DeltaWingArguments {
    #[command(flatten)]
    settings: SettingsArguments,
    #[command(flatten)]
    output: OutputArguments,
    #[command(flatten)]
    solver: SolverArguments,
}

#[derive(Debug, Args)]
pub struct FewerModesArguments {
    #[command(flatten)]
    settings: SettingsArguments,
    #[command(flatten)]
    output: OutputArguments,
}

/// Runs every reading of the step against the printed gages.
pub fn readings(output: &OutputArguments, quiet: bool) -> Result<(), PresentError> {
    let reconstruction = Reconstruction::embedded()?;
    let columns = during(quiet, "readings of the step", || {
        all_columns(&reconstruction)
    })?;
    let detection = |reading| detection(&reconstruction, reading);
    let detections = READINGS
        .into_iter()
        .map(detection)
        .collect::<Result<Vec<_>, _>>()?;
    let tables = tables::readings::readings_tables(&columns, &detections)?;
    output.write(&tables, || json::readings(&columns, &detections))
}

/// Writes Table 1, computed anew, and the paper's other tables as printed.
pub fn tables(arguments: &TablesArguments) -> Result<(), PresentError> {
    let all: Vec<u8> = (1..=13).collect();
    let numbers = if arguments.numbers.is_empty() {
        &all
    } else {
        &arguments.numbers
    };
    let table = |&number: &u8| match number {
        1 => tables::published::root_error_table(),
        _ => tables::published::published_table(number.into()),
    };
    let tables = numbers.iter().map(table).collect::<Result<Vec<_>, _>>()?;
    arguments
        .output
        .write(&tables, || json::document(json!({ "tables": tables })))
}

/// Runs Case 2 with fewer modes and writes Tables 9 to 12 and what truncation costs.
pub fn fewer_modes(
    FewerModesArguments { settings, output }: &FewerModesArguments,
    quiet: bool,
) -> Result<(), PresentError> {
    let mut case = Case::new(PUBLISHED_CASE)?;
    settings.apply(&mut case.settings)?;
    let (published, all) = during(quiet, "runs with fewer modes", || {
        (published_runs(&case), all_runs(&case))
    });
    let (published, all) = (published?, all?);
    let mut tables = tables::fewer_modes::published_tables(&case, &published)?;
    tables.extend(tables::fewer_modes::truncation_tables(&all));
    output.write(&tables, || json::document(json!({ "runs": all })))
}

/// Corrects a case by elements and by matrices and writes what either knows afterwards.
pub fn matrices(arguments: &MatricesArguments) -> Result<(), PresentError> {
    let case = Case::new(arguments.case)?;
    let comparison = compare_matrices(&case, arguments.test_modes)?;
    let tables = tables::matrices::matrix_tables(&case, &comparison);
    arguments.output.write(&tables, || {
        json::document(json!({ "comparison": comparison }))
    })
}

/// Looks at the paper's cases and the delta wing before the first step, and writes what is found.
pub fn check(output: &OutputArguments) -> Result<(), PresentError> {
    let mut found = Vec::new();
    for number in CASES {
        let case = Case::new(number)?;
        let test = case.test_modes()?;
        found.push((
            format!("Case {number}"),
            preflight_of(&case.model()?, &test, &case.settings)?,
        ));
    }
    let wing = Known::delta_wing()?;
    let model = first_model(&DeltaWing::embedded()?)?;
    found.push((wing.name, preflight_of(&model, &wing.test, &settings())?));
    output.write(&[tables::preflight::findings_table(&found)], || {
        json::preflight(&found)
    })
}

/// Writes the wing's answers beside others' and the correlation of its gages; whether it converged.
pub fn delta_wing(arguments: &DeltaWingArguments, quiet: bool) -> Result<bool, PresentError> {
    let wing = DeltaWing::embedded()?;
    let solver = Solver::of(&arguments.solver)?;
    let mut settings = settings();
    arguments.settings.apply(&mut settings)?;
    let elements = |model: &_, factors: &[f64]| solver.elements(model, factors);
    let run = during(quiet, "the delta wing", || {
        correlate_wing_with(&wing, &settings, solver.name(), elements, |_, _| {})
    })?;
    let tables = tables::delta_wing::delta_wing_tables(&wing, &run)?;
    arguments
        .output
        .write(&tables, || json::delta_wing(&wing, &run))?;
    if !run.correlation.converged {
        say(
            "corfem: the correlation did not converge within its limits; the best found is in the report",
        );
    }
    Ok(run.correlation.converged)
}
