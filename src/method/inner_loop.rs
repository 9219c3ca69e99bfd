//! The inner loop: steps by perturbation alone, from one exact solution to the next.
//! Tour: [chapter 5](crate::tour::chapter_05_inner_loop).

use crate::method::derivatives::{DerivativeRule, error_changes};
use crate::method::error::{Error, positive_setting};
use crate::method::error_sum::{ErrorMeasure, Errors};
use crate::method::linear_algebra::check_length;
use crate::method::model::{Bounds, ModalModel};
use crate::method::state::{ModalState, UpdateRule};
use crate::method::step::{
    Accumulation, Limit, StepRule, limited_factor, stiffness_changes, unlimited_factors,
};
use serde::{Deserialize, Serialize};

/// How the inner loop steps and when it stops.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct InnerSettings {
    /// Relaxation $R$ of the first iteration of a pass.
    pub first_relaxation: f64,
    /// Relaxation $R$ of the others.
    pub relaxation: f64,
    /// Bounds of one iteration's factor.
    pub factor_range: Bounds,
    /// Tolerance TOLI on the error sum $e_S$, in the measure below.
    pub tolerance: f64,
    /// How often a step that does not lower $e_S$ is halved before the place counts as a local minimum; zero stops
    /// at the first rise.
    pub halvings: usize,
    /// Most iterations (accepted steps).
    pub iterations: usize,
    /// How the error sum's derivatives are taken.
    pub derivatives: DerivativeRule,
    /// How they become factors.
    pub step: StepRule,
    /// How the changes of several iterations come together.
    pub accumulation: Accumulation,
    /// How errors are measured by the tolerances and by the step.
    pub measure: ErrorMeasure,
    /// How modes follow the factors.
    pub update: UpdateRule,
}

impl Default for InnerSettings {
    /// The paper's: $R$ = 0.8 then 1.0, factors from 0.55 to 1.50, TOLI 2.5 %, 30 iterations; five halvings.
    fn default() -> Self {
        Self {
            first_relaxation: 0.8,
            relaxation: 1.0,
            factor_range: Bounds {
                lower: 0.55,
                upper: 1.50,
            },
            tolerance: 0.025,
            halvings: 5,
            iterations: 30,
            derivatives: DerivativeRule::default(),
            step: StepRule::default(),
            accumulation: Accumulation::default(),
            measure: ErrorMeasure::default(),
            update: UpdateRule::default(),
        }
    }
}

impl InnerSettings {
    pub(crate) fn check(&self) -> Result<(), Error> {
        let Bounds { lower, upper } = self.factor_range;
        Bounds::positive("factor limits", lower, upper)?;
        positive_setting("first_relaxation", self.first_relaxation)?;
        positive_setting("relaxation", self.relaxation)?;
        positive_setting("tolerance", self.tolerance)
    }
}

/// Why an inner loop stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// The error sum fell below its tolerance.
    Tolerance,
    /// Neither the step nor any of its halvings lowered the error sum.
    LocalMinimum,
    /// The number of iterations allowed was used up.
    Iterations,
}

/// One accepted step.
#[derive(Debug, Clone)]
pub struct Iteration {
    /// $\Delta e$ of every parameter (12) at the place the step was taken from.
    pub error_changes: Vec<f64>,
    /// $\Delta k$ of every parameter there.
    pub stiffness_changes: Vec<f64>,
    /// Factors of (13) before any bound.
    pub unlimited_factors: Vec<f64>,
    /// How often the step was halved.
    pub halvings: usize,
    /// Factor on each parameter's gage or mass since the last exact solution, after the step.
    pub factors: Vec<f64>,
    /// What limited each parameter's factor.
    pub limits: Vec<Limit>,
    /// Errors after the step.
    pub errors: Errors,
}

/// The history of one inner loop.
#[derive(Debug, Clone)]
pub struct InnerRun {
    /// Errors of the last exact solution, where the loop began.
    pub start: Errors,
    /// Accepted steps.
    pub iterations: Vec<Iteration>,
    /// Where the loop ended, with the factors on the stored shares.
    pub last: ModalState,
    /// Factor on each parameter's gage or mass since the last exact solution, where it ended.
    pub factors: Vec<f64>,
    /// Unlimited factors at the start: what the first iteration asked for, taken or not.
    pub first_unlimited_factors: Vec<f64>,
    /// Why it stopped.
    pub stop: Stop,
}

