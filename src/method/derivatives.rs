//! Derivatives of the error sum (12): what a small change of each parameter does to it.
//! Tour: [chapter 4](crate::tour::chapter_04_step).
//!
//! [`by_definition`] is the paper's way, parameter by parameter. [`gradient`] is its limit for all parameters at once: a sweep
//! over the test modes gives the derivative by every entry of $\beta$, an inner product with $V^t K_e V$ that by a parameter.

use crate::method::appendix_c::general::{self, ModalChange};
use crate::method::appendix_c::{SMALLEST_SEPARATION, first_order};
use crate::method::error::{Error, at_least_one};
use crate::method::error_sum::unit_shape_difference;
use crate::method::linear_algebra::finite_list;
use crate::method::model::{ModalModel, ParameterMatrix};
use crate::method::modes::ModeSet;
use crate::method::state::ModalState;
use nalgebra::{DMatrix, DVectorView};
use serde::{Deserialize, Serialize};

/// Relative change of a parameter's stiffness for a derivative.
pub const DERIVATIVE_STEP: f64 = 0.001;

/// Separation of two modes, relative to the larger $\omega^2$, below which a difference holds them to their own shapes.
///
/// A step of [`DERIVATIVE_STEP`] couples two modes so close by a tenth and more, which is no longer first order. Where two
/// roots meet their shapes have no derivative at all, while the roots still have one.
pub const HELD_SEPARATION: f64 = 10.0 * DERIVATIVE_STEP;

/// Which derivatives the inner loop steps by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DerivativeRule {
    /// The paper's difference, [`by_definition`].
    #[default]
    Definition,
    /// Its limit, [`gradient`].
    Gradient,
}

/// $\Delta e_e = e_f + e_v - e_S$ (12) of every parameter at the present state.
///
/// # Errors
/// [`Error::Empty`] without parameters; those of [`by_definition`].
pub fn error_changes(
    model: &ModalModel,
    state: &ModalState,
    rule: DerivativeRule,
) -> Result<Vec<f64>, Error> {
    at_least_one("parameters", model.shares.len())?;
    if rule == DerivativeRule::Definition {
        return by_definition(model, state);
    }
    Ok(gradient(model, state)?
        .into_iter()
        .map(|slope| DERIVATIVE_STEP * slope)
        .collect())
}

/// $\Delta e_e = e_f + e_v - e_S$ of every parameter, for $\Delta K = 0.001 c_e K_e$ or $\Delta M = 0.001 c_e M_e$ at the
/// present factors $c_e$ (12).
///
/// For each, $\beta = 0.001 c_e V^t K_e V$ (or $\alpha$ with $M_e$) with the present modes $V$; roots and shapes follow by
/// first order (C.20, C.21) and the error sum is taken anew with the present pairing. Modes closer than
/// [`HELD_SEPARATION`] keep their own shapes.
///
/// # Errors
/// [`Error::LostRoot`] when a change takes a root's sign; those of [`gradient`].
///
/// # Example
///
/// ```rust
/// use corfem::method::derivatives::by_definition;
/// use corfem::method::model::{DynamicModel, ParameterMatrix};
/// # use corfem::method::modes::ModeSet;
/// # use corfem::method::state::ModalState;
/// # use nalgebra::{dmatrix, dvector};
///
/// let shares = vec![ParameterMatrix::Stiffness(dmatrix![4.0])];
/// let model = DynamicModel { stiffness: dmatrix![4.0], mass: dmatrix![1.0], shares };
/// let test = ModeSet::new(dvector![9.0], dmatrix![1.0])?;
/// let modal = model.analyze(&test, None)?;
/// // The error is 1 - (2/3)√c, here at c = 1.001 and at 1.
/// let changes = by_definition(&modal, &ModalState::start(&modal))?;
/// assert!((changes[0] - 2.0 / 3.0 * (1.0 - 1.001_f64.sqrt())).abs() < 1e-15);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn by_definition(model: &ModalModel, state: &ModalState) -> Result<Vec<f64>, Error> {
    state.check(model)?;
    let (count, p) = (model.vibration_count(), &state.generalized_shapes);
    let k = state.modes.omega_squared.rows(0, count).into_owned();
    let are_close =
        |i: usize, j: usize| i != j && (k[i] - k[j]).abs() < HELD_SEPARATION * k[i].max(k[j]);
    let of_parameter = |(share, factor): (&ParameterMatrix, &f64)| {
        let change = DERIVATIVE_STEP * *factor * p.tr_mul(&(share.matrix() * p));
        let own = change.view((0, 0), (count, count));
        let own = own.map_with_location(|i, j, entry| if are_close(i, j) { 0.0 } else { entry });
        let perturbed = match share {
            ParameterMatrix::Stiffness(_) => first_order(&k, &own)?,
            ParameterMatrix::Mass(_) => {
                general::first_order(&ModalChange::of_vibrations(&k, 0.0 * &own, own))?
            }
        };
        perturbed.check_roots()?;
        let now = &state.modes.shapes;
        let mut shapes = now.columns(0, count) * perturbed.shapes;
        if let ParameterMatrix::Mass(_) = share {
            // With ω² = 0 the first order of a rigid-body mode in a vibration is -α_Ri.
            let rigid = p.ncols() - count;
            shapes -= now.columns(count, rigid) * change.view((count, 0), (rigid, count));
        }
        let modes = ModeSet {
            omega_squared: perturbed.roots.map(f64::recip),
            shapes,
        };
        Ok(model.errors_of(&modes, &state.pairing)?.sum() - state.errors.sum())
    };
    let changes = model
        .shares
        .iter()
        .zip(&state.factors)
        .map(of_parameter)
        .collect::<Result<_, _>>()?;
    finite_list("changes of the error sum", changes)
}

