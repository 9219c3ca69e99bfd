//! The inner loop: steps by perturbation alone, from one exact solution to the next.
//! Tour: [chapter 6](crate::tour::chapter_06_inner_loop).

use super::{
    analysis::{Analysis, State},
    error::{Error, Result, positive},
    error_sum::Errors,
    linear_algebra::check_length,
    step::{Bounds, StepRule, limited_factor, next_share_factor, unlimited_factor},
};
use serde::Serialize;

/// Settings of the inner loop: how it steps and when it stops.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InnerSettings {
    /// Relaxation $R$ of the first iteration of a pass.
    pub first_relaxation: f64,
    /// Relaxation $R$ of the others.
    pub relaxation: f64,
    /// Bounds of one iteration's factor.
    pub factor_range: Bounds,
    /// Tolerance TOLI on the error sum $e_S$.
    pub tolerance: f64,
    /// Ours: halvings of a step that does not lower $e_S$ before the place counts as a local minimum; zero stops
    /// at the first rise.
    pub halvings: usize,
    /// Most iterations (accepted steps).
    pub iterations: usize,
    /// Reading of the step.
    pub step: StepRule,
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
            step: StepRule::Matrix,
        }
    }
}

impl InnerSettings {
    fn check(&self) -> Result<()> {
        let Bounds { lower, upper } = self.factor_range;
        Bounds::positive("factor limits", lower, upper)?;
        let owner = || "the inner loop".into();
        positive("first_relaxation", owner, self.first_relaxation)?;
        positive("relaxation", owner, self.relaxation)?;
        positive("tolerance", owner, self.tolerance)
    }
}

/// Reason why an inner loop stopped.
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
    /// Number of halvings of the step.
    pub halvings: usize,
    /// Factor $g_e$ on each parameter's gage since the last exact solution, after the step.
    pub gage_factors: Vec<f64>,
    /// Errors after the step.
    pub errors: Errors,
}

/// The history of one inner loop.
#[derive(Debug, Clone)]
pub struct InnerRun {
    /// Accepted steps.
    pub iterations: Vec<Iteration>,
    /// State where the loop ended, with the factors on the stored stiffness.
    pub last: State,
    /// Factor $g_e$ on each parameter's gage since the last exact solution, where it ended.
    pub gage_factors: Vec<f64>,
    /// Reason why it stopped.
    pub stop: Stop,
}

/// Runs the inner loop from the last exact modes.
///
/// `earlier` holds each parameter's factor from earlier passes and `gage_bounds` the bounds on its whole product. At least
/// one step is tried even when the start is within tolerance, for the outer loop decides whether to begin.
///
/// # Errors
/// Settings out of their ranges, lists of other lengths, and a parameter of which no derivative can be taken. A step too far for the
/// perturbation is halved like one that raises $e_S$; modes too close to follow are an error when the first step and all its halvings bring
/// them so close.
///
/// # Example
///
/// ```rust
/// use corfem::method::inner_loop::{Stop, run};
/// use corfem::method::model::DynamicModel;
/// use corfem::method::outer_loop::Settings;
/// # use corfem::method::modes::Modes;
/// # use nalgebra::{dmatrix, dvector};
///
/// // A unit mass on a spring of 4 beside a test mode of ω² = 9.
/// let spring = dmatrix![4.0];
/// let model = DynamicModel { stiffness: spring.clone(), mass: dmatrix![1.0], shares: vec![spring] };
/// let test = Modes::new(dvector![9.0], dmatrix![1.0])?;
/// let settings = Settings::default().for_modes(1).inner; // steps and tolerances of one mode for the paper's nine
/// let inner = run(&model.analyze(&test, None)?, &[1.0], &[None], &settings)?;
/// // The first step asks for a factor of 1.6 and gets the 1.5 that one iteration may.
/// assert!((inner.iterations[0].unlimited_factors[0] - 1.6).abs() < 0.001);
/// assert_eq!((inner.iterations[0].gage_factors[0], inner.stop), (1.5, Stop::Tolerance));
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn run(
    analysis: &dyn Analysis,
    earlier: &[f64],
    gage_bounds: &[Option<Bounds>],
    settings: &InnerSettings,
) -> Result<InnerRun> {
    settings.check()?;
    check_length("parameter limits", gage_bounds.len(), earlier.len())?;
    let ones = vec![1.0; earlier.len()];
    let mut run = InnerRun {
        iterations: Vec::new(),
        last: analysis.at(&ones)?,
        gage_factors: ones,
        stop: Stop::Iterations,
    };
    while run.iterations.len() < settings.iterations {
        let is_first = run.iterations.is_empty();
        let direction = direction(analysis, &run.last, &run.gage_factors, is_first, settings)?;
        match lowering_step(analysis, &run, direction, earlier, gage_bounds, settings) {
            Ok(Some((iteration, lower))) => {
                run.last = lower;
                run.gage_factors.clone_from(&iteration.gage_factors);
                run.iterations.push(iteration);
            }
            // An error in the first step names the modes that prevent any; later ones end the loop where it is.
            Err(error) if is_first || !error.is_of_close_modes() => return Err(error),
            _ => {
                run.stop = Stop::LocalMinimum;
                break;
            }
        }
        if run.last.errors.sum() < settings.tolerance {
            run.stop = Stop::Tolerance;
            break;
        }
    }
    Ok(run)
}

