//! Whatever the terminal, home, time zone and language of who runs it, the program writes the same bytes.

use crate::prelude::*;
use corfem::job::FILES;
use std::process::Command;

/// Variables with another value, or without one.
const OTHERS: [&[(&str, Option<&str>)]; 4] = [
    &[
        ("TERM", None),
        ("HOME", None),
        ("TZ", None),
        ("LANG", None),
        ("LC_ALL", None),
    ],
    &[("TERM", Some("dumb")), ("HOME", Some("/nowhere"))],
    &[
        ("TERM", Some("xterm-256color")),
        ("TZ", Some("Asia/Kathmandu")),
        ("CLICOLOR_FORCE", Some("1")),
    ],
    &[
        ("LANG", Some("de_DE.UTF-8")),
        ("LC_ALL", Some("tr_TR.UTF-8")),
        ("LC_NUMERIC", Some("fr_FR.UTF-8")),
    ],
];

#[test]
fn terminal_home_time_zone_and_language_make_no_difference() {
    let (folder, job) = placed(&rods());
    let job = job.to_str().unwrap();
    let path = folder.path().join("out");
    let out = path.to_str().unwrap();
    let run = |words: &[&str], variables: &[(&str, Option<&str>)]| {
        let mut command = Command::new(assert_cmd::cargo::cargo_bin("corfem"));
        command.args(words);
        for (name, value) in variables {
            match value {
                Some(value) => command.env(name, value),
                None => command.env_remove(name),
            };
        }
        let output = command.output().unwrap();
        let written = FILES.map(|name| fs::read(path.join(name)).ok());
        (output.status.code(), output.stdout, output.stderr, written)
    };
    for words in [
        &["correlate", job, "--folder", out][..],
        &["study", "--help"],
        &["tables", "1", "5"],
        &["correlate", "no such job.toml"],
        &["correlates"],
    ] {
        let usual = run(words, &[("TERM", Some("xterm"))]);
        for variables in OTHERS {
            assert!(run(words, variables) == usual, "{words:?} {variables:?}");
        }
    }
}
