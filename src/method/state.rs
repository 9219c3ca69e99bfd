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
use nalgebra::{DMatrix, DVector};
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
    /// The modes, each in the place of the exact mode or further shape of the basis that it continues.
    pub(crate) modes: ModeSet,
    /// Their shapes in terms of the basis, of unit generalized mass (N × N).
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

    /// The modes, each in the place of the exact mode or further shape of the basis that it continues.
    pub fn modes(&self) -> &ModeSet {
        &self.modes
    }

    /// Their shapes in terms of the basis, of unit generalized mass (N × N).
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
        let count = model.basis.len();
        Self {
            factors: vec![1.0; model.shares.len()],
            modes: model.basis.clone(),
            generalized_shapes: DMatrix::identity(count, count),
            pairing: model.exact.pairing.clone(),
            errors: model.exact.errors,
        }
    }

    /// Refuses a state of another model.
    pub(crate) fn check(&self, model: &ModalModel) -> Result<(), Error> {
        let (rows, columns) = model.basis.shapes.shape();
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
        let basis = &model.basis;
        let SummedChange {
            k,
            beta,
            alpha,
            apart,
        } = SummedChange::new(model, &factors)?;
        let (count, size) = (k.len(), basis.len());
        let has_mass = model
            .shares
            .iter()
            .any(|share| matches!(share, ParameterMatrix::Mass(_)));
        let whole = || ModalChange::of_vibrations(&k, beta.clone(), alpha.clone());
        let perturbed = match rule {
            UpdateRule::Eigensolution => eigensolution(&whole())?,
            UpdateRule::Recursive1 if has_mass => {
                general::recursive_1_converged(&whole(), ROOT_TOLERANCE, MOST_ORDERS)?.perturbed
            }
            UpdateRule::Recursive1 => {
                recursive_1_converged(&k, &beta, ROOT_TOLERANCE, MOST_ORDERS)?.perturbed
            }
        };
        perturbed.check_roots()?;
        let mut shapes = perturbed.shapes;
        normalize_with_mass(&mut shapes, &alpha)?;
        let shapes = with_rigid_bodies(apart, shapes);
        let close = shapes.tr_mul(&model.cross);
        let pairing = (model.pair)(&close.rows(0, model.exact.modes.len()).into_owned())?;
        let all = &basis.shapes * &shapes;
        let vibrations = all.columns(0, count).into_owned();
        let ModeSet { omega_squared, .. } =
            ModeSet::new(perturbed.roots.map(f64::recip), vibrations)?;
        let modes = ModeSet {
            omega_squared: omega_squared.resize_vertically(size, 0.0),
            shapes: all,
        };
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

/// The change of all parameters together, seen through the vibrations of the basis.
pub(crate) struct SummedChange {
    /// $\omega^2$ of the vibrations before it.
    pub(crate) k: DVector<f64>,
    /// $\beta = \sum_{stiffness} (c_e - 1) V^t K_e V$.
    pub(crate) beta: DMatrix<f64>,
    /// $\alpha = \sum_{mass} (c_e - 1) V^t M_e V$, less what rigid-body modes carry.
    pub(crate) alpha: DMatrix<f64>,
    /// Where there are rigid-body modes, [`apart_from_rigid_bodies`].
    pub(crate) apart: Option<DMatrix<f64>>,
}

impl SummedChange {
    pub(crate) fn new(model: &ModalModel, factors: &[f64]) -> Result<Self, Error> {
        let (count, size) = (model.vibration_count(), model.basis.len());
        let (mut beta, mut alpha) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
        for (share, factor) in model.shares.iter().zip(factors) {
            match share {
                ParameterMatrix::Stiffness(matrix) => beta += (factor - 1.0) * matrix,
                ParameterMatrix::Mass(matrix) => alpha += (factor - 1.0) * matrix,
            }
        }
        let apart = apart_from_rigid_bodies(&alpha, count)?;
        if let Some(apart) = &apart {
            beta = beta.resize(count, count, 0.0);
            alpha = (alpha * apart).resize(count, count, 0.0);
        }
        Ok(Self {
            k: model.basis.omega_squared.rows(0, count).into_owned(),
            beta,
            alpha,
            apart,
        })
    }
}

/// Shapes in terms of the basis (N × N) that a change of mass, `alpha` $= V^t \Delta M V$ (N × N), leaves apart: the `count` vibrations and
/// the rigid-body modes $R$ behind them; none where there are no such.
///
/// Rigid-body modes strain nothing, and stay what they are; vibrations stay orthogonal to them by carrying some of them along,
///
/// $$ V - R q, \qquad (I + \alpha_{RR}) q = \alpha_{RV} . $$
///
/// The stiffness is that in $V$, the change of mass $\alpha_{VV} - \alpha_{VR} q$, and the roots $1/\omega^2$ of rigid-body modes, which would be infinite, are not needed.
fn apart_from_rigid_bodies(
    alpha: &DMatrix<f64>,
    count: usize,
) -> Result<Option<DMatrix<f64>>, Error> {
    let rigid = alpha.nrows() - count;
    if rigid == 0 {
        return Ok(None);
    }
    let mut apart = DMatrix::identity(alpha.nrows(), alpha.nrows());
    let own = DMatrix::identity(rigid, rigid) + alpha.view((count, count), (rigid, rigid));
    let factor = own.cholesky().ok_or(Error::NotPositiveDefinite {
        what: "mass of the rigid-body modes",
        dof: 0,
    })?;
    let along = factor.solve(&alpha.view((count, 0), (rigid, count)).into_owned());
    apart
        .view_mut((count, 0), (rigid, count))
        .copy_from(&-along);
    let mut orthonormal = apart.view_mut((count, count), (rigid, rigid));
    factor
        .l()
        .tr_solve_lower_triangular_unchecked_mut(&mut orthonormal);
    Ok(Some(apart))
}

/// Generalized shapes of vibrations and rigid-body modes from those of the vibrations (n × n).
pub(crate) fn with_rigid_bodies(
    apart: Option<DMatrix<f64>>,
    vibrations: DMatrix<f64>,
) -> DMatrix<f64> {
    let Some(apart) = apart else {
        return vibrations;
    };
    let mut both = DMatrix::identity(apart.nrows(), apart.nrows());
    both.view_mut((0, 0), vibrations.shape())
        .copy_from(&vibrations);
    apart * both
}
