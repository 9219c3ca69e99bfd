//! Analysis as the loops need it: four questions.
//! Tour: [chapter 4](crate::tour::chapter_04_step).
//!
//! [`Model`](crate::method::model::Model) answers them as the paper does. Any other analysis that answers them can be correlated.

use super::{
    error::Result, error_sum::Errors, linear_algebra::Matrix, modes::Modes, sorting::Pairing,
    step::StepRule,
};

/// Relative change of a parameter's stiffness for a derivative.
pub const DERIVATIVE_STEP: f64 = 0.001;

/// Ours: separation of two modes, relative to the larger $\omega^2$, below which a difference holds them to their own shapes.
///
/// A step of [`DERIVATIVE_STEP`] couples two modes so close by a tenth and more, which is no longer first order. Where two
/// roots meet their shapes have no derivative at all, while the roots still have one.
pub const HELD_SEPARATION: f64 = 10.0 * DERIVATIVE_STEP;

/// Modes at factors on the stored stiffness, beside the test modes.
#[derive(Debug, Clone)]
pub struct State {
    /// Factor $s_e$ on each parameter's stiffness since the last exact modes.
    pub factors: Vec<f64>,
    /// The modes, each in the place of the exact mode that it continues.
    pub modes: Modes,
    /// Their shapes in terms of the exact modes, of unit generalized mass (n × n).
    pub generalized_shapes: Matrix,
    /// The mode that answers each test mode.
    pub pairing: Pairing,
    /// Distance from the test modes.
    pub errors: Errors,
}

/// An exact analysis of a model beside its test modes, from which the modes of changed models follow by perturbation.
pub trait Analysis {
    /// The exact modes: all factors are one.
    fn exact(&self) -> &State;

    /// The modes at these factors on the stored stiffness, all changes since the exact modes taken at once (9 to 11).
    ///
    /// # Errors
    /// [`Error::WrongShape`](super::error::Error::WrongShape) unless there is a factor for every parameter;
    /// [`Error::NotAVibration`](super::error::Error::NotAVibration), [`Error::CoalescingModes`](super::error::Error::CoalescingModes) or
    /// [`Error::UnsettledRoots`](super::error::Error::UnsettledRoots) for a change that the perturbation cannot follow.
    fn at(&self, factors: &[f64]) -> Result<State>;

    /// $\Delta e_e = e_f + e_v - e_S$ (12) of every parameter at a state, for 0.1 % of its present stiffness.
    ///
    /// # Errors
    /// [`Error::WrongShape`](super::error::Error::WrongShape) for a state of another model;
    /// [`Error::NotAVibration`](super::error::Error::NotAVibration) when a change takes a root's sign.
    fn error_changes(&self, state: &State) -> Result<Vec<f64>>;

    /// $\Delta k_e$ (12) of every parameter at a state, dimensionless, with the factors $g_e$ on gages since the exact modes.
    fn stiffness_changes(&self, state: &State, gage_factors: &[f64], rule: StepRule) -> Vec<f64>;
}

/// $\Delta k_e$ (12) of every parameter by a rule, from its relative stiffness on the test modes (g × g) and its gage (in).
pub(crate) fn changes_by(
    rule: StepRule,
    test_shares: &[Matrix],
    state: &State,
    gages: &[f64],
    gage_factors: &[f64],
) -> Vec<f64> {
    let stored = test_shares.iter().zip(&state.factors);
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
