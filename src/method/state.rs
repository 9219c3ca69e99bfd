//! Where an inner loop stands: the modes after changes of stiffness and mass, by perturbation from the last exact ones.
//! Tour: [chapter 5](crate::tour::chapter_05_inner_loop).

use crate::method::appendix_c::general::{self, ModalChange};
use crate::method::appendix_c::{eigensolution, normalize_with_mass, recursive_1_converged};
use crate::method::error::Error;
use crate::method::error_sum::Errors;
use crate::method::linear_algebra::{check_length, check_shape};
use crate::method::model::{ModalModel, ParameterMatrix};
use crate::method::modes::ModeSet;
use crate::method::pairing::Pairing;
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

/// Relative change of a root at which Recursive 1 counts as converged: round-off.
pub const ROOT_TOLERANCE: f64 = 1e-13;
/// Most orders of Recursive 1.
pub const MOST_ORDERS: usize = 60;

/// How modes are brought up to date after a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum UpdateRule {
    /// Recursive 1 (C.22) until the roots change by less than [`ROOT_TOLERANCE`], at most to order [`MOST_ORDERS`]: the
    /// paper's.
    #[default]
    Recursive1,
    /// An eigensolution in the modal coordinates, which is what the perturbation replaces. It also serves where modes are so
    /// close that the recursion does not settle.
    Eigensolution,
}

/// The modes and errors at some factors on a modal model's shares. They belong together:
///
/// ```compile_fail,E0616
/// # fn better(mut state: corfem::method::state::ModalState) {
/// state.errors.shape = 0.0;
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct ModalState {
    /// Factor on each parameter's share since the last exact modes.
    pub(crate) factors: Vec<f64>,
    /// The modes, each in the place of the exact mode it continues.
    pub(crate) modes: ModeSet,
    /// Their shapes in terms of the exact ones, of unit generalized mass (n × n).
    pub(crate) generalized_shapes: DMatrix<f64>,
    /// Which mode answers which test mode.
    pub(crate) pairing: Pairing,
    /// Distance from the test modes.
    pub(crate) errors: Errors,
}

impl ModalState {
    /// Factor on each parameter's share since the last exact modes.
    pub fn factors(&self) -> &[f64] {
        &self.factors
    }

    /// The modes, each in the place of the exact mode it continues.
    pub fn modes(&self) -> &ModeSet {
        &self.modes
    }

    /// Their shapes in terms of the exact ones, of unit generalized mass (n × n).
    pub fn generalized_shapes(&self) -> &DMatrix<f64> {
        &self.generalized_shapes
    }

    /// Which mode answers which test mode.
    pub fn pairing(&self) -> &Pairing {
        &self.pairing
    }

    /// Distance from the test modes.
    pub fn errors(&self) -> Errors {
        self.errors
    }

    /// The state before any change: all factors one, the exact modes.
    pub fn start(model: &ModalModel) -> Self {
        let count = model.exact.modes.len();
        Self {
            factors: vec![1.0; model.shares.len()],
            modes: model.exact.modes.clone().into(),
            generalized_shapes: DMatrix::identity(count, count),
            pairing: model.exact.pairing.clone(),
            errors: model.exact.errors,
        }
    }

    /// Refuses a state of another model.
    pub(crate) fn check(&self, model: &ModalModel) -> Result<(), Error> {
        let (rows, columns) = model.exact.modes.shapes.shape();
        check_length("parameter factors", self.factors.len(), model.shares.len())?;
        check_shape("shapes of the state", &self.modes.shapes, rows, columns)
    }

    /// The state at `factors` on the shares, the whole change since the last exact modes taken at once:
    ///
    /// $$ \beta = \sum_{stiffness} (c_e - 1) V^t K_e V, \qquad \alpha = \sum_{mass} (c_e - 1) V^t M_e V $$
    ///
    /// # Errors
    /// [`Error::WrongShape`] for factors or a model that do not fit; those of [`recursive_1_converged`], with changes of mass
    /// [`general::recursive_1_converged`], or [`eigensolution`]; those of [`normalize_with_mass`].
    pub fn at(model: &ModalModel, factors: Vec<f64>, rule: UpdateRule) -> Result<Self, Error> {
        check_length("parameter factors", factors.len(), model.shares.len())?;
        let exact = &model.exact.modes;
        let count = exact.len();
        let (mut beta, mut alpha) = (DMatrix::zeros(count, count), DMatrix::zeros(count, count));
        for (share, factor) in model.shares.iter().zip(&factors) {
            match share {
                ParameterMatrix::Stiffness(matrix) => beta += (factor - 1.0) * matrix,
                ParameterMatrix::Mass(matrix) => alpha += (factor - 1.0) * matrix,
            }
        }
        let k = &exact.omega_squared;
        let has_mass = model
            .shares
            .iter()
            .any(|share| matches!(share, ParameterMatrix::Mass(_)));
        let whole = || ModalChange::of_vibrations(k, beta.clone(), alpha.clone());
        let perturbed = match rule {
            UpdateRule::Eigensolution => eigensolution(&whole())?,
            UpdateRule::Recursive1 if has_mass => {
                general::recursive_1_converged(&whole(), ROOT_TOLERANCE, MOST_ORDERS)?.perturbed
            }
            UpdateRule::Recursive1 => {
                recursive_1_converged(k, &beta, ROOT_TOLERANCE, MOST_ORDERS)?.perturbed
            }
        };
        perturbed.check_roots()?;
        let mut shapes = perturbed.shapes;
        normalize_with_mass(&mut shapes, &alpha)?;
        let pairing = (model.pair)(&shapes.tr_mul(&model.cross))?;
        let modes = ModeSet::new(perturbed.roots.map(f64::recip), &exact.shapes * &shapes)?;
        let errors = model.errors_of(&modes, &pairing)?;
        Ok(Self {
            factors,
            modes,
            generalized_shapes: shapes,
            pairing,
            errors,
        })
    }
}
