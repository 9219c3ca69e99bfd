//! Correlation with fewer modes: the paper's Tables 9 to 12, and the cost of truncation over all numbers of modes.
//!
//! One pass of a case with its lowest test modes against its lowest analysis modes. The inner loop then works in a
//! truncated modal basis, and so do its frequencies: a change of stiffness cannot move a shape out of the modes it
//! started with. The exact check afterwards shows what that costs.

use crate::method::analysis::{Analysis, State};
use crate::method::error::at_least_one;
use crate::method::inner_loop::Stop;
use crate::method::outer_loop::{Settings, correlate};
use crate::method::structure::ElementKind;
use crate::torque_box::Case;
use crate::torque_box::error::CaseError;
use crate::torque_box::wing_box::{PANEL_COUNT, gage_rms};
use serde::Serialize;

/// The case that the paper runs with fewer modes.
pub const PUBLISHED_CASE: usize = 2;

/// Test and analysis modes of the paper's runs, in the order of its Tables 10, 11 and 12.
pub const PUBLISHED_RUNS: [(usize, usize); 8] = [
    (7, 7),
    (7, 9),
    (5, 5),
    (5, 7),
    (5, 9),
    (3, 5),
    (3, 7),
    (3, 9),
];

/// Modes beside the test modes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Agreement {
    /// Frequencies, Hz: first those of the modes paired with test modes, in their order, then the others ascending.
    pub frequencies_hz: Vec<f64>,
    /// RMS frequency error over the test modes, a fraction.
    pub frequency_rms: f64,
    /// RMS shape error over the test modes, a fraction.
    pub shape_rms: f64,
}

impl Agreement {
    fn new(state: &State) -> Self {
        let State {
            modes,
            pairing,
            errors,
            ..
        } = state;
        let all = modes.frequencies_hz();
        let others = (0..all.len()).filter(|mode| !pairing.analysis_mode.contains(mode));
        let order = pairing.analysis_mode.iter().copied().chain(others);
        let frequencies_hz = order.map(|mode| all[mode]).collect();
        Self {
            frequencies_hz,
            frequency_rms: errors.frequency_rms(),
            shape_rms: errors.shape_rms(),
        }
    }
}

/// One pass with some of the modes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FewerModesRun {
    /// Case number.
    pub case: usize,
    /// Number of test modes, the lowest.
    pub test_modes: usize,
    /// Number of analysis modes, the lowest.
    pub analysis_modes: usize,
    /// Frequencies of the test modes, Hz.
    pub test_frequencies_hz: Vec<f64>,
    /// Iterations made.
    pub iterations: usize,
    /// Reason for which the inner loop stopped.
    pub stop: Stop,
    /// Error sum after every iteration.
    pub inner_error_sums: Vec<f64>,
    /// The exact solution before any change.
    pub initial: Agreement,
    /// The inner loop's own last modes: by perturbation, with the $B$ it began with, as the paper prints them.
    pub inner: Agreement,
    /// The exact solution at the gages found, by the same test modes.
    pub exact: Agreement,
    /// The exact solution at the gages found beside all test modes, those left out of the correlation too.
    pub exact_all_modes: Agreement,
    /// Gages found, in, elements 1 to 15.
    pub gages_in: Vec<f64>,
    /// RMS gage error of the shear panels, a fraction.
    pub shear_gage_rms: f64,
    /// RMS gage error of the membranes, a fraction.
    pub membrane_gage_rms: f64,
}

/// One pass of a case from its first gages, with its lowest `test_modes` test modes and `analysis_modes` analysis
/// modes.
///
/// # Errors
/// [`Error::Count`](crate::method::error::Error::Count) for numbers of modes that are not $1 \le$ test $\le$ analysis $\le$ DOF;
/// those of the model, the analysis and the loops.
pub fn fewer_modes_run(
    case: &Case,
    test_modes: usize,
    analysis_modes: usize,
) -> Result<FewerModesRun, CaseError> {
    let model = case.model()?;
    let all = case.test_modes()?;
    let test = all.lowest(test_modes)?;
    let settings = Settings {
        least_passes: 1,
        most_passes: 1,
        ..case.settings.clone()
    };
    let ranges = model.factor_ranges()?;
    let correlation = correlate(
        |factors| model.analyze(factors, &test, Some(analysis_modes)),
        &ranges,
        &settings,
        |_, _| true,
    )?;
    at_least_one("passes", correlation.passes.len())?;
    let pass = &correlation.passes[0];
    let gages = model.sizes(&pass.factors)?[..PANEL_COUNT].to_vec();
    let all_modes = model.analyze(&pass.factors, &all, None)?;
    Ok(FewerModesRun {
        case: case.number,
        test_modes,
        analysis_modes,
        test_frequencies_hz: test.frequencies_hz(),
        iterations: pass.inner.iterations.len(),
        stop: pass.inner.stop,
        inner_error_sums: pass
            .inner
            .iterations
            .iter()
            .map(|iteration| iteration.errors.sum())
            .collect(),
        initial: Agreement::new(&correlation.initial),
        inner: Agreement::new(&pass.inner.last),
        exact: Agreement::new(&pass.check),
        exact_all_modes: Agreement::new(all_modes.exact()),
        shear_gage_rms: gage_rms(&case.panels, &gages, ElementKind::ShearPanel),
        membrane_gage_rms: gage_rms(&case.panels, &gages, ElementKind::Membrane),
        gages_in: gages,
    })
}

/// The paper's runs: Case 2 with seven, five and three test modes.
///
/// # Errors
/// The errors of the model, the analysis and the loops, as in [`fewer_modes_run`].
pub fn published_runs(case: &Case) -> Result<Vec<FewerModesRun>, CaseError> {
    PUBLISHED_RUNS
        .iter()
        .map(|&(test, analysis)| fewer_modes_run(case, test, analysis))
        .collect()
}

/// Every pair of numbers of modes, 1 ≤ test ≤ analysis ≤ DOF, by test and then by analysis modes.
///
/// # Errors
/// The errors of the model, the analysis and the loops, as in [`fewer_modes_run`].
pub fn all_runs(case: &Case) -> Result<Vec<FewerModesRun>, CaseError> {
    let most = case.reconstruction.masses.len();
    let pairs = (1..=most).flat_map(|test| (test..=most).map(move |analysis| (test, analysis)));
    pairs
        .map(|(test, analysis)| fewer_modes_run(case, test, analysis))
        .collect()
}
