//! Derivatives of the error sum (12): a 0.1 % change of each parameter by first-order perturbation.

use crate::error::Error;
use crate::linalg::check_length;
use crate::modal::{ModalProblem, ModalState, Share};
use crate::objective::squared_shape_difference;
use crate::perturbation::recursive::{first_order_into, first_order_mass_into};
use nalgebra::{DMatrix, DVector};

/// Relative change of a parameter's stiffness for a derivative.
pub const DERIVATIVE_STEP: f64 = 0.001;

/// What a small change of each parameter does.
#[derive(Debug, Clone, PartialEq)]
pub struct Derivatives {
    /// Change of the error sum, $\Delta e_e = e_f + e_v - e_S$, for $\Delta K = 0.001\, c_e K_e$ or $\Delta M = 0.001\, c_e M_e$.
    pub error_change: Vec<f64>,
    /// The same change's relative generalized stiffness or mass on the test modes, one column per parameter
    /// (test modes × parameters).
    pub share_change: DMatrix<f64>,
}

/// $\Delta e$ and $\Delta k$ of (12) for every parameter at the present state.
///
/// For each, $\beta = 0.001\, c_e\, V^t K_e V$ (or $\alpha$ with $M_e$) with the present modes $V$; roots and shapes follow by first order
/// (C.20, C.21) and the error sum is taken anew with the present pairing. The loop allocates nothing.
///
/// # Errors
/// [`Error::CoalescingModes`] when two present modes are too close for first order.
pub fn error_derivatives(problem: &ModalProblem, state: &ModalState) -> Result<Derivatives, Error> {
    let mut workspace = Workspace::new(problem);
    let mut error_change = vec![0.0; problem.parameter_count()];
    error_changes_into(problem, state, &mut workspace, &mut error_change)?;
    let mut share_change = DERIVATIVE_STEP * &problem.test_shares;
    for (mut column, &factor) in share_change.column_iter_mut().zip(&state.factors) {
        column *= factor;
    }
    Ok(Derivatives {
        error_change,
        share_change,
    })
}

/// Storage for one parameter's change, used again for the next.
#[derive(Debug, Clone)]
pub struct Workspace {
    product: DMatrix<f64>,
    change: DMatrix<f64>,
    roots: DVector<f64>,
    generalized_shapes: DMatrix<f64>,
    shape: DVector<f64>,
}

impl Workspace {
    /// Storage for the modes of a problem.
    pub fn new(problem: &ModalProblem) -> Self {
        let count = problem.start.len();
        Self {
            product: DMatrix::zeros(count, count),
            change: DMatrix::zeros(count, count),
            roots: DVector::zeros(count),
            generalized_shapes: DMatrix::zeros(count, count),
            shape: DVector::zeros(problem.start.shapes.nrows()),
        }
    }
}

/// $\Delta e$ of every parameter, written into `error_change`, without an allocation.
///
/// # Errors
/// As [`error_derivatives`], and [`Error::WrongShape`] unless `error_change` has one entry per parameter.
pub fn error_changes_into(
    problem: &ModalProblem,
    state: &ModalState,
    workspace: &mut Workspace,
    error_change: &mut [f64],
) -> Result<(), Error> {
    check_length(
        "error changes",
        error_change.len(),
        problem.parameter_count(),
    )?;
    for (e, change) in error_change.iter_mut().enumerate() {
        *change = error_sum_after(problem, state, e, workspace)? - state.errors.sum();
    }
    Ok(())
}

/// The error sum after a 0.1 % change of one parameter.
fn error_sum_after(
    problem: &ModalProblem,
    state: &ModalState,
    parameter: usize,
    work: &mut Workspace,
) -> Result<f64, Error> {
    let share = &problem.generalized_shares[parameter];
    multiply_into(share.matrix(), &state.generalized_shapes, &mut work.product);
    transposed_multiply_into(&state.generalized_shapes, &work.product, &mut work.change);
    work.change *= DERIVATIVE_STEP * state.factors[parameter];
    let first_order = match share {
        Share::Stiffness(_) => first_order_into,
        Share::Mass(_) => first_order_mass_into,
    };
    first_order(
        &state.modes.omega_squared,
        &work.change,
        &mut work.roots,
        &mut work.generalized_shapes,
    )?;
    let dof_count = work.shape.len() as f64;
    let (mut frequency, mut shape) = (0.0, 0.0);
    for (j, &i) in state.pairing.analysis_mode.iter().enumerate() {
        let ratio = 1.0 / (work.roots[i] * problem.test.omega_squared[j]).sqrt();
        frequency += (ratio - 1.0) * (ratio - 1.0);
        work.shape.gemv(
            1.0,
            &state.modes.shapes,
            &work.generalized_shapes.column(i),
            0.0,
        );
        shape += squared_shape_difference(
            work.shape.as_view(),
            state.pairing.sign[j],
            problem.test.shapes.column(j).as_view(),
        );
    }
    Ok(frequency.sqrt() + (shape / dof_count).sqrt())
}

/// $C = A B$ column by column: the library's whole-matrix product allocates its packing buffers.
fn multiply_into(a: &DMatrix<f64>, b: &DMatrix<f64>, c: &mut DMatrix<f64>) {
    for (mut column, right) in c.column_iter_mut().zip(b.column_iter()) {
        column.gemv(1.0, a, &right, 0.0);
    }
}

/// $C = A^t B$ column by column.
fn transposed_multiply_into(a: &DMatrix<f64>, b: &DMatrix<f64>, c: &mut DMatrix<f64>) {
    for (mut column, right) in c.column_iter_mut().zip(b.column_iter()) {
        column.gemv_tr(1.0, a, &right, 0.0);
    }
}
