//! The plan of a factorization: what does not change with the sizes.

use crate::method::assembly::{ElementMatrix, check_elements};
use crate::method::error::Error;
use crate::method::ordering::Mesh;
use crate::method::structure::{StructuralDof, Structure};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Par, Side, Spec};
use nalgebra::{DVector, Vector3};
use std::collections::HashMap;
use std::ops::Range;

/// What does not change with the sizes: in which order the DOF are eliminated, where the stiffness has entries, and where its
/// factor then has them.
#[derive(Debug)]
pub struct FactorizationPlan {
    /// When each DOF is eliminated; everything below counts the DOF in that order.
    pub(super) turn: Vec<usize>,
    /// The lower triangle, column by column; the first entry of a column is the diagonal.
    pub(super) pattern: SymbolicSparseColMat<usize>,
    /// Place among the entries of every entry of every element's own lower triangle.
    places: Vec<u32>,
    pub(super) symbolic: SymbolicCholesky<usize>,
    /// Of the DOF that the elements had.
    pub(super) fingerprint: u64,
}

/// A number that other DOF do not have, by the Fowler–Noll–Vo hash.
pub(super) fn fingerprint(elements: &[ElementMatrix]) -> u64 {
    let (offset, prime) = (0xcbf2_9ce4_8422_2325_u64, 0x0100_0000_01b3);
    let all = elements.iter().flat_map(|element| element.dof.iter().copied().chain([usize::MAX]));
    all.fold(offset, |hash, dof| (hash ^ dof as u64).wrapping_mul(prime))
}

impl FactorizationPlan {
    /// The plan for a structure's elements: nested dissection by its grids' positions.
    ///
    /// # Errors
    /// Those of [`super::FactorizedStiffness::new`] for elements that do not fit the DOF; [`Error::TooMany`] for more entries than are
    /// counted here; [`Error::NoConvergence`] when there is no memory for it.
    #[doc = include_str!("../../../paper/examples/factorization/plan_new.md")]
    pub fn new(structure: &Structure, elements: &[ElementMatrix]) -> Result<Self, Error> {
        let position: HashMap<usize, Vector3<f64>> =
            structure.grids().iter().map(|grid| (grid.label, grid.position)).collect();
        Self::of(elements, structure.free_dof(), |grid| position.get(&grid).copied())
    }

    /// The same with positions where they are known.
    pub(super) fn of(
        elements: &[ElementMatrix],
        free: &[StructuralDof],
        position: impl Fn(usize) -> Option<Vector3<f64>>,
    ) -> Result<Self, Error> {
        check_elements(elements, &vec![1.0; elements.len()], free.len())?;
        let count = free.len();
        let dof_of: Vec<&[StructuralDof]> = free.chunk_by(|a, b| a.grid == b.grid).collect();
        let points: Vec<_> = dof_of.iter().map(|dof| position(dof[0].grid).unwrap_or_default()).collect();
        let point_of: Vec<usize> = dof_of.iter().enumerate().flat_map(|(point, dof)| vec![point; dof.len()]).collect();
        let points_of: Vec<Vec<usize>> =
            elements.iter().map(|element| element.dof.iter().map(|&dof| point_of[dof]).collect()).collect();
        let order = Mesh::new(points, points_of).nested_dissection();
        // The DOF of a point follow one another.
        let first_dof = |point: usize| point_of.partition_point(|&other| other < point);
        let order = order.into_iter().flat_map(|point| first_dof(point)..first_dof(point + 1));
        let mut turn = vec![0; count];
        order.enumerate().for_each(|(place, dof)| turn[dof] = place);
        let (column_starts, rows) = lower_pattern(elements, &turn);
        let available = u32::MAX as usize;
        if rows.len() > available {
            return Err(Error::TooMany { what: "entries of the stiffness", available, requested: rows.len() });
        }
        let place = |row: usize, column: usize| {
            let (from, to) = (column_starts[column], column_starts[column + 1]);
            (from + rows[from..to].partition_point(|&other| other < row)) as u32
        };
        let mut places = Vec::new();
        for ElementMatrix { dof, .. } in elements {
            let turns: Vec<usize> = dof.iter().map(|&dof| turn[dof]).collect();
            for (column, &other) in turns.iter().enumerate() {
                places.extend(turns[column..].iter().map(|&turn| place(turn.max(other), turn.min(other))));
            }
        }
        let pattern = SymbolicSparseColMat::new_checked(count, count, column_starts, None, rows);
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let failed = |_| Error::NoConvergence("sparse assembly");
        // In the order given the library reads the upper triangle here, and the lower one when it factorizes.
        let upper = pattern.as_ref().transpose().to_col_major().map_err(failed)?;
        let symbolic =
            factorize_symbolic_cholesky(upper.as_ref(), Side::Upper, SymmetricOrdering::Identity, parameters);
        let symbolic = symbolic.map_err(failed)?;
        Ok(Self { turn, pattern, places, symbolic, fingerprint: fingerprint(elements) })
    }

