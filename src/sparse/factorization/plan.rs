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
use serde::Serialize;
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
        for (place, &dof) in order.iter().enumerate() {
            turn[dof] = place;
        }
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for (column, &dof) in order.iter().enumerate() {
            let own = columns[dof].iter().map(|&row| turn[row]);
            rows.extend(own.filter(|&row| row >= column));
            rows[starts[column]..].sort_unstable();
            starts.push(rows.len());
        }
        let pattern = SymbolicSparseColMat::new_checked(count, count, starts, None, rows);
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
                    for place in self.pattern.col_range(own) {
                        places[self.pattern.row_idx()[place]] = place;
                    }
                    last = own;
                }
                if row >= own {
                    values[places[row]] += number * value;
                }
            }
        }
        values
    }

    /// Multiplies rows and columns of entries so that the diagonal is of ones, by numbers that it returns.
    pub(super) fn scale(&self, entries: &mut [f64]) -> Vec<f64> {
        let size = |column: usize| match entries[self.pattern.col_ptr()[column]] {
            0.0 => 1.0,
            entry => entry.abs().sqrt().recip(),
        };
        let scale: Vec<f64> = (0..self.order.len()).map(size).collect();
        for (column, own) in scale.iter().enumerate() {
            for place in self.pattern.col_range(column) {
                entries[place] *= own * scale[self.pattern.row_idx()[place]];
            }
        }
        scale
    }

    /// $L$ and $D$ of given entries, in one thread whatever the library's global setting: its parallel kernels have open reports of wrong
    /// results on large matrices.
    pub(super) fn factor(&self, what: &'static str, entries: &[f64]) -> Result<Vec<f64>, Error> {
        self.factorizations.fetch_add(1, Relaxed);
        let symbolic = &self.symbolic;
        let mut values = vec![0.0; symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Spec::default());
        let done = symbolic.factorize_numeric_ldlt(
            &mut values,
            SparseColMatRef::new(self.pattern.as_ref(), entries),
            Side::Lower,
            LdltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
            Spec::default(),
        );
        let refused = |LdltError::ZeroPivot { index }| Error::NotPositiveDefinite {
            what,
            row: self.order[index],
        };
        done.map_err(refused)?;
        Ok(values)
    }
}

/// Order of elimination of rows that are coupled to those in their columns. Neighbors coupled to the same rows, as those of one grid
/// are, are one point of the mesh.
fn order_of(columns: &[Vec<usize>]) -> Vec<usize> {
    let is_new = |row: &usize| *row == 0 || columns[*row] != columns[row - 1];
    let mut first: Vec<usize> = (0..columns.len()).filter(is_new).collect();
    first.push(columns.len());
    let near = |own: &[usize]| {
        let point = |row: &usize| first.partition_point(|first| first <= row) - 1;
        let mut near: Vec<usize> = columns[own[0]].iter().map(point).collect();
        near.dedup();
        near
    };
    let points: Vec<Vec<usize>> = first.windows(2).map(near).collect();
    let order = nested_dissection(&points).into_iter();
    order
        .flat_map(|point| first[point]..first[point + 1])
        .collect()
}
