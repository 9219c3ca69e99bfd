//! A sparse symmetric factorization by the method's own plan, that also counts.

use super::SparseMatrix;
use crate::method::error::Error;
use crate::method::linear_algebra::{check_length, check_shape};
use crate::sparse::factorization::FactorizationPlan;
use crate::sparse::{check_solution, start_vector};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::supernodal::SupernodalLdltRef;
use faer::sparse::linalg::cholesky::{LdltRef, SymbolicCholeskyRaw};
use faer::{Conj, MatMut, Par};
use nalgebra::{DMatrix, DVector, Vector3};
use std::sync::Arc;

/// $A = S^{-1} L D L^t S^{-1}$ of a symmetric matrix, where the diagonal $S$ brings its largest entries to one.
#[derive(Debug)]
pub struct Factor {
    plan: Arc<FactorizationPlan>,
    values: Vec<f64>,
    /// This and the pivots of $D$ in the order of elimination.
    scale: DVector<f64>,
    pivots: Vec<f64>,
}

impl Factor {
    /// Factorizes a symmetric matrix (both triangles given), which may be indefinite.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless it is square; [`Error::NotPositiveDefinite`] naming a row without entries or where a pivot
    /// vanishes; [`Error::WrongSolution`] when the factor does not solve its own matrix.
    pub fn new(what: &'static str, matrix: &SparseMatrix) -> Result<Self, Error> {
        check_length(what, matrix.columns(), matrix.rows())?;
        Self::planned(&Self::plan(&[matrix])?, what, &[(1.0, matrix)])
    }

    /// The plan for sums of square matrices of one size.
    pub(super) fn plan(matrices: &[&SparseMatrix]) -> Result<Arc<FactorizationPlan>, Error> {
        let count = matrices
            .iter()
            .map(|matrix| matrix.rows())
            .max()
            .unwrap_or(0);
        let coupled = |row: usize| {
            matrices
                .iter()
                .flat_map(|matrix| matrix.column(row))
                .map(|entry| entry.0)
                .collect()
        };
        Ok(Arc::new(FactorizationPlan::of_matrices(
            count,
            coupled,
            |_| Vector3::zeros(),
        )?))
    }

    /// As [`Self::new`] of a sum of matrices, each times its number, by their plan.
    pub(super) fn planned(
        plan: &Arc<FactorizationPlan>,
        what: &'static str,
        terms: &[(f64, &SparseMatrix)],
    ) -> Result<Self, Error> {
        let failed = || Error::NoConvergence("sparse factorization");
        let sum = terms
            .iter()
            .flat_map(|(number, matrix)| matrix.times_number(*number));
        let mut entries = plan.entries_of(sum).ok_or_else(failed)?;
        // A positive definite matrix then has a unit diagonal.
        let scale = plan.scale(
            &mut entries,
            |entry| if entry == 0.0 { 1.0 } else { entry.abs() },
        );
        let (values, is_done) = plan.factor(&entries, false)?;
        let SymbolicCholeskyRaw::Supernodal(supernodal) = plan.symbolic.raw() else {
            return Err(failed());
        };
        let factor = SupernodalLdltRef::new(supernodal, &values);
        let blocks = (0..supernodal.n_supernodes()).map(|node| factor.supernode(node).val());
        let pivots: Vec<f64> = blocks
            .flat_map(|block| (0..block.ncols()).map(move |column| block[(column, column)]))
            .collect();
        if let Some(at) = pivots
            .iter()
            .position(|pivot| !pivot.is_finite() || *pivot == 0.0)
        {
            return Err(Error::NotPositiveDefinite {
                what,
                dof: plan.order[at],
            });
        }
        is_done.then_some(()).ok_or_else(failed)?;
        let factor = Self {
            plan: Arc::clone(plan),
            values,
            scale,
            pivots,
        };
        let solved = |right: &DVector<f64>| {
            let column = DMatrix::from_column_slice(right.len(), 1, right.as_slice());
            factor.solved(column).column(0).into_owned()
        };
        check_solution(
            what,
            |x| plan.times(&entries, x),
            solved,
            &start_vector(factor.scale.len()),
        )?;
        Ok(factor)
    }

    /// Solutions of the scaled problem, in the order of elimination.
    fn solved(&self, mut columns: DMatrix<f64>) -> DMatrix<f64> {
        let (symbolic, count) = (&self.plan.symbolic, columns.ncols());
        let mut memory = MemBuffer::new(symbolic.solve_in_place_scratch::<f64>(count, Par::Seq));
        let view =
            MatMut::from_column_major_slice_mut(columns.as_mut_slice(), self.scale.len(), count);
        let factor = LdltRef::new(symbolic, &self.values);
        factor.solve_in_place_with_conj(Conj::No, view, Par::Seq, MemStack::new(&mut memory));
        columns
    }

    /// $A^{-1} R$ for every column of $R$ (rows × m).
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless it has a row per row of the matrix.
    pub fn solve(&self, right: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        let (count, columns, FactorizationPlan { order, turn, .. }) =
            (self.scale.len(), right.ncols(), &*self.plan);
        check_shape("right-hand sides", right, count, columns)?;
        let solved = self.solved(DMatrix::from_fn(count, columns, |at, column| {
            self.scale[at] * right[(order[at], column)]
        }));
        let at = |row: usize, column: usize| self.scale[turn[row]] * solved[(turn[row], column)];
        Ok(DMatrix::from_fn(count, columns, at))
    }

    /// The number of negative pivots, which is that of the matrix's negative eigenvalues (Sylvester's law of inertia).
    pub fn negative_count(&self) -> usize {
        self.pivots.iter().filter(|pivot| **pivot < 0.0).count()
    }

    /// Refuses a matrix that is not positive definite beyond round-off.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`] naming the row of the smallest pivot.
    pub fn check_positive(self, what: &'static str) -> Result<Self, Error> {
        let round_off = 32.0 * f64::EPSILON * (self.pivots.len() as f64).sqrt();
        let (pivot, dof) = self.smallest_pivot();
        if pivot > round_off {
            Ok(self)
        } else {
            Err(Error::NotPositiveDefinite { what, dof })
        }
    }

    /// The smallest pivot of the matrix scaled to unit diagonal, and the row of the matrix that it belongs to.
    pub fn smallest_pivot(&self) -> (f64, usize) {
        let pivots = self
            .pivots
            .iter()
            .copied()
            .zip(self.plan.order.iter().copied());
        pivots
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((0.0, 0))
    }
}
