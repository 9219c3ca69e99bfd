//! Files written whole or not at all.

use std::io::{self, Write};
use std::path::Path;

/// The folder of a file: a bare name has the present one.
fn folder_of(path: &Path) -> &Path {
    path.parent()
        .filter(|own| !own.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}

/// Writes and syncs a new file before it takes the place of the old one, if any. A link is followed, and stays one; one to nothing is
/// refused.
///
/// # Errors
/// The operating system's error; the old file is then as it was.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let path = &if path.is_symlink() {
        path.canonicalize()?
    } else {
        path.to_owned()
    };
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut staged = builder.prefix(".corfem-").tempfile_in(folder_of(path))?;
    staged.write_all(bytes)?;
    staged.as_file().sync_all()?;
    staged.persist(path)?;
    Ok(())
}

/// The file of a name, in which a # may choose one matrix of several.
pub(crate) fn file_of(name: &Path) -> &Path {
    name.to_str()
        .and_then(|text| text.rsplit_once('#'))
        .filter(|_| !name.exists())
        .map_or(name, |(file, _)| Path::new(file))
}

/// Refuses a place where no file can be made, before there is anything to write.
///
/// # Errors
/// The operating system's error.
pub fn probe(path: &Path) -> io::Result<()> {
    match path.metadata() {
        Ok(found) if found.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Err(nothing) if path.is_symlink() => Err(nothing),
        _ if path.as_os_str().as_encoded_bytes().ends_with(b"/") => {
            Err(io::ErrorKind::IsADirectory.into())
        }
        _ => tempfile::tempfile_in(folder_of(path)).map(drop),
    }
}
