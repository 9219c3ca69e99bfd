//! Bounded Gauss–Newton steps with Levenberg and Marquardt's damping, one exact analysis each.

use super::identifiability::{Identifiability, PRIOR_DEVIATION, identifiability};
use super::residuals::{jacobian, residuals};
use crate::method::error::{Error, positive_setting};
use crate::method::error_sum::ModeWeight;
use crate::method::linear_algebra::check_length;
use crate::method::model::{Bounds, ExactResult, ModalModel};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Damping of the first step, relative to the curvature of each parameter.
const FIRST_DAMPING: f64 = 1e-3;
/// Longest step in the logarithm of any factor: $e$ times as soft or stiff.
const LONGEST_STEP: f64 = 1.0;
/// A step that moves no logarithm by more is none.
const SHORTEST_STEP: f64 = 1e-9;

/// What a weighted correlation assumes and when it stops.
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
    /// The prior deviation of each of so many parameters.
    pub(crate) fn priors(&self, count: usize) -> Vec<f64> {
        match self.prior_deviations[..] {
            [one] => vec![one; count],
            _ => self.prior_deviations.clone(),
        }
    }
}

/// Why a weighted correlation stopped.
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
    /// Why it stopped.
    pub stop: WeightedStop,
    /// What the test modes see of the parameters there.
    pub identifiability: Identifiability,
}

/// Where a correlation stands.
struct Iterate {
    factors: Vec<f64>,
    model: ModalModel,
    jacobian: DMatrix<f64>,
    objective: f64,
    gradient: DVector<f64>,
    curvature: DMatrix<f64>,
}

/// Lowers $\frac{1}{2} \sum r^2 + \frac{1}{2} \sum (\ln c_e/\tau_e)^2$ over the factors $c_e$ within their bounds, from `first`.
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
/// Those of `analyze` at the first factors, of [`residuals`] and [`identifiability`]; [`Error::Setting`], [`Error::Limits`] and [`Error::WrongShape`] for
/// settings and lists out of range.
pub fn gauss_newton<E: From<Error>>(
    mut analyze: impl FnMut(&[f64]) -> Result<ModalModel, E>,
    first: &[f64],
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
) -> Result<WeightedCorrelation, E> {
    steps(&mut analyze, true, first, ranges, weights, settings)
}

