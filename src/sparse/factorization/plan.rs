//! The plan of a factorization: what does not change with the sizes.

use crate::method::assembly::{ElementMatrix, check_elements};
use crate::method::error::Error;
use crate::method::structure::{StructuralDof, Structure};
use crate::sparse::ordering::Mesh;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Par, Side, Spec};
use nalgebra::{DVector, Vector3};
use std::ops::Range;

/// What does not change with the sizes: in which order the DOF are eliminated, where the stiffness has entries, and where its
/// factor then has them.
#[derive(Debug)]
pub struct FactorizationPlan {
    /// The DOF in the order of elimination, and when each is eliminated; everything below counts the DOF in that order.
    pub(crate) order: Vec<usize>,
    pub(crate) turn: Vec<usize>,
    /// The lower triangle, column by column; the first entry of a column is the diagonal.
    pub(super) pattern: SymbolicSparseColMat<usize>,
    /// Place among the entries of every entry of every element's own lower triangle; none where a matrix is factorized.
    places: Vec<u32>,
    pub(crate) symbolic: SymbolicCholesky<usize>,
    /// Of the DOF that the elements had.
    pub(super) fingerprint: u64,
}

/// A number that other DOF do not have, by the Fowler–Noll–Vo hash.
pub(super) fn fingerprint(elements: &[ElementMatrix]) -> u64 {
    let (offset, prime) = (0xcbf2_9ce4_8422_2325_u64, 0x0100_0000_01b3);
    let all = elements
        .iter()
        .flat_map(|element| element.dof.iter().copied().chain([usize::MAX]));
    all.fold(offset, |hash, dof| (hash ^ dof as u64).wrapping_mul(prime))
}

impl FactorizationPlan {
    /// The plan for a structure's elements: nested dissection by its grids' positions.
    ///
    /// # Errors
    /// Those of [`super::FactorizedStiffness::new`] for elements that do not fit the DOF; [`Error::TooMany`] for more entries than are
    /// counted here; [`Error::NoConvergence`] when there is no memory for it.
    pub fn new(structure: &Structure, elements: &[ElementMatrix]) -> Result<Self, Error> {
        Self::of(elements, structure.free_dof(), |grid| {
            structure.position(grid).unwrap_or_default()
        })
    }

    /// The same with positions of grids, all alike where they are not known.
    pub(super) fn of(
        elements: &[ElementMatrix],
        free: &[StructuralDof],
        position: impl Fn(usize) -> Vector3<f64>,
    ) -> Result<Self, Error> {
        check_elements(elements, &vec![1.0; elements.len()], free.len())?;
        let mut touching = vec![Vec::new(); free.len()];
        for ElementMatrix { dof, .. } in elements {
            dof.iter()
                .for_each(|&row| touching[row].push(dof.as_slice()));
        }
        let plan = Self::of_matrices(
            free.len(),
            |row| touching[row].concat(),
            |row| position(free[row].grid),
        )?;
        let mut places = Vec::new();
        for ElementMatrix { dof, .. } in elements {
            let turns: Vec<usize> = dof.iter().map(|&dof| plan.turn[dof]).collect();
            for (column, &other) in turns.iter().enumerate() {
                let place = |&turn: &usize| {
                    plan.place(turn.max(other), turn.min(other))
                        .map(|place| place as u32)
                };
                places.extend(turns[column..].iter().filter_map(place));
            }
        }
        Ok(Self {
            places,
            fingerprint: fingerprint(elements),
            ..plan
        })
    }

