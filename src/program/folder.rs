//! A set of files in a folder: a reader finds all the old ones or all the new ones, wherever the program is stopped.
//!
//! New files are written in a hidden folder inside the folder itself. Each place of the set then becomes a symbolic
//! link through one link to the old files, that one link is turned to the new ones, and each file takes its link's
//! place: only the middle step, a single rename, changes what is read. What a stopped run leaves, in the hidden folder
//! alone, the next run settles first. Other files, folders and the folder itself are not touched. What a step needs is
//! on the disk before it, so that the same holds when the machine stops.
//!
//! Where there are no symbolic links, files are replaced one by one.

use super::place::{as_old, old_file, probe, sync, sync_folder};
use super::signals;
use corfem::files::error::FileError;
use corfem::present::PresentError;
use std::fs::{self, File};
use std::io::{Error, ErrorKind, Result, Write};
use std::path::Path;

/// The hidden folder, and in it the link that is turned and the folders it leads to.
const STAGE: &str = ".corfem-set";
const CURRENT: &str = "current";
const OLD: &str = "old";
const NEW: &str = "new";

/// Refuses a folder that files could not be written into, before there are any.
pub fn check_folder(folder: &Path) -> std::result::Result<(), PresentError> {
    let check = || match fs::metadata(folder) {
        _ if folder.as_os_str() == "-" => Err(Error::new(
            ErrorKind::InvalidInput,
            "standard output is no folder",
        )),
        Ok(_) => probe(folder),
        Err(_) => probe(folder.parent().unwrap_or(folder)),
    };
    Ok(check().map_err(FileError::of_file(folder, "write"))?)
}

/// Writes the files, by name and text, into a folder, made if it is new: all of them or none.
pub fn put_all(
    folder: &Path,
    files: &[(String, Vec<u8>)],
) -> std::result::Result<(), PresentError> {
    let failed = |path: &Path| FileError::of_file(path, "write");
    let made = fs::create_dir(folder).is_ok();
    // Two runs into one folder take turns, where the file system can lock; the lock ends with this run.
    let lock = File::open(folder).map_err(failed(folder))?;
    let _ = lock.lock();
    let _held = signals::hold();
    settle(folder).map_err(failed(folder))?;
    let write = || {
        let new = folder.join(STAGE).join(NEW);
        [OLD, NEW]
            .iter()
            .try_for_each(|name| fs::create_dir_all(folder.join(STAGE).join(name)))
            .map_err(failed(folder))?;
        for (name, text) in files {
            let path = folder.join(name);
            stage(&path, &new.join(name), text).map_err(failed(&path))?;
        }
        switch(folder, files).map_err(failed(folder))
    };
    let done = write();
    if done.is_err() {
        let _ = settle(folder);
        let _ = made.then(|| fs::remove_dir(folder));
    }
    Ok(done?)
}

/// Writes the new file of a place where nobody looks.
fn stage(path: &Path, new: &Path, text: &[u8]) -> Result<()> {
    if fs::symlink_metadata(path).is_ok_and(|found| !found.is_file()) {
        return Err(Error::new(
            ErrorKind::AlreadyExists,
            "something else than a file stands there",
        ));
    }
    let old = old_file(path)?;
    let mut file = File::create(new)?;
    file.write_all(text)?;
    // Another's file becomes one's own where it cannot stay the other's.
    let _ = old.map(|old| as_old(&file, &old));
    sync(&file)
}

/// Turns a folder from its old files to those staged.
fn switch(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<()> {
    let stage = folder.join(STAGE);
    let (current, next) = (stage.join(CURRENT), stage.join("next"));
    if link(OLD, &current).is_err() {
        for (name, _) in files {
            fs::rename(stage.join(NEW).join(name), folder.join(name))?;
        }
        return settle(folder);
    }
    for (name, _) in files {
        let (path, old) = (folder.join(name), stage.join(OLD).join(name));
        if path.exists() && fs::hard_link(&path, &old).is_err() {
            fs::copy(&path, &old).and_then(|_| File::open(&old)?.sync_all())?;
        }
    }
    [&stage.join(OLD), &stage.join(NEW), &stage, folder]
        .into_iter()
        .for_each(sync_folder);
    for (name, _) in files {
        link(&format!("{STAGE}/{CURRENT}/{name}"), &next)?;
        fs::rename(&next, folder.join(name))?;
    }
    sync_folder(folder);
    link(NEW, &next)?;
    fs::rename(next, current)?;
    sync_folder(&stage);
    settle(folder)
}

/// Puts the file that a link into the stage leads to in the link's place, and removes the stage. What is read stays
/// what it was.
fn settle(folder: &Path) -> Result<()> {
    let stage = folder.join(STAGE);
    if fs::symlink_metadata(&stage).is_err() {
        return Ok(());
    }
    let entries: Vec<_> = fs::read_dir(folder)?.collect::<Result<_>>()?;
    for path in entries.into_iter().map(|entry| entry.path()) {
        let Ok(target) = fs::read_link(&path) else {
            continue;
        };
        if target.starts_with(STAGE) {
            match fs::rename(folder.join(target), &path) {
                // Nothing stood here before.
                Err(error) if error.kind() == ErrorKind::NotFound => fs::remove_file(path)?,
                done => done?,
            }
        }
    }
    sync_folder(folder);
    fs::remove_dir_all(stage)
}

#[cfg(unix)]
fn link(target: &str, path: &Path) -> Result<()> {
    std::os::unix::fs::symlink(target, path)
}

#[cfg(not(unix))]
fn link(_: &str, _: &Path) -> Result<()> {
    Err(ErrorKind::Unsupported.into())
}
