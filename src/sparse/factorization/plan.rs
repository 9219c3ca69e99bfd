//! The plan of a factorization: everything that does not change with the sizes.

use crate::method::error::Error;
use crate::sparse::SparseMatrix;
use crate::sparse::ordering::nested_dissection;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::{SupernodalLdltRef, SupernodeRef};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Par, Side, Spec};
use nalgebra::DVector;
use serde::Serialize;
use std::mem::take;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Parts of a factorization that do not change with the sizes: the order in which the DOF are eliminated, and the places where the
/// stiffness and its factor have entries.
#[derive(Debug)]
pub struct FactorizationPlan {
    /// The DOF in the order of elimination.
    pub order: Vec<usize>,
    /// Turn of each DOF in the elimination; everything below counts the DOF in that order.
    pub(super) turn: Vec<usize>,
    /// The lower triangle, column by column; the first entry of a column is the diagonal.
    pattern: SymbolicSparseColMat<usize>,
    symbolic: SymbolicCholesky<usize>,
    /// Memory of the last factor that is no longer needed: new memory costs a large factorization an eighth of its time.
    spare: Mutex<Vec<f64>>,
    /// Factorizations and eigensolutions made so far.
    factorizations: AtomicUsize,
    eigensolutions: AtomicUsize,
}

/// Work that analyses of a structure have taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Work {
    /// Orders of elimination found.
    pub orderings: usize,
    /// Numerical factorizations, those that count modes among them.
    pub factorizations: usize,
    /// Searches for modes.
    pub eigensolutions: usize,
}

impl FactorizationPlan {
    /// The plan for sums of symmetric matrices of one size. Neighbors coupled to the same rows, as those of one grid are, are one point
    /// of the mesh.
    ///
    /// # Errors
    /// [`Error::Failed`] when there is no memory for it.
    pub(in crate::sparse) fn of_sum(matrices: &[&SparseMatrix]) -> Result<Self, Error> {
        let count = matrices[0].rows();
        let column = |row: usize| {
            let coupled = matrices.iter().flat_map(|matrix| matrix.column(row));
            let mut rows: Vec<usize> = coupled.map(|entry| entry.0).chain([row]).collect();
            rows.sort_unstable();
            rows.dedup();
            rows
        };
        let columns: Vec<Vec<usize>> = (0..count).map(column).collect();
        let order = order_of(&columns);
        let mut turn = vec![0; count];
        order
            .iter()
            .enumerate()
            .for_each(|(place, &dof)| turn[dof] = place);
        let (mut column_starts, mut rows) = (vec![0], Vec::new());
        for (column, &dof) in order.iter().enumerate() {
            rows.extend(
                columns[dof]
                    .iter()
                    .map(|&row| turn[row])
                    .filter(|&row| row >= column),
            );
            rows[column_starts[column]..].sort_unstable();
            column_starts.push(rows.len());
        }
        let pattern = SymbolicSparseColMat::new_checked(count, count, column_starts, None, rows);
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let failed = |_| Error::no_convergence("sparse assembly");
        // In the order given the library reads the upper triangle here, and the lower one when it factorizes.
        let upper = pattern
            .as_ref()
            .transpose()
            .to_col_major()
            .map_err(failed)?;
        let symbolic = factorize_symbolic_cholesky(
            upper.as_ref(),
            Side::Upper,
            SymmetricOrdering::Identity,
            parameters,
        );
        let symbolic = symbolic.map_err(failed)?;
        Ok(Self {
            order,
            turn,
            pattern,
            symbolic,
            spare: Mutex::default(),
            factorizations: AtomicUsize::new(0),
            eigensolutions: AtomicUsize::new(0),
        })
    }

    /// Counts a search for modes.
    pub(in crate::sparse) fn count_eigensolution(&self) {
        self.eigensolutions.fetch_add(1, Relaxed);
    }

    /// Work done by this plan.
    pub(in crate::sparse) fn work(&self) -> Work {
        Work {
            orderings: 1,
            factorizations: self.factorizations.load(Relaxed),
            eigensolutions: self.eigensolutions.load(Relaxed),
        }
    }

