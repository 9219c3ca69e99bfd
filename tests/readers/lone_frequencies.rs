//! Tests that know of some modes the frequency alone.

use crate::prelude::*;

/// The building by weighted steps, whose test lacks the shapes of these modes (from one).
pub fn without_shapes(modes: &[usize]) -> Files {
    let mut files = comparing(building(), "method = \"gauss_newton\"");
    let text = file(&mut files, "test.csv");
    let lines = text.lines().enumerate().map(|(row, line)| {
        let mut cells = line.split(',').collect_vec();
        if row > 1 {
            let first = cells.len() - 5;
            modes.iter().for_each(|mode| cells[first + mode - 1] = "");
        }
        cells.join(",") + "\n"
    });
    *text = lines.collect();
    files
}

#[test]
fn frequencies_without_shapes_count_as_frequencies_and_nowhere_else() {
    let [found, with_all] =
        [&[2, 4][..], &[]].map(|modes| finished(&prepared(&without_shapes(modes))));
    let (exact, job) = (found.found.first.result().unwrap(), &found.found.prepared);
    // By hand: the frequencies of all five modes, the shapes of three.
    let (hertz, tests) = (
        exact.modes.frequencies_hz(),
        &job.loaded.data.frequencies_hz,
    );
    let squares = (0..5).map(|mode| (hertz[mode] / tests[mode] - 1.0).powi(2));
    let frequency = squares.sum::<f64>().sqrt();
    assert_within(exact.errors.frequency, frequency, ROUND_OFF * frequency);
    let with_all = with_all.found.first.result().unwrap();
    assert!(exact.errors.shape < with_all.errors.shape);
    let counts = (exact.errors.shape_count, exact.errors.frequency_count);
    assert_eq!(counts, (3, 5));
    let residuals = residuals(&found.found.first, &job.weights()).unwrap();
    assert_eq!(residuals.len(), 3 * (1 + 5) + 2);
    // What is left of the test still finds every story.
    assert_alike(found.found.factors.iter(), STORIES, WEIGHTED_FACTOR);
    assert_eq!(about(&trust_in(job), "frequencies-alone"), ["2", "4"]);
}
