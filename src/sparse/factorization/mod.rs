//! The one factorization, of every symmetric matrix, with its inertia.
//! Tour: [chapter 7](crate::tour::chapter_07_condensation).

mod plan;

pub(in crate::sparse) use plan::FactorizationPlan;
pub use plan::Work;

use crate::method::error::Error;
use crate::method::linear_algebra::check_shape;
use crate::sparse::SparseMatrix;
use crate::sparse::finite;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_unit_lower_triangular_in_place, solve_unit_upper_triangular_in_place,
};
use faer::{Accum, MatMut, MatRef, Par};
use nalgebra::{DMatrix, DVector};
use std::mem::take;
use std::sync::Arc;

/// A symmetric matrix, factorized once and solved many times:
///
/// $$ A = S^{-1} L D L^t S^{-1} $$
///
/// where the diagonal $S$ brings the diagonal of $A$ to one in size, $L$ has a unit diagonal and $D$ holds the pivots. Of a positive
/// definite matrix this is Cholesky's factor $L D^{1/2}$.
///
/// Rows are not exchanged, so that the pivots of an indefinite matrix may be small with large numbers below them, which take digits
/// from all that follows.
#[derive(Debug, Clone)]
pub struct Factor {
    plan: Arc<FactorizationPlan>,
    values: Vec<f64>,
    /// $S$ and $D$ in the order of elimination.
    scale: DVector<f64>,
    pivots: Vec<f64>,
}

