//! `corfem matrices`.

use super::report::ReportArguments;
use clap::Args;
use corfem::cases::Case;
use corfem::present::error::PresentError;
use corfem::present::report::matrix_tables::matrix_tables;
use corfem::present::report::{json, render};
use corfem::studies::matrix_comparison::{USUAL_CASE, USUAL_TEST_MODES, compare_matrices};

#[derive(Debug, Args)]
pub struct MatricesArguments {
    /// Which case
    #[arg(value_name = "CASE", default_value_t = USUAL_CASE)]
    case: usize,
    /// How many test modes, the lowest, the corrections are given
    #[arg(long, value_name = "N", default_value_t = USUAL_TEST_MODES)]
    test_modes: usize,
    #[command(flatten)]
    report: ReportArguments,
}

/// Corrects a case by elements and by matrices and writes what either knows afterwards.
pub fn matrices(arguments: &MatricesArguments) -> Result<(), PresentError> {
    let case = Case::new(arguments.case)?;
    let comparison = compare_matrices(&case, arguments.test_modes)?;
    let tables = matrix_tables(&case, &comparison);
    arguments.report.write(&tables, render::render_tables, || {
        json::matrices(&comparison)
    })
}
