//! The program by transcripts: what is typed, and what then stands on its streams and in its folder.
//!
//! A line begins with its mark: `#` a law, in a new folder; `@` a job that is put there; `>` a file, whose lines end with `<`; `~` what
//! replaces what in a file; `/` a new folder; `$` a command, behind the mark its status if it is not zero; `|` words on standard output,
//! `!` on standard error, `%` in a file; `:` a value at a place of the JSON on standard output, or its length behind `#`; `[` all that
//! the folder holds. Words stand there whatever the breaks of lines, and ` … ` is anything between them. Behind `|`, `!` or a file's name,
//! `^` is how it begins, `-` what is not there, `.` that it is empty, `=` the command that prints the same, `#` its number of lines and
//! `<` the most characters of a line.

use crate::common::jobs::folder_of;
use crate::common::jobs::unbroken;
use crate::prelude::*;
use crate::presentation::program::cli::text;
use std::process::Output;

fn ran(folder: &Path, words: &str) -> Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin("corfem"));
    let words = words
        .split('\'')
        .enumerate()
        .flat_map(|(place, part)| match place % 2 {
            0 => part.split_whitespace().collect_vec(),
            _ => vec![part],
        });
    command
        .args(words.skip(1))
        .current_dir(folder)
        .output()
        .unwrap()
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

fn job_into(folder: &Path, name: &str) {
    let files = match name {
        "rods" => rods(),
        name => {
            let files = fs::read_dir(folder_of(name))
                .unwrap()
                .map(|file| file.unwrap());
            let read = |file: fs::DirEntry| {
                let text = fs::read_to_string(file.path()).unwrap();
                (file.file_name().into_string().unwrap(), text)
            };
            files.map(read).collect()
        }
    };
    for (name, text) in files {
        fs::write(folder.join(name), text).unwrap();
    }
}

/// Holds the laws of a transcript.
fn play(transcript: &str) {
    let (mut folder, mut law) = (new_folder(), "");
    let (mut said, mut failed) = (None::<Output>, Vec::new());
    let mut lines = transcript.lines();
    while let Some(line) = lines.next() {
        let (mark, rest) = line.split_once(' ').unwrap_or((line, ""));
        let here = folder.path();
        let output = |stream: fn(&Output) -> &Vec<u8>| {
            said.as_ref()
                .map_or_else(String::new, |said| text(stream(said)))
        };
        let out = || output(|said| &said.stdout);
        let is_right = match mark.split_at(mark.len().min(1)) {
            ("", _) => true,
            ("#", _) => {
                (folder, law) = (new_folder(), rest);
                true
            }
            ("@", _) => {
                job_into(here, rest);
                true
            }
            (">", _) => {
                let text = lines.by_ref().take_while(|line| *line != "<");
                let text: String = text.map(|line| format!("{line}\n")).collect();
                fs::write(here.join(rest), text).is_ok()
            }
            ("~", _) => {
                let [file, old, new] = rest.split(" | ").collect_vec()[..] else {
                    panic!("{line}")
                };
                let [old, new] = [old, new].map(|text| text.replace("\\n", "\n"));
                let text = fs::read_to_string(here.join(file)).unwrap();
                text.contains(&old)
                    && fs::write(here.join(file), text.replacen(&old, &new, 1)).is_ok()
            }
            ("/", _) => fs::create_dir_all(here.join(rest)).is_ok(),
            ("$", status) => {
                let done = said.insert(ran(here, rest));
                done.status.code() == Some(status.parse().unwrap_or(0))
            }
            ("|", mark) => is(&out(), mark, rest, here),
            ("!", mark) => is(&output(|said| &said.stderr), mark, rest, here),
            ("%", mark) => {
                let (file, words) = rest.split_once(' ').unwrap_or((rest, ""));
                is(
                    &fs::read_to_string(here.join(file)).unwrap_or_default(),
                    mark,
                    words,
                    here,
                )
            }
            (":", _) => has_value(&out(), rest),
            ("[", _) => {
                let names = fs::read_dir(here)
                    .unwrap()
                    .map(|file| file.unwrap().file_name());
                let names: BTreeSet<_> = names.map(|name| name.into_string().unwrap()).collect();
                names.into_iter().collect_vec().join(" ") == rest
            }
            _ => panic!("{line}"),
        };
        if !is_right {
            failed.push(format!("{law}: {line}\n{said:?}"));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n\n"));
}

macro_rules! transcripts {
    ($($name:ident)+) => {$(
        #[test]
        fn $name() {
            play(include_str!(concat!("transcripts/", stringify!($name), ".txt")));
        }
    )+};
}

transcripts! { cases modes jobs outputs tables }
