//! Results as JSON: every document begins with program, version and units, and a correlation always has the same form.
//!
//! Errors are fractions (RMS and sums alike), gages inches, frequencies hertz in the order of the test modes. Factors
//! of a pass are totals since the first model, those of an iteration totals since the last exact solution. A number
//! that is not finite is `null`. Every function that writes a document has the errors of [`document`].

use super::PresentError;
use super::report::{ModeResiduals, Report, Stage};
use super::tables::deck::{not_read, unit_shapes};
use crate::files::deck::Unread;
use crate::files::test_data::DIRECTIONS;
use crate::files::turns;
use crate::job::concern::Answered;
use crate::job::verdict::Verdict;
use crate::job::{Trial, Trust, of_bodies};
use crate::method::inner_loop::Iteration;
use crate::method::step::Bounds;
use crate::method::step::Limit;
use crate::sparse::Work;
use crate::sparse::whole_modes::WholeModes;
use crate::weighted::comparison::ExactResult;
use crate::weighted::intervals::Withheld;
use crate::weighted::misfit::Misfit;
use crate::weighted::starts::{Minimum, StartEnd};
use nalgebra::DMatrix;
use serde::Serialize;
use serde_json::{Value, json};

/// A document with its heading.
#[derive(Serialize)]
struct Document<T> {
    program: &'static str,
    version: &'static str,
    units: &'static str,
    #[serde(flatten)]
    content: T,
}

/// A document of the paper's structure with its heading as pretty-printed JSON and a final newline.
///
/// # Errors
/// [`PresentError::Json`], which memory alone could cause.
pub fn document(content: impl Serialize) -> Result<String, PresentError> {
    in_units(
        "inch, pound-force, second, hertz; errors are fractions",
        content,
    )
}

/// A document of a user's structure with its heading, as [`document`].
///
/// # Errors
/// [`PresentError::Json`], as [`document`].
pub fn own_document(content: impl Serialize) -> Result<String, PresentError> {
    in_units(
        "the model's own units, hertz; errors are fractions",
        content,
    )
}

fn in_units(units: &'static str, content: impl Serialize) -> Result<String, PresentError> {
    let document = Document {
        program: env!("CARGO_PKG_NAME"),
        version: env!("CARGO_PKG_VERSION"),
        units,
        content,
    };
    let mut text = String::new();
    for c in serde_json::to_string_pretty(&document)?.chars() {
        match turns(c) {
            true => text += &format!("\\u{:04x}", u32::from(c)),
            false => text.push(c),
        }
    }
    Ok(text + "\n")
}

/// A report as the document has it.
#[derive(Serialize)]
struct ReportValue<'a> {
    name: &'a str,
    converged: bool,
    trust: &'a Option<Trust>,
    checks: Option<Vec<Answered>>,
    verdict: &'a Option<Verdict>,
    verdict_in_words: String,
    parameters: &'a [String],
    ranges: &'a [Option<Bounds>],
    factors: &'a [f64],
    standard_deviations: &'a Option<Vec<Option<f64>>>,
    prior_shares: &'a Option<Vec<f64>>,
    misfit: &'a Option<Misfit>,
    #[serde(skip_serializing_if = "Option::is_none")]
    analyses: Option<usize>,
    #[serde(flatten)]
    work: Option<Work>,
    minima: &'a [Minimum],
    failed_starts: usize,
    starts: &'a [Option<StartEnd>],
    trials: &'a [Trial],
    intervals: Vec<Value>,
    residuals: &'a [ModeResiduals],
    at_bound: Vec<bool>,
    best_pass: Option<usize>,
    test_mode_numbers: &'a [usize],
    test_frequencies_hz: Vec<f64>,
    frequencies_alone: Vec<Value>,
    sensors: Vec<&'a str>,
    initial: SolutionValue<'a>,
    corrected_agreement: AgreementValue,
    passes: Vec<PassValue<'a>>,
    derivatives: Option<DerivativesValue<'a>>,
}

/// An exact solution, and the agreement of its modes with the test's where that is asked for.
#[derive(Serialize)]
struct SolutionValue<'a> {
    frequencies_hz: &'a [f64],
    frequency_rms: f64,
    shape_rms: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    agreement: Option<AgreementValue>,
}

/// Modal assurance and cross-orthogonality, analysis modes by test modes, and the paired analysis modes, from one.
#[derive(Serialize)]
struct AgreementValue {
    paired_analysis_modes: Vec<usize>,
    modal_assurance: MatrixRows,
    cross_orthogonality: Option<MatrixRows>,
}

#[derive(Serialize)]
struct PassValue<'a> {
    iterations: usize,
    stop: Value,
    unlimited_factors: Option<&'a [f64]>,
    factors: &'a [f64],
    exact: SolutionValue<'a>,
    history: Vec<IterationValue<'a>>,
}

#[derive(Serialize)]
pub struct IterationValue<'a> {
    frequency_error: f64,
    shape_error: f64,
    error_sum: f64,
    halvings: usize,
    unlimited_factors: &'a [f64],
    factors: &'a [f64],
    limits: &'a [Limit],
}

#[derive(Serialize)]
struct DerivativesValue<'a> {
    frequency_percent_per_percent: MatrixRows,
    error_sum_per_percent: &'a [f64],
}

