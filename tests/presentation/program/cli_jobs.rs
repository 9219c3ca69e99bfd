//! `corfem correlate` and `corfem check JOB` from outside: what they print, write and leave alone.

use crate::common::jobs::{folder_of, unbroken};
use crate::prelude::*;
use crate::presentation::program::cli::{corfem, text, words};
use corfem::present::render::WIDTH;
use std::process::Output;

/// The worked jobs, and whether their models are decks.
const JOBS: [(&str, bool); 3] = [("box", true), ("building", false), ("wing", true)];

fn correlate(job: &Path, more: &[&str]) -> Output {
    corfem(&[&["correlate", words(job), "-q"], more].concat())
}

/// What a worked job prints and writes into a folder.
pub struct Reported {
    report: String,
    pub files: BTreeMap<String, String>,
}

impl Reported {
    pub fn of(job: &Path) -> Self {
        let folder = new_folder();
        let output = correlate(job, &["--folder", words(folder.path())]);
        // The page says how the job was run.
        let read = |file: String| {
            let text = fs::read_to_string(folder.path().join(&file)).unwrap();
            (file, text.replace(words(job), "job.toml"))
        };
        let found = Self {
            report: text(&output.stdout),
            files: names(folder.path()).into_iter().map(read).collect(),
        };
        let status = if found.json()["is_within"] == true {
            0
        } else {
            3
        };
        assert_eq!(
            (output.status.code(), text(&output.stderr)),
            (Some(status), String::new()),
            "{}",
            job.display()
        );
        found
    }

    /// Asserts that another run printed and wrote the same bytes.
    pub fn assert_same(&self, other: &Self) {
        assert_eq!(self.report, other.report);
        assert!(self.files.keys().eq(other.files.keys()));
        for (file, text) in &self.files {
            assert!(other.files[file] == *text, "{file}");
        }
    }

    pub fn json(&self) -> Value {
        serde_json::from_str(&self.files["correlation.json"]).unwrap()
    }
}

/// The worked jobs, each run once for all tests.
pub fn reported(name: &str) -> &'static Reported {
    static FIRST: [OnceLock<Reported>; 3] = [const { OnceLock::new() }; 3];
    let place = JOBS.iter().position(|(job, _)| *job == name);
    FIRST[place.unwrap()].get_or_init(|| Reported::of(&folder_of(name).join("job.toml")))
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

#[test]
fn a_worked_job_has_its_report_its_factors_and_its_deck() {
    for (name, is_deck) in JOBS {
        let Reported { report, files } = reported(name);
        let mut expected = BTreeSet::from([
            "correlation.json",
            "factors.csv",
            "modes.csv",
            "report.html",
            "shapes.csv",
            "shapes.unv",
        ]);
        let model = ["corrected.bdf", "mass.mtx", "stiffness.mtx"];
        expected.extend(if is_deck { &model[..1] } else { &model[1..] });
        assert!(files.keys().eq(&expected), "{name}");
        let found = reported(name).json();
        let count = |key: &str| found[key].as_array().unwrap().len();
        assert!(!is_deck || found["is_within"] == true, "{name}");
        assert!(
            found["misfit"]["degrees_of_freedom"].as_f64() > Some(0.0),
            "{name}"
        );
        for (file, rows) in [
            ("factors", "parameters"),
            ("modes", "modes"),
            ("shapes", "readings"),
        ] {
            let lines = files[&format!("{file}.csv")].lines().count();
            assert_eq!(lines, 1 + count(rows), "{name}: {file}");
        }
        // The Universal File has the shapes of all three, at the sensors' grids.
        let shapes = read("shapes.unv", files["shapes.unv"].as_bytes()).unwrap();
        let hertz = found["modes"].as_array().unwrap().iter();
        let hertz = hertz
            .map(|own| own["test_hz"].as_f64().unwrap())
            .collect_vec();
        assert_eq!(shapes.frequencies_hz.len(), 3 * hertz.len(), "{name}");
        assert_alike(&shapes.frequencies_hz, &hertz, UNIVERSAL_ROUNDING);
        assert!(
            report.lines().all(|line| line.chars().count() <= WIDTH),
            "{report}"
        );
        let [answer, verdict] = ["answer", "verdict"].map(|key| found[key].as_str().unwrap());
        assert!(
            unbroken(report).starts_with(&format!("{answer} {verdict}")),
            "{report}"
        );
        // The page ends with what makes it again: version, command, job, and above them how the job was run.
        let page = &files["report.html"];
        let job = fs::read_to_string(folder_of(name).join("job.toml")).unwrap();
        let job = job
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;");
        for words in [
            &job.replace('"', "&quot;"),
            found["title"].as_str().unwrap(),
            "by the command",
            " --folder ",
        ] {
            assert!(page.contains(words), "{name}: {words}");
        }
    }
}

