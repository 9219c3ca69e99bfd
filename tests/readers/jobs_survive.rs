//! Whatever stands in a job and in its files, it is looked at, corrected and reported, or refused: nothing panics.
//!
//! `CORFEM_CALLS=100000 cargo test --release jobs_survive -- --nocapture` damages so many; `CORFEM_SEED` goes on behind them.

use crate::common::jobs::run;
use crate::prelude::*;
use crate::readers::readers_survive::asked;
use corfem::job::TEMPLATE;
use corfem::present::json;
use corfem::present::page::report_page;
use std::cell::Cell;

/// Values in the place of numbers, of lists and of any other.
const NUMBERS: [&str; 12] = [
    "0",
    "-1",
    "1",
    "2",
    "0.5",
    "1e-300",
    "1e300",
    "nan",
    "inf",
    "1000000",
    "3.0",
    "1.0000001",
];
const LISTS: [&str; 5] = ["[]", "[1, 0]", "[0.01, 1.0, 3.0]", "[1, 1, 1]", "[3, 2, 1]"];
const OTHERS: [&str; 4] = ["\"matrix\"", "\"paper\"", "\"nearest\"", "true"];

/// One entry of the template under its heading, with its own value or another.
fn entry(draws: &mut Draws) -> [String; 2] {
    let mut heading = String::new();
    let mut all = Vec::new();
    for line in TEMPLATE.lines() {
        let line = line.trim_start_matches("# ");
        match line.split_once(" = ") {
            Some((name, value)) if !name.contains(' ') => {
                let value = value.split(" #").next().unwrap_or("").trim();
                all.push([heading.clone(), name.to_owned(), value.to_owned()]);
            }
            _ if line.starts_with('[') => {
                heading = line.split("  ").next().unwrap_or("").to_owned()
            }
            _ => {}
        }
    }
    let [heading, name, value] = &all[draws.below(all.len())];
    let others = match value.chars().next() {
        Some('[') => &LISTS[..],
        Some(first) if first.is_ascii_digit() => &NUMBERS,
        _ => &OTHERS,
    };
    let value = if draws.unit() < 0.5 {
        value
    } else {
        others[draws.below(others.len())]
    };
    [heading.clone(), format!("{name} = {value}")]
}

/// The job with an entry more, or with damage in one of its files.
fn mutated(files: &Files, draws: &mut Draws) -> Vec<(String, Vec<u8>)> {
    let mut files = files
        .iter()
        .map(|(name, text)| (name.clone(), text.clone().into_bytes()))
        .collect_vec();
    if draws.unit() < 0.6 {
        let job = files
            .iter_mut()
            .find(|(name, _)| name == "job.toml")
            .unwrap();
        let mut text = String::from_utf8(job.1.clone()).unwrap();
        for _ in 0..1 + draws.below(2) {
            let [heading, line] = entry(draws);
            let own = line.split(" = ").next().unwrap_or("");
            let kept = text
                .lines()
                .filter(|line| line.split(" = ").next() != Some(own) || draws.unit() < 0.1)
                .collect_vec();
            let mut kept = kept.join("\n") + "\n";
            match kept.find(&format!("{heading}\n")) {
                Some(at) if !heading.is_empty() => {
                    kept.insert_str(at + heading.len() + 1, &format!("{line}\n"))
                }
                _ if heading.is_empty() => kept.insert_str(0, &format!("{line}\n")),
                _ => kept += &format!("{heading}\n{line}\n"),
            }
            text = kept;
        }
        job.1 = text.into_bytes();
    } else {
        let file = draws.below(files.len());
        let text = String::from_utf8_lossy(&files[file].1).into_owned();
        let numbers = text
            .char_indices()
            .filter(|(_, digit)| digit.is_ascii_digit())
            .collect_vec();
        files[file].1 = if draws.unit() < 0.6 && !numbers.is_empty() {
            // Another digit somewhere: most often still a file.
            let (at, _) = numbers[draws.below(numbers.len())];
            let digit = draws.below(10).to_string();
            [&text[..at], &digit, &text[at + 1..]].concat().into_bytes()
        } else {
            draws.damaged(&files[file].1)
        };
    }
    files
}

/// Everything that `check` and `correlate` print of a job, which a request stops after some analyses.
fn corrected(path: &Path) -> Result<bool, PresentError> {
    let loaded = prepare(path)?;
    let trust = Trust::before(&loaded)?;
    let tables = check_tables(&loaded, &trust)?;
    assert!(!render::text(&tables).is_empty());
    let left = Cell::new(12);
    let result = run(
        &loaded,
        |_| {},
        || {
            left.set(left.get() - 1);
            left.get() > 0
        },
    )?;
    let report = Report::new(&result, "corfem")?;
    assert!(!report.csv().is_empty() && !render::text(&report.brief()).is_empty());
    json::document(json::OWN_UNITS, &report)?;
    report_page(&report)?;
    loaded.loaded.corrected_model(&result.found.factors)?;
    Ok(result
        .found
        .factors
        .iter()
        .all(|factor| factor.is_finite() && *factor > 0.0))
}

#[test]
fn no_job_panics_whatever_stands_in_it() {
    let (calls, from) = (asked("CORFEM_CALLS", 500), asked("CORFEM_SEED", 0));
    let jobs = [rods(), building(), measured_building(6, 3)];
    let (mut refused, mut faults) = (0, Vec::new());
    for seed in from..from + calls {
        let mut draws = Draws(seed);
        let job = draws.below(jobs.len());
        let files = mutated(&jobs[job], &mut draws);
        let (folder, path) = placed(&Vec::new());
        for (name, bytes) in &files {
            fs::write(folder.path().join(name), bytes).unwrap();
        }
        match catch_unwind(AssertUnwindSafe(|| corrected(&path))) {
            Ok(Ok(is_finite)) => assert!(is_finite, "seed {seed}"),
            Ok(Err(error)) => {
                refused += 1;
                assert!(!error.to_string().is_empty());
            }
            Err(_) => faults.push(seed),
        }
    }
    println!("{calls} jobs, {refused} refused");
    assert!(faults.is_empty(), "seeds {faults:?}");
    assert!(
        refused > calls / 5 && refused < calls * 9 / 10,
        "{refused} of {calls}"
    );
}