/// Any correlation: its parameters by name, its test, its verdict, and its whole history.
///
/// # Errors
/// The errors of [`Report::agreement`].
pub fn report(report: &Report) -> Result<Value, PresentError> {
    let at_bound = |(e, factor): (usize, &f64)| report.is_at_bound(e, *factor);
    let factors = report.factors();
    let value = ReportValue {
        name: &report.title,
        converged: report.converged(),
        trust: &report.trust,
        checks: report.trust.as_ref().map(Trust::answers),
        verdict: &report.verdict,
        verdict_in_words: report.words(),
        parameters: &report.parameters,
        ranges: &report.ranges,
        factors: &factors,
        standard_deviations: &report.deviations,
        prior_shares: &report.prior_shares,
        misfit: &report.misfit,
        analyses: report.analyses,
        work: report.work,
        minima: &report.minima,
        failed_starts: report.failed_starts(),
        starts: &report.starts,
        trials: &report.trials,
        intervals: report.intervals.iter().map(interval).collect(),
        residuals: &report.residuals,
        at_bound: factors.iter().enumerate().map(at_bound).collect(),
        best_pass: report.best.map(|best| best + 1),
        test_mode_numbers: &report.mode_numbers,
        test_frequencies_hz: report.test.frequencies_hz(),
        frequencies_alone: (0..report.initial.lone.len())
            .map(|place| frequency_alone(report, place))
            .collect(),
        sensors: report
            .sensors
            .iter()
            .map(|sensor| &sensor.name[..])
            .collect(),
        initial: SolutionValue {
            agreement: Some(agreement(report, &report.initial)?),
            ..solution(&report.initial)
        },
        corrected_agreement: agreement(report, report.corrected())?,
        passes: report.stages.iter().map(pass).collect(),
        derivatives: report.derivatives.as_ref().map(|at| DerivativesValue {
            frequency_percent_per_percent: matrix_rows(&at.frequency),
            error_sum_per_percent: &at.error_sum,
        }),
    };
    Ok(serde_json::to_value(value)?)
}

fn agreement(report: &Report, check: &ExactResult) -> Result<AgreementValue, PresentError> {
    let found = report.agreement(check)?;
    let modes = check.pairing.analysis_mode.iter();
    Ok(AgreementValue {
        paired_analysis_modes: modes.map(|mode| mode + 1).collect(),
        modal_assurance: matrix_rows(&found.assurance),
        cross_orthogonality: found.orthogonality.as_ref().map(matrix_rows),
    })
}

/// The ends of a parameter's 95 % interval, or why they are withheld.
fn interval(interval: &Result<Bounds, Withheld>) -> Value {
    match interval {
        Ok(ends) => json!(ends),
        Err(withheld) => json!({ "withheld": withheld }),
    }
}

/// A frequency of the test without a shape with its partners in the first and the corrected model; places count from one.
fn frequency_alone(report: &Report, place: usize) -> Value {
    let lone = |check: &ExactResult| check.lone[place];
    let hertz = |check: &ExactResult| check.modes.frequencies_hz()[lone(check).partner];
    let both = [&report.initial, report.corrected()];
    json!({
        "mode": report.mode_number(report.test.len() + place),
        "test_hz": lone(&report.initial).frequency_hz,
        "analysis_modes": both.map(|check| lone(check).partner + 1),
        "frequencies_hz": both.map(hertz),
    })
}

/// The rows of a matrix.
pub type MatrixRows = Vec<Vec<f64>>;

pub fn matrix_rows(matrix: &DMatrix<f64>) -> MatrixRows {
    let rows = matrix.row_iter();
    rows.map(|row| row.iter().copied().collect()).collect()
}

fn solution(check: &ExactResult) -> SolutionValue<'_> {
    SolutionValue {
        frequencies_hz: &check.frequencies_hz,
        frequency_rms: check.errors.frequency_rms(),
        shape_rms: check.errors.shape_rms(),
        agreement: None,
    }
}

fn pass(stage: &Stage) -> PassValue<'_> {
    let inner = stage.inner.as_ref();
    let history = inner.map_or(&[][..], |inner| &inner.iterations);
    PassValue {
        iterations: inner.map_or(1, |inner| inner.iterations.len()),
        stop: inner.map_or_else(|| json!(stage.stop), |inner| json!(inner.stop)),
        unlimited_factors: inner.map(|inner| &inner.first_unlimited_factors[..]),
        factors: &stage.factors,
        exact: solution(&stage.check),
        history: history.iter().map(iteration).collect(),
    }
}

pub fn iteration(iteration: &Iteration) -> IterationValue<'_> {
    IterationValue {
        frequency_error: iteration.errors.frequency,
        shape_error: iteration.errors.shape,
        error_sum: iteration.errors.sum(),
        halvings: iteration.halvings,
        unlimited_factors: &iteration.unlimited_factors,
        factors: &iteration.factors,
        limits: &iteration.limits,
    }
}

/// The lowest `count` modes of a deck or of matrices, every shape scaled to a largest component of one; components in the order of
/// `dof`, which is empty for matrices that do not name their rows.
pub fn deck_modes(
    unread: &[Unread],
    modes: &WholeModes,
    count: usize,
) -> Result<String, PresentError> {
    let (masses, shapes) = unit_shapes(modes, count);
    let dof = modes
        .dof
        .iter()
        .map(|dof| json!({"grid": dof.grid, "direction": DIRECTIONS[dof.direction]}));
    own_document(json!({
        "dof": dof.collect::<Value>(),
        "rigid_body_modes": modes.rigid_body,
        "doubtful": modes.doubtful.iter().map(|found| of_bodies(found).words()).collect::<Vec<_>>(),
        "frequencies_hz": modes.modes.frequencies_hz().into_iter().take(count).collect::<Value>(),
        "generalized_masses": masses,
        "shapes": shapes,
        "not_read": unread.iter().map(not_read).collect::<Value>(),
    }))
}