/// Keys of a value and of what it holds.
fn keys_within(value: &Value) -> BTreeSet<&str> {
    match value {
        Value::Object(own) => {
            let inner = own.values().flat_map(keys_within);
            own.keys().map(String::as_str).chain(inner).collect()
        }
        Value::Array(own) => own.iter().flat_map(keys_within).collect(),
        _ => BTreeSet::new(),
    }
}

/// `paper/json.md` has every key of the document and no other, and in the row of each all keys within it.
#[test]
fn the_json_of_a_correlation_has_the_keys_of_its_page() {
    let page = include_str!("../../../paper/json.md").lines();
    let rows = page.filter(|line| line.starts_with("| `")).collect_vec();
    let own = |row: &'static str| row.split('|').nth(1).unwrap().split('`').skip(1).step_by(2);
    for (name, _) in JOBS {
        let found = reported(name).json();
        let found = found.as_object().unwrap();
        let of_page = rows
            .iter()
            .flat_map(|row| own(row))
            .collect::<BTreeSet<_>>();
        assert!(
            found.keys().collect::<BTreeSet<_>>().iter().eq(&of_page),
            "{name}"
        );
        for (key, value) in found {
            let row = rows
                .iter()
                .find(|row| own(row).any(|of| of == key))
                .unwrap();
            for inner in keys_within(value) {
                assert!(
                    row.contains(&format!("`{inner}`")),
                    "{name}: {key}: {inner}"
                );
            }
        }
    }
}

/// The wrapper for Python corrects its own example: the second of two springs was built half as stiff again.
#[test]
#[ignore = "needs Python with numpy"]
fn the_wrapper_for_python_returns_what_the_program_finds() {
    let wrapper = in_root("golden/python/corfem.py");
    let output = std::process::Command::new("python3")
        .arg(wrapper)
        .arg(env!("CARGO_BIN_EXE_corfem"))
        .output();
    let output = output.unwrap();
    let said = text(&output.stdout);
    let numbers: Vec<f64> = said
        .split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect();
    assert!(
        (numbers[0] - 1.0).abs() < 1e-3 && (numbers[1] - 1.5).abs() < 1e-3,
        "{said}"
    );
    // Factors of drawn tests scatter by the deviations that are told.
    assert!(
        numbers[3..].iter().all(|times| (0.5..2.0).contains(times)),
        "{said}"
    );
}

/// So do the examples, which are these jobs.
#[test]
fn the_same_job_gives_the_same_bytes() {
    reported("box").assert_same(&Reported::of(&folder_of("box").join("job.toml")));
}

/// A worked job with one text replaced by another, in a folder of its own.
fn changed(name: &str, old: &str, new: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = new_folder();
    for file in names(&folder_of(name)) {
        fs::copy(folder_of(name).join(&file), folder.path().join(&file)).unwrap();
    }
    let path = folder.path().join("job.toml");
    let job = fs::read_to_string(&path).unwrap();
    assert!(job.contains(old), "{old}");
    fs::write(&path, job.replacen(old, new, 1)).unwrap();
    (folder, path)
}

/// Waits until a program has taken the signal of Ctrl-C over.
#[cfg(unix)]
fn await_taken(child: &std::process::Child) {
    let takes_it = || {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
        caught
            .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
            .is_none_or(|mask| mask & 2 != 0)
    };
    for _ in 0..600 {
        std::thread::sleep(std::time::Duration::from_millis(100));
        if takes_it() {
            break;
        }
    }
}

/// Waits until a program has computed for a second and a half of its own, enough for some analyses, however busy the machine;
/// for six seconds where that is not known.
#[cfg(unix)]
fn await_work(child: &std::process::Child) {
    let has_worked = || {
        std::thread::sleep(std::time::Duration::from_millis(100));
        let stat = fs::read_to_string(format!("/proc/{}/stat", child.id())).ok()?;
        // The fourteenth number of the line, in hundredths of a second.
        let after = stat.rsplit_once(')')?.1;
        let ticks: u32 = after.split_whitespace().nth(11)?.parse().ok()?;
        Some(ticks >= 150)
    };
    for round in 0..3000 {
        match has_worked() {
            Some(true) => break,
            None if round >= 60 => break,
            _ => (),
        }
    }
}

/// A pipe that nobody reads holds the program while it writes the best so far.
#[cfg(unix)]
#[test]
fn a_second_signal_ends_the_program_at_once() {
    use crate::common::signals::{corfem_run_by, send, undisturbed};
    use std::os::unix::process::ExitStatusExt;
    use std::process::Child;
    let (folder, job) = changed("building", "", "");
    let pipe = folder.path().join("pipe");
    let made = Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()), "mkfifo");
    let mut child = corfem_run_by(undisturbed())
        .args(["correlate", words(&job), "-q", "-o", words(&pipe)])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    await_taken(&child);
    let ends_within = |child: &mut Child, seconds: u64| {
        (0..10 * seconds).find_map(|_| {
            std::thread::sleep(Duration::from_millis(100));
            child.try_wait().unwrap()
        })
    };
    assert!(ends_within(&mut child, 1).is_none(), "nobody reads");
    send(&child, Signal::INT);
    assert!(ends_within(&mut child, 1).is_none(), "it is postponed");
    send(&child, Signal::INT);
    let ended = ends_within(&mut child, 10);
    let _ = child.kill();
    let _ = child.wait();
    let signal = ended.and_then(|status| status.signal());
    assert_eq!(signal, Some(Signal::INT.as_raw()));
}

/// A correlation that would last is stopped: the best so far is written whole, and standard error says so.
#[cfg(unix)]
#[test]
fn a_signal_keeps_the_best_so_far() {
    use crate::common::signals::{corfem_run_by, send, undisturbed};
    let endless = "method = \"gauss_newton\"\nstarts = 1000000";
    let (folder, job) = changed("wing", "method = \"gauss_newton\"", endless);
    let out = folder.path().join("out");
    let mut child = corfem_run_by(undisturbed())
        .args(["correlate", words(&job), "-q", "--folder", words(&out)])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    await_taken(&child);
    await_work(&child);
    assert!(child.try_wait().unwrap().is_none(), "it lasts");
    send(&child, Signal::INT);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(3));
    assert_eq!(
        text(&output.stderr),
        "corfem: stopped by request; the best factors so far are given\n"
    );
    assert!(text(&output.stdout).contains("Factors on the first model"));
    assert_eq!(
        names(&out),
        [
            "corrected.bdf",
            "correlation.json",
            "factors.csv",
            "modes.csv",
            "report.html",
            "shapes.csv",
            "shapes.unv",
        ]
    );
    let found = json(&out.join("correlation.json"));
    let mut factors = found["parameters"].as_array().unwrap().iter();
    assert!(
        factors.any(|own| (own["factor"].as_f64().unwrap() - 1.0).abs() > FIELD_ROUNDING),
        "better than the first model"
    );
}

#[cfg(unix)]
#[test]
fn a_folder_that_is_a_link_to_nothing_is_refused_before_the_run() {
    let folder = new_folder();
    let link = folder.path().join("link");
    std::os::unix::fs::symlink("nowhere", &link).unwrap();
    for place in [words(&link), "nowhere/.."] {
        let job = folder_of("building").join("job.toml");
        let output = correlate(&job, &["--folder", place]);
        assert_eq!(
            (output.status.code(), output.stdout.len()),
            (Some(2), 0),
            "{place}"
        );
        assert!(
            text(&output.stderr).starts_with("corfem: cannot write"),
            "{}",
            text(&output.stderr)
        );
    }
    assert_eq!(names(folder.path()), ["link"]);
}
