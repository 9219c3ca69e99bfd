//! How far a model is from its test at the best factors, beside what noise alone would leave.

use super::comparison::Comparison;
use super::identifiability::covariance;
use super::residuals::{jacobian, residuals};
use crate::method::error::Error;
use crate::method::error::require;
use crate::method::linear_algebra::check_length;
use crate::sparse::{ModeWeight, gram};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Part of the tests of a right model that are called those of a wrong one.
const FALSE_ALARMS: f64 = 1e-3;
/// Part of them in which one mode of a right model is called no better than acceptable.
const FEW: f64 = 0.05;
/// Errors so many times as large as declared are what few numbers are asked to show,
const TOO_LARGE: f64 = 3.0;
/// in all but this part of the tests.
const MISSED: f64 = 0.01;
/// Part of them that a test must show to judge at all: more often than not.
const LEAST_POWER: f64 = 0.5;
/// Part of a number by which less than one is left over by round-off.
const SLIGHT: f64 = 1e-6;
/// Relative difference of every frequency of a model that any test must refuse.
const HALF_OFF: f64 = 0.5;

/// How far the best model is from the test, in the standard deviations that test or job gives.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Misfit {
    /// $\chi^2 = \sum r^2$ over the weighted [`residuals`], without the prior.
    pub chi_squared: f64,
    /// Degrees of freedom $\nu$: what a right model's chi-squared is in the mean.
    pub degrees_of_freedom: f64,
    /// The 99.9 % quantile of chi-squared of $\nu$ degrees of freedom, or of one where less than one is left.
    pub largest_by_noise: f64,
    /// The 0.1 % quantile, of as many degrees of freedom: what noise leaves at least.
    pub least_by_noise: f64,
    /// Part of the tests with three times the noise whose chi-squared is larger than the 99.9 % quantile.
    pub power: f64,
    /// Chi-squared of a model with every frequency half off and with shapes at right angles to the test's.
    pub of_unlike: f64,
}

/// Mark of so many numbers of a test by the squares of their residuals in deviations: such as noise alone leaves in 95 of 100 tests, in 999
/// of 1000, or larger. The fit takes from every mode too little to count.
pub fn mark(squares: f64, numbers: usize) -> &'static str {
    let law = ChiSquared::new(numbers as f64);
    match law.map_or(0.0, |law| law.sf(squares)) {
        FEW.. => "good",
        FALSE_ALARMS.. => "acceptable",
        _ => "poor",
    }
}

fn chi_squared_law(degrees_of_freedom: f64) -> Result<ChiSquared, Error> {
    ChiSquared::new(degrees_of_freedom.max(1.0)).map_err(|_| Error::no_convergence("chi-squared"))
}

/// The 99.9 % quantile of chi-squared of so many degrees of freedom, or of one where there are fewer.
///
/// # Errors
/// One for a number of degrees that is not finite.
pub(crate) fn most_by_noise(degrees: f64) -> Result<f64, Error> {
    Ok(chi_squared_law(degrees)?.inverse_cdf(1.0 - FALSE_ALARMS))
}

/// Number of frequencies and shape components with a weight, less the scales of the shapes.
fn numbers(comparison: &Comparison, weights: &[ModeWeight]) -> usize {
    let shapes = &comparison.model.test.shapes;
    let compared = |(mode, weight): (usize, &ModeWeight)| {
        let mut groups = comparison.test.together.iter();
        let size = groups
            .find(|group| group.contains(&mode))
            .map_or(1, Vec::len);
        let is_shape = weight.shape > 0.0 && mode < shapes.ncols();
        usize::from(weight.frequency > 0.0)
            + usize::from(is_shape) * shapes.nrows().saturating_sub(size)
    };
    weights.iter().enumerate().map(compared).sum()
}

/// Numbers of a test that were not fitted, beside what a fit foretells of them.
#[derive(Debug, Clone)]
pub struct Prediction {
    /// Residuals over their predicted deviations, zero of what was fitted.
    pub residuals: DVector<f64>,
    /// Words for numbers that neither noise nor what is open of the factors explains.
    pub missed: Option<String>,
}

