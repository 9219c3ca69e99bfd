//! A pre-flight: what looks wrong with model and test before the first step, each finding with its evidence.
//!
//! The loops fit gages to whatever data they get: with one reversed sensor the gages are silently wrong. So a job's test is judged
//! at its sensors by the modes of the whole model: each common mistake in the readings is undone on trial, and the one that
//! explains the shapes best is named, if it does so well enough (`readings.rs` has the equations). Frequencies take no part in that;
//! their ratios are judged after shapes have been paired.

mod frequencies;
mod order;
mod readings;
mod shapes;
mod words;

pub use frequencies::{CommonFactor, FACTORS, FrequenciesExchanged, NamedFactor};
pub use readings::SeenModes;
pub use shapes::Change;
pub use words::FindingNames;
pub(super) use words::hyphened;

use crate::method::error::Error;
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use crate::method::outer_loop::Settings;
use crate::method::sorting::{Pairing, pair_modes};
use crate::method::step::Bounds;
use crate::sparse::modal_assurance;
use nalgebra::DMatrix;
use readings::explain;
use shapes::changed;

/// Modal assurance of two test modes from which they are nearly one shape. Two modes of the box, whose masses differ
/// several hundredfold, have 0.75 with noise of 1 %, and a mode measured twice has 0.99. It does not depend on the
/// order and signs of the points, so that a mistake in these does not look like a mode measured twice.
pub const NEARLY_SAME: f64 = 0.9;
/// Frequencies that differ by less are one mode's, measured twice.
const SAME_FREQUENCY: f64 = 0.02;
/// Singular value of the test shapes, of unit length, below which the points do not distinguish them: orthogonal shapes have one.
pub const LEAST_SINGULAR: f64 = 0.3;
/// Tolerance beyond which a percentage was probably meant: a fifth of the frequency, or of the largest component.
pub const LARGEST_TOLERANCE: f64 = 0.2;