/// Runs the inner loop from the last exact modes.
///
/// `base` holds each parameter's factor from earlier passes and `total_ranges` the bounds on its whole product. At least
/// one step is tried even when the start is within tolerance, for the outer loop decides whether to begin.
///
/// # Errors
/// [`Error::Setting`], [`Error::Limits`], [`Error::WrongShape`] for settings, bounds and lists; those of [`error_changes`]
/// and [`stiffness_changes`]. A step too far for the perturbation is halved like one that raises $e_S$;
/// [`Error::CoalescingModes`] or [`Error::UnsettledRoots`] is returned when the first and all its halvings are.
///
/// # Example
///
/// ```rust
/// use corfem::method::inner_loop::{InnerSettings, Stop, run};
/// use corfem::method::model::{DynamicModel, ParameterMatrix};
/// # use corfem::method::modes::ModeSet;
/// # use nalgebra::{dmatrix, dvector};
///
/// // A unit mass on a spring of 4 beside a test mode of ω² = 9.
/// let shares = vec![ParameterMatrix::Stiffness(dmatrix![4.0])];
/// let model = DynamicModel { stiffness: dmatrix![4.0], mass: dmatrix![1.0], shares };
/// let test = ModeSet::new(dvector![9.0], dmatrix![1.0])?;
/// let inner = run(&model.analyze(&test, None)?, &[1.0], &[None], &InnerSettings::default())?;
/// // The first step asks for 1 + 0.8 · (3 · 1/3) · (1/3) / (4/9), and 1.5 is allowed.
/// assert!((inner.first_unlimited_factors[0] - 1.6).abs() < 0.001);
/// assert_eq!((inner.iterations[0].factors[0], inner.stop), (1.5, Stop::Tolerance));
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn run(
    model: &ModalModel,
    base: &[f64],
    total_ranges: &[Option<Bounds>],
    settings: &InnerSettings,
) -> Result<InnerRun, Error> {
    settings.check()?;
    InnerLoop::new(model, base, total_ranges, settings, &|state| {
        error_changes(model, state, settings.derivatives)
    })?
    .run()
}

/// Factors of (13) before any bound that the first iteration from the last exact modes asks for.
///
/// # Errors
/// Those of [`run`] for settings; those of [`error_changes`].
pub fn first_factors(model: &ModalModel, settings: &InnerSettings) -> Result<Vec<f64>, Error> {
    settings.check()?;
    let (ones, free) = (
        vec![1.0; model.shares.len()],
        vec![None; model.shares.len()],
    );
    let derivative = |state: &_| error_changes(model, state, settings.derivatives);
    let first = InnerLoop::new(model, &ones, &free, settings, &derivative)?;
    let direction = first.direction(&ModalState::start(model), &ones, true)?;
    Ok(direction.unlimited_factors)
}

/// The function that gives the change of the error sum by every parameter (12) at a state of one model: [`error_changes`] or a faster
/// form of it.
pub type Derivative<'a> = dyn Fn(&ModalState) -> Result<Vec<f64>, Error> + 'a;

/// What one inner loop works on.
pub(crate) struct InnerLoop<'a> {
    model: &'a ModalModel,
    base: &'a [f64],
    total_ranges: &'a [Option<Bounds>],
    settings: &'a InnerSettings,
    derivative: &'a Derivative<'a>,
}

/// A step that lowers the error sum, and where it leads.
struct Step {
    halvings: usize,
    limits: Vec<Limit>,
    factors: Vec<f64>,
    state: ModalState,
}

impl<'a> InnerLoop<'a> {
    pub(crate) fn new(
        model: &'a ModalModel,
        base: &'a [f64],
        total_ranges: &'a [Option<Bounds>],
        settings: &'a InnerSettings,
        derivative: &'a Derivative<'a>,
    ) -> Result<Self, Error> {
        check_length("parameter factors", base.len(), model.shares.len())?;
        check_length("parameter limits", total_ranges.len(), model.shares.len())?;
        for range in total_ranges.iter().flatten() {
            Bounds::positive("parameter limits", range.lower, range.upper)?;
        }
        Ok(Self {
            model,
            base,
            total_ranges,
            settings,
            derivative,
        })
    }

