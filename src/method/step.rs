//! The step (13): from derivatives to stiffness change factors, and the bounds that hold them.

use crate::method::derivatives::Derivatives;
use crate::method::error::Error;
use serde::{Deserialize, Serialize};

/// How the derivatives become factors. All give $c_e = 1 - R e_S g_e$ and differ in $g_e$.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum StepRule {
    /// $g_e = \Delta e_e/\Delta k_e$ with $\Delta k_e$ the root sum of squares over the test modes of the relative
    /// generalized stiffness changes. The primary rule.
    #[default]
    RootSumOfSquares,
    /// $\Delta k_e$ summed over the test modes instead: smaller steps, on the torque box one and a half to two times
    /// the iterations.
    SumOverModes,
    /// Plain steepest descent, $g_e = d_e/\sum_s d_s^2$ with $d_e = \Delta e_e/0.001$: the step that would bring the
    /// linearized error sum to zero. It ignores how much stiffness each parameter has and soon overshoots: on the
    /// torque box it stalls without halvings after three to six iterations, and with them creeps.
    SteepestDescent,
}

/// Unlimited stiffness change factors by (13).
///
/// $$ c_e = 1 - R e_S \frac{\Delta e_e}{\Delta k_e} $$
///
/// The paper prints $c = R e_S (\Delta e/\Delta k)$, which is the change of the factor, not the factor
/// (`paper/errata.md`). A parameter without stiffness in any test mode keeps factor one.
pub fn unlimited_factors(
    derivatives: &Derivatives,
    error_sum: f64,
    relaxation: f64,
    rule: StepRule,
) -> Vec<f64> {
    let square_sum: f64 = derivatives
        .error_change
        .iter()
        .map(|change| (change / crate::method::derivatives::DERIVATIVE_STEP).powi(2))
        .sum();
    let columns = derivatives.share_change.column_iter();
    derivatives
        .error_change
        .iter()
        .zip(columns)
        .map(|(&change, stiffness)| {
            let per_unit = match rule {
                StepRule::RootSumOfSquares => stiffness.norm(),
                StepRule::SumOverModes => stiffness.sum(),
                StepRule::SteepestDescent => {
                    square_sum * crate::method::derivatives::DERIVATIVE_STEP
                }
            };
            if per_unit > 0.0 {
                1.0 - relaxation * error_sum * change / per_unit
            } else {
                1.0
            }
        })
        .collect()
}

/// A closed interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// Its lower end.
    pub lower: f64,
    /// Its upper end.
    pub upper: f64,
}

impl Range {
    /// An interval of positive numbers.
    ///
    /// # Errors
    /// [`Error::Limits`] unless $0 < \text{lower} < \text{upper}$, both finite.
    pub fn positive(what: &str, lower: f64, upper: f64) -> Result<Self, Error> {
        if lower > 0.0 && upper > lower && upper.is_finite() {
            Ok(Self { lower, upper })
        } else {
            Err(Error::Limits {
                what: what.to_owned(),
                lower,
                upper,
            })
        }
    }

    /// Whether a number lies in the interval.
    pub fn contains(&self, value: f64) -> bool {
        (self.lower..=self.upper).contains(&value)
    }

    /// The nearest number in the interval; unlike [`f64::clamp`] no interval makes it panic.
    fn clamp(&self, value: f64) -> f64 {
        if value < self.lower {
            self.lower
        } else if value > self.upper {
            self.upper
        } else {
            value
        }
    }
}

/// What held a parameter's factor in an iteration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Limit {
    /// Nothing: the factor is the computed one.
    None,
    /// The bounds of one iteration's factor (0.55 and 1.50 in the paper).
    Factor,
    /// The bounds of the parameter's total, such as a gage limit.
    Total,
}

/// One parameter's new total factor after a step of `1 + fraction·(c − 1)`, within its bounds, and what held it.
///
/// `total` is the factor so far and `base` what it multiplies (the product of earlier passes), so that the
/// parameter stands at `base·total` of its first value; `total_range` bounds that product.
pub fn limited_factor(
    total: f64,
    base: f64,
    step: f64,
    factor_range: Range,
    total_range: Option<Range>,
) -> (f64, Limit) {
    let factor = factor_range.clamp(step);
    let mut limit = if factor == step {
        Limit::None
    } else {
        Limit::Factor
    };
    let mut next = total * factor;
    if let Some(range) = total_range {
        let held = range.clamp(base * next) / base;
        if !range.contains(base * next) {
            limit = Limit::Total;
            next = held;
        }
    }
    (next, limit)
}
