//! Weighted correlations from several first points, and the different minima that they end in.

use super::comparison::Comparison;
use super::gauss_newton::{WeightedCorrelation, WeightedSettings, WeightedStop, gauss_newton};
use crate::method::error::Error;
use crate::method::error::at_least_one;
use crate::method::step::Bounds;
use crate::sparse::ModeWeight;
use crate::sparse::random::uniform;
use nalgebra::DVector;
use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Places between which the quadratic model of the objective rises by less count as the same: a chi-squared of two thousandths, which
/// no test can tell.
const SAME_OBJECTIVE: f64 = 1e-3;

/// A minimum that noise allows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Minimum {
    /// Factor of each parameter on its first value.
    pub factors: Vec<f64>,
    /// Sum of the squared residuals, without the prior.
    pub chi_squared: f64,
    /// Number of starts that end there.
    pub starts: usize,
}

/// The end of the steps from one start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StartEnd {
    /// The objective there.
    pub objective: f64,
    /// Exact analyses made.
    pub analyses: usize,
    /// Reason why they stopped.
    pub stop: WeightedStop,
}

/// Gauss–Newton steps, of one start or of several.
#[derive(Debug, Clone)]
pub struct WeightedHistory {
    /// The steps that lead lowest.
    pub best: WeightedCorrelation,
    /// The minima that noise allows of several starts.
    pub minima: Vec<Minimum>,
    /// The end of every start, the model's own first; none where it failed.
    pub starts: Vec<Option<StartEnd>>,
}

/// [`gauss_newton`] from factors of one, and from `starts` − 1 random places: factors from 0.5 to 2, log-uniformly by
/// [`uniform`] from `seed`, brought within their bounds. Returns the best, the minima that noise allows, the best first, and how every
/// start ended, none where it failed. One that stops short of a gradient within tolerance makes no minimum of its own, unless it is the best.
///
/// Two ends are one minimum where $h^t A h/2$ is at most a thousandth, $h$ being the difference of their logarithms and $A$ the curvature
/// at the lower. Noise allows a minimum if twice its objective is above twice the least by at most the 95 % quantile of chi-squared
/// of as many degrees of freedom as parameters: what likelihood ratios exclude beyond that has no part in the region that holds the truth
/// in 95 of 100 tests (Wilks, *Annals of Mathematical Statistics* 9 (1938), 60–62). The prior counts as measurements of the parameters.
///
/// # Errors
/// Those of [`gauss_newton`] of the last start when all fail, or of any once `go_on` is false; [`Error::Count`] without starts.
pub fn from_several_starts<E: From<Error>>(
    mut analyze: impl FnMut(&[f64]) -> Result<Comparison, E>,
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
    (starts, seed): (usize, u64),
    go_on: impl Fn() -> bool,
) -> Result<WeightedHistory, E> {
    at_least_one("starts", starts)?;
    let (mut state, mut ends, mut failed, mut all) = (seed, Vec::new(), None, Vec::new());
    for start in 0..starts {
        let first = match start {
            0 => vec![1.0; ranges.len()],
            _ => draw(ranges.len(), &mut state),
        };
        match gauss_newton(&mut analyze, &first, ranges, weights, settings) {
            Ok(found) => {
                all.push(Some(found.end()));
                ends.push(found);
            }
            Err(error) if !go_on() => return Err(error),
            Err(error) => {
                all.push(None);
                failed = Some(error);
            }
        }
    }
    ends.sort_by(|a, b| a.objective.total_cmp(&b.objective));
    let Some(best) = ends.first().cloned() else {
        return Err(failed.unwrap_or_else(|| Error::no_convergence("starts").into()));
    };
    let allowed = ChiSquared::new(ranges.len() as f64)
        .map_or(0.0, |chi_squared| 0.5 * chi_squared.inverse_cdf(0.95));
    let mut minima: Vec<(&WeightedCorrelation, usize)> = Vec::new();
    for end in &ends {
        let is_new = minima.is_empty()
            || end.stop == WeightedStop::Gradient && end.objective <= best.objective + allowed;
        let known = minima.iter().position(|(minimum, _)| is_same(minimum, end));
        match known {
            Some(place) => minima[place].1 += 1,
            None if is_new => minima.push((end, 1)),
            None => (),
        }
    }
    let minimum = |(end, starts): (&WeightedCorrelation, usize)| Minimum {
        factors: end.factors.clone(),
        chi_squared: 2.0 * end.objective - settings.pull(&end.factors),
        starts,
    };
    let minima = minima.into_iter().map(minimum).collect();
    Ok(WeightedHistory {
        best,
        minima,
        starts: all,
    })
}

impl WeightedCorrelation {
    /// The end of its steps.
    pub(crate) fn end(&self) -> StartEnd {
        StartEnd {
            objective: self.objective,
            analyses: self.analyses,
            stop: self.stop,
        }
    }
}

/// Random factors from 0.5 to 2, log-uniform.
pub(super) fn draw(count: usize, state: &mut u64) -> Vec<f64> {
    let draw = |_| 0.5 * 4.0_f64.powf(uniform(state));
    (0..count).map(draw).collect()
}

/// True if steps have ended in a minimum again.
fn is_same(minimum: &WeightedCorrelation, end: &WeightedCorrelation) -> bool {
    let both = minimum.factors.iter().zip(&end.factors);
    let apart = both.map(|(a, b)| (a / b).ln());
    let apart = DVector::from_iterator(end.factors.len(), apart);
    let curvature = minimum.identifiability.covariance.clone().cholesky();
    curvature.is_some_and(|factor| 0.5 * apart.dot(&factor.solve(&apart)) <= SAME_OBJECTIVE)
}
