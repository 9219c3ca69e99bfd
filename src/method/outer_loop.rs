//! The outer loop: finite element analysis, inner loop, and back, until analysis and test agree.
//! Tour: [chapter 5](crate::tour::chapter_05_inner_loop).

use crate::method::derivatives::error_changes;
use crate::method::error::{Error, positive_setting};
use crate::method::error_sum::{Errors, mode_errors};
use crate::method::inner_loop::{Derivative, InnerLoop, InnerRun, InnerSettings, Stop};
use crate::method::linear_algebra::check_length;
use crate::method::model::{Bounds, ExactResult, ModalModel};
use crate::method::verdict::{Outcome, Verdict};
use serde::{Deserialize, Serialize};

/// When analysis and test count as correlated, and how long to try.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// The inner loop; its tolerance is that of the first pass.
    pub inner: InnerSettings,
    /// Tolerance TOLI of the passes after the first.
    pub later_inner_tolerance: f64,
    /// Tolerance TOLO on the error sum of the exact check.
    pub error_sum_tolerance: f64,
    /// Tolerance TOLF on its frequency error (SRSS).
    pub frequency_tolerance: f64,
    /// Tolerance TOLV on its shape error (SRSS).
    pub shape_tolerance: f64,
    /// Passes made even when the tolerances are met earlier.
    pub least_passes: usize,
    /// Most passes.
    pub most_passes: usize,
}

impl Default for Settings {
    /// TOLI 2.5 % then 1.5 %; TOLO, TOLF and TOLV such that what the paper accepted is accepted: 5 %, 1.5 %
    /// (0.5 % RMS of nine modes) and 4 %; one to ten passes.
    fn default() -> Self {
        Self {
            inner: InnerSettings::default(),
            later_inner_tolerance: 0.015,
            error_sum_tolerance: 0.05,
            frequency_tolerance: 0.015,
            shape_tolerance: 0.04,
            least_passes: 1,
            most_passes: 10,
        }
    }
}

impl Settings {
    fn check(&self) -> Result<(), Error> {
        self.inner.check()?;
        positive_setting("later_inner_tolerance", self.later_inner_tolerance)?;
        positive_setting("error_sum_tolerance", self.error_sum_tolerance)?;
        positive_setting("frequency_tolerance", self.frequency_tolerance)?;
        positive_setting("shape_tolerance", self.shape_tolerance)
    }
}

/// One pass: an inner loop and the exact check of where it led.
#[derive(Debug, Clone)]
pub struct Pass {
    /// The inner loop's history.
    pub inner: InnerRun,
    /// Factor of each parameter on its first value, after the pass.
    pub factors: Vec<f64>,
    /// The exact solution at these factors.
    pub check: ExactResult,
}

/// The whole history of a correlation.
#[derive(Debug, Clone)]
pub struct Correlation {
    /// The exact solution before any change.
    pub initial: ExactResult,
    /// The passes made.
    pub passes: Vec<Pass>,
    /// The pass with the lowest exact error sum, of those within tolerance if there are any, from zero; none when no pass improved
    /// on the start.
    pub best: Option<usize>,
    /// The factors of that pass; all one when there is none.
    pub best_factors: Vec<f64>,
    /// Whether an exact solution meets the tolerances.
    pub converged: bool,
    /// What it came to.
    pub verdict: Verdict,
}

/// Corrects a model until its modes agree with the test modes.
///
/// `analyze` is the finite element analysis: given each parameter's factor on its first value it returns the modal model
/// there, with a new $B$ and compared with the test modes, such as [`crate::method::model::FiniteElementModel::analyze`].
/// `total_ranges` bounds those factors, one entry per parameter. `progress` is told of every pass as it is finished.
///
/// # Errors
/// Those of `analyze`, of the inner loop, and [`Error::Setting`] or [`Error::Limits`] for settings out of range. Modes that
/// the inner loop cannot follow are an error in the first pass and the end of the correlation in a later one.
///
/// # Example
///
/// ```rust
/// use corfem::method::error::Error;
/// use corfem::method::model::{DynamicModel, ParameterMatrix};
/// # use corfem::method::modes::ModeSet;
/// use corfem::method::outer_loop::{Settings, correlate};
/// # use nalgebra::{dmatrix, dvector};
///
/// // A unit mass on a spring of 4, of which the test says 9.
/// let test = ModeSet::new(dvector![9.0], dmatrix![1.0])?;
/// let analyze = |factors: &[f64]| -> Result<_, Error> {
///     let stiffness = dmatrix![4.0 * factors[0]];
///     let shares = vec![ParameterMatrix::Stiffness(stiffness.clone())];
///     DynamicModel { stiffness, mass: dmatrix![1.0], shares }.analyze(&test, None)
/// };
/// let result = correlate(analyze, &[None], &Settings::default(), |_, _| {})?;
/// assert!(result.converged && (result.best_factors[0] - 2.25).abs() < 0.05);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn correlate<E: From<Error>>(
    mut analyze: impl FnMut(&[f64]) -> Result<ModalModel, E>,
    total_ranges: &[Option<Bounds>],
    settings: &Settings,
    mut progress: impl FnMut(usize, &Pass),
) -> Result<Correlation, E> {
    let rule = settings.inner.derivatives;
    correlate_while(
        &mut analyze,
        &|model| Box::new(move |state| error_changes(model, state, rule)),
        total_ranges,
        settings,
        &mut |number, pass| {
            progress(number, pass);
            true
        },
    )
}

