//! Bounded Gauss–Newton steps with Levenberg and Marquardt's damping, one exact analysis each.

use super::comparison::{Comparison, ExactResult};
use super::identifiability::{
    Identifiability, PRIOR_DEVIATION, identifiability, information, tikhonov,
};
use super::residuals::{jacobian, residuals};
use super::second_order::SecondOrder;
use crate::method::error::{Error, positive};
use crate::method::linear_algebra::check_length;
use crate::method::step::Bounds;
use crate::sparse::{ModeWeight, solve_positive};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Damping of the first step, relative to the curvature of each parameter.
const FIRST_DAMPING: f64 = 1e-3;
/// Longest step in the logarithm of any factor: $e$ times as soft or stiff.
const LONGEST_STEP: f64 = 1.0;
/// Part of the fall that a basis promised by which the exact one may differ before the next basis gets further deflections.
const WRONG_PROMISE: f64 = 0.1;
/// Part of the fall of the first step that the last one in a basis may leave: a tenth of what the basis was wrong by.
const LEFT: f64 = 0.1 * WRONG_PROMISE;
/// Rounding of an objective, relative to it: of a sum of squares of residuals that an analysis tells to some 1e-10.
const OBJECTIVE_DIGITS: f64 = 1e-12;
/// Fall of the objective below an end that is worth to go on: a chi-squared of two thousandths, which no test can tell.
pub(crate) const LOWER: f64 = 1e-3;
/// Part of it that steps may leave which do not lead lower.
const TOLD: f64 = 0.01;
/// Steps that move no logarithm by more end the iteration.
const SHORTEST_STEP: f64 = 1e-9;

/// Assumptions of a weighted correlation, and when it stops.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WeightedSettings {
    /// Standard deviations $\tau$ of the factors' logarithms before the test, one a parameter or one for all; their inverses are Tikhonov's
    /// weights toward one.
    pub prior_deviations: Vec<f64>,
    /// Stop when no parameter alone would move by more than this part of its standard deviation, or all together by more than a step of
    /// this size in deviations.
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

    /// The prior's part of twice the objective, $\sum (\ln s_e/\tau_e)^2$.
    pub(crate) fn pull(&self, factors: &[f64]) -> f64 {
        let pulls = factors.iter().zip(self.priors(factors.len()));
        pulls
            .map(|(factor, prior)| (factor.ln() / prior).powi(2))
            .sum()
    }
}

/// Reason why a weighted correlation stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum WeightedStop {
    /// A step that nothing damps promises a fall within tolerance, but for what the gradient presses against bounds; or one that no test
    /// can tell, where shorter steps found none.
    Gradient,
    /// Only short steps promise as little: ahead of them pairs of modes change or meet, or the digits of an analysis tell no lower place.
    Short,
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
    /// The model there.
    pub last: Comparison,
}

impl WeightedCorrelation {
    /// The history of these steps and of others from a lower place.
    pub(crate) fn and_then(self, next: Self) -> Self {
        Self {
            initial: self.initial,
            iterations: [self.iterations, next.iterations].concat(),
            analyses: self.analyses + next.analyses,
            ..next
        }
    }
}