impl Prediction {
    /// Prediction of the numbers with these weights, their residuals $r$ and Jacobian $J$, by factors whose logarithms have the covariance
    /// $C$ without them, in noise $w$ times as large as declared; none where no number has a weight. They share the errors of the factors,
    /// and are judged together, by the 99.9 % quantile of chi-squared:
    ///
    /// $$ S = w^2 I + J C J^t, \qquad \chi^2 = r^t S^{-1} r = \frac{1}{w^2} \Big( r^t r - \frac{1}{w^2} g^t C \big( I + \frac{1}{w^2} J^t J C
    ///    \big)^{-1} g \Big), \qquad g = J^t r . $$
    ///
    /// # Errors
    /// The errors of [`residuals`] and [`jacobian`]; one for a singular $S$.
    pub(crate) fn of(
        comparison: &Comparison,
        weights: &[ModeWeight],
        covariance: &DMatrix<f64>,
        widening: f64,
    ) -> Result<Option<Self>, Error> {
        let degrees_of_freedom = numbers(comparison, weights) as f64;
        if degrees_of_freedom == 0.0 {
            return Ok(None);
        }
        let residuals = residuals(comparison, weights)? / widening;
        let jacobian = jacobian(comparison, weights)? / widening;
        let by_factors = &jacobian * covariance;
        let slopes = jacobian.tr_mul(&residuals);
        let mixed = DMatrix::identity(slopes.len(), slopes.len()) + jacobian.tr_mul(&by_factors);
        let explained = mixed.lu().solve(&slopes);
        let explained = explained.ok_or(Error::no_convergence("predicted deviations"))?;
        let chi_squared = residuals.norm_squared() - slopes.dot(&(covariance * explained));
        let most = most_by_noise(degrees_of_freedom)?;
        let squares = by_factors.component_mul(&jacobian).column_sum();
        let deviations = squares.map(|square| (1.0 + square).sqrt());
        Ok(Some(Self {
            residuals: residuals.component_div(&deviations),
            missed: (chi_squared > most).then(|| {
                format!(
                    "The model does not hold where it was not fitted: chi-squared of the modes held out is {chi_squared:.1} by predicted \
                     deviations; noise alone leaves at most {most:.1} in 999 of 1000 tests."
                )
            }),
        }))
    }
}

impl Misfit {
    /// Of a model at its best factors, with the priors of all parameters but those at a bound.
    ///
    /// A test mode gives its frequency and, of $d$ sensors, $d - 1$ numbers, because a shape's scale is free, or $d - m$ where $m$ modes
    /// are compared together; a weight of zero takes its numbers out. The fit takes away the trace of
    /// $H = J (J^t J + \mathrm{diag}(\tau^{-2}))^{-1} J^t$, which is the sum of [`learned`](super::identifiability::Identifiability::learned), over the
    /// parameters that are not at a bound. With the eigenvalues $h$ of $H$ the residuals of a right model have variances $1 - h$ in the
    /// mean over its prior: $\nu$ is the mean of chi-squared, and $2 \nu$ no less than its variance, $2 \sum (1 - h)^2$.
    ///
    /// # Errors
    /// Those of [`residuals`] and [`jacobian`]; [`Error::Value`] for a prior that is not positive.
    pub fn of(
        comparison: &Comparison,
        weights: &[ModeWeight],
        priors: &[f64],
        at_bound: &[usize],
    ) -> Result<Self, Error> {
        let count = comparison.model.moves.ncols();
        check_length("prior deviations", priors.len(), count)?;
        let chi_squared = residuals(comparison, weights)?.norm_squared();
        let free: Vec<usize> = (0..count).filter(|e| !at_bound.contains(e)).collect();
        let jacobian = jacobian(comparison, weights)?.select_columns(&free);
        let priors: Vec<f64> = free.iter().map(|&e| priors[e]).collect();
        let fitted: f64 = if free.is_empty() {
            0.0
        } else {
            let left = covariance(gram(&jacobian), &priors)?.diagonal();
            let left = left.iter().zip(&priors);
            left.map(|(left, prior)| 1.0 - left / prior.powi(2)).sum()
        };
        let (test, numbers) = (&comparison.model.test, numbers(comparison, weights));
        let unlike = |(mode, weight): (usize, &ModeWeight)| {
            let shapes = (mode < test.len()).then(|| test.shapes.column(mode));
            let size = shapes.map_or(0.0, |shape| (shape / shape.amax()).norm());
            (HALF_OFF * weight.frequency).powi(2) + (size * weight.shape).powi(2)
        };
        let degrees_of_freedom = numbers as f64 - fitted;
        let owner = || "the fit".into();
        let is_met = degrees_of_freedom.is_finite();
        require(
            is_met,
            "degrees of freedom",
            owner,
            degrees_of_freedom,
            "a finite number",
        )?;
        let law = chi_squared_law(degrees_of_freedom)?;
        let largest_by_noise = most_by_noise(degrees_of_freedom)?;
        Ok(Self {
            chi_squared,
            degrees_of_freedom,
            largest_by_noise,
            least_by_noise: law.inverse_cdf(FALSE_ALARMS),
            power: law.sf(largest_by_noise / TOO_LARGE.powi(2)),
            of_unlike: weights.iter().enumerate().map(unlike).sum(),
        })
    }

