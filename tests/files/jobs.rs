//! Three worked jobs: their files are what `tests/common/jobs.rs` makes, and their results are known from how they were made.

use crate::common::golden::{Numbers, assert_golden};
use crate::common::jobs::{Files, STORIES, building, delta_wing, torque_box, torque_box_truth};
use crate::common::tolerances::{JOB_BOX, JOB_RESULTS, JOB_WING, RECOVERED_STORY};
use corfem::files::job::{Finished, Prepared, run};
use corfem::present::render;
use corfem::present::subject::Subject;
use corfem::present::tables::job::{doubts_table, places_table, seen_table};
use corfem::present::tables::subject::subject_tables;
use corfem::studies::delta_wing::correlation::GROUPS;
use std::path::{Path, PathBuf};

const NUMBERS: Numbers = Numbers { relative: JOB_RESULTS, absolute: JOB_RESULTS, last_digit: true };

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/jobs").join(name)
}

/// `CORFEM_JOBS=write` writes the files instead of comparing them.
fn check_files(name: &str, files: &Files) {
    let folder = folder(name);
    let writes = std::env::var("CORFEM_JOBS").is_ok_and(|asked| asked == "write");
    for (file, text) in files {
        let path = folder.join(file);
        if writes {
            std::fs::create_dir_all(&folder).expect("a folder");
            std::fs::write(&path, text).expect("it writes");
        }
        let stored = std::fs::read_to_string(&path).expect("it reads");
        // Numbers that were computed may differ in their last digit on another machine.
        let numbers = Numbers { relative: JOB_RESULTS, absolute: JOB_RESULTS, last_digit: false };
        assert!(numbers.agree(&stored, text), "{}", path.display());
    }
}

fn finished(name: &str) -> (Prepared, Finished) {
    let prepared = Prepared::new(&folder(name).join("job.toml")).unwrap_or_else(|error| panic!("{error}"));
    let finished = run(&prepared, |_| {}, || true).unwrap_or_else(|error| panic!("{error}"));
    let subject = Subject::of_job(&prepared, Some(&finished)).expect("a subject");
    let mut tables = vec![doubts_table(&prepared).expect("doubts"), places_table(&prepared)];
    tables.extend(subject_tables(&subject).expect("tables"));
    tables.push(seen_table(&prepared, &finished).expect("a table"));
    let text = render::text(&tables);
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    assert_golden(&format!("job_{name}"), &text, NUMBERS);
    (prepared, finished)
}

#[test]
fn the_building_is_found_story_by_story_from_five_floors() {
    check_files("building", &building());
    let (_, found) = finished("building");
    for (story, (found, truth)) in found.factors.iter().zip(&STORIES).enumerate() {
        assert!((found / truth - 1.0).abs() < RECOVERED_STORY, "story {}: {found} for {truth}", story + 1);
    }
}

#[test]
fn the_wing_is_found_from_ten_modes_at_its_upper_grids() {
    check_files("wing", &delta_wing());
    let (prepared, found) = finished("wing");
    assert!(prepared.placed.iter().all(|sensor| sensor.distance.is_some_and(|distance| distance < 1e-2)));
    for (group, found) in GROUPS.iter().zip(&found.factors) {
        let error = found * group.first_over_true - 1.0;
        assert!(error.abs() < JOB_WING, "{}: {error}", group.name);
    }
}

/// Noisy modes of the box, orthogonalized by Appendix B, which deletes some: the panels that the intervals claim to know are known.
#[test]
fn the_box_is_corrected_from_noisy_modes_by_its_deck() {
    check_files("box", &torque_box());
    let (prepared, found) = finished("box");
    assert!(!prepared.deleted.is_empty(), "Appendix B deletes");
    let start: f64 = torque_box_truth().iter().map(|truth| truth.ln().powi(2)).sum();
    let end: f64 =
        torque_box_truth().iter().zip(&found.factors).map(|(truth, found)| (found / truth).ln().powi(2)).sum();
    assert!(end < JOB_BOX * start, "{end} of {start}");
}
