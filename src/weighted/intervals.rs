//! 95 % intervals of the factors around the optimum of weighted steps.

use super::comparison::Comparison;
use super::gauss_newton::{Problem, WeightedSettings};
use super::identifiability::{MOSTLY_PRIOR, NORMAL_95, covariance, information, tikhonov};
use super::residuals::{jacobian, residuals};
use crate::method::error::Error;
use crate::method::step::Bounds;
use crate::sparse::{ModeWeight, gram, solve_positive};
use nalgebra::DVector;
use statrs::function::erf::erfc;

/// Part of the tests in which an interval by slopes may miss the truth before the objective itself is asked.
const MOST_MISSED: f64 = 0.07;
/// Difference of two deviations, relative to one of them, up to which that between them is their mean.
const ALIKE: f64 = 0.05;
/// Largest distance of the root of twice the rise of the objective from [`NORMAL_95`], relative to it, at an end that is sought: 94.6 to
/// 95.4 %.
const CLOSE: f64 = 0.02;
/// Most tries for an end; an interval without one is withheld.
const TRIES: usize = 30;
/// Distance of two places, relative to that of the farther one from the optimum, between which the objective jumps past an end.
const JUMP: f64 = 1e-4;
/// Most parameters whose intervals are followed beyond their slopes: each takes some eigensolutions in a basis.
pub(crate) const MOST_FOLLOWED: usize = 200;
/// Fall of the objective beside a fixed factor that may be left: at the ends it moves the root of twice the rise by a thousandth of itself.
const LEFT: f64 = 4e-3;

/// 95 % intervals about the factors at the optimum of weighted steps, `widening` times as wide (in logarithms) as by the weights. None of
/// a parameter at a bound, and of one that is known mostly from the prior.
///
/// By the slopes, with the covariance $C$ of the logarithms ([`identifiability`](super::identifiability::identifiability)), the interval is $c_e e^{\pm 1.96 s_e}$. It holds as far as
/// $s_e$ is the same within it. Where it changes along the way, on which the other logarithms move by $C_{ie}/C_{ee}$ of the one, an end is
/// $r = \int \mathrm dt/s_e(t)$ deviations away, here by Simpson's rule or, of deviations within 5 %, their mean, and the truth beyond it
/// in a part $\Phi(-r)$ of the tests. Where both
/// parts together exceed 7 %, and there are no more than 200 parameters, the ends are where the objective itself, the lowest that the other parameters allow, is higher by
/// $\frac12 1.96^2$ (the profile likelihood). An end that is not found withholds the interval, and so does an objective lower than at the
/// factors, which then are no minimum.
///
/// No end is beyond the prior's own 95 % interval, $e^{\pm 1.96 \tau}$, unless the factor is.
///
/// `analyze` need be no other analysis: a job follows the modes in the basis of its best model.
///
/// # Errors
/// [`Error::WrongShape`] and [`Error::Value`] for weights and priors out of range, and for residuals that are not finite.
///
/// Source: Venzon and Moolgavkar, *Applied Statistics* 37 (1988), 87.
pub fn intervals(
    analyze: &dyn Fn(&[f64]) -> Result<Comparison, Error>,
    factors: &[f64],
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
    widening: f64,
) -> Result<Vec<Option<Bounds>>, Error> {
    let priors = settings.priors(factors.len());
    let (model, reach) = (analyze(factors)?, NORMAL_95 * widening);
    let covariance = covariance(gram(&jacobian(&model, weights)?), &priors)?;
    let deviations = covariance.map_diagonal(f64::sqrt);
    let tikhonov = tikhonov(&priors);
    let least = 0.5 * (residuals(&model, weights)?.norm_squared() + settings.pull(factors));
    let root = |objective: f64| (2.0 * (objective - least)).max(0.0).sqrt();
    let interval = |e: usize| -> Option<Bounds> {
        let is_mostly_prior = (deviations[e] / priors[e]).powi(2) > MOSTLY_PRIOR;
        if is_mostly_prior || ranges[e].is_some_and(|range| is_at_end(range, factors[e])) {
            return None;
        }
        // Logarithms of all factors for a change of this one, which is held there.
        let path = covariance.column(e) / covariance[(e, e)];
        let along = |path: &DVector<f64>, log: f64| -> Vec<f64> {
            let moved = |(factor, share): (&f64, &f64)| factor * (share * log).exp();
            factors.iter().zip(path).map(moved).collect()
        };
        let by_slope = reach * deviations[e];
        // The deviation at the optimum over that elsewhere; nothing is told where there is no model.
        let ratio = |log: f64| {
            let there = deviation(analyze, &along(&path, log), e, weights, &tikhonov);
            there.map_or(0.0, |there| deviations[e] / there)
        };
        let missed = |log: f64| {
            let end = ratio(log);
            let mean = match (end - 1.0).abs() <= ALIKE {
                true => 0.5 * (1.0 + end),
                false => (1.0 + 4.0 * ratio(0.5 * log) + end) / 6.0,
            };
            0.5 * erfc(NORMAL_95 * mean / 2.0_f64.sqrt())
        };
        let is_straight = || missed(-by_slope) + missed(by_slope) <= MOST_MISSED;
        let logs = if factors.len() > MOST_FOLLOWED || is_straight() {
            [-by_slope, by_slope]
        } else {
            // The next place begins on the way to the last one found.
            let mut best = path.clone();
            let mut rise = |log: f64| {
                let first = along(&best, log);
                let mut ranges = ranges.to_vec();
                ranges[e] = Some(Bounds {
                    lower: first[e],
                    upper: first[e] * (1.0 + 4.0 * f64::EPSILON),
                });
                let problem = Problem::new(first.len(), &ranges, weights, settings);
                let analyze = &mut |at: &[f64]| analyze(at);
                let enough = (LEFT, least - LEFT);
                let (objective, found) = problem
                    .and_then(|of| of.lowest(analyze, &first, enough))
                    .ok()?;
                if objective < enough.1 {
                    return None;
                }
                let moved = found.iter().zip(factors);
                best.iter_mut()
                    .zip(moved)
                    .for_each(|(best, (found, factor))| *best = (found / factor).ln() / log);
                Some(root(objective) - reach)
            };
            [
                end(&mut rise, -by_slope, reach)?,
                end(&mut rise, by_slope, reach)?,
            ]
        };
        Some(within_prior(factors[e].ln(), logs, NORMAL_95 * priors[e]))
    };
    Ok((0..factors.len()).map(interval).collect())
}

