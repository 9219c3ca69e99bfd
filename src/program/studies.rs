//! `corfem tables` and `fewer-modes`.

use super::output::{OutputArguments, tell};
use super::paper::tables;
use super::settings::SettingsArguments;
use clap::Args;
use corfem::present::{PresentError, json};
use corfem::torque_box::Case;
use corfem::torque_box::fewer_modes::{PUBLISHED_CASE, all_runs, published_runs};
use serde_json::json;

#[derive(Debug, Args)]
pub struct TablesArguments {
    /// Numbers of the tables; all thirteen if none is named
    #[arg(value_name = "TABLE", value_parser = clap::value_parser!(u8).range(1..=13))]
    numbers: Vec<u8>,
    #[command(flatten)]
    output: OutputArguments,
}

#[derive(Debug, Args)]
pub struct FewerModesArguments {
    #[command(flatten)]
    output: OutputArguments,
    #[command(flatten)]
    settings: SettingsArguments,
}

/// Writes Table 1, computed anew, and the paper's other tables as printed.
pub fn tables(arguments: &TablesArguments) -> Result<bool, PresentError> {
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
    let document = json!({ "tables": tables });
    arguments
        .output
        .write(&tables, || json::document(json::BOX_UNITS, document))?;
    Ok(true)
}

/// Runs Case 2 with fewer modes and writes Tables 9 to 12 and the cost of truncation.
pub fn fewer_modes(
    FewerModesArguments { settings, output }: &FewerModesArguments,
    quiet: bool,
) -> Result<bool, PresentError> {
    let mut case = Case::new(PUBLISHED_CASE)?;
    settings.apply(&mut case.settings)?;
    tell(quiet, "runs with fewer modes");
    let (published, all) = (published_runs(&case)?, all_runs(&case)?);
    tell(quiet, "");
    let mut tables = tables::fewer_modes::published_tables(&case, &published)?;
    tables.extend(tables::fewer_modes::truncation_tables(&all));
    output.write(&tables, || {
        json::document(json::BOX_UNITS, json!({ "runs": all }))
    })?;
    Ok(true)
}