/// Place where a correlation stands.
struct Iterate {
    factors: Vec<f64>,
    comparison: Comparison,
    residuals: DVector<f64>,
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
/// for the parameters that the gradient does not press against a bound, with the [`SecondOrder`] of
/// the residuals beside $A$ where that foretold the last step better. Those it takes beyond one stop there and the
/// others are solved for anew. It is taken if the exact objective falls. With $\rho$, the fall over the one that the
/// quadratic model promised, $\mu$ is multiplied by $\max(\frac{1}{3}, 1 - (2\rho - 1)^3)$ then, and by 2, 4, 8, ... in
/// rejections on end. A step to where `analyze` fails is rejected as well. Test modes are paired anew at every place.
///
/// The trial from every place goes to where such steps end in a basis, without another analysis: the modes and the deflections of the
/// compared ones along the first step, with slopes corrected to the exact ones. Where a model has all its modes, that is the end. The
/// exact objective decides. A basis that promised another fall than there was is followed by one with deflections of all parameters, in
/// which $\mu \thinspace \mathrm{diag} A$ holds the factors at the place. Steps end where the fall that is promised without damping is
/// that of a step shorter than the tolerance, or the round-off of the objective; and short of that where rejections have damped
/// them until they promise no more.
///
/// `analyze` and `ranges` are those of [`crate::method::outer_loop::correlate`]. Source: Marquardt, *SIAM Journal* 11
/// (1963), 431; Nielsen, *Damping Parameter in Marquardt's Method*, IMM-REP-1999-05, Technical University of Denmark
/// (1999).
///
/// # Errors
/// What `analyze` refuses at the first factors; [`Error::Value`], [`Error::Range`] and [`Error::WrongShape`] for settings and lists out of
/// range, and for residuals that are not finite.
pub fn gauss_newton<E: From<Error>>(
    analyze: impl FnMut(&[f64]) -> Result<Comparison, E>,
    first: &[f64],
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
) -> Result<WeightedCorrelation, E> {
    gauss_newton_below(f64::INFINITY, analyze, first, ranges, weights, settings)
}

/// Steps of [`gauss_newton`] that have to end below an `objective`: above it they end where they promise no more than a hundredth of
/// [`LOWER`].
///
/// # Errors
/// The errors of [`gauss_newton`].
pub(crate) fn gauss_newton_below<E: From<Error>>(
    objective: f64,
    mut analyze: impl FnMut(&[f64]) -> Result<Comparison, E>,
    first: &[f64],
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
) -> Result<WeightedCorrelation, E> {
    let mut problem = Problem::new(first.len(), ranges, weights, settings)?;
    problem.objective = objective;
    problem.correlation(&mut analyze, first)
}

/// Problem that the steps of a correlation share.
pub(super) struct Problem<'a> {
    /// The objective below which steps have to end.
    objective: f64,
    ranges: &'a [Option<Bounds>],
    weights: &'a [ModeWeight],
    settings: &'a WeightedSettings,
    priors: Vec<f64>,
    /// $1/\tau^2$ of every parameter.
    tikhonov: DVector<f64>,
    /// Logarithms from which a term of the objective holds the steps, and its curvature for each.
    held: Option<(DVector<f64>, DVector<f64>)>,
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
        Ok(Self {
            tikhonov: tikhonov(&priors),
            held: None,
            objective: f64::INFINITY,
            ranges,
            weights,
            settings,
            priors,
        })
    }

    /// A problem with a term that holds the steps at these logarithms, with a curvature for each.
    pub(super) fn held_at(self, logs: DVector<f64>, curvature: DVector<f64>) -> Self {
        Self {
            held: Some((logs, curvature)),
            ..self
        }
    }

    /// The exact analysis at factors brought within their bounds; none where the objective is not below a number.
    fn place_at<E: From<Error>>(
        &self,
        analyze: &mut dyn FnMut(&[f64]) -> Result<Comparison, E>,
        factors: Vec<f64>,
        below: f64,
    ) -> Result<Option<Iterate>, E> {
        let factors = self.within(&factors);
        let comparison = analyze(&factors)?;
        let count = comparison.model.moves.ncols();
        check_length("parameter factors", factors.len(), count)?;
        let residuals = residuals(&comparison, self.weights)?;
        let (pull, held) = self.pull(&factors);
        let objective = 0.5 * residuals.norm_squared() + held;
        if objective >= below {
            return Ok(None);
        }
        // Slopes are needed of a place that is kept alone.
        let comparison = comparison.with_slopes()?;
        let jacobian = jacobian(&comparison, self.weights)?;
        let mut curvature = information(&jacobian, &self.tikhonov);
        if let Some((_, held)) = &self.held {
            curvature += DMatrix::from_diagonal(held);
        }
        Ok(Some(Iterate {
            gradient: jacobian.tr_mul(&residuals) + pull,
            objective,
            curvature,
            factors,
            comparison,
            residuals,
            jacobian,
        }))
    }

    /// Factors brought within their bounds.
    fn within(&self, factors: &[f64]) -> Vec<f64> {
        let within = |(&factor, range): (&f64, &Option<Bounds>)| {
            range.map_or(factor, |range| factor.clamp(range.lower, range.upper))
        };
        factors.iter().zip(self.ranges).map(within).collect()
    }

    /// The gradient of the prior's part of the objective, and of what holds the steps, and both parts.
    fn pull(&self, factors: &[f64]) -> (DVector<f64>, f64) {
        let logs = logs_of(factors);
        let mut pull = logs.component_mul(&self.tikhonov);
        let mut part = 0.5 * pull.dot(&logs);
        if let Some((from, curvature)) = &self.held {
            let moved = logs - from;
            let held = moved.component_mul(curvature);
            part += 0.5 * held.dot(&moved);
            pull += held;
        }
        (pull, part)
    }

    /// Fall at an objective below which a step is none.
    fn least(&self, objective: f64) -> f64 {
        let digits = OBJECTIVE_DIGITS * objective;
        let least = digits.max(0.5 * self.settings.tolerance.powi(2));
        match objective > self.objective {
            true => least.max(TOLD * LOWER),
            false => least,
        }
    }

    /// The exact analysis at the first factors.
    fn first_at<E: From<Error>>(
        &self,
        analyze: &mut dyn FnMut(&[f64]) -> Result<Comparison, E>,
        first: &[f64],
    ) -> Result<Iterate, E> {
        let place = self.place_at(analyze, first.to_vec(), f64::INFINITY)?;
        Ok(place.ok_or(Error::no_convergence("weighted steps"))?)
    }

    /// The history of the steps from `first`, an exact analysis each.
    fn correlation<E: From<Error>>(
        &self,
        analyze: &mut dyn FnMut(&[f64]) -> Result<Comparison, E>,
        first: &[f64],
    ) -> Result<WeightedCorrelation, E> {
        let mut place = self.first_at(analyze, first)?;
        let (initial, mut iterations) = (place.comparison.result()?, Vec::new());
        let (mut trials, mut further, mut damping) = (0, 0, Damping::FIRST);
        let mut second_order = SecondOrder::new(first.len());
        let most = 6 * place.comparison.model.test.len() + 30;
        let stop = loop {
            let least = self.least(place.objective);
            let whole = self.whole_fall(&place)?;
            // A place where a mode meets another is no end: its slopes are not those of the objective.
            if whole <= least && !place.comparison.meets() {
                break WeightedStop::Gradient;
            }
            let foretold = self.foretold(&place, &second_order, damping.now)?;
            let Some((promised, step)) = foretold.filter(|(fall, _)| *fall > least) else {
                break place.end(whole);
            };
            if trials == self.settings.trials {
                break WeightedStop::Trials;
            }
            trials += 1;
            let ahead = self.ahead(
                &place,
                (promised, &step),
                damping.now,
                further,
                &mut second_order,
            );
            let (promised, trial) = ahead.unwrap_or_else(|| (promised, place.after(&step)));
            place.comparison.model.release();
            // A place without a model is no better than this one.
            let next = self
                .place_at(analyze, trial, place.objective)
                .ok()
                .flatten();
            let fall = next
                .as_ref()
                .map_or(0.0, |next| place.objective - next.objective);
            if (fall - promised).abs() > WRONG_PROMISE * promised {
                further = most;
            }
            match next {
                Some(next) => {
                    next.teach(&mut second_order, &place);
                    place = next;
                    damping.after(fall / promised);
                    iterations.push(place.iteration()?);
                }
                None => damping.more(),
            }
        };
        Ok(WeightedCorrelation {
            initial,
            iterations,
            identifiability: identifiability(&place.jacobian, &self.priors)?,
            factors: place.factors,
            objective: place.objective,
            last: place.comparison,
            analyses: trials + 1,
            stop,
        })
    }

    /// The lowest objective that steps in one basis find from `first`, with an estimate of the second order, and the factors there, but for
    /// a fall that may be `left`, and as far as to an objective that is low `enough`.
    pub(super) fn lowest(
        &self,
        second_order: &mut SecondOrder,
        analyze: &mut dyn FnMut(&[f64]) -> Result<Comparison, Error>,
        first: &[f64],
        (left, enough): (f64, f64),
    ) -> Result<(f64, Vec<f64>), Error> {
        let (mut place, mut foretold) = (self.first_at(analyze, first)?, 0.0);
        let mut damping = Damping::FIRST;
        for _ in 0..self.settings.trials {
            let Some((promised, step)) = self.foretold(&place, second_order, damping.now)? else {
                break;
            };
            if place.objective < enough {
                break;
            }
            if promised <= left && place.objective - promised >= enough {
                foretold = promised.max(0.0);
                break;
            }
            let next = self.place_at(analyze, place.after(&step), place.objective);
            match next.ok().flatten().filter(|_| promised > 0.0) {
                Some(next) => {
                    damping.after((place.objective - next.objective) / promised);
                    next.teach(second_order, &place);
                    place = next;
                }
                None => damping.more(),
            }
        }
        Ok((place.objective - foretold, place.factors))
    }

    /// The damped step and the fall that it promises, with the second order in the curvature where its estimate is used.
    fn foretold(
        &self,
        place: &Iterate,
        second_order: &SecondOrder,
        damping: f64,
    ) -> Result<Option<(f64, DVector<f64>)>, Error> {
        if let Some(sum) = second_order.told()
            && let Ok(Some(step)) = self.step(place, &(&place.curvature + sum), damping)
        {
            return Ok(Some(step));
        }
        self.step(place, &place.curvature, damping)
    }

    /// The damped step of a curvature from a place within the room of every logarithm, if there is one, and the fall that it promises.
    fn step(
        &self,
        place: &Iterate,
        curvature: &DMatrix<f64>,
        damping: f64,
    ) -> Result<Option<(f64, DVector<f64>)>, Error> {
        let room = place.room(self.ranges);
        let free = place.free(&room);
        let is_flat = |&e: &usize| {
            let deviations = place.curvature[(e, e)].sqrt();
            place.gradient[e].abs() <= self.settings.tolerance * deviations
        };
        if free.iter().all(is_flat) {
            return Ok(None);
        }
        let mut step = bounded_step(curvature, &place.gradient, free, &room, damping)?;
        step *= (LONGEST_STEP / step.amax()).min(1.0);
        let fall = place.promised_fall(curvature, &step);
        Ok((step.amax() > SHORTEST_STEP).then_some((fall, step)))
    }

    /// Fall that a step promises which nothing damps; zero without one.
    fn whole_fall(&self, place: &Iterate) -> Result<f64, Error> {
        let step = self.step(place, &place.curvature, 0.0)?;
        Ok(step.map_or(0.0, |(fall, _)| fall))
    }

    /// The fall to where the steps from a place end in a basis of the modes and their deflections along a step, and so many `further` ones,
    /// and the factors there; none if nowhere lower. Once further ones are needed, `damping` times the curvature holds every parameter at
    /// the place.
    fn ahead(
        &self,
        place: &Iterate,
        (promised, step): (f64, &DVector<f64>),
        damping: f64,
        further: usize,
        second_order: &mut SecondOrder,
    ) -> Option<(f64, Vec<f64>)> {
        // As long as the basis has told the truth, it is followed to its end.
        let (damping, left) = match further {
            0 => (0.0, 0.0),
            _ => (damping, LEFT * promised),
        };
        let model = &place.comparison.model;
        let modes = place.comparison.partners();
        let basis = model
            .in_basis(None, |whole| {
                whole.along(step, &modes, (further, &place.misfits()))
            })
            .ok()?;
        let exact = Some((&place.jacobian, self.weights));
        let mut follow = place.comparison.within(basis, &place.factors, exact).ok()?;
        let (logs, holding) = (
            logs_of(&place.factors),
            damping * place.curvature.diagonal(),
        );
        let held = Problem {
            held: Some((logs.clone(), holding.clone())),
            priors: self.priors.clone(),
            tikhonov: self.tikhonov.clone(),
            ..*self
        };
        let (objective, factors) = held
            .lowest(second_order, &mut follow, &place.factors, (left, 0.0))
            .ok()?;
        let moved = logs_of(&factors) - &logs;
        let held = 0.5 * moved.component_mul(&moved).dot(&holding);
        let promised = place.objective - (objective - held);
        (promised > 0.0).then_some((promised, factors))
    }
}

