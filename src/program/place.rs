//! Where a report goes: standard output, a device or a pipe, or a file, which is written whole or not at all.

use corfem::files::error::FileError;
use corfem::present::PresentError;
use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Where a report goes.
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
        OutputPlace::StandardOutput => write_all_to(std::io::stdout().lock(), text),
        OutputPlace::Device(path) => {
            write_all_to(OpenOptions::new().append(true).open(path)?, text)
        }
        OutputPlace::File(path) => replace(&path, text.as_bytes()),
    };
    Ok(write().map_err(FileError::of_file(named(path), "write"))?)
}

fn named(path: Option<&Path>) -> &Path {
    path.filter(|path| path.as_os_str() != "-")
        .unwrap_or(Path::new("standard output"))
}

/// Whether files can be made in a folder: one without a name is, for a moment.
pub fn probe(folder: &Path) -> io::Result<()> {
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    tempfile::tempfile_in(folder).map(drop)
}

fn place(path: Option<&Path>) -> io::Result<OutputPlace> {
    let Some(path) = path.filter(|path| path.as_os_str() != "-") else {
        return Ok(OutputPlace::StandardOutput);
    };
    match std::fs::metadata(path) {
        Ok(found) if found.is_dir() => return Err(ErrorKind::IsADirectory.into()),
        Ok(found) if is_standard_output(&found) => return Ok(OutputPlace::StandardOutput),
        Ok(found) if !found.is_file() => return Ok(OutputPlace::Device(path.to_owned())),
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let mut path = path.to_owned();
    while let Ok(target) = std::fs::read_link(&path) {
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

/// Whether it is a name of one of the program's own open files, such as `/dev/fd/3`.
fn is_descriptor(path: &Path) -> bool {
    let folder = path.parent().and_then(|folder| folder.canonicalize().ok());
    folder.is_some_and(|folder| folder.starts_with("/proc"))
}

#[cfg(unix)]
fn is_standard_output(found: &Metadata) -> bool {
    use std::os::{fd::AsFd, unix::fs::MetadataExt};
    let own = std::io::stdout()
        .as_fd()
        .try_clone_to_owned()
        .and_then(|own| File::from(own).metadata());
    own.is_ok_and(|own| (own.dev(), own.ino()) == (found.dev(), found.ino()))
}

#[cfg(not(unix))]
fn is_standard_output(_: &Metadata) -> bool {
    false
}

/// Writes a whole text. A reader that closes the pipe early is not an error.
fn write_all_to(mut out: impl Write, text: &str) -> io::Result<()> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => done,
    }
}

/// Refuses to replace what is no regular file, or a file that may not be written.
pub fn replaceable(path: &Path) -> io::Result<()> {
    if std::fs::symlink_metadata(path).is_ok_and(|found| !found.is_file()) {
        return Err(io::Error::new(
            ErrorKind::AlreadyExists,
            "it exists and is not a regular file",
        ));
    }
    match OpenOptions::new().write(true).open(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Writes a new file completely and syncs it before it takes the place of the old one, if any. It has the rights of any new file.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replaceable(path)?;
    // A bare name has an empty parent, which is the present folder.
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut staged = builder.prefix(".corfem-").tempfile_in(folder)?;
    staged.write_all(bytes)?;
    staged.as_file().sync_all()?;
    staged.persist(path)?;
    // The name is on the disk too, where the platform can say so.
    let _ = File::open(folder.join(".")).and_then(|folder| folder.sync_all());
    Ok(())
}