pub(super) fn steps<E: From<Error>>(
    analyze: &mut dyn FnMut(&[f64]) -> Result<ModalModel, E>,
    is_exact: bool,
    first: &[f64],
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
) -> Result<WeightedCorrelation, E> {
    let priors = settings.priors(first.len());
    check_length("prior deviations", priors.len(), first.len())?;
    for prior in &priors {
        positive_setting("prior_deviation", *prior)?;
    }
    positive_setting("tolerance", settings.tolerance)?;
    check_length("parameter limits", ranges.len(), first.len())?;
    ranges
        .iter()
        .flatten()
        .try_for_each(|r| Bounds::positive("parameter limits", r.lower, r.upper).map(drop))?;
    let tikhonov = DVector::from_iterator(priors.len(), priors.iter().map(|prior| prior.powi(-2)));
    let mut place_at = |factors: Vec<f64>| -> Result<Iterate, E> {
        let within = |(&factor, range): (&f64, &Option<Bounds>)| {
            range.map_or(factor, |range| range.clamp(factor))
        };
        let factors: Vec<f64> = factors.iter().zip(ranges).map(within).collect();
        let model = analyze(&factors)?;
        check_length("parameter factors", factors.len(), model.shares.len())?;
        let logs = DVector::from_iterator(factors.len(), factors.iter().map(|factor| factor.ln()));
        let (residuals, jacobian) = (residuals(&model, weights)?, jacobian(&model, weights)?);
        let pull = tikhonov.component_mul(&logs);
        let objective = 0.5 * (residuals.norm_squared() + pull.dot(&logs));
        let gradient = jacobian.tr_mul(&residuals) + pull;
        let curvature = jacobian.tr_mul(&jacobian) + DMatrix::from_diagonal(&tikhonov);
        Ok(Iterate {
            factors,
            model,
            jacobian,
            objective,
            gradient,
            curvature,
        })
    };
    let mut place = place_at(first.to_vec())?;
    let initial = place.model.exact.clone();
    let mut is_new = is_exact;
    let (mut iterations, mut damping, mut growth, mut trials) = (Vec::new(), FIRST_DAMPING, 2.0, 0);
    let stop = loop {
        let Iterate {
            factors,
            gradient,
            curvature,
            ..
        } = &place;
        let room = |(range, factor): (&Option<Bounds>, &f64)| {
            let range = range.unwrap_or(Bounds {
                lower: 0.0,
                upper: f64::INFINITY,
            });
            Bounds {
                lower: (range.lower / factor).ln(),
                upper: (range.upper / factor).ln(),
            }
        };
        let room: Vec<Bounds> = ranges.iter().zip(factors).map(room).collect();
        let is_free = |&e: &usize| {
            if gradient[e] > 0.0 {
                room[e].lower < 0.0
            } else {
                room[e].upper > 0.0
            }
        };
        let free: Vec<usize> = (0..first.len()).filter(is_free).collect();
        let is_flat =
            |&e: &usize| gradient[e].abs() <= settings.tolerance * curvature[(e, e)].sqrt();
        if free.iter().all(is_flat) {
            break WeightedStop::Gradient;
        }
        if trials == settings.trials {
            break WeightedStop::Trials;
        }
        if std::mem::take(&mut is_new)
            && let Some(ahead) = ahead(&place, ranges, weights, settings)
        {
            trials += 1;
            if let Ok(next) = place_at(ahead)
                && next.objective < place.objective
            {
                (place, is_new) = (next, is_exact);
                iterations.push(place.iteration());
            }
            continue;
        }
        let mut step = bounded_step(curvature, gradient, free, &room, damping)?;
        step *= (LONGEST_STEP / step.amax()).min(1.0);
        if step.amax() <= SHORTEST_STEP {
            break WeightedStop::Step;
        }
        trials += 1;
        let trial = factors
            .iter()
            .zip(&step)
            .map(|(factor, step)| factor * step.exp());
        // A place without a model is no better than this one.
        let Ok(next) = place_at(trial.collect()) else {
            (damping, growth) = (damping * growth, 2.0 * growth);
            continue;
        };
        let promised = -gradient.dot(&step) - 0.5 * step.dot(&(curvature * &step));
        let fall = place.objective - next.objective;
        if !(fall > 0.0 && promised > 0.0) {
            (damping, growth) = (damping * growth, 2.0 * growth);
            continue;
        }
        (place, is_new) = (next, is_exact);
        iterations.push(place.iteration());
        damping *= (1.0 - (2.0 * fall / promised - 1.0).powi(3)).max(1.0 / 3.0);
        growth = 2.0;
    };
    let identifiability = identifiability(&place.jacobian, &priors)?;
    let (
        Iterate {
            factors, objective, ..
        },
        analyses,
    ) = (place, trials + 1);
    Ok(WeightedCorrelation {
        initial,
        iterations,
        factors,
        objective,
        analyses,
        stop,
        identifiability,
    })
}

impl Iterate {
    fn iteration(&self) -> WeightedIteration {
        WeightedIteration {
            factors: self.factors.clone(),
            check: self.model.exact.clone(),
            objective: self.objective,
        }
    }
}

/// Where the steps from a place end in the basis of its model; none if nowhere else.
fn ahead(
    place: &Iterate,
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
) -> Option<Vec<f64>> {
    let mut follow = |factors: &[f64]| {
        let both = factors.iter().zip(&place.factors);
        let change: Vec<f64> = both.map(|(factor, from)| factor / from).collect();
        place.model.followed(&change)
    };
    let found = steps::<Error>(
        &mut follow,
        false,
        &place.factors,
        ranges,
        weights,
        settings,
    );
    let found = found.ok().filter(|found| !found.iterations.is_empty())?;
    Some(found.factors)
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
            dof: 0,
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
        beyond
            .into_iter()
            .for_each(|place| step[free[place]] = room[free[place]].clamp(solved[place]));
        free = inside.into_iter().map(|place| free[place]).collect();
    }
}
