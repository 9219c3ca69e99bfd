//! Standard output, standard error and `-o`: what cannot be written is said, and nothing else is touched.

#![cfg(unix)]

use crate::prelude::*;
use crate::presentation::program::cli::{corfem, text};
use fs::File;
use std::os::unix::fs::{FileTypeExt, MetadataExt, PermissionsExt, symlink};
use std::process::Output;

/// Case 4 is the shortest report.
const SHORT: [&str; 3] = ["cases", "4", "-q"];

fn program(arguments: &[&str]) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin("corfem"));
    command.args(arguments);
    command
}

fn full() -> Stdio {
    File::options()
        .write(true)
        .open("/dev/full")
        .unwrap()
        .into()
}

fn to_file(path: &Path) -> Output {
    corfem(&[&SHORT[..], &["-o", path.to_str().unwrap()]].concat())
}

fn report() -> Vec<u8> {
    corfem(&SHORT).stdout
}

#[test]
fn standard_output_that_takes_nothing_is_an_error() {
    for arguments in [&SHORT[..], &["deck", "4"], &["tables", "13", "-o", "-"]] {
        let output = program(arguments).stdout(full()).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let said = text(&output.stderr);
        assert!(
            said.starts_with("corfem: cannot write standard output: No space"),
            "{said}"
        );
    }
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = program(&SHORT).stdout(writer).output().unwrap();
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
}

#[test]
fn nobody_listening_on_standard_error_changes_nothing() {
    for (arguments, status) in [
        (&["cases", "4"][..], 0),
        (&["cases", "9"], 2),
        (&["cases", "x"], 2),
    ] {
        let output = program(arguments).stderr(full()).output().unwrap();
        assert_eq!(output.status.code(), Some(status), "{arguments:?}");
    }
}

#[test]
fn a_dash_and_names_of_standard_output_are_standard_output() {
    let folder = new_folder();
    // Another descriptor, and a file it is appended to.
    let shell = "echo before > log; \"$0\" cases 4 -q -o /dev/stderr 2>> log; cat log; rm log";
    let program_path = assert_cmd::cargo::cargo_bin("corfem");
    let output = Command::new("sh")
        .args(["-c", shell])
        .arg(program_path)
        .current_dir(folder.path())
        .output();
    assert_eq!(
        output.unwrap().stdout,
        [b"before\n", &report()[..]].concat()
    );
    for name in ["-", "/dev/stdout", "/dev/fd/1"] {
        let arguments = [&SHORT[..], &["-o", name]].concat();
        let output = program(&arguments)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0), "{name}");
        assert_eq!(output.stdout, report(), "{name}");
        // A file it is appended to keeps what it has.
        let path = folder.path().join("log");
        fs::write(&path, "before\n").unwrap();
        let log = File::options().append(true).open(&path).unwrap();
        assert!(program(&arguments).stdout(log).status().unwrap().success());
        assert_eq!(
            fs::read(&path).unwrap(),
            [b"before\n", &report()[..]].concat()
        );
    }
    assert_eq!(
        fs::read_dir(folder.path()).unwrap().count(),
        1,
        "no file is called -"
    );
}

#[test]
fn devices_and_pipes_are_written_through_and_stay_what_they_are() {
    assert_eq!(to_file(Path::new("/dev/null")).status.code(), Some(0));
    assert!(
        fs::metadata("/dev/null")
            .unwrap()
            .file_type()
            .is_char_device()
    );
    let refused = to_file(Path::new("/dev/full"));
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).starts_with("corfem: cannot write /dev/full: "));
    let folder = new_folder();
    let pipe = folder.path().join("pipe");
    assert!(
        Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read(pipe).unwrap()
    });
    assert_eq!(to_file(&pipe).status.code(), Some(0));
    assert_eq!(reader.join().unwrap(), report());
    assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
}

#[test]
fn links_are_followed_and_modes_are_those_of_new_files() {
    let folder = new_folder();
    let path = |name: &str| folder.path().join(name);
    symlink("there.txt", path("link")).unwrap();
    symlink("link", path("link to link")).unwrap();
    // To nothing yet, and then to a file with a mode of its own.
    assert_eq!(to_file(&path("link to link")).status.code(), Some(2));
    fs::write(path("there.txt"), "before").unwrap();
    fs::set_permissions(path("there.txt"), PermissionsExt::from_mode(0o604)).unwrap();
    assert_eq!(to_file(&path("link to link")).status.code(), Some(0));
    assert_eq!(fs::read(path("there.txt")).unwrap(), report());
    let mode = |name: &str| fs::metadata(path(name)).unwrap().mode() & 0o777;
    fs::write(path("new"), "").unwrap();
    assert_eq!(mode("there.txt"), mode("new"));
    fs::remove_file(path("new")).unwrap();
    // A link that leads to itself leads nowhere.
    symlink("circle", path("circle")).unwrap();
    assert_eq!(to_file(&path("circle")).status.code(), Some(2));
    fs::remove_file(path("circle")).unwrap();
    assert!(path("link").is_symlink() && path("link to link").is_symlink());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
}

#[test]
fn new_files_and_folders_have_the_rights_of_the_umask() {
    let folder = new_folder();
    let program = assert_cmd::cargo::cargo_bin("corfem");
    let shell = "umask 027; \"$0\" cases 4 -q -o file && \"$0\" figures -q --folder out && stat -c %a file out out/box_points.svg";
    let output = Command::new("sh")
        .args(["-c", shell])
        .arg(program)
        .current_dir(folder.path())
        .output();
    assert_eq!(text(&output.unwrap().stdout), "640\n750\n640\n");
}

#[test]
fn control_characters_in_an_error_are_shown() {
    let said = text(&corfem(&["modes", "no\u{1b}[31m.dat"]).stderr);
    assert!(
        said.starts_with("corfem: cannot read no\\u{1b}[31m.dat: "),
        "{said}"
    );
}

#[test]
fn letters_lines_and_tabs_of_an_error_are_shown_as_they_are() {
    let words = "expected \"Fl\u{fc}gel\",\n\tfound 'C:\\x'";
    assert_eq!(corfem::files::escaped(words), words);
    assert_eq!(
        corfem::files::escaped("\u{1b}[2J\r\u{9b}"),
        "\\u{1b}[2J\\r\\u{9b}"
    );
}
