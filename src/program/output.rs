//! Input and output that commands share: the torque box, the options of reports, and notes to the user.

use super::place::write_report;
use clap::{Args, ValueEnum};
use corfem::files::error::FileError;
use corfem::files::{escaped, read_bytes};
use corfem::present::table::Table;
use corfem::present::{PresentError, render};
use corfem::torque_box::wing_box::Reconstruction;
use std::io::Write;
use std::path::{Path, PathBuf};

#[derive(Debug, Default, Args)]
pub struct OutputArguments {
    /// Format of the report
    #[arg(short, long, value_enum, default_value = "text")]
    format: FormatArgument,
    /// Write the report to this file instead of standard output (-)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, ValueEnum)]
enum FormatArgument {
    /// Tables for a terminal, 80 columns wide
    #[default]
    Text,
    /// Tables in Markdown
    Markdown,
    /// The whole history as JSON
    Json,
    /// One number per line
    Csv,
}

impl OutputArguments {
    /// True if the report is text.
    pub fn is_text(&self) -> bool {
        self.format == FormatArgument::Text
    }

    /// Writes tables in the format asked for; `json` makes the document with everything that they show.
    pub fn write(
        &self,
        tables: &[Table],
        json: impl FnOnce() -> Result<String, PresentError>,
    ) -> Result<(), PresentError> {
        self.write_in_brief(tables, tables, json)
    }

    /// As [`Self::write`], with other tables for a reader than for a script.
    pub fn write_in_brief(
        &self,
        brief: &[Table],
        all: &[Table],
        json: impl FnOnce() -> Result<String, PresentError>,
    ) -> Result<(), PresentError> {
        let report = match self.format {
            FormatArgument::Text => render::text(brief),
            FormatArgument::Markdown => render::markdown(brief),
            FormatArgument::Json => json()?,
            FormatArgument::Csv => render::csv(all),
        };
        self.write_text(&report)
    }

    /// Writes a text where the report would go.
    pub fn write_text(&self, text: &str) -> Result<(), PresentError> {
        write_report(self.output.as_deref(), text)
    }
}

/// The box of a file, or the reconstructed one.
pub fn reconstruction(box_file: Option<&Path>) -> Result<Reconstruction, PresentError> {
    let Some(path) = box_file else {
        return Ok(Reconstruction::embedded()?);
    };
    let bytes = read_bytes(path).map_err(FileError::of_file(path, "read"))?;
    let text = String::from_utf8_lossy(&bytes);
    Ok(Reconstruction::parse(&path.display().to_string(), &text)?)
}

/// Prints a line on standard error, with control characters escaped. A closed standard error is no reason to fail.
pub fn note(words: impl std::fmt::Display) {
    let _ = writeln!(std::io::stderr(), "{}", escaped(&words.to_string()));
}
