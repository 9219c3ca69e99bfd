//! 95 % intervals of the factors around the optimum of weighted steps.

use super::comparison::Comparison;
use super::gauss_newton::{Problem, WeightedSettings, logs_of};
use super::identifiability::{MOSTLY_PRIOR, NORMAL_95, covariance, tikhonov};
use super::residuals::{jacobian, residuals};
use super::second_order::SecondOrder;
use crate::method::error::Error;
use crate::method::linear_algebra::check_length;
use crate::method::step::Bounds;
use crate::sparse::{ModeWeight, gram};
use nalgebra::DVector;
use serde::Serialize;

/// Largest distance of the root of twice the rise of the objective from [`NORMAL_95`], relative to it, at an end that is sought: 94.6 to
/// 95.4 %.
const CLOSE: f64 = 0.02;
/// Most tries for an end; an interval without one is withheld.
const TRIES: usize = 30;
/// Distance of two places, relative to that of the farther one from the optimum, between which the objective jumps past an end.
const JUMP: f64 = 1e-4;
/// Most parameters whose intervals are followed beyond their slopes: each takes some nine analyses, and each of these the normal equations of all.
pub(crate) const MOST_FOLLOWED: usize = 200;
/// Fall of the objective beside a fixed factor that is foretold, and not looked at: wrong by a tenth of itself it moves the root of twice the
/// rise at the ends by three thousandths.
const LEFT: f64 = 0.1;
/// Fall below the objective at the factors that no rounding makes.
const LOWER: f64 = 4e-3;

/// Reason why a parameter has no interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Withheld {
    /// Steps have not ended at an optimum, or were not weighted.
    NoOptimum,
    /// The factor is at a bound.
    AtBound,
    /// The prior says more of it than the test.
    MostlyPrior,
    /// With another value of it the objective falls below that at the factors, which then are no minimum.
    Lower,
    /// No place was found where the objective has risen by as much as at an end.
    NoEnd,
}

impl Withheld {
    /// All reasons.
    pub(crate) const ALL: [Self; 5] = [
        Self::NoOptimum,
        Self::AtBound,
        Self::MostlyPrior,
        Self::Lower,
        Self::NoEnd,
    ];

    /// Words for it, which the parameters follow.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::NoOptimum => "they hold about a minimum of weighted steps alone",
            Self::AtBound => "at a bound",
            Self::MostlyPrior => "known mostly from the prior",
            Self::Lower => {
                "with another value the objective is lower, so that the factors are no minimum"
            }
            Self::NoEnd => "no end as far as the modes can be followed",
        }
    }
}

/// 95 % intervals about the factors at the optimum of weighted steps, with the deviations of the measurement `widening` times as large as
/// by the weights, and the prior's as they are. None of a parameter at a bound, and of one that is known mostly from the prior.
///
/// The ends are where the objective, the lowest that the other parameters allow, is higher by $\frac12 1.96^2$ than at the factors (the profile
/// likelihood). They are sought from $c_e e^{\pm 1.96 s_e}$, with the covariance $C$ of the logarithms
/// ([`identifiability`](super::identifiability::identifiability)), where the other logarithms have moved by $C_{ie}/C_{ee}$ of the one. An
/// end that is not found withholds the interval, and so does an objective lower than at the factors, which then are no minimum. With more
/// than 200 parameters the interval is the one from which the ends are sought.
///
/// With a widening $w$ that objective is $\frac{1}{2w^2}(\sum r^2 + \sum (x_e/\tau_e)^2) + \frac12(1 - w^{-2}) \sum ((x_e - \hat x_e)/\tau_e)^2$
/// of the logarithms $x$: it has its minimum at the factors too, and all of the prior's curvature. No end is beyond the prior's own 95 %
/// interval, $e^{\pm 1.96 \tau}$, unless the factor is.
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
) -> Result<Vec<Result<Bounds, Withheld>>, Error> {
    check_length("ranges", ranges.len(), factors.len())?;
    let (model, priors) = (
        analyze(factors)?.with_slopes()?,
        settings.priors(factors.len()),
    );
    let weight = |own: &ModeWeight| ModeWeight {
        frequency: own.frequency / widening,
        shape: own.shape / widening,
    };
    let weights: Vec<ModeWeight> = weights.iter().map(weight).collect();
    let covariance = covariance(gram(&jacobian(&model, &weights)?), &priors)?;
    let deviations = covariance.map_diagonal(f64::sqrt);
    let tikhonov = tikhonov(&priors);
    let profile = Profile {
        analyze,
        factors,
        ranges,
        weights: &weights,
        least: 0.5
            * (residuals(&model, &weights)?.norm_squared()
                + settings.pull(factors) / widening.powi(2)),
        settings: WeightedSettings {
            prior_deviations: priors.iter().map(|prior| prior * widening).collect(),
            ..settings.clone()
        },
        held: (1.0 - widening.powi(-2)) * &tikhonov,
    };
    let interval = |e: usize| -> Result<Bounds, Withheld> {
        if ranges[e].is_some_and(|range| is_at_end(range, factors[e])) {
            return Err(Withheld::AtBound);
        }
        if (deviations[e] / priors[e]).powi(2) > MOSTLY_PRIOR {
            return Err(Withheld::MostlyPrior);
        }
        let by_slope = NORMAL_95 * deviations[e];
        let ends = if factors.len() > MOST_FOLLOWED {
            [-by_slope, by_slope]
        } else {
            // On either side the first way is by slopes, the next through the last place within.
            let sought = |first: f64| {
                let mut way = covariance.column(e) / covariance[(e, e)];
                end(&mut |log| profile.rise(e, &mut way, log), first)
            };
            [sought(-by_slope)?, sought(by_slope)?]
        };
        Ok(within_prior(factors[e].ln(), ends, NORMAL_95 * priors[e]))
    };
    Ok((0..factors.len()).map(interval).collect())
}

