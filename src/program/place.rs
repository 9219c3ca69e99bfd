//! The place of a report: standard output, a device or a pipe, a file, which is written whole or not at all, or a folder of files.

use corfem::files::disk::{probe, replace};
use corfem::files::error::FileError;
use corfem::present::PresentError;
use std::fs::{OpenOptions, create_dir};
use std::io::{ErrorKind, Write, stdout};
use std::path::Path;

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
pub fn check(file: Option<&Path>, folder: Option<&Path>) -> Result<(), PresentError> {
    for path in named(file).into_iter().filter(|path| !is_device(path)) {
        probe(path).map_err(FileError::of_file(path, "write"))?;
    }
    if let Some(path) = folder {
        // What has the name already must be a folder, and be there.
        let probed = match path.symlink_metadata() {
            Ok(_) => probe(&path.join("x")),
            Err(_) => probe(path),
        };
        probed.map_err(FileError::of_file(path, "write"))?;
    }
    Ok(())
}

/// Writes a result to standard output, which `-` is too, through to a device or a pipe, or to a file, whole or not at all.
pub fn write_report(path: Option<&Path>, bytes: impl AsRef<[u8]>) -> Result<(), PresentError> {
    let bytes = bytes.as_ref();
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

/// Writes the files of a run, by name and content, into a folder, made if it is new.
pub fn write_files<T: AsRef<[u8]>>(
    folder: &Path,
    files: impl IntoIterator<Item = (impl AsRef<Path>, T)>,
) -> Result<(), PresentError> {
    if !folder.is_dir() {
        create_dir(folder).map_err(FileError::of_file(folder, "write"))?;
    }
    let mut files = files.into_iter();
    files.try_for_each(|(name, content)| write_report(Some(&folder.join(name)), content))
}