/// Derivative of the error sum with respect to every parameter's factor, relative to the present one: the limit of
/// $\Delta e_e/0.001$ for smaller and smaller changes.
///
/// By first order $\mathrm d\omega_i^2 = \beta_{ii}$ and $\mathrm d v_i = \sum_{r \ne i} v_r \beta_{ri}/(\omega_i^2 - \omega_r^2)$. With
/// $g_i = \partial e_v/\partial v_i$, and because $\beta$ is symmetric,
///
/// $$ \frac{\mathrm d e_S}{\mathrm d c_e} = \sum_{r,i} \Sigma_{ri} \kappa_{ri}, \qquad \kappa = V^t K_e V, \qquad
/// \Sigma_{ii} = \frac{\partial e_f}{\partial \omega_i^2}, \qquad
/// \Sigma_{ri} = \Sigma_{ir} = \frac{v_r^t g_i - v_i^t g_r}{2(\omega_i^2 - \omega_r^2)} . $$
///
/// A change of mass enters as $\beta_{ri} = -\omega_i^2 \alpha_{ri}$. Where an error is zero its root has a kink and no derivative;
/// that error then counts as constant. Modes closer than [`SMALLEST_SEPARATION`] keep their own shapes.
///
/// # Errors
/// [`Error::WrongShape`] for a state of another model; [`Error::NotFinite`].
///
/// # Example
///
/// ```rust
/// use corfem::method::derivatives::gradient;
/// use corfem::method::model::{DynamicModel, ParameterMatrix};
/// # use corfem::method::modes::ModeSet;
/// # use corfem::method::state::ModalState;
/// # use nalgebra::{dmatrix, dvector};
///
/// let shares = vec![ParameterMatrix::Stiffness(dmatrix![4.0])];
/// let model = DynamicModel { stiffness: dmatrix![4.0], mass: dmatrix![1.0], shares };
/// let test = ModeSet::new(dvector![9.0], dmatrix![1.0])?;
/// let modal = model.analyze(&test, None)?;
/// // The derivative of 1 - (2/3)√c at c = 1.
/// let slopes = gradient(&modal, &ModalState::start(&modal))?;
/// assert!((slopes[0] + 1.0 / 3.0).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn gradient(model: &ModalModel, state: &ModalState) -> Result<Vec<f64>, Error> {
    state.check(model)?;
    let pull = shape_pull(model, state);
    let has_mass = model
        .shares
        .iter()
        .any(|share| matches!(share, ParameterMatrix::Mass(_)));
    let of_mass =
        has_mass.then(|| in_exact_modes(sensitivity(model, state, pull.clone(), |k| -k), state));
    let of_stiffness = in_exact_modes(sensitivity(model, state, pull, |_| 1.0), state);
    let slope = |share: &ParameterMatrix| match (share, &of_mass) {
        (ParameterMatrix::Mass(matrix), Some(of_mass)) => entries(of_mass).dot(&entries(matrix)),
        (share, _) => entries(&of_stiffness).dot(&entries(share.matrix())),
    };
    let slopes = model
        .shares
        .iter()
        .zip(&state.factors)
        .map(|(share, factor)| factor * slope(share))
        .collect();
    finite_list("gradient", slopes)
}

