//! How a report is written and where: the same options for every command that has one.

use super::{FormatArgument, put};
use clap::Args;
use corfem::present::error::PresentError;
use corfem::present::report::table::Table;
use corfem::present::report::{Format, render};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct ReportArguments {
    /// How to write the report
    #[arg(short, long, value_enum, default_value = "text")]
    format: FormatArgument,
    /// Write the report to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl ReportArguments {
    /// Writes tables as they are asked for: `words` makes text or Markdown of them, `json` the whole of what they show.
    pub fn write(
        &self,
        tables: &[Table],
        words: fn(&[Table], bool) -> String,
        json: impl FnOnce() -> Result<String, PresentError>,
    ) -> Result<(), PresentError> {
        let report = match self.format.into() {
            Format::Text => words(tables, false),
            Format::Markdown => words(tables, true),
            Format::Json => json()?,
            Format::Csv => render::csv(tables)?,
        };
        put(self.output.as_deref(), &report)
    }
}
