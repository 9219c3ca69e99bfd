//! 95 % intervals of the factors around the optimum of weighted steps.

use super::gauss_newton::{WeightedSettings, steps};
use super::identifiability::{NORMAL_95, identifiability};
use super::residuals::{jacobian, residuals};
use crate::method::error::Error;
use crate::method::error_sum::ModeWeight;
use crate::method::model::{Bounds, ModalModel};

/// How far the root of twice the rise of the objective may be from [`NORMAL_95`], relative to it, at the ends of an interval by slopes:
/// between 1.76 and 2.16 standard deviations are 92 to 97 %.
const SLOPE_TELLS: f64 = 0.1;
/// The same at an end that is sought: 94.6 to 95.4 %.
const CLOSE: f64 = 0.02;
/// Most tries for an end; an interval without one is withheld.
const TRIES: usize = 30;
/// The lowest objective beside a fixed factor need not be found better than that: half its square in the rise.
const GRADIENT: f64 = 1e-2;

/// 95 % intervals about the factors at the optimum of weighted steps, `widening` times as wide (in logarithms) as by the weights. None of
/// a parameter at a bound, and of one that is known mostly from the prior.
///
/// By the slopes, with the covariance $C$ of the logarithms ([`identifiability`]), the interval is $c_e e^{\pm 1.96 s_e}$ and the objective
/// at its ends, the other logarithms moved by $C_{ie}/C_{ee}$ of the one, is higher by $\frac12 1.96^2$. Where it is not, the ends are where
/// the objective itself, the lowest that the other parameters allow, is higher by as much (the profile likelihood). Both are followed in the
/// basis of the model at the optimum, without another analysis; an end that is not found withholds the interval.
///
/// # Errors
/// Those of [`residuals`], [`jacobian`] and [`identifiability`].
///
/// Source: Venzon and Moolgavkar, *Applied Statistics* 37 (1988), 87.
pub fn intervals(
    model: &ModalModel,
    factors: &[f64],
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
    widening: f64,
) -> Result<Vec<Option<Bounds>>, Error> {
    let priors = settings.priors(factors.len());
    let seen = identifiability(&jacobian(model, weights)?, &priors)?;
    let reach = NORMAL_95 * widening;
    let objective = |model: &ModalModel, factors: &[f64]| -> Result<f64, Error> {
        let pulls = factors.iter().zip(&priors);
        let pull: f64 = pulls
            .map(|(factor, prior)| (factor.ln() / prior).powi(2))
            .sum();
        Ok(0.5 * (residuals(model, weights)?.norm_squared() + pull))
    };
    let least = objective(model, factors)?;
    let root = |objective: f64| (2.0 * (objective - least)).max(0.0).sqrt();
    let follow = |at: &[f64]| -> Result<ModalModel, Error> {
        let change: Vec<f64> = at.iter().zip(factors).map(|(at, from)| at / from).collect();
        model.followed(&change)
    };
    let settings = WeightedSettings {
        tolerance: GRADIENT,
        ..settings.clone()
    };
    let interval = |e: usize| -> Option<Bounds> {
        if ranges[e].is_some_and(|range| range.has_end_at(factors[e])) || seen.is_mostly_prior(e) {
            return None;
        }
        let along = |log: f64| -> Vec<f64> {
            let share = |i: usize| seen.covariance[(i, e)] / seen.covariance[(e, e)];
            let moved = |(i, factor): (usize, &f64)| factor * (share(i) * log).exp();
            factors.iter().enumerate().map(moved).collect()
        };
        let by_slope = reach * seen.deviations[e];
        let tells = |at: Vec<f64>| {
            let there = follow(&at).and_then(|model| objective(&model, &at));
            there.is_ok_and(|there| (root(there) / reach - 1.0).abs() <= SLOPE_TELLS)
        };
        let logs = if [-by_slope, by_slope].map(along).map(tells) == [true; 2] {
            [-by_slope, by_slope]
        } else {
            let mut rise = |log: f64| {
                let first = along(log);
                let mut ranges = ranges.to_vec();
                ranges[e] = Some(Bounds {
                    lower: first[e],
                    upper: first[e] * (1.0 + 4.0 * f64::EPSILON),
                });
                let found = steps(
                    &mut |at: &[f64]| follow(at),
                    false,
                    &first,
                    &ranges,
                    weights,
                    &settings,
                );
                found.ok().map(|found| root(found.objective) - reach)
            };
            [
                end(&mut rise, -by_slope, reach)?,
                end(&mut rise, by_slope, reach)?,
            ]
        };
        let [lower, upper] = logs.map(|log| factors[e] * log.exp());
        Some(Bounds { lower, upper })
    };
    Ok((0..factors.len()).map(interval).collect())
}

/// Where `rise`, less than zero at zero, is zero to within [`CLOSE`] of `reach`: from `first` outward, then between.
fn end(rise: &mut dyn FnMut(f64) -> Option<f64>, first: f64, reach: f64) -> Option<f64> {
    let (mut inner, mut outer) = ((0.0, -reach), (first, rise(first)?));
    for _ in 0..TRIES {
        if outer.1.abs() <= CLOSE * reach {
            return Some(outer.0);
        }
        if outer.1 < 0.0 {
            (inner, outer) = (outer, (1.5 * outer.0, rise(1.5 * outer.0)?));
            continue;
        }
        let log = inner.0 - inner.1 * (outer.0 - inner.0) / (outer.1 - inner.1);
        let next = (log, rise(log)?);
        if next.1.abs() <= CLOSE * reach {
            return Some(next.0);
        }
        if next.1 < 0.0 {
            inner = next;
        } else {
            outer = next;
        }
    }
    None
}
