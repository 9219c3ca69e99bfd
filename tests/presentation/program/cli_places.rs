//! `-o` to places where no new file can be made, and what is on the disk before a name changes.
//!
//! Pipes, devices, links and the umask are in [`super::cli_streams`].

#![cfg(unix)]

use crate::prelude::*;
use crate::presentation::program::cli::text;
use fs::Permissions;
use rustix::process::geteuid;
use std::io::ErrorKind;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::os::unix::process::CommandExt;
use std::process::Output;
use std::thread::sleep;

/// A user who owns nothing.
const NOBODY: u32 = 65534;

/// A folder with the program and an old file in `held`, which takes no new files from the user the program runs as.
struct Place {
    root: TempDir,
    held: PathBuf,
    file: PathBuf,
}

impl Place {
    fn new() -> Self {
        let root = new_folder();
        let held = root.path().join("held");
        let file = held.join("report.txt");
        fs::copy(
            assert_cmd::cargo::cargo_bin("corfem"),
            root.path().join("corfem"),
        )
        .unwrap();
        fs::create_dir(&held).unwrap();
        fs::write(&file, "old ".repeat(10_000)).unwrap();
        set(root.path(), 0o755);
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
                done => return done.unwrap(),
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
    fs::set_permissions(path, Permissions::from_mode(mode)).unwrap();
}

fn names(folder: &Path) -> usize {
    fs::read_dir(folder).unwrap().count()
}

/// A new file takes the place of the old one, so that the folder must take it.
#[test]
fn a_folder_that_takes_no_files_is_refused() {
    let place = Place::new();
    let old = fs::read(&place.file).unwrap();
    let link = place.root.path().join("link");
    symlink("held/report.txt", &link).unwrap();
    for to in [&place.file, &link] {
        let refused = place.run(to);
        assert_eq!(refused.status.code(), Some(2), "{}", to.display());
        let said = text(&refused.stderr);
        assert!(said.contains("cannot write "), "{said}");
    }
    assert_eq!(fs::read(&place.file).unwrap(), old);
    assert_eq!(names(&place.held), 1);
}

/// The calls of a run that wait for the disk or change a name, in order.
fn calls(arguments: &[&str], folder: &Path) -> Vec<String> {
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
    assert!(command.status().unwrap().success());
    fs::read_to_string(log)
        .unwrap()
        .lines()
        .map(str::to_owned)
        .collect()
}

#[test]
#[ignore = "needs strace"]
fn new_files_are_on_the_disk_before_they_take_a_name() {
    let folder = new_folder();
    let calls = calls(&["cases", "4", "-q", "-o", "report.txt"], folder.path());
    let kinds = calls
        .iter()
        .map(|call| {
            if call.contains("fsync(") {
                "sync"
            } else {
                "rename"
            }
        })
        .collect_vec();
    assert_eq!(kinds, ["sync", "rename"], "{calls:?}");
    let out = new_folder();
    let calls = self::calls(&["figures", "-q", "--folder", "figures"], out.path());
    // Every file before its name.
    let kinds: String = calls
        .iter()
        .map(|call| if call.contains("fsync(") { 's' } else { 'r' })
        .collect();
    assert_eq!(kinds, "sr".repeat(names(&out.path().join("figures"))));
}

/// The law: no command writes over what it reads, by whatever name.
#[test]
fn no_output_takes_the_place_of_an_input() {
    for name in ["shapes.csv", "factors.csv", "modes.csv"] {
        let mut files = building();
        let job = file(&mut files, "job.toml");
        *job = job.replace("\"test.csv\"", &format!("{name:?}"));
        let test = files.iter_mut().find(|(own, _)| own == "test.csv");
        test.unwrap().0 = name.to_owned();
        let (folder, _) = placed(&files);
        symlink(folder.path(), folder.path().join("link")).unwrap();
        let commands = [
            "correlate job.toml --folder .".to_owned(),
            "correlate job.toml --folder link".to_owned(),
            format!("correlate job.toml -o link/{name}"),
            "correlate job.toml -o job.toml".to_owned(),
            format!("check job.toml -o {name}"),
            "modes --stiffness stiffness.mtx --mass mass.mtx -o link/mass.mtx".to_owned(),
        ];
        for command in commands {
            let mut program = Command::new(assert_cmd::cargo::cargo_bin("corfem"));
            let program = program.args(command.split(' ')).current_dir(folder.path());
            let found = program.output().unwrap();
            let words = text(&found.stderr);
            assert_eq!(found.status.code(), Some(2), "{command}: {words}");
            assert!(words.contains("this run reads it"), "{command}: {words}");
            for (name, text) in &files {
                assert!(fs::read_to_string(folder.path().join(name)).unwrap() == *text);
            }
            let count = fs::read_dir(folder.path()).unwrap().count();
            assert_eq!(count, files.len() + 1, "{command}");
        }
    }
}
