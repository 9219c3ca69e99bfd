//! `corfem fewer-modes`.

use super::{FormatArgument, put};
use clap::Args;
use corfem::cases::Case;
use corfem::error::Error;
use corfem::fewer_modes::{PUBLISHED_CASE, all_runs, published_runs};
use corfem::report::fewer_modes_tables::fewer_modes_tables;
use corfem::report::{Format, json, render};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct FewerModesArguments {
    /// How to write the report
    #[arg(short, long, value_enum, default_value = "text")]
    format: FormatArgument,
    /// Write the report to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Runs Case 2 with fewer modes and writes Tables 9 to 12 and what truncation costs.
pub fn fewer_modes(arguments: &FewerModesArguments) -> Result<bool, Error> {
    let case = Case::new(PUBLISHED_CASE)?;
    let runs = all_runs(&case)?;
    let tables = fewer_modes_tables(&case, &published_runs(&case)?, &runs)?;
    let report = match arguments.format.into() {
        Format::Text => render::render(&tables, false),
        Format::Markdown => render::render(&tables, true),
        Format::Json => json::fewer_modes(&runs)?,
        Format::Csv => render::csv(&tables)?,
    };
    put(arguments.output.as_deref(), &report)?;
    Ok(true)
}
