//! The step (13): from derivatives to stiffness change factors, and the bounds that limit them.
//! Tour: [chapter 4](crate::tour::chapter_04_step).

use crate::method::derivatives::DERIVATIVE_STEP;
use crate::method::model::{Bounds, ModalModel, REFERENCE_GAGE};
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

/// Least part of the stored stiffness that the changes of an inner loop leave when they add.
pub const LEAST_SHARE: f64 = 1e-3;

/// How the change in generalized stiffness $\Delta k_e$ of (12) and (13) is measured for a change of 0.1 %.
///
/// The paper's sentence can be read in several ways, and its tables do not decide between them (`paper/interpretation.md`). With
/// $\kappa_{ij} = c_e V_{Gi}^t K_e V_{Gj}/(\omega_{Gi} \omega_{Gj})$, the element's stiffness on the test modes relative to the
/// test's own:
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StepRule {
    /// $0.001 \lVert \kappa \rVert_F$, the coupling of modes included: the library's own. With all
    /// modes it is $\lVert K_G^{-1/2} \Delta K K_G^{-1/2} \rVert_F$ with the test's stiffness $K_G$, whatever the basis.
    #[default]
    #[serde(rename = "matrix")]
    Norm,
    /// $0.001 (\sum_i \kappa_{ii}^2)^{1/2}$, the diagonal alone.
    #[serde(rename = "own")]
    Diagonal,
    /// The relative change itself, 0.001 for every parameter.
    Relative,
    /// The change of gage in units of [`REFERENCE_GAGE`], $0.001 t_e/(0.01 \text{ in})$.
    Gage,
}

/// $\Delta k_e$ of every parameter for a change of 0.1 % (12), dimensionless.
///
/// The parameters stand at `share_factors` on the model's shares and at `size_factors` on its gages, one of either a parameter.
pub fn stiffness_changes(
    model: &ModalModel,
    share_factors: &[f64],
    size_factors: &[f64],
    rule: StepRule,
) -> Vec<f64> {
    let relative =
        |((share, share_factor), (size, size_factor)): ((&DMatrix<f64>, &f64), (&f64, &f64))| {
            match rule {
                StepRule::Norm => share_factor * share.norm(),
                StepRule::Diagonal => share_factor * share.diagonal().norm(),
                StepRule::Relative => 1.0,
                StepRule::Gage => size_factor * size / REFERENCE_GAGE,
            }
        };
    let shares = model.test_shares.iter().zip(share_factors);
    let sizes = model.sizes.iter().zip(size_factors);
    shares
        .zip(sizes)
        .map(|parameter| DERIVATIVE_STEP * relative(parameter))
        .collect()
}

/// Unlimited stiffness change factors by (13).
///
/// $$ c_e = 1 - R e_S \frac{\Delta e_e}{\Delta k_e} $$
///
/// The paper prints $c = R e_S (\Delta e/\Delta k)$, which is the change of the factor, not the factor
/// (`paper/errata.md`). A parameter without stiffness in any test mode keeps factor one.
pub fn unlimited_factors(
    error_changes: &[f64],
    stiffness_changes: &[f64],
    error_sum: f64,
    relaxation: f64,
) -> Vec<f64> {
    let factor = |(&error, &stiffness): (&f64, &f64)| match stiffness > 0.0 {
        // An infinite factor becomes the largest finite number; the limits cut it anyway.
        true => (1.0 - relaxation * error_sum * error / stiffness).clamp(-f64::MAX, f64::MAX),
        false => 1.0,
    };
    error_changes
        .iter()
        .zip(stiffness_changes)
        .map(factor)
        .collect()
}

/// What limited a parameter's factor in an iteration.
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

/// One parameter's new total factor after a `fraction` of the limited step, and what limited it.
///
/// The unlimited factor $c$ is first brought within the bounds of one iteration, then the step $c - 1$ is shortened, so that a
/// halving shortens the step that is taken. `total` is the factor so far and `base` what it multiplies (the product of earlier
/// passes), so that the parameter stands at `base·total` of its first value; `total_range` bounds that product.
pub fn limited_factor(
    unlimited: f64,
    fraction: f64,
    total: f64,
    base: f64,
    factor_range: Bounds,
    total_range: Option<Bounds>,
) -> (f64, Limit) {
    let factor = factor_range.clamp(unlimited);
    let next = total * (1.0 + fraction * (factor - 1.0));
    match total_range {
        Some(range) if !range.contains(base * next) => {
            (range.clamp(base * next) / base, Limit::Total)
        }
        _ => (
            next,
            if factor == unlimited {
                Limit::None
            } else {
                Limit::Factor
            },
        ),
    }
}

/// How the changes of an inner loop's iterations come together on the stiffness stored since the last exact modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Accumulation {
    /// They add, $K_e \big(1 + \sum (c - 1)\big)$ and at least [`LEAST_SHARE`] of $K_e$, while gages multiply: the paper's, by its
    /// Tables 9 to 12.
    #[default]
    Sum,
    /// They multiply as gages do: $K_e c_1 c_2$ after two steps.
    Product,
}

impl StepRule {
    /// What the rule is called in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Norm => "matrix",
            Self::Diagonal => "own",
            Self::Relative => "relative",
            Self::Gage => "gage",
        }
    }
}

impl Accumulation {
    /// The factor on a stored share after a step that takes its gage's factor from `total` to `next`.
    pub fn next_share_factor(self, share_factor: f64, total: f64, next: f64) -> f64 {
        match self {
            // `f64::max` would turn NaN into a number.
            Self::Sum if share_factor + next / total - 1.0 < LEAST_SHARE => LEAST_SHARE,
            Self::Sum => share_factor + next / total - 1.0,
            Self::Product => next,
        }
    }
}