/// The same with any function for the derivatives, ended after a pass for which `progress` returns false: what was found until
/// then is kept. It is compiled once per type of error, and not once per caller.
pub(crate) fn correlate_while<E: From<Error>>(
    analyze: &mut dyn FnMut(&[f64]) -> Result<ModalModel, E>,
    derivative: &dyn for<'m> Fn(&'m ModalModel) -> Box<Derivative<'m>>,
    total_ranges: &[Option<Bounds>],
    settings: &Settings,
    progress: &mut dyn FnMut(usize, &Pass) -> bool,
) -> Result<Correlation, E> {
    settings.check()?;
    let mut factors = vec![1.0; total_ranges.len()];
    let mut model = analyze(&factors)?;
    check_length("parameter factors", factors.len(), model.shares.len())?;
    let (first, mut passes) = (model.clone(), Vec::<Pass>::new());
    let mut inner_settings = settings.inner.clone();
    let mut converged = meets(&model.exact.errors, settings);
    let mut is_stopped = false;
    while passes.len() < settings.most_passes
        && (passes.len() < settings.least_passes || !converged)
    {
        let run = |derivative: Box<Derivative>| {
            InnerLoop::new(
                &model,
                &factors,
                total_ranges,
                &inner_settings,
                &*derivative,
            )?
            .run()
        };
        let inner = match run(derivative(&model)) {
            Ok(inner) => inner,
            // Nowhere to go from here, as in a local minimum: what the passes before have reached is kept.
            Err(error) if error.is_of_close_modes() && !passes.is_empty() => break,
            Err(error) => return Err(error.into()),
        };
        for (factor, step) in factors.iter_mut().zip(&inner.factors) {
            *factor *= step;
        }
        model = analyze(&factors)?;
        let pass = Pass {
            check: model.exact.clone(),
            factors: factors.clone(),
            inner,
        };
        converged = meets(&pass.check.errors, settings);
        is_stopped = !progress(passes.len() + 1, &pass);
        let is_at_end = pass.inner.iterations.is_empty();
        passes.push(pass);
        if is_stopped || is_at_end {
            break;
        }
        inner_settings.tolerance = settings.later_inner_tolerance;
    }
    Ok(Correlation::best_of(
        &first,
        passes,
        total_ranges,
        settings,
        is_stopped,
    )?)
}

impl Correlation {
    /// The best of the first model and all passes, and the verdict on it.
    fn best_of(
        first: &ModalModel,
        passes: Vec<Pass>,
        total_ranges: &[Option<Bounds>],
        settings: &Settings,
        is_stopped: bool,
    ) -> Result<Self, Error> {
        let ones = vec![1.0; total_ranges.len()];
        let start = (None, &first.exact, &ones);
        let checks = passes
            .iter()
            .enumerate()
            .map(|(pass, Pass { check, factors, .. })| (Some(pass), check, factors));
        // Whether a result is within tolerance comes before how large its error sum is.
        let place = |check: &ExactResult| (!meets(&check.errors, settings), check.errors.sum());
        let (best, check, factors) = checks.fold(start, |best, next| {
            if place(next.1) < place(best.1) {
                next
            } else {
                best
            }
        });
        let converged = meets(&check.errors, settings);
        let has_stepped = passes.iter().any(|pass| !pass.inner.iterations.is_empty());
        let outcome = match passes.last() {
            _ if is_stopped && !converged => Outcome::Request,
            _ if !has_stepped && !converged => Outcome::Nothing,
            Some(pass) if pass.inner.stop == Stop::LocalMinimum => Outcome::LocalMinimum,
            _ if converged => Outcome::Tolerance,
            _ => Outcome::Cap,
        };
        let errors = mode_errors(&check.modes, &check.pairing, &first.test)?;
        let verdict = Verdict::new(
            outcome,
            (compared_sum(&check.errors, settings), &errors),
            factors,
            &first.largest_parts(),
            total_ranges,
            converged,
        );
        Ok(Self {
            initial: first.exact.clone(),
            best,
            best_factors: factors.clone(),
            passes,
            converged,
            verdict,
        })
    }
}

/// The error sum in the measure of the settings, frequencies and shapes each by their number.
pub(crate) fn compared_sum(errors: &Errors, settings: &Settings) -> f64 {
    let [frequencies, shapes] = scales(errors, settings);
    frequencies * (errors.frequency + shapes / frequencies * errors.shape)
}

/// Whether errors meet the tolerances in the measure of the settings.
pub(crate) fn meets(errors: &Errors, settings: &Settings) -> bool {
    let [frequencies, shapes] = scales(errors, settings);
    compared_sum(errors, settings) <= settings.error_sum_tolerance
        && frequencies * errors.frequency <= settings.frequency_tolerance
        && shapes * errors.shape <= settings.shape_tolerance
}

fn scales(errors: &Errors, settings: &Settings) -> [f64; 2] {
    let measure = settings.inner.measure;
    [errors.mode_count + errors.lone_count, errors.mode_count].map(|count| measure.scale(count))
}
