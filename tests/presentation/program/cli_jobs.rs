//! `corfem correlate` and `corfem check JOB` from outside: what they print, write and leave alone.

use crate::common::jobs::folder_of;
use crate::prelude::*;
use crate::presentation::program::cli::{corfem, numbers, text};
use corfem::present::render::WIDTH;
use std::process::Output;

/// The worked jobs, and whether their models are decks.
const JOBS: [(&str, bool); 3] = [("box", true), ("building", false), ("wing", true)];

pub fn words(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

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
            let text = fs::read_to_string(folder.path().join(&file)).expect("it reads");
            (file, text.replace(words(job), "job.toml"))
        };
        let found = Self {
            report: text(&output.stdout),
            files: names(folder.path()).into_iter().map(read).collect(),
        };
        let status = if found.json()["verdict"]["is_within"] == true {
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
        serde_json::from_str(&self.files["correlation.json"]).expect("JSON")
    }
}

/// The worked jobs, each run once for all tests.
pub fn reported(name: &str) -> &'static Reported {
    static FIRST: [OnceLock<Reported>; 3] = [const { OnceLock::new() }; 3];
    let place = JOBS.iter().position(|(job, _)| *job == name);
    FIRST[place.expect("a job")].get_or_init(|| Reported::of(&folder_of(name).join("job.toml")))
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("it reads")).expect("JSON")
}

/// Without the breaks of lines.
fn unbroken(text: &str) -> String {
    text.split_whitespace().collect_vec().join(" ")
}

