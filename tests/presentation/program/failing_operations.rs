//! Every operation on a file fails once, the first, the second and so on, until the program does not come to it any more: it ends
//! with status 2 and names the file, every file is old or new and whole, and what the next run finds is enough for it.

use crate::prelude::*;
use crate::presentation::program::cli::text;
use std::process::Output;

/// What makes an operation fail, in a build with debug assertions.
const VARIABLE: &str = "CORFEM_FAILING_OPERATION";
const OLD: &[u8] = b"old";

/// Names and bytes of a folder.
type Files = BTreeMap<String, Vec<u8>>;

fn files(folder: &Path) -> Files {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let named = |entry: fs::DirEntry| {
        let name = entry.file_name().into_string().unwrap();
        (name, fs::read(entry.path()).unwrap())
    };
    entries.map(named).collect()
}

/// A command, to which the folder it writes into is added.
struct Run {
    words: Vec<String>,
    /// Status when nothing fails.
    status: Option<i32>,
    /// What the folder then holds.
    new: Files,
}

impl Run {
    fn of(words: &[&str]) -> Self {
        let mut run = Run {
            words: words.iter().map(|word| (*word).to_owned()).collect(),
            status: None,
            new: Files::new(),
        };
        let folder = new_folder();
        let out = folder.path().join("out");
        let output = run.output(folder.path(), None);
        run.status = output.status.code();
        run.new = files(&out);
        assert!(
            [Some(0), Some(3)].contains(&run.status),
            "{}",
            text(&output.stderr)
        );
        run
    }

    /// Runs it in a folder, whose `out` it writes into and whose `temporary`, if there is one, is for temporary files.
    fn output(&self, folder: &Path, failing: Option<usize>) -> Output {
        Command::new(assert_cmd::cargo::cargo_bin("corfem"))
            .args(&self.words)
            .arg("out")
            .current_dir(folder)
            .env("TMPDIR", folder.join("temporary"))
            .envs(failing.map(|number| (VARIABLE, number.to_string())))
            .output()
            .unwrap()
    }

    /// The same files with another text.
    fn old(&self) -> Files {
        let old = |name: &String| (name.clone(), OLD.to_vec());
        self.new.keys().map(old).collect()
    }

    /// Makes an operation fail in a folder that holds these files, or in a new one; its kind, or none if there are not so many.
    fn fail(&self, number: usize, before: Option<&Files>) -> Option<String> {
        let folder = new_folder();
        let [out, temporary] = ["out", "temporary"].map(|name| folder.path().join(name));
        fs::create_dir(&temporary).unwrap();
        if let Some(files) = before {
            fs::create_dir(&out).unwrap();
            for (name, bytes) in files {
                fs::write(out.join(name), bytes).unwrap();
            }
        }
        let output = self.output(folder.path(), Some(number));
        let (found, said) = (files(&out), text(&output.stderr));
        let context = format!("operation {number} of {:?}: {said}", self.words);
        assert!(files(&temporary).is_empty(), "{context}");
        if output.status.code() == self.status {
            assert!(found == self.new, "{context}");
            return None;
        }
        assert_eq!(output.status.code(), Some(2), "{context}");
        // cannot write FILE: CORFEM_FAILING_OPERATION made it fail to sync FILE
        let error = said
            .lines()
            .last()
            .and_then(|line| line.strip_prefix("corfem: cannot "));
        let reason = format!(": {VARIABLE} made it fail to ");
        let (named, failed) = error
            .and_then(|error| error.split_once(&reason))
            .expect(&context);
        let (kind, path) = failed.split_once(' ').expect(&context);
        let path = path.trim_start_matches("a file in ").trim_end_matches("/.");
        let (_, named) = named.split_once(' ').expect(&context);
        // A new folder is tried where it will be.
        assert!(path == "." || named.starts_with(path), "{context}");
        let none = Files::new();
        let before = before.unwrap_or(&none);
        assert!(
            before.keys().all(|name| found.contains_key(name)),
            "nothing old is lost: {context}"
        );
        for (name, bytes) in &found {
            let is_samples = name == "samples.csv";
            let is = |files: &Files| {
                files.get(name).is_some_and(|whole| {
                    // A study adds whole lines to those that are there.
                    whole == bytes
                        || is_samples
                            && whole.starts_with(bytes)
                            && bytes.last().is_none_or(|last| *last == b'\n')
                })
            };
            assert!(
                is(&self.new) || is(before),
                "{name} is neither old nor new: {context}"
            );
        }
        if found.contains_key("samples.csv") {
            // What is there is enough to go on with.
            let resumed = self.output(folder.path(), None);
            assert_eq!(
                resumed.status.code(),
                self.status,
                "{}",
                text(&resumed.stderr)
            );
            assert!(files(&out) == self.new, "{context}");
        }
        Some(kind.to_owned())
    }

