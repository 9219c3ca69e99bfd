//! `-o` to places where a file can only be written over, and what is on the disk before a name changes.
//!
//! Pipes, devices, links, modes and the umask are in [`super::cli_streams`].

#![cfg(unix)]

use crate::program::cli::text;
use rustix::process::geteuid;
use std::fs::{self, Permissions};
use std::io::ErrorKind;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::thread::sleep;
use std::time::Duration;
use tempfile::TempDir;

/// A user who owns nothing.
const NOBODY: u32 = 65534;

/// A folder with the program and an old file in `held`, which takes no new files from the user the program runs as.
struct Place {
    root: TempDir,
    held: PathBuf,
    file: PathBuf,
}

impl Place {
    fn new(mode: u32) -> Self {
        let root = tempfile::tempdir().expect("a folder");
        let held = root.path().join("held");
        let file = held.join("report.txt");
        fs::copy(
            assert_cmd::cargo::cargo_bin("corfem"),
            root.path().join("corfem"),
        )
        .expect("copied");
        fs::create_dir(&held).expect("made");
        fs::write(&file, "old ".repeat(10_000)).expect("written");
        set(root.path(), 0o755);
        set(&file, mode);
        set(&held, 0o555);
        Self { root, held, file }
    }

    /// The program's shortest report; as nobody where everything is allowed to root.
    fn run(&self, to: &Path) -> Output {
        let mut command = Command::new(self.root.path().join("corfem"));
        command
            .args(["cases", "4", "-q", "-o"])
            .arg(to)
            .current_dir("/");
        if geteuid().is_root() {
            command.uid(NOBODY).gid(NOBODY);
        }
        // Another test may start a program of its own while the copy is still open for writing, and hold it open for a moment.
        for _ in 0..200 {
            match command.output() {
                Err(busy) if busy.kind() == ErrorKind::ExecutableFileBusy => {
                    sleep(Duration::from_millis(50))
                }
                done => return done.expect("it starts"),
            }
        }
        panic!("the program stays busy")
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        set(&self.held, 0o755);
    }
}

fn set(path: &Path, mode: u32) {
    fs::set_permissions(path, Permissions::from_mode(mode)).expect("set");
}

fn names(folder: &Path) -> usize {
    fs::read_dir(folder).expect("a folder").count()
}

fn report() -> Vec<u8> {
    crate::program::cli::corfem(&["cases", "4", "-q"]).stdout
}

#[test]
fn a_file_in_a_folder_that_takes_none_is_written_over() {
    let place = Place::new(0o666);
    let before = fs::metadata(&place.file).expect("it is there");
    let link = place.root.path().join("link");
    symlink("held/report.txt", &link).expect("made");
    for to in [&place.file, &link] {
        fs::write(&place.file, "old ".repeat(10_000)).expect("written");
        let output = place.run(to);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        assert_eq!(
            fs::read(&place.file).expect("it reads"),
            report(),
            "whole, and nothing of the old one"
        );
    }
    let after = fs::metadata(&place.file).expect("it is there");
    assert_eq!(
        (after.ino(), after.mode(), after.uid()),
        (before.ino(), before.mode(), before.uid())
    );
    assert!(link.is_symlink());
    assert_eq!(names(&place.held), 1);
}

#[test]
fn a_new_file_in_such_a_folder_and_one_that_may_not_be_written_are_refused() {
    let place = Place::new(0o444);
    let old = fs::read(&place.file).expect("it reads");
    for to in [place.held.join("new.txt"), place.file.clone()] {
        let refused = place.run(&to);
        assert_eq!(refused.status.code(), Some(2), "{}", to.display());
        assert!(
            text(&refused.stderr).contains("expected to write it"),
            "{}",
            text(&refused.stderr)
        );
    }
    assert_eq!(fs::read(&place.file).expect("it reads"), old);
    assert_eq!(names(&place.held), 1);
}

#[test]
fn anothers_file_stays_anothers() {
    if !geteuid().is_root() {
        println!("NOT RUN: only root can make a file for another user.");
        return;
    }
    let place = Place::new(0o666);
    // Files can be made here, but not given to the owner of the old one.
    set(&place.held, 0o777);
    let before = fs::metadata(&place.file).expect("it is there");
    assert_eq!(place.run(&place.file).status.code(), Some(0));
    let after = fs::metadata(&place.file).expect("it is there");
    assert_eq!(
        (after.ino(), after.uid(), after.mode()),
        (before.ino(), before.uid(), before.mode())
    );
    assert_eq!(fs::read(&place.file).expect("it reads"), report());
    assert_eq!(names(&place.held), 1, "what was staged is gone");
}

