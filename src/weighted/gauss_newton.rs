//! Bounded Gauss–Newton steps with Levenberg and Marquardt's damping, one exact analysis each.

use super::comparison::{Comparison, ExactResult};
use super::identifiability::{Identifiability, PRIOR_DEVIATION, identifiability};
use super::residuals::{jacobian, residuals};
use crate::method::error::{Error, positive};
use crate::method::linear_algebra::check_length;
use crate::method::step::Bounds;
use crate::sparse::ModeWeight;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Damping of the first step, relative to the curvature of each parameter.
const FIRST_DAMPING: f64 = 1e-3;
/// Longest step in the logarithm of any factor: $e$ times as soft or stiff.
const LONGEST_STEP: f64 = 1.0;
/// A step that moves no logarithm by more is none.
const SHORTEST_STEP: f64 = 1e-9;

/// Assumptions of a weighted correlation, and when it stops.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WeightedSettings {
    /// Standard deviations $\tau$ of the factors' logarithms before the test, one a parameter or one for all; their inverses are Tikhonov's
    /// weights toward one.
    pub prior_deviations: Vec<f64>,
    /// Stop when no parameter alone would move by more than this part of its standard deviation.
    pub tolerance: f64,
    /// Most trial steps, taken or not: one exact analysis each.
    pub trials: usize,
}

impl Default for WeightedSettings {
    /// [`PRIOR_DEVIATION`] for all; 1e-5 and a hundred trials.
    fn default() -> Self {
        Self {
            prior_deviations: vec![PRIOR_DEVIATION],
            tolerance: 1e-5,
            trials: 100,
        }
    }
}

impl WeightedSettings {
    /// Prior deviations of `count` parameters.
    pub(crate) fn priors(&self, count: usize) -> Vec<f64> {
        match self.prior_deviations[..] {
            [one] => vec![one; count],
            _ => self.prior_deviations.clone(),
        }
    }
}

/// Reason why a weighted correlation stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum WeightedStop {
    /// The gradient is within tolerance, but for what it presses against bounds.
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
    pub check: ExactResult,
    /// The objective there.
    pub objective: f64,
}

/// The history of a weighted correlation.
#[derive(Debug, Clone)]
pub struct WeightedCorrelation {
    /// The exact solution at the first factors.
    pub initial: ExactResult,
    /// Accepted steps.
    pub iterations: Vec<WeightedIteration>,
    /// Factor of each parameter on its first value, where it ended.
    pub factors: Vec<f64>,
    /// The objective where it ended.
    pub objective: f64,
    /// Exact analyses made.
    pub analyses: usize,
    /// Reason why it stopped.
    pub stop: WeightedStop,
    /// Identifiability of the parameters there.
    pub identifiability: Identifiability,
}

/// Place where a correlation stands.
struct Iterate {
    factors: Vec<f64>,
    comparison: Comparison,
    jacobian: DMatrix<f64>,
    objective: f64,
    gradient: DVector<f64>,
    curvature: DMatrix<f64>,
}

/// Lowers $\frac{1}{2} \sum r^2 + \frac{1}{2} \sum (\ln s_e/\tau_e)^2$ over the factors $s_e$ within their bounds, from `first`.
///
/// The unknowns are logarithms: factors stay positive, and twice and half as stiff are equally far. With the
/// [`jacobian`] $J$, $A = J^t J + \mathrm{diag}(\tau^{-2})$ and the gradient $g$, a step solves
///
/// $$ (A + \mu \mathrm{diag} A) h = -g $$
///
/// for the parameters that the gradient does not press against a bound. Those it takes beyond one stop there and the
/// others are solved for anew. It is taken if the exact objective falls. With $\rho$, the fall over the one that the
/// quadratic model promised, $\mu$ is multiplied by $\max(\frac{1}{3}, 1 - (2\rho - 1)^3)$ then, and by 2, 4, 8, ... in
/// rejections on end. A step to where `analyze` fails is rejected as well. Test modes are paired anew at every place.
///
/// The first trial from every place goes to where the same steps end in the basis of its model, without another analysis: where the
/// lowest modes and residual vectors tell all, that is the end. The exact objective decides there too.
///
/// `analyze` and `ranges` are those of [`crate::method::outer_loop::correlate`]. Source: Marquardt, *SIAM Journal* 11
/// (1963), 431; Nielsen, *Damping Parameter in Marquardt's Method*, IMM-REP-1999-05, Technical University of Denmark
/// (1999).
///
/// # Errors
/// What `analyze` refuses at the first factors; [`Error::Value`], [`Error::Range`] and [`Error::WrongShape`] for settings and lists out of
/// range, and for residuals that are not finite.
pub fn gauss_newton<E: From<Error>>(
    mut analyze: impl FnMut(&[f64]) -> Result<Comparison, E>,
    first: &[f64],
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
) -> Result<WeightedCorrelation, E> {
    Problem::new(first.len(), ranges, weights, settings)?.steps(&mut analyze, true, first)
}

