//! The one factorization, of every symmetric matrix, with its inertia.
//! Tour: [chapter 7](crate::tour::chapter_07_condensation).

mod plan;

pub(in crate::sparse) use plan::FactorizationPlan;
pub use plan::Work;

use crate::method::error::Error;
use crate::method::linear_algebra::check_shape;
use crate::sparse::{SparseMatrix, finite};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_unit_lower_triangular_in_place, solve_unit_upper_triangular_in_place,
};
use faer::{Accum, MatMut, MatRef, Par};
use nalgebra::DMatrix;
use std::sync::Arc;

/// A symmetric matrix, factorized once and solved many times:
///
/// $$ A = L D L^t $$
///
/// where $L$ has a unit diagonal and $D$ holds the pivots. Of a positive definite matrix this is Cholesky's factor $L D^{1/2}$.
///
/// Rows are not exchanged, so that the pivots of an indefinite matrix may be small with large numbers below them, which take digits
/// from all that follows.
#[derive(Debug, Clone)]
pub struct Factor {
    plan: Arc<FactorizationPlan>,
    values: Vec<f64>,
    /// $D$ in the order of elimination.
    pivots: Vec<f64>,
    /// One over the root of each diagonal entry, by which rows and columns are multiplied: with it a mode keeps one or two digits more.
    scale: Vec<f64>,
}

impl Factor {
    /// Factorizes a symmetric matrix (both triangles given), which may be indefinite.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`] naming a row without entries or where a pivot vanishes; the errors of
    /// [`SparseMatrix::check_symmetric`].
    pub fn new(what: &'static str, matrix: &SparseMatrix) -> Result<Self, Error> {
        matrix.check_symmetric(what)?;
        let plan = Arc::new(FactorizationPlan::of_sum(&[matrix])?);
        Self::of_sum(&plan, what, &[(1.0, matrix)])
    }

    /// The factor of a sum of symmetric matrices, each times its number, by their plan.
    pub(super) fn of_sum(
        plan: &Arc<FactorizationPlan>,
        what: &'static str,
        terms: &[(f64, &SparseMatrix)],
    ) -> Result<Self, Error> {
        let mut entries = plan.entries_of(terms);
        let scale = plan.scale(&mut entries);
        let values = plan.factor(what, &entries)?;
        let blocks = plan.blocks(&values).map(|block| block.val());
        let pivots = blocks.flat_map(|block| (0..block.ncols()).map(move |at| block[(at, at)]));
        Ok(Self {
            pivots: pivots.collect(),
            plan: Arc::clone(plan),
            scale,
            values,
        })
    }

    /// Rows in the order in which they are eliminated.
    ///
    /// # Example
    ///
    /// ```rust
    /// use corfem::sparse::SparseMatrix;
    /// use corfem::sparse::factorization::Factor;
    /// use nalgebra::DMatrix;
    ///
    /// // Of rows that nothing couples each is eliminated once.
    /// let matrix = SparseMatrix::of_dense("matrix", &DMatrix::identity(3, 3))?;
    /// let mut order = Factor::new("matrix", &matrix)?.order().to_vec();
    /// order.sort_unstable();
    /// assert_eq!(order, [0, 1, 2]);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn order(&self) -> &[usize] {
        &self.plan.order
    }

    /// $A^{-1} R$ for every column of $R$ (rows × m): of a stiffness (lbf/in) the deflections $q_S = K_S^{-1} Q_S$ (A.2) in inches
    /// under loads in lbf.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless $R$ has a row per row of the matrix; [`Error::Value`].
    pub fn solve(&self, right: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        let (count, turn) = (right.ncols(), &self.plan.turn);
        check_shape("loads", finite("loads", right)?, turn.len(), count)?;
        let mut rows = vec![0.0; right.len()];
        for (row, &turn) in turn.iter().enumerate() {
            let own = rows[turn * count..].iter_mut();
            own.zip(&right.row(row))
                .for_each(|(own, load)| *own = load * self.scale[turn]);
        }
        if count > 0 {
            self.forward(&mut rows, count);
            self.backward(&mut rows, count);
        }
        let mut deflections = DMatrix::zeros(turn.len(), count);
        for (mut own, &turn) in deflections.row_iter_mut().zip(turn) {
            own.copy_from_slice(&rows[turn * count..][..count]);
            own *= self.scale[turn];
        }
        finite("deflections", deflections)
    }

    /// $D^{-1} L^{-1}$ times right-hand sides in place, `count` values for each DOF in the order of elimination.
    fn forward(&self, rows: &mut [f64], count: usize) {
        let mut change = Vec::new();
        for block in self.plan.blocks(&self.values) {
            let (diagonal, below) = block.val().split_at_row(block.val().ncols());
            let (start, end) = (block.start(), block.start() + diagonal.ncols());
            let (done, later) = rows.split_at_mut(end * count);
            let own = &mut done[start * count..];
            // Loads on few rows reach few blocks.
            if own.iter().all(|value| *value == 0.0) {
                continue;
            }
            let mut solved = MatMut::from_column_major_slice_mut(own, count, end - start);
            let right = solved.as_mut().transpose_mut();
            solve_unit_lower_triangular_in_place(diagonal, right, Par::Seq);
            change.resize(count * below.nrows(), 0.0);
            let into = MatMut::from_column_major_slice_mut(&mut change, count, below.nrows());
            let (solved, below) = (solved.as_ref(), below.transpose());
            matmul(into, Accum::Replace, solved, below, 1.0, Par::Seq);
            for (&row, change) in block.pattern().iter().zip(change.chunks_exact(count)) {
                let values = later[(row - end) * count..].iter_mut().zip(change);
                values.for_each(|(value, change)| *value -= change);
            }
            for (row, pivot) in own.chunks_exact_mut(count).zip(&self.pivots[start..end]) {
                row.iter_mut().for_each(|value| *value /= pivot);
            }
        }
    }

    /// $L^{-t}$ times right-hand sides in the same way.
    fn backward(&self, rows: &mut [f64], count: usize) {
        let mut solved = Vec::new();
        for block in self.plan.blocks(&self.values).rev() {
            let (diagonal, below) = block.val().split_at_row(block.val().ncols());
            let (start, end) = (block.start(), block.start() + diagonal.ncols());
            let (before, later) = rows.split_at_mut(end * count);
            let own = &mut before[start * count..];
            let mut own = MatMut::from_column_major_slice_mut(own, count, end - start);
            solved.clear();
            for &row in block.pattern() {
                solved.extend_from_slice(&later[(row - end) * count..][..count]);
            }
            let solved = MatRef::from_column_major_slice(&solved, count, below.nrows());
            matmul(own.as_mut(), Accum::Add, solved, below, -1.0, Par::Seq);
            let (upper, right) = (diagonal.transpose(), own.transpose_mut());
            solve_unit_upper_triangular_in_place(upper, right, Par::Seq);
        }
    }

    /// Refuses a matrix with a negative pivot, by the row of the first.
    pub(super) fn check_signs(self, what: &'static str) -> Result<Self, Error> {
        let negative = self
            .pivots
            .iter()
            .position(|pivot| pivot.is_sign_negative());
        match negative.map(|at| self.plan.order[at]) {
            Some(row) => Err(Error::NotPositiveDefinite { what, row }),
            None => Ok(self),
        }
    }

    /// The number of negative pivots, which is that of the matrix's negative eigenvalues (Sylvester's law of inertia).
    pub fn negative_count(&self) -> usize {
        let is_negative = |pivot: &&f64| pivot.is_sign_negative();
        self.pivots.iter().filter(is_negative).count()
    }
}