/// Factors whose logarithms have moved by these shares of one.
fn along(factors: &[f64], path: &DVector<f64>, log: f64) -> Vec<f64> {
    let moved = |(factor, share): (&f64, &f64)| factor * (share * log).exp();
    factors.iter().zip(path).map(moved).collect()
}

/// The objective of an interval, as the lowest that the other parameters allow.
struct Profile<'a> {
    analyze: &'a dyn Fn(&[f64]) -> Result<Comparison, Error>,
    factors: &'a [f64],
    ranges: &'a [Option<Bounds>],
    weights: &'a [ModeWeight],
    settings: WeightedSettings,
    /// Curvature of the term that holds the other logarithms at the factors.
    held: DVector<f64>,
    /// The objective at the factors.
    least: f64,
}

impl Profile<'_> {
    /// The root of twice the rise of the objective beside a logarithm that is moved by so much, less that at an end of an interval. The
    /// search begins along a way, the shares by which all logarithms move, and leaves there the one that it has found.
    fn rise(&self, e: usize, way: &mut DVector<f64>, log: f64) -> Result<f64, Withheld> {
        let first = along(self.factors, way, log);
        let mut ranges = self.ranges.to_vec();
        ranges[e] = Some(Bounds {
            lower: first[e],
            upper: first[e] * (1.0 + 4.0 * f64::EPSILON),
        });
        let analyze = &mut |at: &[f64]| (self.analyze)(at);
        let enough = self.least - LOWER;
        let (objective, found) = Problem::new(first.len(), &ranges, self.weights, &self.settings)
            .map(|problem| problem.held_at(logs_of(self.factors), self.held.clone()))
            .and_then(|problem| {
                let second_order = &mut SecondOrder::new(first.len());
                problem.lowest(second_order, analyze, &first, (LEFT, enough))
            })
            .map_err(|_| Withheld::NoEnd)?;
        if objective < enough {
            return Err(Withheld::Lower);
        }
        let rise = (2.0 * (objective - self.least)).max(0.0).sqrt() - NORMAL_95;
        // Beyond the end the lowest place found may be another valley's.
        if rise < 0.0 {
            *way = (logs_of(&found) - logs_of(self.factors)) / log;
        }
        Ok(rise)
    }
}

/// Ends of an interval at these distances of a logarithm, no farther from zero than a `prior` unless the logarithm itself is.
fn within_prior(log: f64, ends: [f64; 2], prior: f64) -> Bounds {
    Bounds {
        lower: (log + ends[0]).max((-prior).min(log)).exp(),
        upper: (log + ends[1]).min(prior.max(log)).exp(),
    }
}

/// Place where `rise`, less than zero at zero, is zero: from `first` outward, then between, until it is so to within [`CLOSE`], and there on
/// the line through the place before.
fn end(rise: &mut dyn FnMut(f64) -> Result<f64, Withheld>, first: f64) -> Result<f64, Withheld> {
    let (mut inner, mut outer, mut log) = ((0.0, -NORMAL_95), None, first);
    for _ in 0..TRIES {
        let own = (log, rise(log)?);
        let on_line = |other: (f64, f64)| own.0 - own.1 * (own.0 - other.0) / (own.1 - other.1);
        if own.1.abs() <= CLOSE * NORMAL_95 {
            return Ok(on_line(inner));
        }
        match own.1 < 0.0 {
            true => inner = own,
            false => outer = Some(own),
        }
        log = match outer {
            None => 1.5 * own.0,
            Some((far, _)) if (far - inner.0).abs() <= JUMP * far.abs() => break,
            Some((far, above)) => inner.0 - inner.1 * (far - inner.0) / (above - inner.1),
        };
    }
    Err(Withheld::NoEnd)
}

/// Distance from an end of its range, relative, within which a factor counts as at its bound.
const AT_END: f64 = 1e-9;

/// True if a factor is at an end of its range, to round-off.
pub(crate) fn is_at_end(range: Bounds, factor: f64) -> bool {
    let ends = [range.lower, range.upper];
    ends.iter().any(|end| (factor / end - 1.0).abs() < AT_END)
}