/// $v_r^t \partial e_v/\partial v_i$ (n × n), what mode $r$ added to mode $i$ does to the shape error: one sweep over the test
/// modes.
fn shape_pull(model: &ModalModel, state: &ModalState) -> DMatrix<f64> {
    let shapes = &state.modes.shapes;
    let dof_count = shapes.nrows();
    let mut slopes = DMatrix::zeros(dof_count, shapes.ncols());
    let paired = state.pairing.analysis_mode.iter().enumerate();
    for (j, &i) in paired.filter(|_| state.errors.shape > 0.0) {
        // With u = ±v/|v_m| and the test's w, both of unit largest component: ∂e_v/∂v = ±(u − w)/(d e_v |v_m|), and what
        // the scale takes away at component m.
        let (shape, sign, mut slope) = (
            shapes.column(i),
            state.pairing.sign[j],
            slopes.column_mut(i),
        );
        let largest = unit_shape_difference(
            shape,
            sign,
            model.test.shapes.column(j),
            slope.as_mut_slice(),
        );
        let m = shape.iamax();
        slope[m] -= slope.dot(&shape) / shape[m];
        slope *= model.weights[j].shape.powi(2) * sign
            / (dof_count as f64 * state.errors.shape * largest);
    }
    shapes.tr_mul(&slopes)
}

/// $\Sigma$ (n × n) in place of the pull, with $\partial\beta_{ri}$ `per_change` of $\omega_i^2$.
fn sensitivity(
    model: &ModalModel,
    state: &ModalState,
    mut pull: DMatrix<f64>,
    per_change: impl Fn(f64) -> f64,
) -> DMatrix<f64> {
    let k = state.modes.omega_squared.as_slice();
    for i in 0..k.len() {
        pull[(i, i)] = 0.0;
        for r in i + 1..k.len() {
            let apart = k[i] - k[r];
            let both = per_change(k[i]) * pull[(r, i)] - per_change(k[r]) * pull[(i, r)];
            let are_apart = apart.abs() > SMALLEST_SEPARATION * k[i].max(k[r]);
            pull[(r, i)] = if are_apart { 0.5 * both / apart } else { 0.0 };
            pull[(i, r)] = pull[(r, i)];
        }
    }
    for (j, &i) in state.pairing.analysis_mode.iter().enumerate() {
        if state.errors.frequency > 0.0 {
            let ratio = (k[i] / model.test.omega_squared[j]).sqrt();
            let error = model.weights[j].frequency.powi(2) * (ratio - 1.0);
            pull[(i, i)] = per_change(k[i]) * error * ratio / (2.0 * k[i] * state.errors.frequency);
        }
    }
    pull
}

/// A sensitivity in the present modes $V p$ as one in the exact modes $V$, which the shares belong to: $p \Sigma p^t$.
fn in_exact_modes(sensitivity: DMatrix<f64>, state: &ModalState) -> DMatrix<f64> {
    if state.factors.iter().all(|&factor| factor == 1.0) {
        return sensitivity;
    }
    let p = &state.generalized_shapes;
    p * sensitivity * p.transpose()
}

/// The entries of a matrix as one vector, whose products with another are faster than a matrix's column by column.
fn entries(matrix: &DMatrix<f64>) -> DVectorView<'_, f64> {
    DVectorView::from_slice(matrix.as_slice(), matrix.len())
}
