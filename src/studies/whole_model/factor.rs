//! A sparse symmetric factorization, in one thread whatever the library's global setting, that also counts.

use super::SparseMatrix;
use crate::method::error::Error;
use crate::method::linear_algebra::{check_length, check_shape, check_solution, from_faer, start_vector, to_faer};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::supernodal::SupernodalLdltRef;
use faer::sparse::linalg::cholesky::{
    LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, Par, Side, Spec};
use nalgebra::{DMatrix, DVector};

/// $A = S^{-1} L D L^t S^{-1}$ of a symmetric matrix, where the diagonal $S$ brings its largest entries to one.
#[derive(Debug)]
pub struct Factor {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    scale: DVector<f64>,
    /// Every pivot of $D$ and the row it belongs to.
    pivots: Vec<(f64, usize)>,
}

impl Factor {
    /// Factorizes a symmetric matrix (both triangles given), which may be indefinite.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless it is square; [`Error::NotPositiveDefinite`] naming a row without entries or where a pivot
    /// vanishes; [`Error::WrongSolution`] when the factor does not solve its own matrix.
    pub fn new(what: &'static str, matrix: &SparseMatrix) -> Result<Self, Error> {
        let count = matrix.rows();
        check_length(what, matrix.columns(), count)?;
        let mut largest = DVector::<f64>::zeros(count);
        for &(row, _, value) in matrix.entries() {
            largest[row] = largest[row].max(value.abs());
        }
        // Of the diagonal where there is one: a positive definite matrix then has a unit diagonal.
        matrix.entries().iter().filter(|entry| entry.0 == entry.1).for_each(|entry| largest[entry.0] = entry.2.abs());
        if let Some(dof) = largest.iter().position(|&entry| entry == 0.0) {
            return Err(Error::NotPositiveDefinite { what, dof });
        }
        let scale = largest.map(|entry| 1.0 / entry.sqrt());
        let lower = matrix.entries().iter().filter(|(row, column, _)| row >= column);
        let scaled = lower.map(|&(row, column, value)| Triplet::new(row, column, value * scale[row] * scale[column]));
        let failed = || Error::NoConvergence("sparse factorization");
        let scaled = SparseColMat::try_new_from_triplets(count, count, &scaled.collect::<Vec<_>>());
        let scaled = scaled.map_err(|_| failed())?;
        let amd = SymmetricOrdering::Amd;
        let symbolic = factorize_symbolic_cholesky(scaled.symbolic(), Side::Lower, amd, Default::default());
        let symbolic = symbolic.map_err(|_| failed())?;
        let mut values = vec![0.0; symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| failed())?;
        let (none, stack) = (Default::default(), MemStack::new(&mut memory));
        let (side, spec) = (Side::Lower, Spec::default());
        let done = symbolic.factorize_numeric_ldlt(&mut values, scaled.as_ref(), side, none, Par::Seq, stack, spec);
        let is_done = done.is_ok();
        let pivots = pivots(&symbolic, &values);
        let vanished = |pivot: &&(f64, usize)| !(pivot.0.is_finite() && pivot.0 != 0.0);
        if let Some(&(_, dof)) = pivots.iter().find(vanished) {
            return Err(Error::NotPositiveDefinite { what, dof });
        }
        if !is_done {
            return Err(failed());
        }
        let factor = Self { symbolic, values, scale, pivots };
        let column = |x: &DVector<f64>| DMatrix::from_column_slice(count, 1, x.as_slice());
        let scaled_column = |x: DMatrix<f64>, by: &DVector<f64>| x.column(0).component_mul(by);
        let unscale = factor.scale.map(f64::recip);
        let times = |x: &DVector<f64>| {
            let product = matrix.times(&column(&x.component_mul(&factor.scale)));
            product.map_or_else(|_| DVector::from_element(count, f64::NAN), |p| scaled_column(p, &factor.scale))
        };
        let solved = |x: &DVector<f64>| {
            let right = column(&x.component_mul(&unscale));
            let solution = factor.solve(&right);
            solution.map_or_else(|_| DVector::from_element(count, f64::NAN), |s| scaled_column(s, &unscale))
        };
        check_solution(what, times, solved, &start_vector(count))?;
        Ok(factor)
    }

    /// $A^{-1} R$ for every column of $R$ (rows × m).
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless it has a row per row of the matrix.
    pub fn solve(&self, right: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        check_shape("right-hand sides", right, self.scale.len(), right.ncols())?;
        let scaled = |mut matrix: DMatrix<f64>| {
            matrix.column_iter_mut().for_each(|mut column| column.component_mul_assign(&self.scale));
            matrix
        };
        let mut columns = to_faer(&scaled(right.clone()));
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(columns.ncols(), Par::Seq);
        let (factor, mut memory) = (LdltRef::new(&self.symbolic, &self.values), MemBuffer::new(scratch));
        factor.solve_in_place_with_conj(Conj::No, columns.as_mut(), Par::Seq, MemStack::new(&mut memory));
        Ok(scaled(from_faer(columns.as_ref())))
    }

    /// The number of negative pivots, which is that of the matrix's negative eigenvalues (Sylvester's law of inertia).
    pub fn negative_count(&self) -> usize {
        self.pivots.iter().filter(|(pivot, _)| *pivot < 0.0).count()
    }

    /// Refuses a matrix that is not positive definite beyond round-off.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`] naming the row of the smallest pivot.
    pub fn check_positive(self, what: &'static str) -> Result<Self, Error> {
        let round_off = 32.0 * f64::EPSILON * (self.pivots.len() as f64).sqrt();
        let (pivot, dof) = self.smallest_pivot();
        if pivot > round_off { Ok(self) } else { Err(Error::NotPositiveDefinite { what, dof }) }
    }

    /// The smallest pivot of the matrix scaled to unit diagonal, and the row of the matrix that it belongs to.
    pub fn smallest_pivot(&self) -> (f64, usize) {
        let smallest = self.pivots.iter().min_by(|a, b| a.0.total_cmp(&b.0));
        smallest.copied().unwrap_or((0.0, 0))
    }
}

/// The pivots of a factorization and the rows of the matrix they belong to.
fn pivots(symbolic: &SymbolicCholesky<usize>, values: &[f64]) -> Vec<(f64, usize)> {
    let mut pivots = Vec::with_capacity(symbolic.nrows());
    match symbolic.raw() {
        SymbolicCholeskyRaw::Simplicial(simplicial) => {
            pivots.extend(simplicial.col_ptr()[..simplicial.ncols()].iter().map(|&first| values[first]));
        }
        SymbolicCholeskyRaw::Supernodal(supernodal) => {
            let factor = SupernodalLdltRef::new(supernodal, values);
            for node in 0..supernodal.n_supernodes() {
                let columns = factor.supernode(node).val();
                pivots.extend((0..columns.ncols()).map(|column| columns[(column, column)]));
            }
        }
    }
    let order = symbolic.perm().map(|order| order.arrays().0.to_vec());
    let row = |place: usize| order.as_ref().map_or(place, |order| order[place]);
    pivots.into_iter().enumerate().map(|(place, pivot)| (pivot, row(place))).collect()
}