impl Drop for Factor {
    fn drop(&mut self) {
        self.plan.keep(take(&mut self.values));
    }
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
        let (values, zero) = plan.factor(&entries)?;
        let blocks = plan.blocks(&values).map(|block| block.val());
        let pivots = blocks.flat_map(|block| (0..block.ncols()).map(move |at| block[(at, at)]));
        let pivots: Vec<f64> = pivots.collect();
        if let Some(at) = zero {
            let row = plan.order[at];
            return Err(Error::NotPositiveDefinite { what, row });
        }
        Ok(Self {
            plan: Arc::clone(plan),
            values,
            scale,
            pivots,
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
        check_shape("loads", finite("loads", right)?, self.scale.len(), count)?;
        let (mut rows, mut is_loaded) = (vec![0.0; right.len()], vec![false; right.nrows()]);
        for (row, &turn) in turn.iter().enumerate() {
            for (column, value) in rows[turn * count..][..count].iter_mut().enumerate() {
                let load = right[(row, column)];
                is_loaded[turn] |= load != 0.0;
                *value = load * self.scale[turn];
            }
        }
        self.forward(&mut rows, count, &self.reached(is_loaded));
        self.backward(&mut rows, count);
        let mut deflections = DMatrix::zeros(right.nrows(), count);
        for (row, &turn) in turn.iter().enumerate() {
            for (column, value) in rows[turn * count..][..count].iter().enumerate() {
                deflections[(row, column)] = self.scale[turn] * value;
            }
        }
        finite("deflections", deflections)
    }

    /// Rows to which loads on some of them lead in forward substitution.
    fn reached(&self, mut is_reached: Vec<bool>) -> Vec<bool> {
        for block in self.plan.blocks(&self.values) {
            let own = block.start()..block.start() + block.val().ncols();
            if is_reached[own.clone()].contains(&true) {
                is_reached[own].fill(true);
                block
                    .pattern()
                    .iter()
                    .for_each(|&row| is_reached[row] = true);
            }
        }
        is_reached
    }

    /// $L^{-1}$ times right-hand sides in place, `count` values for each DOF that is kept in the order of elimination; blocks of DOF that
    /// are not reached are left alone.
    fn forward(&self, rows: &mut [f64], count: usize, is_reached: &[bool]) {
        let mut scratch = Vec::new();
        for block in self.plan.blocks(&self.values) {
            let end = block.start() + block.val().ncols();
            if !is_reached[block.start()] {
                continue;
            }
            let (done, later) = rows.split_at_mut(end * count);
            let own = &mut done[block.start() * count..];
            let mut own = MatMut::from_column_major_slice_mut(own, count, block.val().ncols());
            let (diagonal, below) = block.val().split_at_row(block.val().ncols());
            solve_unit_lower_triangular_in_place(diagonal, own.as_mut().transpose_mut(), Par::Seq);
            scratch.resize(count * below.nrows(), 0.0);
            let mut change =
                MatMut::from_column_major_slice_mut(&mut scratch, count, below.nrows());
            matmul(
                change.as_mut(),
                Accum::Replace,
                own.as_ref(),
                below.transpose(),
                1.0,
                Par::Seq,
            );
            for (&row, change) in block
                .pattern()
                .iter()
                .zip(scratch.chunks_exact(count.max(1)))
            {
                let values = later[(row - end) * count..].iter_mut().zip(change);
                values.for_each(|(value, change)| *value -= change);
            }
        }
    }

    /// $L^{-t} D^{-1}$ times right-hand sides in the same way.
    fn backward(&self, rows: &mut [f64], count: usize) {
        for (row, pivot) in rows.chunks_exact_mut(count.max(1)).zip(&self.pivots) {
            row.iter_mut().for_each(|value| *value /= pivot);
        }
        let mut scratch = Vec::new();
        for block in self.plan.blocks(&self.values).rev() {
            let end = block.start() + block.val().ncols();
            let (before, later) = rows.split_at_mut(end * count);
            let own = &mut before[block.start() * count..];
            let mut own = MatMut::from_column_major_slice_mut(own, count, block.val().ncols());
            let (diagonal, below) = block.val().split_at_row(block.val().ncols());
            scratch.clear();
            block
                .pattern()
                .iter()
                .for_each(|&row| scratch.extend_from_slice(&later[(row - end) * count..][..count]));
            let solved = MatRef::from_column_major_slice(&scratch, count, below.nrows());
            matmul(own.as_mut(), Accum::Add, solved, below, -1.0, Par::Seq);
            solve_unit_upper_triangular_in_place(
                diagonal.transpose(),
                own.transpose_mut(),
                Par::Seq,
            );
        }
    }

    /// Refuses a matrix with a negative pivot.
    pub(super) fn check_signs(self, what: &'static str) -> Result<Self, Error> {
        match self.negative_count() {
            0 => Ok(self),
            _ => Err(self.not_positive(what)),
        }
    }

    /// The number of negative pivots, which is that of the matrix's negative eigenvalues (Sylvester's law of inertia).
    pub fn negative_count(&self) -> usize {
        let is_negative = |pivot: &&f64| pivot.is_sign_negative();
        self.pivots.iter().filter(is_negative).count()
    }

    /// A motion of negative energy: $S L^{-t} e_p$, whose energy is the most negative pivot p.
    pub(super) fn negative_motion(&self) -> Option<DVector<f64>> {
        let pivots = self.pivots.iter().enumerate();
        let (at, &pivot) = pivots
            .min_by(|a, b| a.1.total_cmp(b.1))
            .filter(|(_, pivot)| **pivot < 0.0)?;
        let mut rows = vec![0.0; self.pivots.len()];
        rows[at] = pivot;
        self.backward(&mut rows, 1);
        let turn = &self.plan.turn;
        Some(DVector::from_fn(rows.len(), |row, _| {
            self.scale[turn[row]] * rows[turn[row]]
        }))
    }

    /// The error that names the row of the smallest pivot.
    fn not_positive(&self, what: &'static str) -> Error {
        let rows = self.pivots.iter().zip(&self.plan.order);
        let smallest = rows.min_by(|a, b| a.0.total_cmp(b.0));
        Error::NotPositiveDefinite {
            what,
            row: smallest.map_or(0, |(_, &dof)| dof),
        }
    }
}
