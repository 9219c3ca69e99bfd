//! Three worked jobs: their files are what `tests/common/jobs.rs` makes, and their results are known from how they were made.

use crate::common::golden::{Numbers, assert_golden};
use crate::common::jobs::{Files, STORIES, building, delta_wing, torque_box, torque_box_truth};
use crate::common::tolerances::{CONDENSED_GAGES, JOB_BOX, JOB_RESULTS, JOB_WING, RECOVERED_STORY, WEIGHTED_FACTOR};
use corfem::files::job::{ComparedModes, Finished, Prepared, run};
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

/// The job of a folder with another way to compare.
fn condensed(name: &str, analysis_modes: usize) -> Finished {
    let path = folder(name).join("job.toml");
    let mut prepared = Prepared::new(&path).unwrap_or_else(|error| panic!("{error}"));
    prepared.job.compare.modes = ComparedModes::Condensed;
    prepared.analysis_modes = analysis_modes;
    run(&prepared, |_| {}, || true).unwrap_or_else(|error| panic!("{error}"))
}

/// Condensation to five floors raises frequencies, and the loop takes that for soft stories which it cannot tell apart.
#[test]
fn condensed_to_five_floors_the_building_is_not_found() {
    let found = condensed("building", 5);
    assert!(found.verdict.error_sum > 0.2 && !found.verdict.is_within, "{}", found.verdict);
    for pair in found.factors.chunks(2) {
        assert!((pair[0] / pair[1] - 1.0).abs() < WEIGHTED_FACTOR, "{pair:?}");
    }
    let worst =
        found.factors.iter().zip(&STORIES).map(|(found, truth)| (found / truth - 1.0).abs()).fold(0.0, f64::max);
    assert!(worst > 0.2, "{worst}");
}

/// All that the wing's sensors do not see is condensed well: both ways find the same.
#[test]
fn condensed_the_wing_has_the_same_gages() {
    let (whole, condensed) = (finished("wing").1, condensed("wing", 19));
    for (a, b) in whole.factors.iter().zip(&condensed.factors) {
        assert!((a / b - 1.0).abs() < CONDENSED_GAGES, "{a} {b}");
    }
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
