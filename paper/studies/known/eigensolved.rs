//! A caller's own analysis: the paper's, but with an eigensolution where it has Recursive 1.

use corfem::method::analysis::{Analysis, State};
use corfem::method::error::Error;
use corfem::method::error_sum::errors;
use corfem::method::model::Model;
use corfem::method::modes::{Modes, solve};
use corfem::method::sorting::pair_modes;
use corfem::method::step::StepRule;
use nalgebra::DMatrix;

/// State of a model at factors by an eigensolution in its modal coordinates, each mode in the place of the exact mode that it is most like.
///
/// # Errors
/// A model that is not a vibration at these factors, or whose modes do not pair with the test's.
pub fn exact_state(model: &Model, factors: &[f64]) -> Result<State, Error> {
    let size = model.exact().modes.len();
    let mut beta = DMatrix::zeros(size, size);
    for (share, factor) in model.shares().iter().zip(factors) {
        beta += (factor - 1.0) * share;
    }
    let stiffness = DMatrix::from_diagonal(model.exact().modes.omega_squared()) + beta;
    let found = solve(&stiffness, &DMatrix::identity(size, size), size)?;
    // Rows of the shapes are the exact modes, so their transpose is the cross-orthogonality of the new modes with these.
    let places = pair_modes(&found.shapes().transpose())?;
    let mut generalized = found.shapes().select_columns(&places.analysis_mode);
    for (mut shape, sign) in generalized.column_iter_mut().zip(&places.sign) {
        shape *= *sign;
    }
    let squares = found.omega_squared().select_rows(&places.analysis_mode);
    let modes = Modes::new(squares, model.exact().modes.shapes() * &generalized)?;
    let pairing = pair_modes(&generalized.tr_mul(model.cross()))?;
    Ok(State {
        factors: factors.to_vec(),
        errors: errors(&modes, &pairing, model.test())?,
        generalized_shapes: generalized,
        modes,
        pairing,
    })
}

/// The analysis.
pub struct Eigensolved(pub Model);

impl Analysis for Eigensolved {
    fn exact(&self) -> &State {
        self.0.exact()
    }

    fn at(&self, factors: &[f64]) -> Result<State, Error> {
        exact_state(&self.0, factors)
    }

    fn error_changes(&self, state: &State) -> Result<Vec<f64>, Error> {
        self.0.error_changes(state)
    }

    fn stiffness_changes(&self, state: &State, gage_factors: &[f64], rule: StepRule) -> Vec<f64> {
        self.0.stiffness_changes(state, gage_factors, rule)
    }
}