    /// How many times the noise the residuals are, the root of chi-squared over $\nu$; none where less than one degree of freedom is left.
    pub fn times_the_noise(&self) -> Option<f64> {
        (self.degrees_of_freedom >= 1.0)
            .then(|| (self.chi_squared / self.degrees_of_freedom).sqrt())
    }

    /// The number of times as large as given that the deviations of the measurement count in intervals: [`Self::times_the_noise`] where noise
    /// cannot have left as much.
    pub fn widening(&self) -> f64 {
        if self.is_by_noise() {
            1.0
        } else {
            (self.chi_squared / self.degrees_of_freedom.max(1.0)).sqrt()
        }
    }

    /// True if the residuals are smaller than noise leaves in 999 of 1000 tests: of a test that was computed, or by deviations that are too
    /// large.
    pub fn is_below_noise(&self) -> bool {
        self.degrees_of_freedom >= 1.0 && self.chi_squared < self.least_by_noise
    }

    /// The reason why no model could have failed such a test, if none could.
    pub(crate) fn untested(&self) -> Option<String> {
        if self.degrees_of_freedom < 1.0 - SLIGHT {
            Some("the fit leaves less than one number over".into())
        } else if self.of_unlike <= self.largest_by_noise {
            Some("by these deviations and weights a model with every frequency half off and other shapes would pass".into())
        } else {
            let percent = 100.0 * self.power;
            (self.power < LEAST_POWER).then(|| {
                format!(
                    "of tests with three times this noise, so few numbers would show {percent:.0} %"
                )
            })
        }
    }

    /// True if a wrong model would have failed: a number at least is left over, three times the noise would more often be seen than not,
    /// and a model unlike the test would be refused.
    pub fn can_fail(&self) -> bool {
        self.untested().is_none()
    }

    /// True if noise may have left as much.
    pub fn is_by_noise(&self) -> bool {
        self.chi_squared <= self.largest_by_noise
    }

    /// Chi-squared and its degrees of freedom in a sentence.
    pub fn in_numbers(&self) -> String {
        format!(
            "Chi-squared is {:.1} for {:.1} degrees of freedom; noise alone leaves at most {:.1} in 999 of 1000 tests.",
            self.chi_squared, self.degrees_of_freedom, self.largest_by_noise
        )
    }

    /// The same after what it means.
    pub fn in_words(&self) -> String {
        let is_few = self.power < 1.0 - MISSED;
        let mut words = match self.untested() {
            _ if !self.is_by_noise() => format!(
                "The model cannot explain this test: residuals are {:.1} times the noise.",
                self.widening()
            ),
            Some(reason) => format!("Nothing to judge by: {reason}."),
            None => format!(
                "As good as the noise allows: residuals are {:.2} times the noise.",
                self.times_the_noise().unwrap_or_default()
            ),
        };
        // Of a larger one a remark has the numbers.
        if self.is_by_noise() {
            words += &format!(" {}", self.in_numbers());
        }
        if is_few && self.is_by_noise() && self.can_fail() {
            words += &format!(
                " Of tests with three times this noise, so few numbers would show {:.0} %.",
                100.0 * self.power
            );
        }
        words
    }
}