    pub(crate) fn run(&self) -> Result<InnerRun, Error> {
        let (mut factors, mut state) = (vec![1.0; self.base.len()], ModalState::start(self.model));
        let start = state.errors;
        let (mut iterations, mut first_unlimited_factors) = (Vec::new(), Vec::new());
        let stop = loop {
            if iterations.len() == self.settings.iterations {
                break Stop::Iterations;
            }
            let is_first = iterations.is_empty();
            let direction = self.direction(&state, &factors, is_first)?;
            if is_first {
                first_unlimited_factors.clone_from(&direction.unlimited_factors);
            }
            let step = match self.lowering_step(&state, &factors, &direction.unlimited_factors) {
                Ok(Some(step)) => step,
                Ok(None) => break Stop::LocalMinimum,
                // An error in the first step names the modes that prevent any; later ones end the loop where it is.
                Err(error) if error.is_of_close_modes() && !is_first => break Stop::LocalMinimum,
                Err(error) => return Err(error),
            };
            (factors, state) = (step.factors, step.state);
            iterations.push(Iteration {
                halvings: step.halvings,
                factors: factors.clone(),
                limits: step.limits,
                errors: state.errors,
                ..direction
            });
            if self.measured(&state) < self.settings.tolerance {
                break Stop::Tolerance;
            }
        };
        Ok(InnerRun {
            start,
            iterations,
            last: state,
            factors,
            first_unlimited_factors,
            stop,
        })
    }

    /// The error sum in the measure of the settings.
    fn measured(&self, state: &ModalState) -> f64 {
        self.settings.measure.scale(self.model.test.len()) * state.errors.sum()
    }

    /// Derivatives (12) and the factors of (13) at the present state: an iteration whose step is yet to come.
    fn direction(
        &self,
        state: &ModalState,
        factors: &[f64],
        is_first: bool,
    ) -> Result<Iteration, Error> {
        let settings = self.settings;
        let error_changes = (self.derivative)(state)?;
        let stiffness_changes =
            stiffness_changes(self.model, &state.factors, factors, settings.step);
        let relaxation = if is_first {
            settings.first_relaxation
        } else {
            settings.relaxation
        };
        let unlimited_factors = unlimited_factors(
            &error_changes,
            &stiffness_changes,
            self.measured(state),
            relaxation,
        );
        Ok(Iteration {
            error_changes,
            stiffness_changes,
            unlimited_factors,
            halvings: 0,
            factors: Vec::new(),
            limits: Vec::new(),
            errors: state.errors,
        })
    }

    /// Tries the limited step, then its halvings, and returns the first that lowers the error sum. When modes come too close in
    /// every trial, returns the last error.
    fn lowering_step(
        &self,
        state: &ModalState,
        factors: &[f64],
        unlimited: &[f64],
    ) -> Result<Option<Step>, Error> {
        let settings = self.settings;
        let (mut is_too_far, mut refusal) = (false, None);
        for halvings in 0..=settings.halvings {
            let fraction = 0.5_f64.powi(halvings as i32);
            let next = |e: usize| {
                let (total_range, base) = (self.total_ranges[e], self.base[e]);
                limited_factor(
                    unlimited[e],
                    fraction,
                    factors[e],
                    base,
                    settings.factor_range,
                    total_range,
                )
            };
            let (next, limits): (Vec<f64>, Vec<Limit>) = (0..factors.len()).map(next).unzip();
            let accumulated = |e: usize| {
                settings
                    .accumulation
                    .next_share_factor(state.factors[e], factors[e], next[e])
            };
            let share_factors = (0..factors.len()).map(accumulated).collect();
            match ModalState::at(self.model, share_factors, settings.update) {
                Ok(lower) if lower.errors.sum() < state.errors.sum() => {
                    return Ok(Some(Step {
                        halvings,
                        limits,
                        factors: next,
                        state: lower,
                    }));
                }
                // Uphill, or too far for the perturbation: a shorter step may do.
                Ok(_) | Err(Error::LostRoot { .. } | Error::NotAVibration { .. }) => {
                    is_too_far = true;
                }
                Err(error) if error.is_of_close_modes() => refusal = Some(error),
                Err(other) => return Err(other),
            }
        }
        refusal.filter(|_| !is_too_far).map_or(Ok(None), Err)
    }
}
