//! Derivatives of the error sum (12): a 0.1 % change of each parameter by first-order perturbation.
//!
//! A derivative is some two thousand multiplications, the same ones for every parameter. They are carried out for a
//! block of parameters side by side, so that the processor's vector unit is always full; the result of a parameter does
//! not depend on which others are beside it, nor on the width of the vector unit.

mod block;
mod lanes;

use crate::method::error::Error;
use crate::method::linear_algebra::check_length;
use crate::method::modal::{ModalProblem, ModalState};
use block::{Block, larger};
use lanes::{Lanes, ZERO, combinations_into, lanes};
use nalgebra::DMatrix;

/// Relative change of a parameter's stiffness for a derivative.
pub const DERIVATIVE_STEP: f64 = 0.001;

/// Separation of two roots, relative to the larger $\omega^2$, below which a derivative holds their modes to their own
/// shapes.
///
/// A step of [`DERIVATIVE_STEP`] couples two modes so close by up to a tenth and more, which is no longer first order; where
/// the roots meet the shapes have no derivative at all, and those of the roots are what is left.
pub const HELD_SEPARATION: f64 = 10.0 * DERIVATIVE_STEP;

/// What a small change of each parameter does.
#[derive(Debug, Clone, PartialEq)]
pub struct Derivatives {
    /// Change of the error sum, $\Delta e_e = e_f + e_v - e_S$, for $\Delta K = 0.001 c_e K_e$ or $\Delta M = 0.001 c_e M_e$.
    pub error_change: Vec<f64>,
    /// The same change's relative generalized stiffness or mass on the test modes, one column per parameter
    /// (test modes × parameters).
    pub share_change: DMatrix<f64>,
}

/// $\Delta e$ and $\Delta k$ of (12) for every parameter at the present state.
///
/// For each, $\beta = 0.001 c_e V^t K_e V$ (or $\alpha$ with $M_e$) with the present modes $V$; roots and shapes follow by first order
/// (C.20, C.21), modes closer than [`HELD_SEPARATION`] held to their own shapes, and the error sum is taken anew with the
/// present pairing. The loop allocates nothing.
///
/// # Errors
/// [`Error::LostRoot`] when a change takes a root's sign.
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

/// What the derivatives of a problem need at every state, and storage for one block of parameters.
#[derive(Debug, Clone)]
pub struct Workspace {
    /// The parameters.
    blocks: Vec<Block>,
    /// Test shapes of unit largest component (d × g).
    test_shapes: DMatrix<f64>,
    /// Present shapes, transposed: a DOF's components in all modes stand together (n × d).
    components: DMatrix<f64>,
    /// One term of the shares (n).
    vector: Vec<Lanes>,
    /// Generalized change (n × n).
    change: Vec<Lanes>,
    /// Changed $\omega^2$, or $1/\omega^2$ for a mass (n).
    x: Vec<Lanes>,
    /// Generalized shapes (n × n).
    generalized_shapes: Vec<Lanes>,
    /// One changed shape (d).
    shape: Vec<Lanes>,
}

impl Workspace {
    /// Prepares the derivatives of a problem.
    pub fn new(problem: &ModalProblem) -> Self {
        let (dof_count, count) = problem.start.shapes.shape();
        let mut test_shapes = problem.test.shapes.clone();
        for mut shape in test_shapes.column_iter_mut() {
            let largest = shape.amax();
            shape /= largest;
        }
        Self {
            blocks: Block::all(problem),
            test_shapes,
            components: DMatrix::zeros(count, dof_count),
            vector: vec![ZERO; count],
            change: vec![ZERO; count * count],
            x: vec![ZERO; count],
            generalized_shapes: vec![ZERO; count * count],
            shape: vec![ZERO; dof_count],
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
    pulp::Arch::new().dispatch(OverBlocks {
        problem,
        state,
        workspace,
        error_change,
    })
}

/// The loop over the blocks, compiled once for each kind of vector unit; `pulp` runs the one that this processor has.
struct OverBlocks<'a> {
    problem: &'a ModalProblem,
    state: &'a ModalState,
    workspace: &'a mut Workspace,
    error_change: &'a mut [f64],
}

impl pulp::NullaryFnOnce for OverBlocks<'_> {
    type Output = Result<(), Error>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        blocks_into(self.problem, self.state, self.workspace, self.error_change)
    }
}

#[inline(always)]
fn blocks_into(
    problem: &ModalProblem,
    state: &ModalState,
    work: &mut Workspace,
    error_change: &mut [f64],
) -> Result<(), Error> {
    state.modes.shapes.transpose_to(&mut work.components);
    let k = &state.modes.omega_squared;
    for block in &work.blocks {
        let mut relative_change = ZERO;
        for (lane, &e) in block.parameters.iter().enumerate() {
            relative_change[lane] = DERIVATIVE_STEP * state.factors[e];
        }
        block.change_into(
            &state.generalized_shapes,
            &relative_change,
            &mut work.vector,
            &mut work.change,
        );
        block.first_order_into(k, &work.change, &mut work.x, &mut work.generalized_shapes)?;
        let (mut frequency, mut shape) = (ZERO, ZERO);
        for (j, &i) in state.pairing.analysis_mode.iter().enumerate() {
            let (x, test) = (&work.x[i], problem.test.omega_squared[j]);
            let own = lanes(|l| if block.is_mass { 1.0 / x[l] } else { x[l] });
            let count = work.x.len();
            combinations_into(
                work.components.as_slice(),
                &work.generalized_shapes[i * count..][..count],
                &mut work.shape,
            );
            let difference = shape_difference(
                &work.shape,
                state.pairing.sign[j],
                &work.test_shapes.as_slice()[j * work.shape.len()..][..work.shape.len()],
            );
            frequency = lanes(|l| frequency[l] + ((own[l] / test).sqrt() - 1.0).powi(2));
            shape = lanes(|l| shape[l] + difference[l]);
        }
        let dof_count = work.shape.len() as f64;
        let sum = lanes(|l| frequency[l].sqrt() + (shape[l] / dof_count).sqrt());
        for (lane, &e) in block.parameters.iter().enumerate() {
            error_change[e] = sum[lane] - state.errors.sum();
        }
    }
    Ok(())
}

/// $\sum_r (\pm v_r/|v|_\infty - w_r)^2$ in every lane, for a test shape $w$ of unit largest component.
#[inline(always)]
fn shape_difference(shape: &[Lanes], sign: f64, test_shape: &[f64]) -> Lanes {
    let mut largest = ZERO;
    for component in shape {
        largest = lanes(|l| larger(component[l].abs(), largest[l]));
    }
    let to_unit = lanes(|l| sign / largest[l]);
    let mut sum = ZERO;
    for (component, test) in shape.iter().zip(test_shape) {
        sum = lanes(|l| sum[l] + (component[l] * to_unit[l] - test).powi(2));
    }
    sum
}
