//! Bounded Gauss–Newton steps with Levenberg and Marquardt's damping, one exact analysis each.

use super::identifiability::{Identifiability, identifiability};
use super::residuals::{Weights, jacobian, residuals};
use crate::method::error::{Error, positive_setting};
use crate::method::linear_algebra::check_length;
use crate::method::model::{Check, ModalModel, Range};
use crate::studies::noisy_modes::split_mix_64;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Objectives this near count as the same: a $\chi^2$ of two thousandths, which no test can tell.
pub const SAME_OBJECTIVE: f64 = 1e-3;
/// Bounds of random first factors.
pub const FIRST_FACTORS: Range = Range { lower: 0.5, upper: 2.0 };

/// How a weighted correlation steps and when it stops.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WeightedSettings {
    /// Standard deviation $\tau$ of the logarithms of the factors before the test: Tikhonov's weight toward a factor of one is
    /// its inverse.
    pub prior_deviation: f64,
    /// Damping of the first step, relative to the curvature of each parameter.
    pub first_damping: f64,
    /// Longest step in the logarithm of any factor.
    pub longest_step: f64,
    /// Stop when no parameter alone would move by more than this many of its standard deviations with the others held.
    pub gradient_tolerance: f64,
    /// Stop when a step would move no logarithm by more than this.
    pub step_tolerance: f64,
    /// Most trial steps, taken or not: one exact analysis each.
    pub trials: usize,
}

impl Default for WeightedSettings {
    /// A prior of $\tau$ = 1: a first factor wrong by $e$ is one standard deviation, so that it decides where the test is
    /// silent and nowhere else. Damping 0.001, steps up to a factor of $e$, tolerances of a ten-thousandth of a standard
    /// deviation and a millionth of a factor, a hundred trials.
    fn default() -> Self {
        Self {
            prior_deviation: 1.0,
            first_damping: 1e-3,
            longest_step: 1.0,
            gradient_tolerance: 1e-4,
            step_tolerance: 1e-6,
            trials: 100,
        }
    }
}

/// Why a weighted correlation stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum WeightedStop {
    /// The gradient of what is not at a bound is within tolerance.
    Gradient,
    /// The step is.
    Step,
    /// The trials allowed were used up.
    Trials,
}

/// One accepted step.
#[derive(Debug, Clone)]
pub struct WeightedIteration {
    /// Factor of each parameter on its first value, after the step.
    pub factors: Vec<f64>,
    /// The exact solution there.
    pub check: Check,
    /// The objective there.
    pub objective: f64,
    /// Damping of the step.
    pub damping: f64,
}

/// A test mode that another analysis mode answers after a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Swap {
    /// The iteration, from one.
    pub iteration: usize,
    /// The test mode, from zero.
    pub test_mode: usize,
    /// Its analysis mode before, by its place in ascending order from zero.
    pub from: usize,
    /// After.
    pub to: usize,
}

/// The history of a weighted correlation.
#[derive(Debug, Clone)]
pub struct WeightedCorrelation {
    /// The exact solution at the first factors.
    pub initial: Check,
    /// The objective there.
    pub initial_objective: f64,
    /// Accepted steps.
    pub iterations: Vec<WeightedIteration>,
    /// Factor of each parameter on its first value, where it ended.
    pub factors: Vec<f64>,
    /// The objective there.
    pub objective: f64,
    /// Exact analyses made.
    pub analyses: usize,
    /// Why it stopped.
    pub stop: WeightedStop,
    /// Test modes whose analysis mode changed.
    pub swaps: Vec<Swap>,
    /// What the test modes see of the parameters there.
    pub identifiability: Identifiability,
}

/// Where a correlation stands: logarithms of the factors, and the exact solution there.
struct Place {
    logs: DVector<f64>,
    factors: Vec<f64>,
    model: ModalModel,
    residuals: DVector<f64>,
    objective: f64,
}

