//! What the tests share: the ledger of tolerances, the strategies, and small structures.

#[macro_use]
pub mod properties;

pub mod appendix_b;
pub mod appendix_c;
pub mod boxes;
pub mod closed_forms;
pub mod complex_pencils;
pub mod condensed;
pub mod decks;
pub mod drawings;
pub mod draws;
#[cfg(unix)]
pub mod fake_solver;
pub mod fill;
pub mod golden;
pub mod free_structures;
pub mod gradient;
pub mod ground_tests;
pub mod hostile;
pub mod jobs;
pub mod known;
pub mod loops;
pub mod matrices;
pub mod measured;
pub mod nastran95;
pub mod outer_loop;
pub mod pairings;
pub mod panels;
#[cfg(unix)]
pub mod signals;
pub mod strategies;
pub mod structures;
pub mod test_files;
pub mod tolerances;
pub mod torque_boxes;
pub mod vibrations;
pub mod whole_models;
pub mod wing_subjects;

use crate::prelude::*;
use proptest::test_runner::FileFailurePersistence;

/// Proptest's configuration for every property: `PROPTEST_CASES` sets the depth, failures are kept beside the
/// source for good.
pub fn config() -> Config {
    Config {
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource(
            "proptest-regressions",
        ))),
        ..Config::default()
    }
}

/// The same with an eighth of the cases, for properties that run whole correlations.
pub fn costly_config() -> Config {
    let config = config();
    Config {
        cases: config.cases.div_ceil(8),
        ..config
    }
}

/// Least-squares slope of log(error) against log(size): the order of convergence.
pub fn log_log_slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    assert!(n >= 2.0, "a slope needs two points");
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let (mx, my) = (
        logs.iter().map(|p| p.0).sum::<f64>() / n,
        logs.iter().map(|p| p.1).sum::<f64>() / n,
    );
    let above: f64 = logs.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
    let below: f64 = logs.iter().map(|p| (p.0 - mx).powi(2)).sum();
    above / below
}

/// Asserts that an answer is this error, with these words and numbers; what is no number is the same as itself.
#[track_caller]
pub fn assert_refused<T>(answer: Result<T, Error>, error: Error) {
    assert_eq!(format!("{:?}", answer.err()), format!("{:?}", Some(error)));
}

/// Changes something about modes.
pub fn alter(modes: &mut Modes, change: impl FnOnce(&mut DVector<f64>, &mut DMatrix<f64>)) {
    let (mut omega_squared, mut shapes) = (modes.omega_squared().clone(), modes.shapes().clone());
    change(&mut omega_squared, &mut shapes);
    *modes = Modes::new(omega_squared, shapes).expect("modes");
}

/// Words of a refusal, or that there is none.
pub fn said<T>(answer: Result<T, impl Display>) -> String {
    answer.map_or_else(|refusal| refusal.to_string(), |_| "an answer".into())
}

/// Words for a matrix that is not positive definite by this row.
pub fn not_definite(what: &str, row: usize) -> String {
    format!(
        "{what} is not positive definite: row {row} (from zero) is a combination of those before it, or not positive"
    )
}
