//! The place of a report: standard output, a device or a pipe, or a file, which is written whole or not at all.

use corfem::files::disk::{
    append, is_standard_output, metadata, probe, read_link, replace, replaceable, standard_output,
};
use corfem::files::error::FileError;
use corfem::present::PresentError;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The place of a report.
enum OutputPlace {
    StandardOutput,
    /// An existing path that is not a regular file, such as a pipe.
    Device(PathBuf),
    /// A regular file, or a new one; links are followed.
    File(PathBuf),
}

/// Refuses a path that could not be written, before there is anything to write. Nothing is changed by it.
pub fn check(path: &Path) -> Result<(), PresentError> {
    let check = || match place(Some(path))? {
        OutputPlace::File(path) => {
            replaceable(&path)?;
            probe(path.parent().unwrap_or(&path))
        }
        // A pipe is not opened yet, because that waits for its reader.
        OutputPlace::StandardOutput | OutputPlace::Device(_) => Ok(()),
    };
    Ok(check().map_err(FileError::of_file(named(Some(path)), "write"))?)
}

/// Writes to standard output, which `-` is too, through to a device or a pipe, or to a file, whole or not at all.
pub fn write_report(path: Option<&Path>, text: &str) -> Result<(), PresentError> {
    let write = || match place(path)? {
        OutputPlace::StandardOutput => write_all_to(standard_output(), text),
        OutputPlace::Device(path) => write_all_to(append(&path)?, text),
        OutputPlace::File(path) => replace(&path, text.as_bytes()),
    };
    Ok(write().map_err(FileError::of_file(named(path), "write"))?)
}

fn named(path: Option<&Path>) -> &Path {
    path.filter(|path| path.as_os_str() != "-")
        .unwrap_or(Path::new("standard output"))
}

fn place(path: Option<&Path>) -> io::Result<OutputPlace> {
    let Some(path) = path.filter(|path| path.as_os_str() != "-") else {
        return Ok(OutputPlace::StandardOutput);
    };
    match metadata(path) {
        Ok(found) if found.is_dir() => return Err(ErrorKind::IsADirectory.into()),
        Ok(found) if is_standard_output(&found) => return Ok(OutputPlace::StandardOutput),
        Ok(found) if !found.is_file() => return Ok(OutputPlace::Device(path.to_owned())),
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let mut path = path.to_owned();
    while let Ok(target) = read_link(&path) {
        if is_descriptor(&path) {
            // A file that is already open is appended to.
            return Ok(OutputPlace::Device(path));
        }
        path = path.parent().unwrap_or(Path::new("")).join(target);
    }
    if path.file_name().is_none() || path.as_os_str().as_encoded_bytes().ends_with(b"/") {
        return Err(ErrorKind::IsADirectory.into());
    }
    Ok(OutputPlace::File(path))
}

/// True for a name of one of the program's own open files, such as `/dev/fd/3`.
fn is_descriptor(path: &Path) -> bool {
    let folder = path.parent().and_then(|folder| folder.canonicalize().ok());
    folder.is_some_and(|folder| folder.starts_with("/proc"))
}

/// Writes a whole text. A reader that closes the pipe early is not an error.
fn write_all_to(mut out: impl Write, text: &str) -> io::Result<()> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => done,
    }
}