/// Lowers $\frac12 \sum r^2 + \frac12 \sum (\ln c_e)^2/\tau^2$ over the factors $c_e$ within their bounds, from `first`.
///
/// The unknowns are logarithms: factors stay positive, and twice and half as stiff are equally far. With the
/// [`jacobian`] $J$, $A = J^t J + I/\tau^2$ and the gradient $g$, a step solves
///
/// $$ (A + \mu \mathrm{diag} A) h = -g $$
///
/// for the parameters not held at a bound that the gradient presses them against. Those it takes beyond a bound stop there and the others
/// are solved for anew. It is taken if the exact objective falls. With $\varrho$, the fall over the one that the
/// quadratic model promised, $\mu$ is multiplied by $\max(\frac13, 1 - (2\varrho - 1)^3)$ then, and by 2, 4, 8, ... in
/// rejections on end. Test modes are paired anew at every place.
///
/// `analyze` returns the exact analysis at given factors and `ranges` bounds each, as for
/// [`crate::method::outer_loop::correlate`].
///
/// # Errors
/// Those of `analyze`, [`residuals`] and [`identifiability`]; [`Error::Setting`] and [`Error::Limits`] for settings and bounds out
/// of range, [`Error::WrongShape`] for lists that do not fit, [`Error::NotPositive`] by `analyze` for a first factor that is not.
///
/// Source: Marquardt, *Journal of the Society for Industrial and Applied Mathematics* 11 (1963), 431; Nielsen, *Damping Parameter
/// in Marquardt's Method*, IMM-REP-1999-05, Technical University of Denmark (1999).
pub fn gauss_newton<E: From<Error>>(
    mut analyze: impl FnMut(&[f64]) -> Result<ModalModel, E>,
    first: &[f64],
    ranges: &[Option<Range>],
    weights: &Weights,
    settings: &WeightedSettings,
) -> Result<WeightedCorrelation, E> {
    positive_setting("prior_deviation", settings.prior_deviation)?;
    positive_setting("first_damping", settings.first_damping)?;
    positive_setting("longest_step", settings.longest_step)?;
    positive_setting("gradient_tolerance", settings.gradient_tolerance)?;
    positive_setting("step_tolerance", settings.step_tolerance)?;
    check_length("parameter limits", ranges.len(), first.len())?;
    for range in ranges.iter().flatten() {
        Range::positive("parameter limits", range.lower, range.upper)?;
    }
    let prior = settings.prior_deviation.powi(-2);
    let mut place_at = |factors: Vec<f64>| -> Result<Place, E> {
        let clamped = factors.iter().zip(ranges).map(|(&factor, range)| range.map_or(factor, |r| r.clamp(factor)));
        let factors: Vec<f64> = clamped.collect();
        let model = analyze(&factors)?;
        check_length("parameter factors", factors.len(), model.shares.len())?;
        let logs = DVector::from_iterator(factors.len(), factors.iter().map(|factor| factor.ln()));
        let residuals = residuals(&model, weights)?;
        let objective = 0.5 * (residuals.norm_squared() + prior * logs.norm_squared());
        Ok(Place { logs, factors, model, residuals, objective })
    };
    let mut place = place_at(first.to_vec())?;
    let (initial, initial_objective) = (place.model.exact.clone(), place.objective);
    let (mut iterations, mut swaps): (Vec<WeightedIteration>, Vec<Swap>) = (Vec::new(), Vec::new());
    let (mut damping, mut growth, mut trials) = (settings.first_damping, 2.0, 0);
    let mut slopes = jacobian(&place.model, weights)?;
    let stop = loop {
        let gradient = slopes.tr_mul(&place.residuals) + prior * &place.logs;
        let curvature = slopes.tr_mul(&slopes) + prior * DMatrix::identity(first.len(), first.len());
        let limits = |e: usize| ranges[e].map_or((f64::NEG_INFINITY, f64::INFINITY), |r| (r.lower.ln(), r.upper.ln()));
        let room: Vec<(f64, f64)> = (0..first.len())
            .map(|e| ((limits(e).0 - place.logs[e]).min(0.0), (limits(e).1 - place.logs[e]).max(0.0)))
            .collect();
        let is_free = |&e: &usize| if gradient[e] > 0.0 { room[e].0 < 0.0 } else { room[e].1 > 0.0 };
        let free: Vec<usize> = (0..first.len()).filter(is_free).collect();
        let alone = |&e: &usize| gradient[e].abs() / curvature[(e, e)].sqrt();
        if free.iter().all(|e| alone(e) <= settings.gradient_tolerance) {
            break WeightedStop::Gradient;
        }
        if trials == settings.trials {
            break WeightedStop::Trials;
        }
        let mut step = bounded_step(&curvature, &gradient, free, &room, damping)?;
        step *= (settings.longest_step / step.amax()).min(1.0);
        if step.amax() <= settings.step_tolerance {
            break WeightedStop::Step;
        }
        trials += 1;
        let next = place_at(place.factors.iter().zip(&step).map(|(factor, step)| factor * step.exp()).collect())?;
        let promised = -gradient.dot(&step) - 0.5 * step.dot(&(&curvature * &step));
        let fall = place.objective - next.objective;
        if !(fall > 0.0 && promised > 0.0) {
            (damping, growth) = (damping * growth, 2.0 * growth);
            continue;
        }
        let pairs = place.model.exact.pairing.analysis_mode.iter().zip(&next.model.exact.pairing.analysis_mode);
        let swapped = pairs.enumerate().filter(|(_, (from, to))| from != to);
        let iteration = iterations.len() + 1;
        swaps.extend(swapped.map(|(test_mode, (&from, &to))| Swap { iteration, test_mode, from, to }));
        place = next;
        slopes = jacobian(&place.model, weights)?;
        let (factors, check, objective) = (place.factors.clone(), place.model.exact.clone(), place.objective);
        iterations.push(WeightedIteration { factors, check, objective, damping });
        damping *= (1.0 - (2.0 * fall / promised - 1.0).powi(3)).max(1.0 / 3.0);
        growth = 2.0;
    };
    let identifiability = identifiability(&slopes, settings.prior_deviation)?;
    let Place { factors, objective, .. } = place;
    let analyses = trials + 1;
    Ok(WeightedCorrelation {
        initial,
        initial_objective,
        iterations,
        factors,
        objective,
        analyses,
        stop,
        swaps,
        identifiability,
    })
}