/// Problem that the steps of a correlation share.
pub(super) struct Problem<'a> {
    ranges: &'a [Option<Bounds>],
    weights: &'a [ModeWeight],
    settings: &'a WeightedSettings,
    priors: Vec<f64>,
    /// $1/\tau^2$ of every parameter.
    tikhonov: DVector<f64>,
}

impl<'a> Problem<'a> {
    pub(super) fn new(
        count: usize,
        ranges: &'a [Option<Bounds>],
        weights: &'a [ModeWeight],
        settings: &'a WeightedSettings,
    ) -> Result<Self, Error> {
        let priors = settings.priors(count);
        check_length("prior deviations", priors.len(), count)?;
        let owner = || "the weighted steps".to_owned();
        for prior in &priors {
            positive("prior_deviation", owner, *prior)?;
        }
        positive("tolerance", owner, settings.tolerance)?;
        check_length("parameter limits", ranges.len(), count)?;
        for range in ranges.iter().flatten() {
            Bounds::positive("parameter limits", range.lower, range.upper)?;
        }
        let tikhonov = priors.iter().map(|prior| prior.powi(-2));
        Ok(Self {
            tikhonov: DVector::from_iterator(count, tikhonov),
            ranges,
            weights,
            settings,
            priors,
        })
    }

    /// The exact analysis at factors brought within their bounds.
    fn place_at<E: From<Error>>(
        &self,
        analyze: &mut dyn FnMut(&[f64]) -> Result<Comparison, E>,
        factors: Vec<f64>,
    ) -> Result<Iterate, E> {
        let within = |(&factor, range): (&f64, &Option<Bounds>)| {
            range.map_or(factor, |range| factor.clamp(range.lower, range.upper))
        };
        let factors: Vec<f64> = factors.iter().zip(self.ranges).map(within).collect();
        let comparison = analyze(&factors)?;
        check_length(
            "parameter factors",
            factors.len(),
            comparison.model.shares.len(),
        )?;
        let logs = DVector::from_iterator(factors.len(), factors.iter().map(|factor| factor.ln()));
        let residuals = residuals(&comparison, self.weights)?;
        let jacobian = jacobian(&comparison, self.weights)?;
        let pull = self.tikhonov.component_mul(&logs);
        Ok(Iterate {
            objective: 0.5 * (residuals.norm_squared() + pull.dot(&logs)),
            gradient: jacobian.tr_mul(&residuals) + pull,
            curvature: jacobian.tr_mul(&jacobian) + DMatrix::from_diagonal(&self.tikhonov),
            factors,
            comparison,
            jacobian,
        })
    }

    /// Steps from `first`; those whose analyses are exact look ahead in the basis of each.
    pub(super) fn steps<E: From<Error>>(
        &self,
        analyze: &mut dyn FnMut(&[f64]) -> Result<Comparison, E>,
        is_exact: bool,
        first: &[f64],
    ) -> Result<WeightedCorrelation, E> {
        let mut place = self.place_at(analyze, first.to_vec())?;
        let initial = place.comparison.result()?;
        let mut is_new = is_exact;
        let (mut iterations, mut trials) = (Vec::new(), 0);
        let (mut damping, mut growth) = (FIRST_DAMPING, 2.0);
        let stop = loop {
            let room = place.room(self.ranges);
            let free = place.free(&room);
            let is_flat = |&e: &usize| {
                let deviations = place.curvature[(e, e)].sqrt();
                place.gradient[e].abs() <= self.settings.tolerance * deviations
            };
            if free.iter().all(is_flat) {
                break WeightedStop::Gradient;
            }
            if trials == self.settings.trials {
                break WeightedStop::Trials;
            }
            if std::mem::take(&mut is_new)
                && let Some(ahead) = self.ahead(&place)
            {
                trials += 1;
                if let Ok(next) = self.place_at(analyze, ahead)
                    && next.objective < place.objective
                {
                    (place, is_new) = (next, is_exact);
                    iterations.push(place.iteration()?);
                }
                continue;
            }
            let mut step = bounded_step(&place.curvature, &place.gradient, free, &room, damping)?;
            step *= (LONGEST_STEP / step.amax()).min(1.0);
            if step.amax() <= SHORTEST_STEP {
                break WeightedStop::Step;
            }
            trials += 1;
            let both = place.factors.iter().zip(&step);
            let trial = both.map(|(factor, step)| factor * step.exp()).collect();
            // A place without a model is no better than this one, nor is one where the objective has not fallen.
            let next = self.place_at(analyze, trial).ok();
            let promised = place.promised_fall(&step);
            let fall = |next: &Iterate| place.objective - next.objective;
            let Some(next) = next.filter(|next| fall(next) > 0.0 && promised > 0.0) else {
                (damping, growth) = (damping * growth, 2.0 * growth);
                continue;
            };
            let ratio = fall(&next) / promised;
            (place, is_new) = (next, is_exact);
            iterations.push(place.iteration()?);
            damping *= (1.0 - (2.0 * ratio - 1.0).powi(3)).max(1.0 / 3.0);
            growth = 2.0;
        };
        Ok(WeightedCorrelation {
            initial,
            iterations,
            identifiability: identifiability(&place.jacobian, &self.priors)?,
            factors: place.factors,
            objective: place.objective,
            analyses: trials + 1,
            stop,
        })
    }