/// Something that looks wrong. Places count from zero here and from one in the words of [`Finding::concern`].
#[derive(Debug, Clone, PartialEq)]
#[allow(
    missing_docs,
    reason = "a variant's own sentence says what its fields are"
)]
pub enum Finding {
    /// All frequencies are wrong by one factor.
    CommonFactor(CommonFactor),
    /// One mistake in the readings explains the shapes; it makes them more likely by ten to the power of `evidence`.
    Suspected { change: Change, evidence: f64 },
    /// Two frequencies belong to each other's shapes.
    FrequenciesExchanged(FrequenciesExchanged),
    /// Two test modes have nearly the same shape, by their modal assurance. Where the second frequency over the first is close to
    /// one, the mode was measured twice.
    NearlySame {
        modes: [usize; 2],
        assurance: f64,
        frequency_ratio: f64,
    },
    /// There are more test modes than their shapes at the measured points tell apart: `distinct` is how many singular values of the
    /// shapes, of unit length, are not small.
    TooManyModes {
        modes: usize,
        points: usize,
        distinct: usize,
        smallest: f64,
    },
    /// The value of a tolerance or of a standard deviation looks like percent.
    Percent { setting: &'static str, value: f64 },
    /// The bounds on a parameter's factor exclude its first value.
    ExcludesStart { parameter: usize, range: Bounds },
    /// Parameters without bounds.
    Unbounded(Vec<usize>),
}

/// The places of test modes without near copies of earlier ones, and a finding for each such copy.
fn distinct_shapes(test: &Modes) -> Result<(Vec<usize>, Vec<Finding>), Error> {
    let assurance = modal_assurance(&test.shapes, &test.shapes)?;
    let frequencies = test.frequencies_hz();
    let (mut apart, mut findings): (Vec<usize>, Vec<Finding>) = (Vec::new(), Vec::new());
    for b in 0..test.len() {
        let Some(&a) = apart.iter().find(|&&a| assurance[(a, b)] >= NEARLY_SAME) else {
            apart.push(b);
            continue;
        };
        let (assurance, frequency_ratio) = (assurance[(a, b)], frequencies[b] / frequencies[a]);
        findings.push(Finding::NearlySame {
            modes: [a, b],
            assurance,
            frequency_ratio,
        });
    }
    Ok((apart, findings))
}

/// Adds the findings from the frequencies of test modes and of their partners.
fn judge_frequencies(
    test: &Modes,
    analysis_hz: &[f64],
    pairing: &Pairing,
    places: &[usize],
    findings: &mut Vec<Finding>,
) {
    let mut test = test.frequencies_hz();
    let partners = pairing.analysis_mode.iter();
    let analysis: Vec<f64> = partners.map(|&mode| analysis_hz[mode]).collect();
    // Modes are numbered as their frequencies ascend: only where these do not may two be exchanged.
    let found = frequencies::exchanged(&test, &analysis)
        .filter(|found| test[found.modes[0]] > test[found.modes[1]]);
    if let Some(found) = found {
        let [a, b] = found.modes;
        test.swap(a, b);
        let modes = [places[a], places[b]];
        findings.push(Finding::FrequenciesExchanged(FrequenciesExchanged {
            modes,
            ..found
        }));
    }
    findings.extend(frequencies::common_factor(&test, &analysis).map(Finding::CommonFactor));
}

/// Checks a test against a model's modes at its sensors; no condensed model is needed, so structures may hang free.
///
/// # Errors
/// Those of the comparison of shapes.
pub fn preflight_at_sensors(
    seen: &SeenModes,
    test: &Modes,
    settings: &Settings,
    ranges: &[Option<Bounds>],
) -> Result<Vec<Finding>, Error> {
    // A mode measured twice has no second partner. A sensor that drowns all others makes shapes alike, but not frequencies.
    let copies = distinct_shapes(test)?.1;
    let is_copy = |mode: usize| {
        let is_of = |finding: &Finding| {
            matches!(finding, Finding::NearlySame { modes, frequency_ratio, .. }
                if modes[1] == mode && (frequency_ratio - 1.0).abs() < SAME_FREQUENCY)
        };
        copies.iter().any(is_of)
    };
    let once: Vec<usize> = (0..test.len()).filter(|mode| !is_copy(*mode)).collect();
    let suspected = explain(seen, &test.shapes.select_columns(&once))?;
    let mut test = test.clone();
    if let Some((change, _)) = &suspected {
        test.shapes = changed(&test.shapes, change);
    }
    let (places, mut findings) = distinct_shapes(&test)?;
    let test = test.select(&places);
    // At one sensor all shapes are alike, and say nothing of partners.
    if test.shapes.nrows() > 1 && test.len() <= seen.modes.len() {
        let pairing = pair_modes(&modal_assurance(&seen.modes.shapes, &test.shapes)?)?;
        let analysis = seen.modes.frequencies_hz();
        judge_frequencies(&test, &analysis, &pairing, &places, &mut findings);
    }
    findings.extend(suspected.map(|(change, evidence)| Finding::Suspected { change, evidence }));
    let points = test.shapes.nrows();
    if test.len() > points {
        let mut unit = test;
        unit.shapes.column_iter_mut().for_each(|mut shape| {
            shape.normalize_mut();
        });
        findings.extend(too_many_modes(&unit.shapes)?);
    }
    findings.extend(check_settings(settings, ranges));
    Ok(findings)
}

/// Test modes, whose shapes have unit length, that the points do not distinguish.
fn too_many_modes(shapes: &DMatrix<f64>) -> Result<Option<Finding>, Error> {
    let (points, modes) = shapes.shape();
    let overlap = symmetric_part(&shapes.tr_mul(shapes));
    let (squares, _) = symmetric_eigen("overlap of test modes", &overlap)?;
    let smallest = squares[0].max(0.0).sqrt();
    let distinct = squares
        .iter()
        .filter(|square| **square >= LEAST_SINGULAR.powi(2))
        .count();
    Ok((distinct < modes).then_some(Finding::TooManyModes {
        modes,
        points,
        distinct,
        smallest,
    }))
}

fn check_settings(settings: &Settings, ranges: &[Option<Bounds>]) -> Vec<Finding> {
    let tolerances = [
        ("inner.tolerance", settings.inner.tolerance),
        ("later_inner_tolerance", settings.later_inner_tolerance),
        ("error_sum_tolerance", settings.error_sum_tolerance),
        ("frequency_tolerance", settings.frequency_tolerance),
        ("shape_tolerance", settings.shape_tolerance),
    ];
    let large = tolerances
        .into_iter()
        .filter(|(_, value)| *value > LARGEST_TOLERANCE);
    let percent = large.map(|(setting, value)| Finding::Percent { setting, value });
    let excluding = ranges.iter().enumerate().filter_map(|(parameter, range)| {
        let range = range.filter(|range| !range.contains(1.0))?;
        Some(Finding::ExcludesStart { parameter, range })
    });
    let unbounded: Vec<usize> = (0..ranges.len())
        .filter(|&parameter| ranges[parameter].is_none())
        .collect();
    let unbounded = (!unbounded.is_empty()).then_some(Finding::Unbounded(unbounded));
    percent.chain(excluding).chain(unbounded).collect()
}