/// The damped step of the `free` parameters within their `room` below and above: one that would leave it stops at its bound.
fn bounded_step(
    curvature: &DMatrix<f64>,
    gradient: &DVector<f64>,
    mut free: Vec<usize>,
    room: &[(f64, f64)],
    damping: f64,
) -> Result<DVector<f64>, Error> {
    let mut step = DVector::zeros(gradient.len());
    while !free.is_empty() {
        // What the parameters stopped at their bounds do to the others is on the right-hand side.
        let right = -(gradient + curvature * &step).select_rows(&free);
        let mut left = curvature.select_rows(&free).select_columns(&free);
        (0..free.len()).for_each(|e| left[(e, e)] *= 1.0 + damping);
        let factor = left.cholesky().ok_or(Error::NotPositiveDefinite { what: "damped curvature", dof: 0 })?;
        let solved = factor.solve(&right);
        let beyond = |place: usize| solved[place] < room[free[place]].0 || solved[place] > room[free[place]].1;
        let (out, within): (Vec<usize>, Vec<usize>) = (0..free.len()).partition(|&place| beyond(place));
        let held = if out.is_empty() { &within } else { &out };
        for &place in held {
            let (lower, upper) = room[free[place]];
            step[free[place]] = Range { lower, upper }.clamp(solved[place]);
        }
        free = if out.is_empty() { Vec::new() } else { within.into_iter().map(|place| free[place]).collect() };
    }
    Ok(step)
}

/// The best of several correlations, and how many lead to it.
#[derive(Debug, Clone)]
pub struct SeveralStarts {
    /// The one with the lowest objective.
    pub best: WeightedCorrelation,
    /// The objective of each.
    pub objectives: Vec<f64>,
    /// How many come within [`SAME_OBJECTIVE`] of the best.
    pub reached: usize,
}

/// [`gauss_newton`] from factors of one, and from `starts` − 1 random places: each factor is drawn log-uniformly from
/// [`FIRST_FACTORS`], by [`split_mix_64`] from `seed`, and brought within its bounds.
///
/// # Errors
/// Those of [`gauss_newton`]; [`Error::Empty`] without starts.
pub fn from_several_starts<E: From<Error>>(
    mut analyze: impl FnMut(&[f64]) -> Result<ModalModel, E>,
    ranges: &[Option<Range>],
    weights: &Weights,
    settings: &WeightedSettings,
    starts: usize,
    seed: u64,
) -> Result<SeveralStarts, E> {
    let (mut state, mut objectives, mut best) = (seed, Vec::new(), None::<WeightedCorrelation>);
    let ratio = FIRST_FACTORS.upper / FIRST_FACTORS.lower;
    let mut draw = || {
        let unit = (split_mix_64(&mut state) >> 11) as f64 / (1_u64 << 53) as f64;
        FIRST_FACTORS.lower * ratio.powf(unit)
    };
    for start in 0..starts {
        let first: Vec<f64> = ranges.iter().map(|_| if start == 0 { 1.0 } else { draw() }).collect();
        let found = gauss_newton(&mut analyze, &first, ranges, weights, settings)?;
        objectives.push(found.objective);
        best = best.filter(|best| best.objective <= found.objective).or(Some(found));
    }
    let best = best.ok_or(Error::Empty { what: "starts" })?;
    let reached = objectives.iter().filter(|&&objective| objective <= best.objective + SAME_OBJECTIVE).count();
    Ok(SeveralStarts { best, objectives, reached })
}