pub(super) fn logs_of(factors: &[f64]) -> DVector<f64> {
    DVector::from_iterator(factors.len(), factors.iter().map(|factor| factor.ln()))
}

/// Levenberg and Marquardt's damping.
#[derive(Clone, Copy)]
struct Damping {
    now: f64,
    growth: f64,
}

impl Damping {
    const FIRST: Self = Self {
        now: FIRST_DAMPING,
        growth: 2.0,
    };

    /// Less or more after a fall that is some part of the promised one.
    fn after(&mut self, ratio: f64) {
        self.now *= (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
        self.growth = 2.0;
    }

    /// More, after a step that led nowhere.
    fn more(&mut self) {
        self.now *= self.growth;
        self.growth *= 2.0;
    }
}

impl Iterate {
    /// Reason why steps ended here though their slopes promise a fall, the `whole` one without damping.
    fn end(&self, whole: f64) -> WeightedStop {
        match whole <= TOLD * LOWER && !self.comparison.meets() {
            true => WeightedStop::Gradient,
            false => WeightedStop::Short,
        }
    }

    /// Tells an estimate of the second order what the step to here from another place has shown.
    fn teach(&self, second_order: &mut SecondOrder, from: &Self) {
        let step = logs_of(&self.factors) - logs_of(&from.factors);
        let own = (&self.jacobian - &from.jacobian).tr_mul(&self.residuals);
        second_order.learn(&step, &(&self.gradient - &from.gradient), own);
    }