#[test]
fn a_worked_job_has_its_report_its_factors_and_its_deck() {
    for (name, is_deck) in JOBS {
        let reported = reported(name);
        let report = &reported.report;
        let mut expected = vec![
            "correlation.json",
            "factors.csv",
            "report.html",
            "residuals.csv",
            "shapes.csv",
            "shapes.unv",
        ];
        expected.splice(0..0, is_deck.then_some("corrected.bdf"));
        expected.sort_unstable();
        assert!(reported.files.keys().eq(&expected), "{name}");
        let found = reported.json();
        assert!(
            is_deck <= found["verdict"]["is_within"].as_bool().expect("a verdict"),
            "{name}"
        );
        // None where no interval holds.
        let factors = numbers(&found["factors"]);
        let deviations = found["standard_deviations"].as_array().expect("a list");
        assert!(
            found["misfit"]["degrees_of_freedom"].as_f64() > Some(0.0),
            "{name}"
        );
        let parameters = found["parameters"].as_array().expect("a list");
        assert_eq!(
            (factors.len(), deviations.len()),
            (parameters.len(), parameters.len()),
            "{name}"
        );
        let run = format!(
            "corfem {} correlate job.toml, inputs ",
            env!("CARGO_PKG_VERSION")
        );
        for name in &expected {
            // The lines of a deck's head are short.
            let text = reported.files[*name].replace("\n$ ", "");
            assert!(text.contains(&run), "{name}");
        }
        let mut reader = csv::ReaderBuilder::new();
        let mut table = reader
            .comment(Some(b'#'))
            .from_reader(reported.files["factors.csv"].as_bytes());
        let rows: Vec<csv::StringRecord> = table.records().map(|row| row.expect("a row")).collect();
        assert_eq!(rows.len(), parameters.len(), "{name}");
        for (e, parameter) in parameters.iter().enumerate() {
            assert_eq!(
                (&rows[e][0], &rows[e][1]),
                (parameter.as_str().expect("a name"), "1"),
                "{name}"
            );
            let same = |column: usize, expected: &Value| {
                let found: Option<f64> = rows[e][column].parse().ok();
                let expected = expected.as_f64();
                assert_eq!(found.is_some(), expected.is_some(), "{name}");
                let apart = found
                    .zip(expected)
                    .map_or(0.0, |(a, b)| relative_error(a, b));
                assert!(apart < ROUND_OFF, "{name}: {apart:e}");
            };
            same(2, &found["factors"][e]);
            same(3, &deviations[e]);
            let interval = &found["intervals"][e];
            same(4, &interval["lower"]);
            same(5, &interval["upper"]);
            let said = ["seen", "mostly prior", "blind", "at bound", "group: "];
            assert!(
                said.iter().any(|said| rows[e][6].starts_with(said)),
                "{name}: {}",
                &rows[e][6]
            );
        }
        let lines = |file: &str| {
            let lines = reported.files[file]
                .lines()
                .filter(|line| !line.starts_with('#'));
            lines.skip(1).count()
        };
        let residuals = found["residuals"].as_array().expect("a list");
        let shapes = residuals
            .iter()
            .map(|mode| mode["shape"].as_array().map_or(0, Vec::len));
        let readings: usize = shapes.sum();
        assert_eq!(lines("residuals.csv"), residuals.len() + readings, "{name}");
        assert_eq!(lines("shapes.csv"), readings, "{name}");
        // The Universal File has the shapes of all three, at the sensors' grids.
        let shapes =
            corfem::files::test_data::read("shapes.unv", reported.files["shapes.unv"].as_bytes());
        let shapes = shapes.expect("a Universal File");
        let hertz = numbers(&found["test_frequencies_hz"]);
        assert_eq!(shapes.frequencies_hz.len(), 3 * hertz.len(), "{name}");
        for (written, hertz) in shapes.frequencies_hz.iter().zip(&hertz) {
            assert!(
                relative_error(written, hertz) < UNIVERSAL_ROUNDING,
                "{name}"
            );
        }
        assert!(
            report.lines().all(|line| line.chars().count() <= WIDTH),
            "{report}"
        );
        let verdict = found["verdict_in_words"].as_str().expect("words");
        let answer = found["answer"].as_str().expect("a line");
        assert!(
            unbroken(report).starts_with(&format!("{answer} {verdict}")),
            "{report}"
        );
        let page = &reported.files["report.html"];
        assert!(
            page.starts_with("<!DOCTYPE html>")
                && page.contains(found["name"].as_str().expect("a name"))
        );
        // It ends with what makes it again: version, command, job, and above them how the job was run.
        let job = fs::read_to_string(folder_of(name).join("job.toml")).expect("it reads");
        let text = job
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;")
            .replace('"', "&quot;");
        assert!(page.contains(&text), "{name}");
        for words in [
            "<table id=\"inputs\">",
            ">method<",
            ">weights of test mode ",
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

/// Every key within a key of the document stands in its row of `paper/json.md`.
#[test]
fn every_key_within_the_json_of_a_correlation_stands_on_its_page() {
    let page = include_str!("../../../paper/json.md");
    for (name, _) in JOBS {
        let found = reported(name).json();
        for (key, value) in found.as_object().expect("an object") {
            let quoted = format!("`{key}`");
            let is_own = |line: &&str| {
                line.starts_with("| `")
                    && line
                        .split('|')
                        .nth(1)
                        .is_some_and(|cell| cell.contains(&quoted))
            };
            let row = page.lines().find(is_own).expect(key);
            for inner in keys_within(value) {
                assert!(
                    row.contains(&format!("`{inner}`")),
                    "{name}: {key}: {inner}"
                );
            }
        }
    }
}

/// `paper/json.md` has every key of the document and no other.
#[test]
fn the_json_of_a_correlation_has_the_keys_of_its_page() {
    let page = include_str!("../../../paper/json.md");
    let rows = page.lines().filter(|line| line.starts_with("| `"));
    let first = rows.filter_map(|line| line.split('|').nth(1));
    let keys: Vec<&str> = first
        .flat_map(|cell| cell.split('`').skip(1).step_by(2))
        .collect();
    for (name, _) in JOBS {
        let found = reported(name).json();
        let mut of_page = keys.clone();
        of_page.sort_unstable();
        let mut own: Vec<&str> = found
            .as_object()
            .expect("an object")
            .keys()
            .map(String::as_str)
            .collect();
        own.sort_unstable();
        assert_eq!(own, of_page, "{name}");
    }
}

/// The wrapper for Python corrects its own example: the second of two springs was built half as stiff again.
#[test]
#[ignore = "needs Python with numpy"]
fn the_wrapper_for_python_returns_what_the_program_finds() {
    let wrapper = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/python/corfem.py");
    let output = std::process::Command::new("python3")
        .arg(wrapper)
        .arg(env!("CARGO_BIN_EXE_corfem"))
        .output();
    let output = output.expect("it runs");
    let said = text(&output.stdout);
    let numbers: Vec<f64> = said
        .split_whitespace()
        .map(|word| word.parse().expect("a number"))
        .collect();
    assert!(
        (numbers[0] - 1.0).abs() < 1e-3 && (numbers[1] - 1.5).abs() < 1e-3,
        "{said}"
    );
}

#[test]
fn a_corrected_deck_differs_in_properties_and_materials_and_has_the_corrected_frequencies() {
    const OWN: [&str; 6] = ["PSHEAR", "PQDMEM", "PTRMEM", "PROD", "MAT1", "CONROD"];
    for (name, _) in JOBS.iter().filter(|(_, is_deck)| *is_deck) {
        let reported = reported(name);
        let original = fs::read_to_string(folder_of(name).join("model.bdf")).expect("it reads");
        let corrected = &reported.files["corrected.bdf"];
        for (one, other) in [(&original, corrected), (corrected, &original)] {
            let known: BTreeSet<&str> = other.lines().collect();
            let own = one.lines().filter(|line| !line.starts_with('$'));
            let own: Vec<&str> = own.filter(|line| !known.contains(line)).collect();
            assert!(!own.is_empty(), "{name}: something is corrected");
            for line in own {
                // An element may have been given a property of its own, and a card a continuation.
                let card = line.split(['*', ',', ' ']).next().expect("a card");
                let is_element = card.starts_with('C') && !line.starts_with("CMASS");
                assert!(
                    OWN.contains(&card) || card.is_empty() || line.starts_with('+') || is_element,
                    "{name}: {line}"
                );
            }
        }
        let found = reported.json();
        let best = found["best_pass"].as_u64().expect("a pass") as usize - 1;
        let folder = new_folder();
        let path = folder.path().join("corrected.bdf");
        fs::write(&path, corrected).expect("written");
        let modes = corfem(&["modes", words(&path), "-f", "json"]);
        let modes: Value = serde_json::from_slice(&modes.stdout).expect("JSON");
        let all = numbers(&modes["frequencies_hz"]);
        for hertz in numbers(&found["passes"][best]["exact"]["frequencies_hz"]) {
            let nearest = all
                .iter()
                .copied()
                .min_by(|a, b| (a - hertz).abs().total_cmp(&(b - hertz).abs()));
            assert_relative_eq!(
                nearest.expect("a mode"),
                hertz,
                max_relative = FIELD_ROUNDING
            );
        }
    }
}

/// So do the examples, which are these jobs.
#[test]
fn the_same_job_gives_the_same_bytes() {
    reported("box").assert_same(&Reported::of(&folder_of("box").join("job.toml")));
}

#[test]
fn every_format_has_the_factors() {
    let job = folder_of("box").join("job.toml");
    let of = |format: &str| {
        let output = correlate(&job, &["-f", format]);
        assert_eq!(output.status.code(), Some(0), "{format}");
        text(&output.stdout)
    };
    let document: Value = serde_json::from_str(&of("json")).expect("JSON");
    let first = numbers(&document["factors"])[0];
    assert!(
        of("text")
            .lines()
            .any(|line| line.starts_with("panel 1 ") && line.contains(&format!("{first:.4}")))
    );
    assert!(
        of("markdown")
            .lines()
            .any(|line| line.starts_with("| panel 1 |") && line.contains(&format!("{first:.4}")))
    );
    let csv = of("csv");
    let cell = csv
        .lines()
        .find_map(|line| line.strip_prefix("job_factors,panel 1,Factor,,"))
        .expect("a factor");
    assert_relative_eq!(
        cell.trim_end_matches(',').parse::<f64>().expect("a number"),
        first,
        max_relative = FIELD_ROUNDING
    );
}

/// A worked job with one text replaced by another, in a folder of its own.
fn changed(name: &str, old: &str, new: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = new_folder();
    for file in names(&folder_of(name)) {
        fs::copy(folder_of(name).join(&file), folder.path().join(&file)).expect("copied");
    }
    let path = folder.path().join("job.toml");
    let job = fs::read_to_string(&path).expect("it reads");
    assert!(job.contains(old), "{old}");
    fs::write(&path, job.replacen(old, new, 1)).expect("written");
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
        .expect("it starts");
    await_taken(&child);
    let ends_within = |child: &mut Child, seconds: u64| {
        (0..10 * seconds).find_map(|_| {
            std::thread::sleep(Duration::from_millis(100));
            child.try_wait().expect("a state")
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
    use std::os::unix::process::ExitStatusExt;
    let endless = "method = \"gauss_newton\"\nstarts = 1000000";
    let (folder, job) = changed("wing", "method = \"gauss_newton\"", endless);
    let out = folder.path().join("out");
    let mut child = corfem_run_by(undisturbed())
        .args(["correlate", words(&job), "-q", "--folder", words(&out)])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    await_taken(&child);
    await_work(&child);
    assert!(child.try_wait().expect("a state").is_none(), "it lasts");
    send(&child, Signal::INT);
    let output = child.wait_with_output().expect("an end");
    assert_eq!(output.status.signal(), Some(Signal::INT.as_raw()));
    assert_eq!(
        text(&output.stderr),
        "corfem: stopped by request; the best factors so far are given\n"
    );
    assert!(text(&output.stdout).contains("factors on the first model"));
    assert_eq!(
        names(&out),
        [
            "corrected.bdf",
            "correlation.json",
            "factors.csv",
            "report.html",
            "residuals.csv",
            "shapes.csv",
            "shapes.unv",
        ]
    );
    let factors = numbers(&json(&out.join("correlation.json"))["factors"]);
    assert!(
        factors
            .iter()
            .any(|factor| (factor - 1.0).abs() > FIELD_ROUNDING),
        "better than the first model"
    );
}

/// Starts and seed of the command line stand for those of the job.
#[test]
fn starts_and_seed_are_taken_from_the_command_line() {
    let (folder, by_paper) = changed("building", "[compare]", "[compare]\nmethod = \"paper\"");
    let job = folder_of("building").join("job.toml");
    let report = |job: &Path, more: &[&str]| {
        let output = correlate(job, &[&["--format", "json"], more].concat());
        serde_json::from_slice::<Value>(&output.stdout).expect("JSON")
    };
    let (paper, once, twice) = (
        report(&by_paper, &[]),
        report(&job, &[]),
        report(&by_paper, &["--starts", "2", "--seed", "5"]),
    );
    drop(folder);
    assert!(
        paper["passes"][0]["iterations"]
            .as_u64()
            .is_some_and(|count| count > 1)
    );
    // Of an exact test both starts find the same building.
    for (a, b) in numbers(&once["factors"])
        .iter()
        .zip(numbers(&twice["factors"]))
    {
        assert!(relative_error(a, b) < WEIGHTED_FACTOR, "{a} {b}");
    }
}

#[test]
fn a_factor_of_point_masses_is_in_the_corrected_deck() {
    let folder = new_folder();
    for (name, file) in crate::common::jobs::rods() {
        let masses = "masses = [\"12-14\"]\nscales = \"mass\"";
        let text = file.replacen("elements = [\"2-3\"]", masses, 1);
        fs::write(folder.path().join(name), text).expect("written");
    }
    let out = folder.path().join("out");
    let output = correlate(&folder.path().join("job.toml"), &["--folder", words(&out)]);
    assert_ne!(output.status.code(), Some(2), "{}", text(&output.stderr));
    let factor = json(&out.join("correlation.json"))["factors"][1]
        .as_f64()
        .expect("a factor");
    let deck = fs::read(out.join("corrected.bdf")).expect("a deck");
    let masses = corfem::files::deck::read("corrected.bdf", &deck, &[])
        .expect("it reads")
        .model
        .masses;
    assert!(
        factor != 1.0
            && masses
                .iter()
                .all(|point| (point.mass - factor).abs() <= FIELD_ROUNDING * factor),
        "{masses:?}"
    );
}

#[cfg(unix)]
#[test]
fn a_folder_that_is_a_link_to_nothing_is_refused_before_the_run() {
    let folder = new_folder();
    let link = folder.path().join("link");
    std::os::unix::fs::symlink("nowhere", &link).expect("linked");
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
