//! Input and output that commands share: the torque box, the one way in which a result is written, and notes to the user.

use clap::{Args, ValueEnum};
use corfem::files::disk::{probe, replace};
use corfem::files::error::FileError;
use corfem::files::{escaped, read_bytes};
use corfem::present::table::Table;
use corfem::present::{PresentError, render};
use corfem::torque_box::wing_box::Reconstruction;
use std::fs::{OpenOptions, create_dir};
use std::io::{ErrorKind, IsTerminal, Write, stdout};
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
    /// One number per line, or of a correlation the rows
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
        self.write_beside(tables, render::csv(tables), json)
    }

    /// As [`Self::write`], with these rows as CSV.
    pub fn write_beside(
        &self,
        tables: &[Table],
        csv: String,
        json: impl FnOnce() -> Result<String, PresentError>,
    ) -> Result<(), PresentError> {
        self.write_text(&match self.format {
            FormatArgument::Text => render::text(tables),
            FormatArgument::Markdown => render::markdown(tables),
            FormatArgument::Json => json()?,
            FormatArgument::Csv => csv,
        })
    }

    /// Writes a text where the report would go.
    pub fn write_text(&self, text: &str) -> Result<(), PresentError> {
        write(self.output.as_deref(), text.as_bytes())
    }
}

/// The file that is asked for, if it is not standard output.
fn named(path: Option<&Path>) -> Option<&Path> {
    path.filter(|path| path.as_os_str() != "-")
}

/// True of a pipe, a device or an open file by its name in `/dev`, which is written to and not replaced.
fn is_device(path: &Path) -> bool {
    let found = path.metadata();
    path.starts_with("/dev") || found.is_ok_and(|found| !found.is_file() && !found.is_dir())
}

/// Refuses a file or a folder that could not be written, before there is anything to write.
pub fn check(file: Option<&Path>, folder: Option<&Path>) -> Result<(), FileError> {
    let file = named(file).filter(|path| !is_device(path));
    // What has the name already must be a folder, and be there.
    let folder = folder.map(|path| match path.symlink_metadata() {
        Ok(_) => (path, path.join("x")),
        Err(_) => (path, path.to_owned()),
    });
    let file = file.map(|path| (path, path.to_owned()));
    let mut probed = file.into_iter().chain(folder);
    probed.try_for_each(|(path, probed)| probe(&probed).map_err(FileError::of_file(path, "write")))
}

/// Writes to standard output, which `-` is too, through to a device or a pipe, or to a file, whole or not at all.
pub fn write(path: Option<&Path>, bytes: &[u8]) -> Result<(), PresentError> {
    let written = match named(path) {
        None => stdout().write_all(bytes),
        Some(path) if is_device(path) => {
            let device = OpenOptions::new().append(true).open(path);
            device.and_then(|mut device| device.write_all(bytes))
        }
        Some(path) => replace(path, bytes),
    };
    match written {
        // A reader that closes the pipe early is no error.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => Ok(done.map_err(FileError::of_file(
            named(path).unwrap_or(Path::new("standard output")),
            "write",
        ))?),
    }
}

/// Writes files, by name and content, into a folder, made if it is new.
pub fn write_files<T: AsRef<[u8]>>(
    folder: &Path,
    files: impl IntoIterator<Item = (impl AsRef<Path>, T)>,
) -> Result<(), PresentError> {
    if !folder.is_dir() {
        create_dir(folder).map_err(FileError::of_file(folder, "write"))?;
    }
    let mut files = files.into_iter();
    files.try_for_each(|(name, content)| write(Some(&folder.join(name)), content.as_ref()))
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

/// Shows how far the work is on one line of standard error, where that is a terminal and nobody asked for quiet.
pub fn tell(quiet: bool, words: &str) {
    let mut stderr = std::io::stderr();
    if !quiet && stderr.is_terminal() {
        let _ = write!(stderr, "\r\x1b[K{}", escaped(words));
    }
}
