//! Derivatives (12): what a thousandth of an element's stiffness does to the error sum, and how large it is.
//! Tour: [chapter 4](crate::tour::chapter_04_step).

use super::{
    analysis::State,
    changed_modes::modes_of,
    error::Result,
    error_sum::errors,
    linear_algebra::{Matrix, check_shape},
    modes::Modes,
    perturbation::first_order,
    step::StepRule,
};

/// Relative change of a parameter's stiffness for a derivative.
pub const DERIVATIVE_STEP: f64 = 0.001;

/// Ours: separation of two modes, relative to the larger $\omega^2$, below which a difference holds them to their own shapes.
///
/// A step of [`DERIVATIVE_STEP`] couples two modes so close by a tenth and more, which is no longer first order. Where two
/// roots meet their shapes have no derivative at all, while the roots still have one.
pub const HELD_SEPARATION: f64 = 10.0 * DERIVATIVE_STEP;

/// $\Delta e = e_f + e_v - e_S$ (12) for a change $\beta = V^t \Delta K V$ (n × n) of a state with the modes $V$: roots and shapes follow by
/// first order (C.20, C.21), and the error sum is taken anew with the state's pairing.
///
/// # Errors
/// A change of other modes, test modes at other DOF, and a change that takes a root's sign.
pub fn error_change(state: &State, beta: &Matrix, test: &Modes) -> Result<f64> {
    let (before, k) = (&state.modes, &state.modes.omega_squared);
    check_shape("generalized stiffness change", beta, k.len(), k.len())?;
    let changed = first_order(k, &without_close_couplings(k.as_slice(), beta))?;
    let errors = errors(&modes_of(&changed, before), &state.pairing, test)?;
    Ok(errors.sum() - state.errors.sum())
}

/// $\Delta k_e$ (12) of every parameter by a rule, from its relative stiffness on the test modes (g × g) and its gage (in).
pub(crate) fn stiffness_changes(
    rule: StepRule,
    test_shares: &[Matrix],
    state: &State,
    gages: &[f64],
    gage_factors: &[f64],
) -> Vec<f64> {
    let stored = test_shares.iter().zip(&state.share_factors);
    stored
        .zip(gages.iter().zip(gage_factors))
        .map(|((share, s), (gage, g))| DERIVATIVE_STEP * rule.measure(share, *s, gage * g))
        .collect()
}

/// Change of stiffness or mass (n × n) without what couples modes closer than [`HELD_SEPARATION`], which keep their own shapes.
pub fn without_close_couplings(omega_squared: &[f64], change: &Matrix) -> Matrix {
    let k = omega_squared;
    change.map_with_location(|i, j, entry| {
        let is_close = i != j && (k[i] - k[j]).abs() < HELD_SEPARATION * k[i].max(k[j]);
        if is_close { 0.0 } else { entry }
    })
}
