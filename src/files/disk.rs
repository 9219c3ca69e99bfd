//! Every operation on a file: no other module of the crate calls the operating system for one.
//!
//! In a build with debug assertions the environment variable `CORFEM_FAILING_OPERATION` names an operation by its number, and that
//! one fails. Every creation, opening, read, write, sync and rename of the process counts, from one. Questions about a file, which
//! may fail without harm, do not count.

pub use std::fs::{Metadata, metadata, read_dir, read_link, symlink_metadata};

use std::fs::{File, OpenOptions, create_dir};
use std::io::{self, Error, ErrorKind, Read, Write};
use std::ops::Deref;
use std::path::{Path, PathBuf};

/// Counts an operation, and fails in its place when the environment asks for that.
fn begin(operation: &str, path: &Path) -> io::Result<()> {
    #[cfg(debug_assertions)]
    {
        use std::sync::LazyLock;
        use std::sync::atomic::{AtomicU64, Ordering::SeqCst};
        const VARIABLE: &str = "CORFEM_FAILING_OPERATION";
        static FAILING: LazyLock<Option<u64>> =
            LazyLock::new(|| std::env::var(VARIABLE).ok()?.parse().ok());
        static COUNT: AtomicU64 = AtomicU64::new(0);
        if *FAILING == Some(COUNT.fetch_add(1, SeqCst) + 1) {
            let path = path.display();
            return Err(Error::other(format!(
                "{VARIABLE} made it fail to {operation} {path}"
            )));
        }
    }
    let _ = (operation, path);
    Ok(())
}

/// An open file or standard output, and its name.
#[derive(Debug)]
pub struct Opened<F> {
    file: F,
    path: PathBuf,
}

/// An open file.
pub type OpenFile = Opened<File>;

impl<F> Opened<F> {
    fn new(operation: &str, path: &Path, open: impl FnOnce() -> io::Result<F>) -> io::Result<Self> {
        begin(operation, path)?;
        let path = path.to_owned();
        Ok(Self {
            file: open()?,
            path,
        })
    }
}

impl<F> Deref for Opened<F> {
    type Target = F;
    fn deref(&self) -> &F {
        &self.file
    }
}

impl<F: Read> Read for Opened<F> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        begin("read", &self.path)?;
        self.file.read(bytes)
    }
}

impl<F: Write> Write for Opened<F> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        begin("write", &self.path)?;
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// A file to read.
///
/// # Errors
/// The operating system's error.
pub fn open(path: &Path) -> io::Result<OpenFile> {
    Opened::new("open", path, || File::open(path))
}

/// A device or pipe to write to.
///
/// # Errors
/// The operating system's error.
pub fn append(path: &Path) -> io::Result<OpenFile> {
    Opened::new("open", path, || OpenOptions::new().append(true).open(path))
}

/// Standard output.
pub fn standard_output() -> Opened<io::StdoutLock<'static>> {
    Opened {
        file: io::stdout().lock(),
        path: "standard output".into(),
    }
}

/// True if standard output goes to this file, device or pipe.
#[cfg(unix)]
pub fn is_standard_output(found: &Metadata) -> bool {
    use std::os::{fd::AsFd, unix::fs::MetadataExt};
    let own = io::stdout()
        .as_fd()
        .try_clone_to_owned()
        .and_then(|own| File::from(own).metadata());
    own.is_ok_and(|own| (own.dev(), own.ino()) == (found.dev(), found.ino()))
}

/// False: only Unix tells where standard output goes.
#[cfg(not(unix))]
pub fn is_standard_output(_: &Metadata) -> bool {
    false
}

/// The system's status report on this process; empty where the system gives none.
pub fn process_status() -> String {
    std::fs::read_to_string("/proc/self/status").unwrap_or_default()
}

/// Makes a folder.
///
/// # Errors
/// The operating system's error.
pub fn make_folder(path: &Path) -> io::Result<()> {
    begin("create", path)?;
    create_dir(path)
}

/// Checks that files can be made in a folder: it makes one without a name for a moment. Half-written files of killed runs are removed.
///
/// # Errors
/// The operating system's error.
pub fn probe(folder: &Path) -> io::Result<()> {
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    begin("create a file in", folder)?;
    tempfile::tempfile_in(folder)?;
    remove_stale(folder);
    Ok(())
}

/// Begins the names of files that are not yet whole.
const STAGED: &str = ".corfem-";

/// Removes files that an earlier run, killed, has left half-written: those that no run has locked. What cannot be removed stays.
fn remove_stale(folder: &Path) {
    for entry in read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let is_staged = entry.file_name().to_string_lossy().starts_with(STAGED)
            && symlink_metadata(&path).is_ok_and(|found| found.is_file());
        if is_staged && File::open(&path).is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = std::fs::remove_file(&path);
        }
    }
}

/// Refuses to replace anything but a regular file, or a file that may not be written.
///
/// # Errors
/// `AlreadyExists` for anything but a regular file; the operating system's error for a file that may not be written.
pub fn replaceable(path: &Path) -> io::Result<()> {
    if symlink_metadata(path).is_ok_and(|found| !found.is_file()) {
        return Err(Error::new(
            ErrorKind::AlreadyExists,
            "it exists and is not a regular file",
        ));
    }
    begin("open", path)?;
    match OpenOptions::new().write(true).open(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Writes and syncs a new file before it takes the place of the old one, if any. The new file has the rights of any new file.
///
/// # Errors
/// The operating system's error; the old file is then as it was, unless only the sync of its folder failed: then the new one is
/// there, whole.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    replaceable(path)?;
    // A bare name has an empty parent, which is the present folder.
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let stage = || builder.prefix(STAGED).tempfile_in(folder);
    let mut staged = Opened::new("create", path, stage)?;
    // A file system without locks keeps its stale files.
    let _ = staged.as_file().try_lock();
    staged.write_all(bytes)?;
    begin("sync", path)?;
    staged.as_file().sync_all()?;
    begin("rename", path)?;
    staged.file.persist(path)?;
    sync_folder(&folder.join("."))
}

/// Syncs a folder, so that a new name in it is on the disk too, where the folder may be read and its file system can sync it.
fn sync_folder(folder: &Path) -> io::Result<()> {
    let Ok(opened) = File::open(folder) else {
        return Ok(());
    };
    begin("sync", folder)?;
    match opened.sync_all() {
        Err(error)
            if ![ErrorKind::InvalidInput, ErrorKind::Unsupported].contains(&error.kind()) =>
        {
            Err(error)
        }
        _ => Ok(()),
    }
}
