//! Every figure of the report, of the wings and of the worked jobs, drawn once for all tests.

use crate::common::jobs::loaded;
use crate::evidence::wing_subjects::wing_subjects;
use crate::paper::figures::{Figure, case_figures, comparison_figures, report_figures};
use crate::prelude::*;
use corfem::torque_box::fewer_modes::{FewerModesRun, all_runs};

/// The four cases, run once for all tests of figures.
pub fn results() -> &'static [CaseResult] {
    static RESULTS: OnceLock<Vec<CaseResult>> = OnceLock::new();
    RESULTS.get_or_init(|| CASES.map(|number| case_run(&case_of(number))).into())
}

/// The runs with fewer modes, run once.
pub fn fewer_modes_runs() -> &'static [FewerModesRun] {
    static RUNS: OnceLock<Vec<FewerModesRun>> = OnceLock::new();
    RUNS.get_or_init(|| all_runs(&case_of(PUBLISHED_CASE)).unwrap())
}

/// The wings, correlated once.
pub fn wings() -> &'static [Report] {
    static WINGS: OnceLock<[Report; 2]> = OnceLock::new();
    WINGS.get_or_init(|| wing_subjects().unwrap())
}

/// Every figure of the report, drawn anew.
pub fn draw_all() -> Vec<Figure> {
    let mut figures = case_figures(results()).unwrap();
    figures.extend(comparison_figures(PUBLISHED_CASE, fewer_modes_runs()).unwrap());
    figures
}

/// Every figure of the report, drawn once.
pub fn figures() -> &'static [Figure] {
    static FIGURES: OnceLock<Vec<Figure>> = OnceLock::new();
    FIGURES.get_or_init(draw_all)
}

/// The same and those of the wings, which have places, bounds and modes that the box has not.
pub fn all_figures() -> &'static [Figure] {
    static FIGURES: OnceLock<Vec<Figure>> = OnceLock::new();
    FIGURES.get_or_init(|| {
        let of_wing = |wing| report_figures(wing).unwrap();
        let of_wings = wings().iter().flat_map(of_wing);
        figures().iter().cloned().chain(of_wings).collect()
    })
}

/// The figures of the worked jobs.
pub fn job_figures() -> &'static [Figure] {
    static FIGURES: OnceLock<Vec<Figure>> = OnceLock::new();
    let of_job = |name| {
        let report = Report::from_job(&loaded(name), Some(worked(name))).unwrap();
        report_figures(&report).unwrap()
    };
    let jobs = ["box", "building", "garteur", "wing"];
    let drawn = || {
        std::thread::scope(|scope| {
            let drawn = jobs.map(|name| scope.spawn(move || of_job(name)));
            drawn.map(|figures| figures.join().unwrap()).concat()
        })
    };
    FIGURES.get_or_init(drawn)
}
