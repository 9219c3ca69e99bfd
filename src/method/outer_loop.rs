//! The outer loop: finite element analysis, inner loop, and back, until analysis and test agree.
//! Tour: [chapter 6](crate::tour::chapter_06_inner_loop).

use super::{
    analysis::{Analysis, State},
    error::{Error, Result, positive},
    error_sum::Errors,
    inner_loop::{InnerRun, InnerSettings, run},
    step::Bounds,
};
use serde::Serialize;

/// Settings of both loops: when analysis and test count as correlated, and how long to try.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    fn check(&self) -> Result<()> {
        let owner = || "the outer loop".into();
        positive("later_inner_tolerance", owner, self.later_inner_tolerance)?;
        positive("error_sum_tolerance", owner, self.error_sum_tolerance)?;
        positive("frequency_tolerance", owner, self.frequency_tolerance)?;
        positive("shape_tolerance", owner, self.shape_tolerance)
    }

    /// Ours: settings for another number of test modes than the nine that the paper's were found with: errors of the same root mean
    /// square are met, and the step (13) is as long.
    pub fn for_modes(&self, count: usize) -> Self {
        let scale = 3.0 / (count.max(1) as f64).sqrt();
        let mut settings = self.clone();
        settings.inner.first_relaxation *= scale;
        settings.inner.relaxation *= scale;
        settings.inner.tolerance /= scale;
        settings.later_inner_tolerance /= scale;
        settings.error_sum_tolerance /= scale;
        settings.frequency_tolerance /= scale;
        settings.shape_tolerance /= scale;
        settings
    }

    /// Verdict that errors are within the tolerances of the exact check.
    pub fn are_met_by(&self, errors: &Errors) -> bool {
        errors.sum() <= self.error_sum_tolerance
            && errors.frequency <= self.frequency_tolerance
            && errors.shape <= self.shape_tolerance
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
    pub check: State,
}

/// The whole history of a correlation.
#[derive(Debug, Clone)]
pub struct Correlation {
    /// The exact solution before any change.
    pub initial: State,
    /// The passes made.
    pub passes: Vec<Pass>,
    /// Ours: the pass with the lowest exact error sum, of those within tolerance if there are any, from zero; none when no pass improved
    /// on the start.
    pub best: Option<usize>,
    /// The factors of that pass; all one when there is none.
    pub best_factors: Vec<f64>,
    /// Verdict that an exact solution meets the tolerances.
    pub converged: bool,
}

impl Correlation {
    /// The exact solution at the best factors.
    pub fn best_check(&self) -> &State {
        self.best
            .map_or(&self.initial, |best| &self.passes[best].check)
    }
}

/// Corrects a model until its modes agree with the test modes.
///
/// `analyze` is the finite element analysis: given each parameter's factor on its first value it returns the analysis
/// there, with a new $B$ and compared with the test modes, such as
/// [`FiniteElementModel::analyze`](crate::method::model::FiniteElementModel::analyze).
/// `gage_bounds` bounds those factors, one entry per parameter. `go_on` is told of every pass as it is finished, and ends the
/// correlation by false: what was found until then is kept.
///
/// # Errors
/// Every error of `analyze`, settings out of their ranges, and bounds of another number. Modes that the inner loop cannot follow are an
/// error in the first pass and the end of the correlation in a later one.
///
/// # Example
///
/// ```rust
/// use corfem::method::error::Error;
/// use corfem::method::model::DynamicModel;
/// # use corfem::method::modes::Modes;
/// use corfem::method::outer_loop::{Settings, correlate};
/// # use nalgebra::{dmatrix, dvector};
///
/// // A unit mass on a spring of 4, of which the test says 9.
/// let test = Modes::new(dvector![9.0], dmatrix![1.0])?;
/// let analyze = |factors: &[f64]| -> Result<_, Error> {
///     let stiffness = dmatrix![4.0 * factors[0]];
///     let shares = vec![stiffness.clone()];
///     DynamicModel { stiffness, mass: dmatrix![1.0], shares }.analyze(&test, None)
/// };
/// let result = correlate(analyze, &[None], &Settings::default().for_modes(1), |_, _| true)?;
/// assert!(result.converged && (result.best_factors[0] - 2.25).abs() < 0.05);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn correlate<A: Analysis, E: From<Error>>(
    mut analyze: impl FnMut(&[f64]) -> Result<A, E>,
    gage_bounds: &[Option<Bounds>],
    settings: &Settings,
    mut go_on: impl FnMut(usize, &Pass) -> bool,
) -> Result<Correlation, E> {
    settings.check()?;
    let mut factors = vec![1.0; gage_bounds.len()];
    let mut analysis = analyze(&factors)?;
    let initial = analysis.exact().clone();
    let mut inner_settings = settings.inner.clone();
    let mut passes: Vec<Pass> = Vec::new();
    while passes.len() < settings.most_passes
        && (passes.len() < settings.least_passes || !settings.are_met_by(&analysis.exact().errors))
    {
        let inner = match run(&analysis, &factors, gage_bounds, &inner_settings) {
            Ok(inner) => inner,
            // Nowhere to go from here, as in a local minimum: what the passes before have reached is kept.
            Err(error) if error.is_of_close_modes() && !passes.is_empty() => break,
            Err(error) => return Err(error.into()),
        };
        for (factor, step) in factors.iter_mut().zip(&inner.gage_factors) {
            *factor *= step;
        }
        analysis = analyze(&factors)?;
        let pass = Pass {
            check: analysis.exact().clone(),
            factors: factors.clone(),
            inner,
        };
        let is_last = !go_on(passes.len() + 1, &pass) || pass.inner.iterations.is_empty();
        passes.push(pass);
        if is_last {
            break;
        }
        inner_settings.tolerance = settings.later_inner_tolerance;
    }
    // Whether a result is within tolerance comes before how large its error sum is.
    let rank = |state: &State| (!settings.are_met_by(&state.errors), state.errors.sum());
    let (mut best, mut lowest) = (None, rank(&initial));
    factors.fill(1.0);
    for (number, pass) in passes.iter().enumerate() {
        if rank(&pass.check) < lowest {
            (best, lowest) = (Some(number), rank(&pass.check));
            factors.clone_from(&pass.factors);
        }
    }
    Ok(Correlation {
        best_factors: factors,
        converged: !lowest.0,
        initial,
        passes,
        best,
    })
}
