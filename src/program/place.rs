//! Where a report goes: standard output, a device or a pipe, or a file, which is written whole or not at all.

use super::signals;
use corfem::files::error::FileError;
use corfem::present::PresentError;
use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Where a report goes.
enum OutputPlace {
    StandardOutput,
    /// What is there and no regular file.
    Through(PathBuf),
    /// A regular file, or a new one; links are followed.
    File(PathBuf, Option<Metadata>),
}

/// Refuses a path that could not be written, before there is anything to write. Nothing is changed by it.
pub fn check(path: &Path) -> Result<(), PresentError> {
    let check = || match place(Some(path))? {
        OutputPlace::File(path, None) => probe(path.parent().unwrap_or(&path)),
        // A pipe is not opened yet: that is to wait for its reader.
        OutputPlace::StandardOutput | OutputPlace::Through(_) | OutputPlace::File(_, Some(_)) => {
            Ok(())
        }
    };
    Ok(check().map_err(FileError::of_file(named(Some(path)), "write"))?)
}

/// Writes to standard output, which `-` is too, through to a device or a pipe, or to a file, whole or not at all.
pub fn put(path: Option<&Path>, text: &str) -> Result<(), PresentError> {
    let write = || match place(path)? {
        OutputPlace::StandardOutput => to(std::io::stdout().lock(), text),
        OutputPlace::Through(path) => to(OpenOptions::new().append(true).open(path)?, text),
        OutputPlace::File(path, old) => {
            let _held = signals::hold();
            replace(&path, old.as_ref(), text)
        }
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

/// What is known of a file that is to be replaced, if it is there and may be written.
pub fn old_file(path: &Path) -> io::Result<Option<Metadata>> {
    match OpenOptions::new().write(true).open(path) {
        Ok(file) => file.metadata().map(Some),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

/// Gives a new file the owner and the mode of the old one.
pub fn as_old(new: &File, old: &Metadata) -> io::Result<()> {
    new.set_permissions(old.permissions())?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let found = new.metadata()?;
        if (found.uid(), found.gid()) != (old.uid(), old.gid()) {
            fchown(new, Some(old.uid()), Some(old.gid()))?;
        }
    }
    Ok(())
}

fn place(path: Option<&Path>) -> io::Result<OutputPlace> {
    let Some(path) = path.filter(|path| path.as_os_str() != "-") else {
        return Ok(OutputPlace::StandardOutput);
    };
    let found = match std::fs::metadata(path) {
        Ok(found) if found.is_dir() => return Err(ErrorKind::IsADirectory.into()),
        Ok(found) if is_standard_output(&found) => return Ok(OutputPlace::StandardOutput),
        Ok(found) if !found.is_file() => return Ok(OutputPlace::Through(path.to_owned())),
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
        found => found.ok(),
    };
    let mut path = path.to_owned();
    while let Ok(target) = std::fs::read_link(&path) {
        if is_descriptor(&path) {
            // A file that is open already is written on, from its end.
            return Ok(OutputPlace::Through(path));
        }
        path = path.parent().unwrap_or(Path::new("")).join(target);
    }
    if path.file_name().is_none() || path.as_os_str().as_encoded_bytes().ends_with(b"/") {
        return Err(ErrorKind::IsADirectory.into());
    }
    let old = if found.is_some() {
        old_file(&path)?
    } else {
        None
    };
    Ok(OutputPlace::File(path, old))
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

/// Writes all of a text. A reader that has seen enough closes the pipe; that is no error of ours.
fn to(mut out: impl Write, text: &str) -> io::Result<()> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => done,
    }
}

/// Puts a new file that is on the disk in the place of the old one, with its owner and mode. One that cannot be replaced,
/// because its folder takes no files or it is mounted or another's, is written over where it stands.
fn replace(path: &Path, old: Option<&Metadata>, text: &str) -> io::Result<()> {
    let mut staged = match new_file_beside(path) {
        Err(_) if old.is_some() => return write_over(path, text),
        staged => staged?,
    };
    staged.write_all(text.as_bytes())?;
    if old.is_some_and(|old| as_old(staged.as_file(), old).is_err()) {
        return write_over(path, text);
    }
    sync(staged.as_file())?;
    match staged.persist(path) {
        Err(_) if old.is_some() => write_over(path, text),
        done => done
            .map(drop)
            .map_err(io::Error::from)
            .map(|()| sync_folder(path.parent().unwrap_or(path))),
    }
}

fn write_over(path: &Path, text: &str) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(text.as_bytes()).and_then(|()| sync(&file))
}

/// Waits until a file is on the disk, where there is one: files of the system itself have none.
pub fn sync(file: &File) -> io::Result<()> {
    file.sync_all().or_else(|error| {
        if error.kind() == ErrorKind::InvalidInput {
            Ok(())
        } else {
            Err(error)
        }
    })
}

/// Waits until the names in a folder are on the disk, where the platform can say so.
pub fn sync_folder(folder: &Path) {
    let _ = File::open(folder.join(".")).and_then(|folder| folder.sync_all());
}

/// A file with a name of its own, with the rights that any new file has.
fn new_file_beside(path: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    // A bare name has an empty parent, which is the present folder.
    builder
        .prefix(".corfem-")
        .tempfile_in(path.parent().unwrap_or(Path::new("")))
}
