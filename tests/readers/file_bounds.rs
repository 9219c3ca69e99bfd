//! Files that are none or have no end: refused before a byte of them is read.
#![cfg(unix)]

use crate::prelude::*;
use corfem::files::{MOST_BYTES, read_bytes};

use fs::{File, remove_file};
use std::os::unix::fs::symlink;

/// Puts something endless in the place of a file; the reason for which it is refused.
fn endless(path: &Path, kind: usize) -> &'static str {
    let not_regular = "it is not a regular file; copy what it gives into one";
    remove_file(path).unwrap();
    match kind {
        0 => symlink("/dev/zero", path).unwrap(),
        1 => assert!(Command::new("mkfifo").arg(path).status().unwrap().success()),
        2 => {
            fs::create_dir(path).unwrap();
            return "it is a folder; name a file in it";
        }
        _ => {
            // Of four gigabytes, none of which is on the disk.
            File::create(path)
                .and_then(|file| file.set_len(4 << 30))
                .unwrap();
            return "it is longer than 2147483648 bytes, the most that corfem reads";
        }
    }
    not_regular
}

#[test]
fn every_file_of_a_job_is_a_regular_file_of_bounded_length() {
    let all = [
        (rods(), vec!["job.toml", "model.bdf", "test.csv"]),
        (
            building(),
            vec![
                "stiffness.mtx",
                "mass.mtx",
                "rows.csv",
                "test.csv",
                "story_3.mtx",
            ],
        ),
    ];
    for (files, names) in all {
        for name in names {
            for kind in 0..4 {
                let (folder, path) = placed(&files);
                let reason = endless(&folder.path().join(name), kind);
                let error = prepare(&path).map(drop).expect_err(name).to_string();
                assert!(
                    error.starts_with("cannot read ") && error.contains(name),
                    "{error}"
                );
                assert!(error.ends_with(reason), "{error}");
            }
        }
    }
}

#[test]
fn a_file_that_ends_is_read_whole() {
    let folder = new_folder();
    let path = folder.path().join("file");
    fs::write(&path, "\u{0}a file\n").unwrap();
    assert_eq!(read_bytes(&path).unwrap(), b"\0a file\n");
    assert_eq!(MOST_BYTES, 2 << 30);
}
