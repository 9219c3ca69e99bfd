//! `corfem fewer-modes`.

use super::report::ReportArguments;
use clap::Args;
use corfem::cases::Case;
use corfem::cases::fewer_modes::{PUBLISHED_CASE, all_runs, published_runs};
use corfem::present::error::PresentError;
use corfem::present::report::fewer_modes_tables::fewer_modes_tables;
use corfem::present::report::{json, render};

#[derive(Debug, Args)]
pub struct FewerModesArguments {
    #[command(flatten)]
    report: ReportArguments,
}

/// Runs Case 2 with fewer modes and writes Tables 9 to 12 and what truncation costs.
pub fn fewer_modes(arguments: &FewerModesArguments) -> Result<(), PresentError> {
    let case = Case::new(PUBLISHED_CASE)?;
    let runs = all_runs(&case)?;
    let tables = fewer_modes_tables(&case, &published_runs(&case)?, &runs)?;
    arguments
        .report
        .write(&tables, render::render, || json::fewer_modes(&runs))
}