/// A regular file that no disk holds, in a folder that takes none from anybody.
#[cfg(target_os = "linux")]
#[test]
fn a_file_of_the_system_itself_is_written_over() {
    let place = Place::new(0o666);
    let output = place.run(Path::new("/proc/self/comm"));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
}

#[test]
fn a_file_that_may_not_be_written_is_refused_where_it_could_be_replaced() {
    let place = Place::new(0o444);
    set(&place.held, 0o777);
    assert_eq!(place.run(&place.file).status.code(), Some(2));
    assert!(
        fs::read_to_string(&place.file)
            .expect("it reads")
            .starts_with("old old")
    );
    assert_eq!(names(&place.held), 1);
}

/// A file that another is mounted on cannot be replaced by a new one of its name.
#[test]
fn a_file_that_is_mounted_is_written_over() {
    let place = Place::new(0o644);
    set(&place.held, 0o755);
    let other = place.held.join("other");
    fs::write(&other, "old").expect("written");
    let shell = "mount --bind \"$2\" \"$1\" && \"$3\" cases 4 -q -o \"$1\"";
    let words = [&place.file, &other, &place.root.path().join("corfem")];
    let run = |shell: &str| {
        Command::new("unshare")
            .args([
                "--user",
                "--map-root-user",
                "--mount",
                "sh",
                "-c",
                shell,
                "sh",
            ])
            .args(words)
            .output()
    };
    if !run("mount --bind \"$2\" \"$1\"").is_ok_and(|done| done.status.success()) {
        println!("NOT RUN: a file that is mounted. It needs unshare and the right to mount.");
        return;
    }
    let done = run(shell).expect("it starts");
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    assert_eq!(fs::read(&other).expect("it reads"), report());
    assert!(
        fs::read_to_string(&place.file)
            .expect("it reads")
            .starts_with("old old"),
        "what lies under it stays"
    );
}

/// The calls of a run that wait for the disk or change a name, in order.
fn calls(arguments: &[&str], folder: &Path) -> Option<Vec<String>> {
    let log = folder.join("log");
    let mut command = Command::new("strace");
    command
        .args([
            "-f",
            "-y",
            "-qq",
            "-e",
            "trace=fsync,?rename,?renameat,?renameat2",
            "-o",
        ])
        .arg(&log);
    command
        .arg(assert_cmd::cargo::cargo_bin("corfem"))
        .args(arguments)
        .current_dir(folder);
    if !command.status().is_ok_and(|status| status.success()) {
        println!("NOT RUN: the order of system calls. It needs strace.");
        return None;
    }
    Some(
        fs::read_to_string(log)
            .expect("it reads")
            .lines()
            .map(str::to_owned)
            .collect(),
    )
}

#[test]
fn new_files_are_on_the_disk_before_they_take_a_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let Some(calls) = calls(&["cases", "4", "-q", "-o", "report.txt"], folder.path()) else {
        return;
    };
    let kinds: Vec<&str> = calls
        .iter()
        .map(|call| {
            if call.contains("fsync(") {
                "sync"
            } else {
                "rename"
            }
        })
        .collect();
    assert_eq!(kinds, ["sync", "rename", "sync"], "{calls:?}");
    let out = tempfile::tempdir().expect("a folder");
    let Some(calls) = self::calls(&["figures", "-q", "-o", "figures"], out.path()) else {
        return;
    };
    let first = calls
        .iter()
        .position(|call| call.contains("rename"))
        .expect("names change");
    let (before, after) = calls.split_at(first);
    let files = names(&out.path().join("figures"));
    let synced = before
        .iter()
        .filter(|call| call.contains("/new/") && call.contains("fsync("))
        .count();
    assert_eq!(synced, files, "every file");
    let turn = after
        .iter()
        .position(|call| call.contains("current\""))
        .expect("the set is turned");
    assert!(
        after[turn - 1].contains("fsync(") && after[turn + 1].contains("fsync("),
        "around the turn: {after:?}"
    );
}
