//! What commands read and write: the box, reports with the same options for every command, files whole or not at all.

use clap::{Args, ValueEnum};
use corfem::cases::torque_box::Reconstruction;
use corfem::files::error::FileError;
use corfem::present::table::Table;
use corfem::present::{PresentError, render};
use std::io::Write;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct OutputArguments {
    /// How to write the report
    #[arg(short, long, value_enum, default_value = "text")]
    format: FormatArgument,
    /// Write the report to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FormatArgument {
    /// Tables for a terminal, 100 columns wide
    Text,
    /// Tables in Markdown
    Markdown,
    /// The whole history as JSON
    Json,
    /// One number a line
    Csv,
}

impl OutputArguments {
    /// Writes tables as they are asked for; `json` makes the whole of what they show.
    pub fn write(
        &self,
        tables: &[Table],
        json: impl FnOnce() -> Result<String, PresentError>,
    ) -> Result<(), PresentError> {
        let report = match self.format {
            FormatArgument::Text => render::text(tables),
            FormatArgument::Markdown => render::markdown(tables),
            FormatArgument::Json => json()?,
            FormatArgument::Csv => render::csv(tables),
        };
        put(self.output.as_deref(), &report)
    }
}

/// The box of a file, or the reconstructed one.
pub fn reconstruction(box_file: Option<&Path>) -> Result<Reconstruction, PresentError> {
    Ok(match box_file {
        None => Reconstruction::embedded()?,
        Some(path) => Reconstruction::parse(&path.display().to_string(), &read(path)?)?,
    })
}

pub fn read(path: &Path) -> Result<String, PresentError> {
    Ok(std::fs::read_to_string(path).map_err(FileError::of_file(path, "read"))?)
}

/// Writes to a file, whole or not at all, or to standard output.
pub fn put(path: Option<&Path>, text: &str) -> Result<(), PresentError> {
    let Some(path) = path else {
        // A reader that has seen enough closes the pipe; that is no error of ours.
        let _ = std::io::stdout().write_all(text.as_bytes());
        return Ok(());
    };
    // A bare name has an empty parent, which is the present folder.
    let folder = path.parent().unwrap_or(Path::new(""));
    let write = || {
        let mut file = tempfile::NamedTempFile::new_in(folder)?;
        file.write_all(text.as_bytes())?;
        file.persist(path)?;
        Ok(())
    };
    Ok(write().map_err(FileError::of_file(path, "write"))?)
}

/// Writes files into a folder, all of them or none: they are written elsewhere beside it first. A new folder then takes
/// its place in one move; in an old one each file does, once every place is known to be free for a file.
pub fn put_all(folder: &Path, files: &[(String, String)]) -> Result<(), PresentError> {
    let failed = |path: &Path| FileError::of_file(path, "write");
    let beside = folder.parent().unwrap_or(Path::new(""));
    let scratch = tempfile::tempdir_in(beside).map_err(failed(folder))?;
    // The scratch folder is its owner's alone; one made in it has the rights any new folder has.
    let staged = scratch.path().join("staged");
    std::fs::create_dir(&staged).map_err(failed(folder))?;
    for (name, text) in files {
        std::fs::write(staged.join(name), text).map_err(failed(&folder.join(name)))?;
    }
    if !folder.exists() {
        return Ok(std::fs::rename(&staged, folder).map_err(failed(folder))?);
    }
    for (name, _) in files {
        let path = folder.join(name);
        if path.is_dir() {
            let source = std::io::Error::from(std::io::ErrorKind::IsADirectory);
            return Err(failed(&path)(source).into());
        }
    }
    for (name, _) in files {
        let path = folder.join(name);
        std::fs::rename(staged.join(name), &path).map_err(failed(&path))?;
    }
    Ok(())
}
