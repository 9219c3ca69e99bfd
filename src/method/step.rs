//! The step (13): from derivatives to stiffness change factors, and the bounds that limit them.
//! Tour: [chapter 4](crate::tour::chapter_04_step).

use super::{
    error::{Error, Result},
    linear_algebra::Matrix,
};
use serde::{Deserialize, Serialize};

/// Gage in which a change of gage is measured by the step, in.
pub const REFERENCE_GAGE: f64 = 0.01;

/// Ours: least part of the stored stiffness that the changes of an inner loop leave when they add.
pub const LEAST_SHARE: f64 = 1e-3;

/// Closed interval of factors, gages or areas.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// Its lower end.
    pub lower: f64,
    /// Its upper end.
    pub upper: f64,
}

/// Part of one that quotients of sizes lose to round-off, some 1e-16 each, and more.
const LOST_DIGITS: f64 = 1e-12;

impl Bounds {
    /// An interval of positive numbers.
    ///
    /// # Errors
    /// Ends other than $0 < \text{lower} < \text{upper}$, both finite.
    pub fn positive(what: &str, lower: f64, upper: f64) -> Result<Self> {
        if lower > 0.0 && upper > lower && upper.is_finite() {
            return Ok(Self { lower, upper });
        }
        let what = what.to_owned();
        Err(Error::Range { what, lower, upper })
    }

    /// Verdict that the interval holds where a factor starts, which is one, or ends there but for digits that sizes and their quotients
    /// lose.
    pub fn holds_start(&self) -> bool {
        self.lower <= 1.0 + LOST_DIGITS && self.upper >= 1.0 - LOST_DIGITS
    }

    /// Verdict that a number lies in the interval, ends included.
    pub fn contains(&self, value: f64) -> bool {
        (self.lower..=self.upper).contains(&value)
    }

    /// The number of the interval nearest to a value; NaN of NaN, which `max` would turn into a number.
    fn nearest(&self, value: f64) -> f64 {
        if value.is_nan() {
            return value;
        }
        value.max(self.lower).min(self.upper)
    }
}

/// Measure of the change in generalized stiffness $\Delta k_e$ of (12) and (13) for a relative change.
///
/// The paper's sentence can be read in several ways, and its tables do not decide between them (`paper/print_and_box.md`). With
/// $\kappa_{ij} = s_e V_{Gi}^t K_e V_{Gj}/(\omega_{Gi} \omega_{Gj})$, the element's stiffness on the test modes relative to the
/// test's own:
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StepRule {
    /// $\lVert \kappa \rVert_F$, the coupling of modes included: the library's own. With all
    /// modes it is $\lVert K_G^{-1/2} \Delta K K_G^{-1/2} \rVert_F$ with the test's stiffness $K_G$, whatever the basis.
    Matrix,
    /// $(\sum_i \kappa_{ii}^2)^{1/2}$, the diagonal alone.
    Own,
    /// The relative change itself, alike for every parameter.
    Relative,
    /// The change of gage in units of [`REFERENCE_GAGE`], $t_e/(0.01 \text{ in})$.
    Gage,
}

impl StepRule {
    /// All of them, the library's own first.
    pub const ALL: [Self; 4] = [Self::Matrix, Self::Own, Self::Relative, Self::Gage];

    /// $\Delta k_e$ for a relative change of one, dimensionless: of a parameter with the stiffness `test_share` relative to the test's
    /// (g × g), at the factor $s_e$ on it, of the present `gage` (in).
    pub fn measure(self, test_share: &Matrix, share_factor: f64, gage: f64) -> f64 {
        match self {
            Self::Matrix => share_factor * test_share.norm(),
            Self::Own => {
                let own = test_share.iter().step_by(test_share.nrows() + 1);
                share_factor * own.map(|kappa| kappa * kappa).sum::<f64>().sqrt()
            }
            Self::Relative => 1.0,
            Self::Gage => gage / REFERENCE_GAGE,
        }
    }
}

/// Unlimited stiffness change factor by (13).
///
/// $$ c_e = 1 - R \frac{3}{n^{1/2}} e_S \frac{\Delta e_e}{\Delta k_e} $$
///
/// `relaxation` is $3R/n^{1/2}$: the paper's $R$ is of nine modes ([`Settings::for_modes`](super::outer_loop::Settings::for_modes)).
///
/// The paper prints $c = R e_S (\Delta e/\Delta k)$, which is the change of the factor, not the factor
/// (`paper/errata.md`). A parameter without stiffness in any test mode keeps factor one.
pub fn unlimited_factor(
    error_change: f64,
    stiffness_change: f64,
    error_sum: f64,
    relaxation: f64,
) -> f64 {
    if stiffness_change > 0.0 {
        let step = relaxation * error_sum * error_change / stiffness_change;
        // An infinite factor becomes the largest finite number; the limits cut it anyway.
        (1.0 - step).clamp(-f64::MAX, f64::MAX)
    } else {
        1.0
    }
}

/// New total factor of a parameter after a `fraction` of the limited step.
///
/// Ours: the unlimited factor $c$ is first brought within the bounds of one iteration, then the step $c - 1$ is shortened, so that a
/// halving shortens the step that is taken. `gage_factor` is the factor so far and `earlier` what it multiplies (the product of earlier
/// passes), so that the parameter stands at `earlier·gage_factor` of its first value; `gage_bounds` bounds that product.
pub fn limited_factor(
    unlimited: f64,
    fraction: f64,
    gage_factor: f64,
    earlier: f64,
    factor_range: Bounds,
    gage_bounds: Option<Bounds>,
) -> f64 {
    let factor = factor_range.nearest(unlimited);
    let next = gage_factor * (1.0 + fraction * (factor - 1.0));
    match gage_bounds {
        Some(range) if !range.contains(earlier * next) => range.nearest(earlier * next) / earlier,
        _ => next,
    }
}

/// Factor $s_e$ on a stored share after a step that takes its gage's factor from `gage_factor` to `next`.
///
/// Ours, read from the paper's Tables 9 to 12: the changes of an inner loop's iterations add on the stiffness stored since the last
/// exact modes, $K_e \big(1 + \sum (c - 1)\big)$ and at least [`LEAST_SHARE`] of $K_e$, while gages multiply.
pub fn next_share_factor(share_factor: f64, gage_factor: f64, next: f64) -> f64 {
    // `f64::max` would turn NaN into a number.
    (share_factor + next / gage_factor - 1.0).clamp(LEAST_SHARE, f64::INFINITY)
}
