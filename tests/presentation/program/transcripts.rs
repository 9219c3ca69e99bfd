//! The program by transcripts: what is typed, and what then stands on its streams and in its folder.
//!
//! A line begins with its mark: `#` a law, in a new folder; `@` a job that is put there; `>` a file, whose lines end with `<`; `~` what
//! replaces what in a file; `$` a command for the shell, behind the mark its status if it is not zero; `|` words on standard output,
//! `!` on standard error, `%` in a file; `:` a value at a place of the JSON on standard output, or its length behind `#`; `[` all that
//! the folder holds. Words stand there whatever the breaks of lines, and ` … ` is anything between them. Behind `|`, `!` or a file's name,
//! `^` is how it begins, `-` what is not there, `.` that it is empty, `=` the command that prints the same, `#` its number of lines and
//! `<` the most characters of a line.

use crate::common::jobs::{files_of, unbroken};
use crate::prelude::*;
use std::process::Output;

/// A command, by the shell, which finds the program first.
fn ran(folder: &Path, words: &str) -> Output {
    let program = assert_cmd::cargo::cargo_bin("corfem");
    let paths = std::env::var("PATH").unwrap();
    let paths = format!("{}:{paths}", program.parent().unwrap().display());
    let mut shell = Command::new("sh");
    shell.args(["-c", words]).env("PATH", paths);
    shell.current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Whether a text is what a mark says of it.
fn is(found: &str, mark: &str, words: &str, folder: &Path) -> bool {
    let (text, words) = (unbroken(found), words.trim());
    let has = || {
        let mut rest = &text[..];
        words.split(" … ").all(|part| {
            let Some((_, behind)) = rest.split_once(part) else {
                return false;
            };
            rest = behind;
            true
        })
    };
    match mark {
        "" => has(),
        "-" => !has(),
        "^" => text.starts_with(words),
        "." => found.is_empty(),
        "=" => found == self::text(&ran(folder, words).stdout),
        "#" => found.lines().count().to_string() == words,
        "<" => found
            .lines()
            .all(|line| line.chars().count() <= words.parse::<usize>().unwrap()),
        _ => panic!("the mark {mark}"),
    }
}

/// Whether JSON has a value at a place, or a list of a length.
fn has_value(document: &str, words: &str) -> bool {
    let document: Value = serde_json::from_str(document).unwrap();
    let (place, asked) = words.split_once(' ').unwrap();
    let found = document.pointer(place);
    match asked.strip_prefix('#') {
        Some(length) => found.and_then(Value::as_array).map(Vec::len) == length.parse().ok(),
        None => found == Some(&serde_json::from_str(asked).unwrap()),
    }
}

/// Holds the laws of a transcript.
fn play(transcript: &str) {
    let (mut folder, mut law) = (new_folder(), "");
    let (mut out, mut errors, mut failed) = (String::new(), String::new(), Vec::new());
    let mut lines = transcript.lines();
    while let Some(line) = lines.next() {
        let (mark, rest) = line.split_once(' ').unwrap_or((line, ""));
        let here = folder.path();
        let read = |name: &str| fs::read_to_string(here.join(name)).unwrap_or_default();
        let put = |name: &str, text: &str| fs::write(here.join(name), text).unwrap();
        let mut is_right = true;
        match mark.split_at(mark.len().min(1)) {
            ("", _) => (),
            ("#", _) => (folder, law) = (new_folder(), rest),
            ("@", _) => {
                let files = if rest == "rods" {
                    rods()
                } else {
                    files_of(rest)
                };
                files.iter().for_each(|(name, text)| put(name, text));
            }
            (">", _) => {
                let text = lines.by_ref().take_while(|line| *line != "<");
                put(
                    rest,
                    &text.map(|line| format!("{line}\n")).collect::<String>(),
                );
            }
            ("~", _) => {
                let rest = rest.replace("\\n", "\n");
                let [file, old, new] = rest.split(" | ").collect_vec()[..] else {
                    panic!("{line}")
                };
                is_right = read(file).contains(old);
                put(file, &read(file).replacen(old, new, 1));
            }
            ("$", status) => {
                let done = ran(here, rest);
                is_right = done.status.code() == Some(status.parse().unwrap_or(0));
                (out, errors) = (text(&done.stdout), text(&done.stderr));
            }
            ("|", mark) => is_right = is(&out, mark, rest, here),
            ("!", mark) => is_right = is(&errors, mark, rest, here),
            ("%", mark) => {
                let (file, words) = rest.split_once(' ').unwrap_or((rest, ""));
                is_right = is(&read(file), mark, words, here);
            }
            (":", _) => is_right = has_value(&out, rest),
            ("[", _) => {
                let names = fs::read_dir(here).unwrap().flatten();
                let names = names.map(|file| file.file_name().into_string().unwrap());
                let names: BTreeSet<String> = names.collect();
                is_right = names.into_iter().collect_vec().join(" ") == rest;
            }
            _ => panic!("{line}"),
        }
        if !is_right {
            failed.push(format!("{law}: {line}\n{out}{errors}"));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n\n"));
}

macro_rules! transcripts {
    ($($(#[$about:meta])* $name:ident)+) => {$(
        #[test]
        $(#[$about])*
        fn $name() {
            play(include_str!(concat!("transcripts/", stringify!($name), ".txt")));
        }
    )+};
}

transcripts! {
    cases
    modes
    jobs
    outputs
    streams
    tables
    #[ignore = "needs strace"]
    new_files_are_on_the_disk_before_they_take_a_name
}