    fn iteration(&self) -> Result<WeightedIteration, Error> {
        Ok(WeightedIteration {
            factors: self.factors.clone(),
            check: self.comparison.result()?,
            objective: self.objective,
        })
    }

    /// Size of the residuals of every test mode, of those without a shape last.
    fn misfits(&self) -> Vec<f64> {
        let (rows, modes) = self.comparison.model.test.shapes.shape();
        let (own, lone) = self.residuals.as_slice().split_at(modes * (1 + rows));
        let size = |own: &[f64]| own.iter().map(|value| value * value).sum::<f64>().sqrt();
        own.chunks(1 + rows)
            .chain(lone.chunks(1))
            .map(size)
            .collect()
    }

    /// Factors after a step of their logarithms.
    fn after(&self, step: &DVector<f64>) -> Vec<f64> {
        let both = self.factors.iter().zip(step);
        both.map(|(factor, step)| factor * step.exp()).collect()
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

    /// Fall of the objective that the quadratic model of a curvature promises for a step.
    fn promised_fall(&self, curvature: &DMatrix<f64>, step: &DVector<f64>) -> f64 {
        -self.gradient.dot(step) - 0.5 * step.dot(&(curvature * step))
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
        let solved = solve_positive("damped curvature", &left, &right)?;
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
