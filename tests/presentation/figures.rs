//! Every figure of the report, drawn once for all tests.

use crate::paper::figures::{Figure, case_figures};
use crate::prelude::*;
use corfem::torque_box::fewer_modes::FewerModesRun;

/// The four cases, run once for all tests of figures.
pub fn results() -> &'static [CaseResult] {
    static RESULTS: OnceLock<Vec<CaseResult>> = OnceLock::new();
    RESULTS.get_or_init(|| CASES.map(|number| case_run(&case_of(number))).into())
}

/// The runs with fewer modes, run once.
pub fn fewer_modes_runs() -> &'static [FewerModesRun] {
    static RUNS: OnceLock<Vec<FewerModesRun>> = OnceLock::new();
    RUNS.get_or_init(|| published_runs(&case_of(PUBLISHED_CASE)).unwrap())
}

/// Every figure of the report, drawn once.
pub fn figures() -> &'static [Figure] {
    static FIGURES: OnceLock<Vec<Figure>> = OnceLock::new();
    FIGURES.get_or_init(|| case_figures(results()).unwrap())
}