    /// Factors where the steps from a place end in the basis of its model; none if nowhere else.
    fn ahead(&self, place: &Iterate) -> Option<Vec<f64>> {
        let mut follow = |factors: &[f64]| {
            let both = factors.iter().zip(&place.factors);
            let change: Vec<f64> = both.map(|(factor, from)| factor / from).collect();
            place.comparison.followed(&change)
        };
        let found = self.steps::<Error>(&mut follow, false, &place.factors);
        let found = found.ok().filter(|found| !found.iterations.is_empty())?;
        Some(found.factors)
    }
}

impl Iterate {
    fn iteration(&self) -> Result<WeightedIteration, Error> {
        Ok(WeightedIteration {
            factors: self.factors.clone(),
            check: self.comparison.result()?,
            objective: self.objective,
        })
    }

    /// Room of every logarithm within the bounds.
    fn room(&self, ranges: &[Option<Bounds>]) -> Vec<Bounds> {
        let (lower, upper) = (0.0, f64::INFINITY);
        let room = |(range, factor): (&Option<Bounds>, &f64)| {
            let range = range.unwrap_or(Bounds { lower, upper });
            Bounds {
                lower: (range.lower / factor).ln(),
                upper: (range.upper / factor).ln(),
            }
        };
        ranges.iter().zip(&self.factors).map(room).collect()
    }

    /// Parameters that the gradient does not press against a bound.
    fn free(&self, room: &[Bounds]) -> Vec<usize> {
        let is_free = |&e: &usize| match self.gradient[e] > 0.0 {
            true => room[e].lower < 0.0,
            false => room[e].upper > 0.0,
        };
        (0..room.len()).filter(is_free).collect()
    }

    /// Fall of the objective that the quadratic model promises for a step.
    fn promised_fall(&self, step: &DVector<f64>) -> f64 {
        -self.gradient.dot(step) - 0.5 * step.dot(&(&self.curvature * step))
    }
}

/// The damped step of the `free` parameters within their `room` below and above: one that would leave it stops at its bound.
fn bounded_step(
    curvature: &DMatrix<f64>,
    gradient: &DVector<f64>,
    mut free: Vec<usize>,
    room: &[Bounds],
    damping: f64,
) -> Result<DVector<f64>, Error> {
    let mut step = DVector::zeros(gradient.len());
    loop {
        // What the parameters stopped at their bounds do to the others is on the right-hand side.
        let right = -(gradient + curvature * &step).select_rows(&free);
        let mut left = curvature.select_rows(&free).select_columns(&free);
        (0..free.len()).for_each(|e| left[(e, e)] *= 1.0 + damping);
        let factor = left.cholesky().ok_or(Error::NotPositiveDefinite {
            what: "damped curvature",
            row: 0,
        })?;
        let solved = factor.solve(&right);
        let within = |place: &usize| room[free[*place]].contains(solved[*place]);
        let (inside, beyond): (Vec<usize>, Vec<usize>) = (0..free.len()).partition(within);
        if beyond.is_empty() {
            inside
                .iter()
                .for_each(|&place| step[free[place]] = solved[place]);
            return Ok(step);
        }
        beyond.into_iter().for_each(|place| {
            step[free[place]] = {
                let Bounds { lower, upper } = room[free[place]];
                solved[place].clamp(lower, upper)
            }
        });
        free = inside.into_iter().map(|place| free[place]).collect();
    }
}