    /// Makes every operation fail, until there are no more; how many there are of each kind.
    fn fail_each(&self, before: Option<&Files>) -> BTreeMap<String, usize> {
        let mut kinds = BTreeMap::new();
        for kind in (1..).map_while(|number| self.fail(number, before)) {
            *kinds.entry(kind).or_default() += 1;
        }
        kinds
    }
}

/// Every file that a command replaces is made, written, synced and renamed, and then its folder is synced.
fn assert_replaced(kinds: &BTreeMap<String, usize>, count: usize, of_folder: usize) {
    let of = |kind: &str| kinds.get(kind).copied().unwrap_or_default();
    assert_eq!([of("sync"), of("rename")], [2 * count, count], "{kinds:?}");
    assert!(of("write") >= count, "{kinds:?}");
    // And the folder is tried, and made if it is new.
    assert_eq!(of("create"), count + of_folder, "{kinds:?}");
}

#[test]
fn a_correlation_in_which_any_operation_fails_loses_nothing() {
    let (_folder, job) = placed(&rods());
    let run = Run::of(&["correlate", "-q", job.to_str().unwrap(), "--folder"]);
    assert_eq!(run.new.len(), 7);
    let kinds = run.fail_each(Some(&run.old()));
    assert_replaced(&kinds, 7, 1);
    // Three files of the job are opened and read, and once more for the identity of the run.
    assert!(kinds["read"] >= 6 && kinds["open"] >= 6 + 7, "{kinds:?}");
    assert_replaced(&run.fail_each(None), 7, 2);
}

#[test]
fn a_study_in_which_any_operation_fails_loses_nothing_and_is_resumed() {
    let (_folder, job) = placed(&rods());
    let job = job.to_str().unwrap();
    let run = Run::of(&[
        "study",
        "-q",
        job,
        "--samples",
        "2",
        "--threads",
        "1",
        "--folder",
    ]);
    assert_eq!(run.new.len(), 2);
    assert_replaced(&run.fail_each(None), 1, 2);
    // A torn line of the second sample is cut off, and the statistics are not of this study.
    let mut torn = run.old();
    let samples = &run.new["samples.csv"];
    torn.insert(
        "samples.csv".to_owned(),
        samples[..samples.len() - 9].to_vec(),
    );
    assert_replaced(&run.fail_each(Some(&torn)), 1, 1);
}

#[test]
fn a_report_in_which_any_operation_fails_leaves_the_old_one_or_the_new_one() {
    let run = Run::of(&["report", "-q", "--folder"]);
    assert_eq!(run.new.len(), 1);
    assert_replaced(&run.fail_each(Some(&run.old())), 1, 1);
}

/// One operation of every kind, each on another figure and the last on the last: all of them take minutes.
#[test]
fn figures_of_which_one_fails_leave_each_old_or_new() {
    let run = Run::of(&["figures", "-q", "--folder"]);
    let (old, count) = (run.old(), run.new.len());
    let steps = ["open", "create", "write", "sync", "rename", "sync"];
    for (step, kind) in steps.into_iter().enumerate() {
        let figure = step * (count - 1) / (steps.len() - 1);
        // The folder is tried and every old file looked at before.
        let number = 1 + count + steps.len() * figure + step + 1;
        assert_eq!(run.fail(number, Some(&old)).as_deref(), Some(kind));
    }
}

#[test]
#[ignore = "minutes: every operation on some twenty figures"]
fn figures_in_which_any_operation_fails_are_each_old_or_new() {
    let run = Run::of(&["figures", "-q", "--folder"]);
    let count = run.new.len();
    assert_replaced(&run.fail_each(Some(&run.old())), count, 1);
    assert_replaced(&run.fail_each(None), count, 2);
}
