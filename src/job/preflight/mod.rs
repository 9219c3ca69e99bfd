//! A pre-flight: what looks wrong with model and test before the first step, each finding with its evidence.
//!
//! The loops fit gages to whatever data they get: with one reversed sensor the gages are silently wrong. So each common
//! mistake is undone here on trial, and the one whose correction makes model and test agree best is named. The *agreement* is the mean over the test modes of the paired cross-orthogonality (4),
//!
//! $$ a = \frac{1}{g} \sum_j \lvert m_{i(j) j} \rvert, \qquad m = V_F^t M V_G, $$
//!
//! with every test shape at unit generalized mass. In all d modes of a right model a reversed sensor makes $m_{jj}$
//! lower by $2 m_i v_{ij}^2$, which sum to 2 over the modes whatever the mass there is: no sensor is too light to be
//! seen. It does not use frequencies; their ratios are judged after shapes have been paired.

mod frequencies;
mod comparison;
mod order;
mod readings;
mod shapes;
mod words;

pub use frequencies::{CommonFactor, FACTORS, FrequenciesExchanged, NamedFactor};
pub use readings::SeenModes;
pub use shapes::{Change, LEAST_DIFFERENCE, LEAST_GAIN, LEAST_SHARE, LOW_PAIR, Mended};
pub use words::FindingNames;
pub(super) use words::hyphened;

use crate::method::error::Error;
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use crate::method::model::{Bounds, DynamicModel, FiniteElementModel};
use crate::method::modes::ModeSet;
use crate::method::outer_loop::Settings;
use crate::method::pairing::{Pairing, modal_assurance, pair_modes};
use comparison::{Comparison, paired_values, reordered};
use nalgebra::DMatrix;
use readings::explain;
use serde::Serialize;
use shapes::{changed, mend};

/// Modal assurance of two test modes from which they are nearly one shape. Two modes of the box, whose masses differ
/// several hundredfold, have 0.75 with noise of 1 %, and a mode measured twice has 0.99. It does not depend on the
/// order and signs of the points, so that a mistake in these does not look like a mode measured twice.
pub const NEARLY_SAME: f64 = 0.9;
/// Frequencies that differ by less are one mode's, measured twice.
const SAME_FREQUENCY: f64 = 0.02;
/// Singular value of the test shapes at unit generalized mass below which the points do not distinguish them: orthogonal shapes
/// have one, and noise of 1 % leaves 0.78 where masses differ several hundredfold.
pub const LEAST_SINGULAR: f64 = 0.3;
/// Tolerance beyond which a percentage was probably meant: a fifth of the frequency, or of the largest component.
pub const LARGEST_TOLERANCE: f64 = 0.2;

/// Something that looks wrong. Places count from zero here and from one in [`std::fmt::Display`]'s words.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[allow(
    missing_docs,
    reason = "a variant's own sentence says what its fields are"
)]
pub enum Finding {
    /// All frequencies are wrong by one factor.
    CommonFactor(CommonFactor),
    /// One change of shapes or model makes them agree.
    Mended(Mended),
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
    /// A test mode and its analysis mode agree badly, by the magnitude of their cross-orthogonality, after the change named if there
    /// is one.
    LowPair {
        test: usize,
        analysis: usize,
        cross: f64,
    },
    /// There are more test modes than their shapes at the measured points tell apart: `distinct` is how many singular values of the
    /// shapes, at unit generalized mass, are not small.
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

/// Checks a finite element model and its test before the first step.
///
/// # Errors
/// Those of the model's analysis and of [`preflight`].
pub fn preflight_of(
    model: &FiniteElementModel,
    test: &ModeSet,
    settings: &Settings,
) -> Result<Vec<Finding>, Error> {
    let ranges = model.factor_ranges()?;
    preflight(
        &model.matrices(&vec![1.0; ranges.len()])?,
        test,
        settings,
        &ranges,
    )
}

/// The same of a model given by its matrices.
///
/// `model` has the first stiffness (lbf/in) and mass (lbf·s²/in) at the d points, `test` the modes as measured, of any
/// scale; `ranges` bounds each parameter's factor, as [`crate::method::model::ScaledStructure::factor_ranges`] gives
/// them, which itself refuses bounds that exclude the start. With more test modes than points, pairs are not judged.
/// Of modes with nearly the same shape only the first is paired.
///
/// # Errors
/// Those of [`crate::method::modes::solve`] and [`ModeSet::scaled_with`].
pub fn preflight(
    model: &DynamicModel,
    test: &ModeSet,
    settings: &Settings,
    ranges: &[Option<Bounds>],
) -> Result<Vec<Finding>, Error> {
    test.scaled_with(&model.mass)?;
    let (places, mut findings) = distinct_shapes(test)?;
    let mut modes = test.select(&places);
    if modes.len() <= model.mass.nrows() {
        modes.shapes = compare_with_model(model, &modes, &places, &mut findings)?;
    }
    findings.extend(too_many_modes(
        &modes.scaled_with(&model.mass)?,
        &model.mass,
    )?);
    findings.extend(check_settings(settings, ranges));
    Ok(findings)
}

/// The places of test modes without near copies of earlier ones, and a finding for each such copy.
fn distinct_shapes(test: &ModeSet) -> Result<(Vec<usize>, Vec<Finding>), Error> {
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

/// Adds the findings from the pairs of the model's modes with these test modes, whose `places` in the test are given. Returns the
/// shapes after the change that mends them.
fn compare_with_model(
    model: &DynamicModel,
    test: &ModeSet,
    places: &[usize],
    findings: &mut Vec<Finding>,
) -> Result<DMatrix<f64>, Error> {
    let mut comparison = Comparison::new(&model.stiffness, &model.mass)?;
    let mended = mend(model, &comparison, test)?;
    let change = mended.as_ref().map(|mended| &mended.change);
    let shapes = change.map_or_else(
        || test.shapes.clone(),
        |change| changed(&test.shapes, change),
    );
    if let Some(Change::Columns(order)) = change {
        comparison = Comparison::new(&reordered(&model.stiffness, order), &model.mass)?;
    }
    let Some(cross) = comparison.cross(&shapes) else {
        return Ok(shapes);
    };
    let pairing = pair_modes(&cross)?;
    let analysis = comparison.analysis.frequencies_hz();
    judge_frequencies(test, &analysis, &pairing, places, findings);
    findings.extend(mended.map(Finding::Mended));
    let low = paired_values(&cross, &pairing)
        .into_iter()
        .enumerate()
        .filter(|(_, value)| *value < LOW_PAIR);
    let analysis = |mode: usize| pairing.analysis_mode[mode];
    findings.extend(low.map(|(mode, cross)| Finding::LowPair {
        test: places[mode],
        analysis: analysis(mode),
        cross,
    }));
    Ok(shapes)
}

/// Adds the findings from the frequencies of test modes and of their partners.
fn judge_frequencies(
    test: &ModeSet,
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
    test: &ModeSet,
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
        let metric = DMatrix::identity(points, points);
        findings.extend(too_many_modes(&unit, &metric)?);
    }
    findings.extend(check_settings(settings, ranges));
    Ok(findings)
}

/// Reports test modes of unit generalized mass that the points do not distinguish.
fn too_many_modes(test: &ModeSet, mass: &DMatrix<f64>) -> Result<Option<Finding>, Error> {
    let (points, modes) = test.shapes.shape();
    let overlap = symmetric_part(&test.shapes.tr_mul(&(mass * &test.shapes)));
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
