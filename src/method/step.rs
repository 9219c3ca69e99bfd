//! The step (13): from derivatives to stiffness change factors, and the bounds that limit them.

use crate::method::derivatives::DERIVATIVE_STEP;
use crate::method::model::{ModalModel, Range};
use crate::method::state::ModalState;
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

/// How $\Delta k_e$ of (12) and (13) is measured for a change of 0.1 %.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum StepRule {
    /// Root sum of squares over the test modes of the element's own relative generalized stiffness changes,
    /// $0.001 c_e V_{Gi}^t K_e V_{Gi}/\omega_{Gi}^2$. The primary rule.
    #[default]
    RootSumOfSquares,
    /// Their sum instead: smaller steps, on the torque box one and a half to two times the iterations.
    SumOverModes,
    /// Plain steepest descent, $\Delta k_e = 0.001 \sum_s (\Delta e_s/0.001)^2$ for every element alike: the step that would
    /// bring the linearized error sum to zero. It ignores how much stiffness each parameter has.
    SteepestDescent,
}

/// $\Delta k_e$ of every parameter for a change of 0.1 % at the present state (12), dimensionless.
pub fn stiffness_changes(model: &ModalModel, state: &ModalState, error_changes: &[f64], rule: StepRule) -> Vec<f64> {
    let slopes = error_changes.iter().map(|change| change / DERIVATIVE_STEP);
    let squared_slopes: f64 = slopes.map(|slope| slope * slope).sum();
    let of_parameter = |(share, factor): (&DMatrix<f64>, &f64)| match rule {
        StepRule::RootSumOfSquares => DERIVATIVE_STEP * factor * share.diagonal().norm(),
        StepRule::SumOverModes => DERIVATIVE_STEP * factor * share.trace(),
        StepRule::SteepestDescent => DERIVATIVE_STEP * squared_slopes,
    };
    model.test_shares.iter().zip(&state.factors).map(of_parameter).collect()
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
        true => 1.0 - relaxation * error_sum * error / stiffness,
        false => 1.0,
    };
    error_changes.iter().zip(stiffness_changes).map(factor).collect()
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

/// One parameter's new total factor after a step of `1 + fraction·(c − 1)`, within its bounds, and what limited it.
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
    let next = total * factor;
    match total_range {
        Some(range) if !range.contains(base * next) => (range.clamp(base * next) / base, Limit::Total),
        _ => (next, if factor == step { Limit::None } else { Limit::Factor }),
    }
}
