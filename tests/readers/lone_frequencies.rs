//! Tests that know of some modes, or of all, the frequency alone.

use crate::common::jobs::run;
use crate::common::jobs::said;
use crate::prelude::*;

/// The building by weighted steps, whose test lacks the shapes of these modes (from one).
pub fn without_shapes(modes: &[usize]) -> Files {
    let mut files = comparing(building(), "method = \"gauss_newton\"");
    let test = files.iter_mut().find(|(name, _)| name == "test.csv");
    let text = &mut test.unwrap().1;
    let mut columns: Vec<usize> = Vec::new();
    let lines = text.lines().map(|line| {
        let mut cells = line.split(',').collect_vec();
        let is_sensor = !columns.is_empty() && line.contains("floor");
        if let Some(first) = cells.iter().position(|cell| *cell == "mode 1") {
            columns = modes.iter().map(|mode| first + mode - 1).collect();
        }
        if is_sensor {
            columns.iter().for_each(|&column| cells[column] = "");
        }
        cells.join(",") + "\n"
    });
    *text = lines.collect();
    files
}

fn result(files: &Files) -> JobResult {
    let (_folder, path) = placed(files);
    prepare(&path)
        .and_then(|loaded| run(&loaded, |_| {}, || true))
        .unwrap()
}

#[test]
fn frequencies_without_shapes_count_as_frequencies_and_nowhere_else() {
    let found = result(&without_shapes(&[2, 4]));
    let (exact, loaded) = (found.found.first.result().unwrap(), &found.found.prepared);
    assert_eq!(loaded.modes, [0, 2, 4]);
    assert_eq!(loaded.loaded.alone, [(1, 1), (3, 3)]);
    // By hand: the frequencies of all five modes, the shapes of three.
    let hertz = exact.modes.frequencies_hz();
    let squares =
        (0..5).map(|mode| (hertz[mode] / loaded.loaded.data.frequencies_hz[mode] - 1.0).powi(2));
    let frequency = squares.sum::<f64>().sqrt();
    assert_within(exact.errors.frequency, frequency, ROUND_OFF * frequency);
    let with_all = result(&without_shapes(&[]));
    let with_all = with_all.found.first.result().unwrap();
    assert!(exact.errors.shape < with_all.errors.shape);
    let counts = (exact.errors.shape_count, exact.errors.frequency_count);
    assert_eq!(counts, (3, 5));
    let residuals = corfem::weighted::residuals::residuals(&found.found.first, &loaded.weights());
    assert_eq!(residuals.unwrap().len(), 3 * (1 + 5) + 2);
    // What is left of the test still finds every story.
    assert_alike(found.found.factors.iter(), STORIES, WEIGHTED_FACTOR);
    let trust = trust_in(loaded);
    assert_eq!(about(&trust, "frequencies-alone"), ["2", "4"]);
}

#[test]
fn a_whole_test_may_be_frequencies() {
    let mut files = without_shapes(&[]);
    let test = files
        .iter_mut()
        .find(|(name, _)| name == "test.csv")
        .unwrap();
    let hertz = prepared(&without_shapes(&[]))
        .loaded
        .data
        .frequencies_hz
        .clone();
    let cells = hertz.iter().map(f64::to_string).collect_vec();
    test.1 = format!(
        "frequency_hz,{}\n,mode 1,mode 2,mode 3,mode 4,mode 5\n",
        cells.join(",")
    );
    let found = result(&files);
    assert!(found.found.prepared.loaded.placed.is_empty() && found.found.prepared.modes.is_empty());
    // Ten stories take all that five frequencies have to tell.
    assert!(
        report_of(&found)
            .answer
            .starts_with("The test confirms nothing: ")
    );
    assert!(!found.verdict.is_within && found.verdict.worst.shape.is_none());
    let [before, after] = [&found.found.first, &found.found.last]
        .map(|comparison| comparison.result().unwrap().errors);
    assert!(
        after.frequency < 0.01 * before.frequency,
        "{after:?} {before:?}"
    );
    assert_eq!(
        (after.shape, after.shape_count, after.frequency_count),
        (0.0, 0, 5)
    );
}

#[test]
fn the_job_may_name_the_partners_of_frequencies() {
    let files = without_shapes(&[2, 4]);
    let named = |partners: &str| {
        let entry = format!("file = \"test.csv\"\npartners = {partners}");
        with(files.clone(), "job.toml", "file = \"test.csv\"", &entry)
    };
    let loaded = prepared(&named("[0, 6, 0, 4, 0]"));
    assert_eq!(loaded.loaded.alone, [(1, 5), (3, 3)]);
    for (partners, expected) in [
        ("[2, 4]", "test.partners: 2 given for 5 test modes"),
        (
            "[0, 0, 0, 4, 0]",
            "test.partners: test mode 2 has a frequency alone; name its mode of the model, from 1",
        ),
        (
            "[1, 2, 0, 4, 0]",
            "test.partners: test mode 1 is paired by its shape; 0 stands for it",
        ),
        ("[0, 4, 0, 4, 0]", "test.partners: mode 4 is named twice"),
        (
            "[0, 2, 0, 11, 0]",
            "test.partners: mode 11 of the model is not among the 10 taken",
        ),
        (
            "[0, 3, 0, 4, 0]",
            "test.partners: mode 3 of the model, a partner of a frequency alone, is by its shape that of test mode 3",
        ),
    ] {
        let error = said(&named(partners));
        assert!(error.contains(expected), "{partners}: {error}");
    }
    let paper = with(files, "job.toml", "\"gauss_newton\"", "\"paper\"");
    assert!(said(&paper).contains(
        "test mode 2 has a frequency alone, and compare.method \"paper\" compares shapes"
    ));
}
