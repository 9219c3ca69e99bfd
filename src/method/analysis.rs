//! Analysis as the loops need it: four questions.
//! Tour: [chapter 4](crate::tour::chapter_04_step).
//!
//! [`ModalModel`](crate::method::model::ModalModel) answers them as the paper does. Any other analysis that answers them can be correlated.

use super::{
    error::Result, error_sum::Errors, linear_algebra::Matrix, modes::Modes, sorting::Pairing,
    step::StepRule,
};

/// Modes at factors on the stored stiffness, beside the test modes.
#[derive(Debug, Clone)]
pub struct State {
    /// Factor $s_e$ on each parameter's stiffness since the last exact modes.
    pub share_factors: Vec<f64>,
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
    /// Another number of factors than there are parameters, and a change that the perturbation cannot follow: one that takes a root's sign,
    /// or brings modes so close that the recursion cannot tell them apart or does not settle.
    fn at(&self, share_factors: &[f64]) -> Result<State>;

    /// $\Delta e_e = e_f + e_v - e_S$ (12) of every parameter at a state, for 0.1 % of its present stiffness.
    ///
    /// # Errors
    /// A state of another model, and a change that takes a root's sign.
    fn error_changes(&self, state: &State) -> Result<Vec<f64>>;

    /// $\Delta k_e$ (12) of every parameter at a state, dimensionless, with the factors $g_e$ on gages since the exact modes.
    fn stiffness_changes(&self, state: &State, gage_factors: &[f64], rule: StepRule) -> Vec<f64>;
}
