//! What the tests share: the ledger of tolerances, the strategies, and small structures.

pub mod presentation;
#[macro_use]
pub mod properties;

pub mod prelude;

pub mod answer;
pub mod appendix_b;
pub mod appendix_c;
pub mod boxes;
pub mod cases;
pub mod closed_forms;
pub mod complex_pencils;
pub mod condensed;
pub mod decks;
pub mod draws;
pub mod dump;
#[cfg(unix)]
pub mod fake_solver;
pub mod fill;
pub mod golden;
pub mod free_structures;
pub mod ground_tests;
pub mod hostile;
pub mod jobs;
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

pub use presentation::studies::{delta_wing, known};
pub use presentation::wing;

use crate::prelude::*;
use nalgebra::ComplexField;
use proptest::test_runner::FileFailurePersistence;
use std::borrow::Borrow;

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
    let logs = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect_vec();
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
    *modes = Modes::new(omega_squared, shapes).unwrap();
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

/// Vectors of what iterators give, with less to say than `collect`.
pub trait CollectVec: Iterator + Sized {
    fn collect_vec(self) -> Vec<Self::Item> {
        self.collect()
    }
}

impl<I: Iterator> CollectVec for I {}

/// The largest of numbers, zero if none is positive.
pub trait Largest: Iterator<Item = f64> + Sized {
    fn largest(self) -> f64 {
        self.fold(0.0, f64::max)
    }
}

impl<I: Iterator<Item = f64>> Largest for I {}

/// What comes of a case.
pub fn case_run(case: &Case) -> CaseResult {
    run_case(case, |_, _| {}).unwrap()
}

/// The identity of a size.
pub fn eye<T: ComplexField>(size: usize) -> DMatrix<T> {
    DMatrix::identity(size, size)
}

/// A square of zeros.
pub fn zero_square<T: ComplexField>(size: usize) -> DMatrix<T> {
    DMatrix::zeros(size, size)
}

/// |found/expected − 1|.
pub fn relative_error(found: impl Borrow<f64>, expected: impl Borrow<f64>) -> f64 {
    (found.borrow() / expected.borrow() - 1.0).abs()
}

/// Modes paired by sorting.
pub fn by_sorting() -> Pair {
    Pair::by(|of| pair_modes(of.cross))
}

/// A case of the paper.
pub fn case_of(number: usize) -> Case {
    Case::new(number).unwrap()
}

/// A file of the repository.
pub fn in_root(path: impl AsRef<Path>) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Asserts that every number found is the expected one but for a part of it.
#[track_caller]
pub fn assert_alike(
    found: impl IntoIterator<Item = impl Borrow<f64>>,
    expected: impl IntoIterator<Item = impl Borrow<f64>>,
    tolerance: f64,
) {
    for (found, expected) in found.into_iter().zip(expected) {
        let (found, expected) = (found.borrow(), expected.borrow());
        assert!(
            relative_error(found, expected) <= tolerance,
            "{found} for {expected}"
        );
    }
}

/// Asserts that a number is the expected one but for so much.
#[track_caller]
pub fn assert_within(found: impl Borrow<f64>, expected: impl Borrow<f64>, allowed: f64) {
    let (found, expected) = (found.borrow(), expected.borrow());
    assert!(
        (found - expected).abs() <= allowed,
        "{found} for {expected}"
    );
}

/// A diagonal matrix.
pub fn diagonal<T: ComplexField>(values: impl AsRef<[T]>) -> DMatrix<T> {
    DMatrix::from_diagonal(&DVector::from_column_slice(values.as_ref()))
}

/// A parameter of a whole model without bounds.
pub fn whole_parameter(name: impl Display, share: WholeShare) -> WholeParameter {
    WholeParameter {
        name: name.to_string(),
        share,
        range: None,
    }
}