    /// How many numbers the factor holds.
    #[doc = include_str!("../../../paper/examples/factorization/plan_factor_entries.md")]
    pub fn factor_entries(&self) -> usize {
        self.symbolic.len_val()
    }

    /// The lower triangle's entries of $\sum_e s_e K_e$.
    pub(super) fn assembled(&self, elements: &[ElementMatrix], sizes: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; self.pattern.row_idx().len()];
        let mut places = self.places.iter();
        for (ElementMatrix { unit, .. }, size) in elements.iter().zip(sizes) {
            for (column, entries) in unit.column_iter().enumerate() {
                for (entry, &place) in entries.iter().skip(column).zip(places.by_ref()) {
                    values[place as usize] += size * entry;
                }
            }
        }
        values
    }

    /// The rows of a column's entries and the range of their places.
    pub(super) fn column(&self, column: usize) -> (&[usize], Range<usize>) {
        let range = self.pattern.col_ptr()[column]..self.pattern.col_ptr()[column + 1];
        (&self.pattern.row_idx()[range.clone()], range)
    }

    /// The product of the matrix of given entries with a vector.
    pub(super) fn times(&self, entries: &[f64], x: &DVector<f64>) -> DVector<f64> {
        let mut product = DVector::zeros(x.len());
        for column in 0..x.len() {
            let (rows, range) = self.column(column);
            let (mut sum, own) = (0.0, x[column]);
            for (&row, entry) in rows.iter().zip(&entries[range]) {
                product[row] += entry * own;
                sum += entry * x[row];
            }
            // The diagonal, which comes first in a column, is counted twice by now.
            product[column] += sum - entries[self.pattern.col_ptr()[column]] * own;
        }
        product
    }

    /// The Cholesky factor of given entries, in one thread whatever the library's global setting: its parallel kernels have open
    /// reports of wrong results on large matrices. None for a matrix that is not positive definite to working precision.
    pub(super) fn factor(&self, entries: &[f64]) -> Result<Option<Vec<f64>>, Error> {
        let mut values = vec![0.0; self.symbolic.len_val()];
        let scratch = self.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| Error::NoConvergence("sparse Cholesky"))?;
        let (none, stack) = (LltRegularization::default(), MemStack::new(&mut memory));
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), entries);
        let symbolic = &self.symbolic;
        let done =
            symbolic.factorize_numeric_llt(&mut values, matrix, Side::Lower, none, Par::Seq, stack, Spec::default());
        let is_definite = done.is_ok();
        Ok(is_definite.then_some(values))
    }
}

/// Where the columns of the lower triangle begin, and the rows of its entries, ascending in each.
fn lower_pattern(elements: &[ElementMatrix], turn: &[usize]) -> (Vec<usize>, Vec<usize>) {
    let mut touching = vec![Vec::new(); turn.len()];
    for ElementMatrix { dof, .. } in elements {
        dof.iter().for_each(|&column| touching[turn[column]].push(dof));
    }
    let (mut starts, mut rows) = (vec![0], Vec::new());
    let mut of_column = Vec::new();
    for (column, touching) in touching.iter().enumerate() {
        of_column.clear();
        of_column.push(column);
        of_column.extend(touching.iter().flat_map(|dof| dof.iter().map(|&dof| turn[dof])).filter(|&row| row > column));
        of_column.sort_unstable();
        of_column.dedup();
        rows.extend_from_slice(&of_column);
        starts.push(rows.len());
    }
    (starts, rows)
}