    /// The plan for symmetric matrices that couple every row to those listed, which have a position each. Neighbors coupled to the same
    /// rows, as those of one grid are, are one point of the mesh.
    ///
    /// # Errors
    /// Those of [`Self::new`].
    pub(crate) fn of_matrices(
        count: usize,
        coupled: impl Fn(usize) -> Vec<usize>,
        position: impl Fn(usize) -> Vector3<f64>,
    ) -> Result<Self, Error> {
        let column = |row: usize| {
            let mut rows = [coupled(row), vec![row]].concat();
            rows.sort_unstable();
            rows.dedup();
            rows
        };
        let columns: Vec<Vec<usize>> = (0..count).map(column).collect();
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
        let places = (0..points.len())
            .map(|point| position(first_row(point)))
            .collect();
        let order = Mesh {
            points: places,
            near: points.iter().map(near).collect(),
        }
        .nested_dissection()
        .into_iter();
        let order: Vec<usize> = order
            .flat_map(|point| first_row(point)..first_row(point + 1))
            .collect();
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
        let available = u32::MAX as usize;
        if rows.len() > available {
            return Err(Error::TooMany {
                what: "entries of the stiffness",
                available,
                requested: rows.len(),
            });
        }
        let pattern = SymbolicSparseColMat::new_checked(count, count, column_starts, None, rows);
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let failed = |_| Error::NoConvergence("sparse assembly");
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
            places: Vec::new(),
            symbolic,
            fingerprint: 0,
        })
    }

    /// Where an entry of the lower triangle stands among all, counted in the order of elimination.
    fn place(&self, row: usize, column: usize) -> Option<usize> {
        let (rows, range) = self.column(column);
        rows.binary_search(&row)
            .ok()
            .map(|place| range.start + place)
    }

    /// How many numbers the factor holds.
    pub fn factor_entries(&self) -> usize {
        self.symbolic.len_val()
    }

    /// How many multiplications and additions the factorization takes in its leading order: the squares of the lengths of the factor's
    /// columns.
    pub fn factor_operations(&self) -> f64 {
        let SymbolicCholeskyRaw::Supernodal(blocks) = self.symbolic.raw() else {
            return 0.0;
        };
        let widths = blocks
            .supernode_begin()
            .iter()
            .zip(blocks.supernode_end())
            .map(|(begin, end)| end - begin);
        let blocks = widths
            .zip(blocks.col_ptr_for_val().windows(2))
            .map(|(width, at)| (width, (at[1] - at[0]) / width));
        blocks
            .flat_map(|(width, length)| {
                (0..width).map(move |column| ((length - column) as f64).powi(2))
            })
            .sum()
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

    /// Those of a symmetric matrix given by row, column and value; none where it has an entry that the plan has not.
    pub(crate) fn entries_of(
        &self,
        matrix: impl Iterator<Item = (usize, usize, f64)>,
    ) -> Option<Vec<f64>> {
        let mut values = vec![0.0; self.pattern.row_idx().len()];
        for (row, column, value) in
            matrix.map(|(row, column, value)| (self.turn[row], self.turn[column], value))
        {
            if row >= column {
                values[self.place(row, column)?] += value;
            }
        }
        Some(values)
    }

    /// The rows of a column's entries and the range of their places.
    pub(super) fn column(&self, column: usize) -> (&[usize], Range<usize>) {
        let range = self.pattern.col_ptr()[column]..self.pattern.col_ptr()[column + 1];
        (&self.pattern.row_idx()[range.clone()], range)
    }

    /// The product of the matrix of given entries with a vector.
    pub(crate) fn times(&self, entries: &[f64], x: &DVector<f64>) -> DVector<f64> {
        let mut product = DVector::zeros(x.len());
        for column in 0..x.len() {
            let (rows, range) = self.column(column);
            product[column] += entries[range.start] * x[column];
            // The diagonal comes first.
            for (&row, entry) in rows.iter().zip(&entries[range]).skip(1) {
                product[row] += entry * x[column];
                product[column] += entry * x[row];
            }
        }
        product
    }

    /// Scales entries so that the given size of those of the diagonal becomes one, and says by what.
    pub(crate) fn scale(&self, entries: &mut [f64], size: impl Fn(f64) -> f64) -> DVector<f64> {
        let starts = &self.pattern.col_ptr()[..self.turn.len()];
        let scale = DVector::from_iterator(
            starts.len(),
            starts.iter().map(|&at| 1.0 / size(entries[at]).sqrt()),
        );
        for column in 0..scale.len() {
            let (rows, range) = self.column(column);
            rows.iter()
                .zip(&mut entries[range])
                .for_each(|(&row, entry)| *entry *= scale[row] * scale[column]);
        }
        scale
    }

    /// The factor of given entries, in one thread whatever the library's global setting: its parallel kernels have open reports of
    /// wrong results on large matrices. Of a `definite` matrix $L$ of $L L^t$, else $L$ and $D$ of $L D L^t$; and whether there is
    /// one to working precision.
    pub(crate) fn factor(
        &self,
        entries: &[f64],
        definite: bool,
    ) -> Result<(Vec<f64>, bool), Error> {
        let (symbolic, side, one) = (&self.symbolic, Side::Lower, Par::Seq);
        let mut values = vec![0.0; symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(one, Spec::default());
        let scratch =
            scratch.or(symbolic.factorize_numeric_ldlt_scratch::<f64>(one, Spec::default()));
        let mut memory = MemBuffer::try_new(scratch)
            .map_err(|_| Error::NoConvergence("sparse factorization"))?;
        let stack = MemStack::new(&mut memory);
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), entries);
        let (llt, ldlt) = (LltRegularization::default(), LdltRegularization::default());
        let is_done = if definite {
            symbolic
                .factorize_numeric_llt(&mut values, matrix, side, llt, one, stack, Spec::default())
                .is_ok()
        } else {
            symbolic
                .factorize_numeric_ldlt(
                    &mut values,
                    matrix,
                    side,
                    ldlt,
                    one,
                    stack,
                    Spec::default(),
                )
                .is_ok()
        };
        Ok((values, is_done))
    }
}