/// The deviation of a parameter's logarithm at factors.
fn deviation(
    analyze: &dyn Fn(&[f64]) -> Result<Comparison, Error>,
    factors: &[f64],
    e: usize,
    weights: &[ModeWeight],
    tikhonov: &DVector<f64>,
) -> Result<f64, Error> {
    let information = information(&jacobian(&analyze(factors)?, weights)?, tikhonov);
    let mut own = DVector::zeros(factors.len());
    own[e] = 1.0;
    Ok(solve_positive("information", &information, &own)?[e].sqrt())
}

/// Ends of an interval at these distances of a logarithm, no farther from zero than a `prior` unless the logarithm itself is.
fn within_prior(log: f64, ends: [f64; 2], prior: f64) -> Bounds {
    Bounds {
        lower: (log + ends[0]).max((-prior).min(log)).exp(),
        upper: (log + ends[1]).min(prior.max(log)).exp(),
    }
}

/// Place where `rise`, less than zero at zero, is zero to within [`CLOSE`] of `reach`: from `first` outward, then between.
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
        if (outer.0 - inner.0).abs() <= JUMP * outer.0.abs() {
            return None;
        }
    }
    None
}

/// Distance from an end of its range, relative, within which a factor counts as at its bound.
const AT_END: f64 = 1e-9;

/// True if a factor is at an end of its range, to round-off.
pub(crate) fn is_at_end(range: Bounds, factor: f64) -> bool {
    let ends = [range.lower, range.upper];
    ends.iter().any(|end| (factor / end - 1.0).abs() < AT_END)
}
