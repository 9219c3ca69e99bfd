//! `corfem matrices`.

use super::{FormatArgument, put};
use clap::Args;
use corfem::cases::Case;
use corfem::error::Error;
use corfem::matrix_comparison::{USUAL_CASE, USUAL_TEST_MODES, compare_matrices};
use corfem::report::matrix_tables::matrix_tables;
use corfem::report::{Format, json, render};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct MatricesArguments {
    /// Which case
    #[arg(value_name = "CASE", default_value_t = USUAL_CASE)]
    case: usize,
    /// How many test modes, the lowest, the corrections are given
    #[arg(long, value_name = "N", default_value_t = USUAL_TEST_MODES)]
    test_modes: usize,
    /// How to write the report
    #[arg(short, long, value_enum, default_value = "text")]
    format: FormatArgument,
    /// Write the report to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Corrects a case by elements and by matrices and writes what either knows afterwards.
pub fn matrices(arguments: &MatricesArguments) -> Result<bool, Error> {
    let case = Case::new(arguments.case)?;
    let comparison = compare_matrices(&case, arguments.test_modes)?;
    let tables = matrix_tables(&case, &comparison);
    let report = match arguments.format.into() {
        Format::Text => render::render_tables(&tables, false),
        Format::Markdown => render::render_tables(&tables, true),
        Format::Json => json::matrices(&comparison)?,
        Format::Csv => render::csv(&tables)?,
    };
    put(arguments.output.as_deref(), &report)?;
    Ok(true)
}