    /// The factor of given values by blocks of columns with the same rows, which the plan always asks for.
    pub(super) fn blocks<'a>(
        &'a self,
        values: &'a [f64],
    ) -> impl DoubleEndedIterator<Item = SupernodeRef<'a, usize, f64>> {
        let factor = match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(symbolic) => {
                Some(SupernodalLdltRef::new(symbolic, values))
            }
            SymbolicCholeskyRaw::Simplicial(_) => None,
        };
        factor.into_iter().flat_map(|factor| {
            (0..factor.symbolic().n_supernodes()).map(move |at| factor.supernode(at))
        })
    }

    /// The lower triangle's entries of a sum of symmetric matrices, each times its number, for which the plan was made.
    pub(super) fn entries_of(&self, terms: &[(f64, &SparseMatrix)]) -> Vec<f64> {
        let mut values = vec![0.0; self.pattern.row_idx().len()];
        // Places of the rows that the present column has.
        let mut places = vec![0; self.turn.len()];
        for (number, matrix) in terms {
            let mut last = usize::MAX;
            for (row, column, value) in matrix.entries() {
                let (row, own) = (self.turn[row], self.turn[column]);
                if last != own {
                    let (rows, range) = self.column(own);
                    rows.iter()
                        .zip(range)
                        .for_each(|(&row, place)| places[row] = place);
                    last = own;
                }
                if row >= own {
                    values[places[row]] += number * value;
                }
            }
        }
        values
    }

    /// The rows of a column's entries and the range of their places.
    fn column(&self, column: usize) -> (&[usize], Range<usize>) {
        let range = self.pattern.col_ptr()[column]..self.pattern.col_ptr()[column + 1];
        (&self.pattern.row_idx()[range.clone()], range)
    }

    /// Scales entries so that those of the diagonal become one in size, and returns the scale.
    pub(super) fn scale(&self, entries: &mut [f64]) -> DVector<f64> {
        let size = |column: usize| match entries[self.pattern.col_ptr()[column]] {
            0.0 => 1.0,
            entry => 1.0 / entry.abs().sqrt(),
        };
        let scale = DVector::from_fn(self.order.len(), |column, _| size(column));
        for column in 0..scale.len() {
            let (rows, range) = self.column(column);
            rows.iter()
                .zip(&mut entries[range])
                .for_each(|(&row, entry)| *entry *= scale[row] * scale[column]);
        }
        scale
    }

    /// Keeps the memory of a factor for the next.
    pub(super) fn keep(&self, values: Vec<f64>) {
        if let Ok(mut spare) = self.spare.lock() {
            *spare = values;
        }
    }

    /// $L$ and $D$ of given entries, and where a pivot is zero, in one thread whatever the library's global setting: its parallel kernels
    /// have open reports of wrong results on large matrices.
    pub(super) fn factor(&self, entries: &[f64]) -> Result<(Vec<f64>, Option<usize>), Error> {
        self.factorizations.fetch_add(1, Relaxed);
        let (symbolic, one) = (&self.symbolic, Par::Seq);
        let mut values = self
            .spare
            .lock()
            .map_or_else(|_| Vec::new(), |mut spare| take(&mut *spare));
        values.resize(symbolic.len_val(), 0.0);
        let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(one, Spec::default());
        let mut memory = MemBuffer::try_new(scratch)
            .map_err(|_| Error::no_convergence("sparse factorization"))?;
        let done = symbolic.factorize_numeric_ldlt(
            &mut values,
            SparseColMatRef::new(self.pattern.as_ref(), entries),
            Side::Lower,
            LdltRegularization::default(),
            one,
            MemStack::new(&mut memory),
            Spec::default(),
        );
        let zero = done.err().map(|LdltError::ZeroPivot { index }| index);
        Ok((values, zero))
    }
}

/// Order of elimination of rows that are coupled to those in their columns. Neighbors coupled to the same rows, as those of one grid
/// are, are one point of the mesh.
fn order_of(columns: &[Vec<usize>]) -> Vec<usize> {
    let points: Vec<&[Vec<usize>]> = columns.chunk_by(|a, b| a == b).collect();
    let point_of: Vec<usize> = points
        .iter()
        .enumerate()
        .flat_map(|(point, of)| vec![point; of.len()])
        .collect();
    let first_row = |point: usize| point_of.partition_point(|&other| other < point);
    let near = |of: &&[Vec<usize>]| {
        let mut near: Vec<usize> = of[0].iter().map(|&row| point_of[row]).collect();
        near.dedup();
        near
    };
    let order = nested_dissection(&points.iter().map(near).collect::<Vec<_>>());
    order
        .into_iter()
        .flat_map(|point| first_row(point)..first_row(point + 1))
        .collect()
}