/// Factors of (13) before any bound that the first iteration from the last exact modes asks for.
///
/// # Errors
/// Settings out of their ranges, and a parameter of which no derivative can be taken.
pub fn first_factors(analysis: &dyn Analysis, settings: &InnerSettings) -> Result<Vec<f64>> {
    settings.check()?;
    let ones = vec![1.0; analysis.exact().share_factors.len()];
    let [.., unlimited] = direction(analysis, &analysis.at(&ones)?, &ones, true, settings)?;
    Ok(unlimited)
}

/// $\Delta e$ and $\Delta k$ of every parameter (12) at a state, and the factors of (13).
fn direction(
    analysis: &dyn Analysis,
    state: &State,
    gage_factors: &[f64],
    is_first: bool,
    settings: &InnerSettings,
) -> Result<[Vec<f64>; 3]> {
    let error_changes = analysis.error_changes(state)?;
    let stiffness_changes = analysis.stiffness_changes(state, gage_factors, settings.step);
    let relaxation = if is_first {
        settings.first_relaxation
    } else {
        settings.relaxation
    };
    let factor = |(error, stiffness): (&f64, &f64)| {
        unlimited_factor(*error, *stiffness, state.errors.sum(), relaxation)
    };
    let changes = error_changes.iter().zip(&stiffness_changes);
    let unlimited_factors = changes.map(factor).collect();
    Ok([error_changes, stiffness_changes, unlimited_factors])
}

/// Tries the limited step, then its halvings, and returns the first that lowers the error sum. When modes come too close in
/// every trial, returns the last error.
fn lowering_step(
    analysis: &dyn Analysis,
    InnerRun {
        last, gage_factors, ..
    }: &InnerRun,
    [error_changes, stiffness_changes, unlimited_factors]: [Vec<f64>; 3],
    earlier: &[f64],
    gage_bounds: &[Option<Bounds>],
    settings: &InnerSettings,
) -> Result<Option<(Iteration, State)>> {
    let (mut is_too_far, mut refusal) = (false, None);
    for halvings in 0..=settings.halvings {
        let fraction = 0.5_f64.powi(halvings as i32);
        let limited = |e: usize| {
            limited_factor(
                unlimited_factors[e],
                fraction,
                gage_factors[e],
                earlier[e],
                settings.factor_range,
                gage_bounds[e],
            )
        };
        let next: Vec<f64> = (0..gage_factors.len()).map(limited).collect();
        let share = |e: usize| next_share_factor(last.share_factors[e], gage_factors[e], next[e]);
        match analysis.at(&(0..gage_factors.len()).map(share).collect::<Vec<_>>()) {
            Ok(lower) if lower.errors.sum() < last.errors.sum() => {
                let iteration = Iteration {
                    error_changes,
                    stiffness_changes,
                    unlimited_factors,
                    halvings,
                    gage_factors: next,
                    errors: lower.errors,
                };
                return Ok(Some((iteration, lower)));
            }
            // Uphill, or too far for the perturbation: a shorter step may do.
            Ok(_) | Err(Error::NotAVibration { .. }) => is_too_far = true,
            Err(error) if error.is_of_close_modes() => refusal = Some(error),
            Err(other) => return Err(other),
        }
    }
    refusal.filter(|_| !is_too_far).map_or(Ok(None), Err)
}
