//! What outputs show of odd names, what a corrected deck says at its head, what killed runs leave, and files without a last line end.

use super::cli::{corfem, text, words};
use crate::common::jobs::{folder_of, rods, run};
use crate::prelude::*;
use crate::readers::twice::universal;
use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};

/// Characters that turn the direction of what follows.
const TURNS: [char; 12] = [
    '\u{61c}', '\u{200e}', '\u{200f}', '\u{202a}', '\u{202b}', '\u{202c}', '\u{202d}', '\u{202e}',
    '\u{2066}', '\u{2067}', '\u{2068}', '\u{2069}',
];

/// The law: no output turns the direction in which it is read, and each still tells which character was there.
#[test]
fn characters_that_turn_text_around_are_escaped_in_every_output() {
    let all: String = TURNS.iter().collect();
    let files = rods_with("name = \"a\"", &format!("name = \"a{all}b\""));
    let files = with(
        files,
        "job.toml",
        "[model]",
        &format!("title = \"t{all}\"\n[model]"),
    );
    let (folder, path) = placed(&files);
    let out = folder.path().join("out");
    let mut outputs = Vec::new();
    for format in ["text", "markdown", "json", "csv"] {
        for command in ["check", "correlate"] {
            outputs.push(text(
                &corfem(&[command, "-q", "-f", format, words(&path)]).stdout,
            ));
        }
    }
    corfem(&["correlate", "-q", words(&path), "--folder", words(&out)]);
    for file in ["report.html", "factors.csv", "correlation.json"] {
        outputs.push(fs::read_to_string(out.join(file)).unwrap());
    }
    for output in &outputs {
        assert!(!output.contains(TURNS), "{output}");
        assert!(output.to_lowercase().contains("202e"), "{output}");
    }
    // Whoever reads JSON by a program finds the name as it was.
    let document: Value = serde_json::from_str(&outputs[outputs.len() - 1]).unwrap();
    let name = document["parameters"][0].as_str().unwrap();
    assert_eq!(name, format!("a{all}b"));
}

#[test]
fn a_corrected_deck_names_its_run_at_its_head_and_is_else_as_it_was() {
    let path = folder_of("box").join("job.toml");
    let folder = new_folder();
    corfem(&[
        "correlate",
        "-q",
        words(&path),
        "--folder",
        words(folder.path()),
    ]);
    let deck = fs::read_to_string(folder.path().join("corrected.bdf")).unwrap();
    let head = deck
        .lines()
        .take_while(|line| line.starts_with("$ "))
        .collect_vec();
    assert!(
        head.iter().all(|line| line.chars().count() <= 72),
        "{head:?}"
    );
    let said = head.iter().map(|line| &line[2..]).collect_vec().join("");
    let run = format!(
        "corfem {} correlate job.toml, inputs ",
        env!("CARGO_PKG_VERSION")
    );
    assert!(
        said.starts_with(&run) && said.contains("keeps the mass"),
        "{said}"
    );
    let json = fs::read_to_string(folder.path().join("correlation.json")).unwrap();
    let identity = said[run.len()..].split("A density").next().unwrap();
    assert!(json.contains(identity.trim()), "{identity}");
    // The mirror: behind the head the deck is that of the library, byte by byte.
    let prepared = prepare(&path).unwrap();
    let result = run_of(&prepared);
    let own = prepared.loaded.corrected_deck(&result).unwrap().unwrap();
    let rest: String = deck.split_inclusive('\n').skip(head.len()).collect();
    assert_eq!(rest.as_bytes(), own);
}

fn run_of(prepared: &corfem::job::PreparedJob) -> Vec<f64> {
    let result = finished(prepared);
    result.found.factors
}

/// A killed run leaves a file of its own; the next run into the same folder removes it, but none that a run still writes.
#[test]
fn half_written_files_of_killed_runs_go_with_the_next_run() {
    let (folder, path) = placed(&rods());
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    let [stale, busy, own] =
        [".corfem-stale", ".corfem-busy", "corfem-own"].map(|name| out.join(name));
    for file in [&stale, &busy, &own] {
        fs::write(file, "half").unwrap();
    }
    let held = fs::File::open(&busy).unwrap();
    held.try_lock().unwrap();
    corfem(&["correlate", "-q", words(&path), "--folder", words(&out)]);
    assert!(!stale.exists() && busy.exists() && own.exists());
    drop(held);
    let report = out.join("report.txt");
    corfem(&["check", "-q", words(&path), "-o", words(&report)]);
    assert!(report.exists() && !busy.exists() && own.exists());
}

/// The law: an input that ends without a line end is read whole.
#[test]
fn a_file_without_a_last_line_end_is_read_whole() {
    let read = |files: &Files| {
        let job = prepared(files).loaded;
        let (stiffness, mass) = job
            .source
            .whole
            .at(&vec![1.0; job.parameter_names().count()])
            .unwrap();
        (job.data.clone(), stiffness, mass, job.title.clone())
    };
    for files in [rods(), building(), universal(7, 39.37)] {
        let whole = read(&files);
        for place in 0..files.len() {
            let mut cut = files.clone();
            let text = &mut cut[place].1;
            text.truncate(text.trim_end_matches('\n').len());
            assert_eq!(read(&cut), whole, "{}", files[place].0);
        }
    }
}

/// One analysis can be stopped: with the flag set inside it, the run ends with the best so far.
#[test]
fn an_analysis_under_way_is_stopped() {
    // The airplane takes more than twenty.
    for asked in [2, 3, 5, 9] {
        let path = folder_of("garteur").join("job.toml");
        let mut loaded = corfem::job::LoadedJob::new(&path).unwrap();
        let stop = Arc::new(AtomicBool::new(false));
        loaded.stop = Some(Arc::clone(&stop));
        let prepared = loaded.prepare().unwrap();
        let calls = Cell::new(0);
        // Said to go on, and stopped in the analysis that follows.
        let go_on = || {
            calls.set(calls.get() + 1);
            let is_over = stop.load(SeqCst);
            stop.store(calls.get() >= asked, SeqCst);
            !is_over
        };
        let result = run(&prepared, |_| {}, go_on).unwrap();
        assert!(result.found.is_interrupted, "{asked}");
        assert!(matches!(result.found.history, History::GaussNewton(None)));
        assert!(
            result.found.analyses <= asked + 2,
            "{asked}: {}",
            result.found.analyses
        );
    }
}
