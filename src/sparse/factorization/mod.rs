//! Factorization of the structural stiffness: planned once, made anew for every set of sizes, solved many times.
//! Tour: [chapter 6](crate::tour::chapter_06_condensation).

mod plan;

pub use plan::FactorizationPlan;

use crate::method::assembly::{ElementMatrix, check_elements, dense_stiffness};
use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{check_finite, check_length, check_shape, cholesky, finite};
use crate::method::structure::{DIRECTIONS, StructuralDof, positive};
use crate::sparse::load_distribution::LoadDistribution;
use crate::sparse::{add_squares, check_solution, start_vector};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::sparse::linalg::cholesky::SymbolicCholeskyRaw;
use faer::sparse::linalg::cholesky::supernodal::{SupernodalLltRef, SupernodeRef};
use faer::{Accum, MatMut, MatRef, Par};
use nalgebra::{DMatrix, DVector, Vector3};
use plan::fingerprint;
use std::sync::Arc;

/// Steps of inverse iteration toward the weakest motion. Each reduces the other motions by the ratio of the two
/// smallest eigenvalues; when the matrix is singular the first step already gains ten decades.
const INVERSE_ITERATIONS: usize = 4;
/// A first estimate of the smallest eigenvalue by so much above round-off needs no second: it is too large by no more than one over
/// the part that the start vector has in the weakest motion.
const CLEARLY_HELD: f64 = 1e6;
/// Shift of the unit-diagonal stiffness that makes a singular one factorizable to find its free motion.
const SINGULAR_SHIFT: f64 = 1e-10;

/// Rows of $W$ that are multiplied at once: as many as a processor's cache holds.
const PANEL: usize = 512;

/// The structural stiffness, factorized once and solved many times.
///
/// Held as $K_S = S^{-1} L L^t S^{-1}$ with a sparse Cholesky factor $L$, where the diagonal $S$ scales $K_S$ to unit
/// diagonal.
#[derive(Debug, Clone)]
pub struct FactorizedStiffness {
    plan: Arc<FactorizationPlan>,
    scale: DVector<f64>,
    values: Vec<f64>,
}

impl FactorizedStiffness {
    /// Assembles and factorizes $K_S = \sum_e s_e K_e$.
    ///
    /// `sizes` are gages (in) and areas (in²), one per element; `free` the free DOF of the structure.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for a wrong number of sizes; [`Error::NotPositive`] naming the element of a bad size;
    /// [`Error::Empty`] without free DOF; [`Error::SingularStiffness`] naming the grid and direction that nothing
    /// constrains, when the smallest eigenvalue of the unit-diagonal stiffness is within round-off of zero;
    /// [`Error::NotPositiveDefinite`] for element matrices that are not semidefinite; [`Error::WrongSolution`] when the
    /// factor does not solve its own matrix.
    ///
    /// # Example
    ///
    /// ```rust
    /// use corfem::chain::rods;
    /// use corfem::method::assembly::element_matrices;
    /// use corfem::method::error::Error;
    /// use corfem::sparse::factorization::FactorizedStiffness;
    ///
    /// // Held nowhere, the chain can move along x.
    /// let free = rods(&[100.0, 50.0], [false, false])?;
    /// let found = FactorizedStiffness::new(&element_matrices(&free), &[100.0, 50.0], free.free_dof());
    /// assert!(matches!(found, Err(Error::SingularStiffness { direction: 'x', .. })));
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn new(
        elements: &[ElementMatrix],
        sizes: &[f64],
        free: &[StructuralDof],
    ) -> Result<Self, Error> {
        check_sizes(elements, sizes, free)?;
        Self::planned(
            &Arc::new(FactorizationPlan::of(elements, free, |_| Vector3::zeros())?),
            elements,
            sizes,
            free,
        )
    }

    /// The same by a plan that was made for these elements.
    ///
    /// # Errors
    /// Those of [`Self::new`]; [`Error::WrongShape`] for a plan of other elements.
    pub fn planned(
        plan: &Arc<FactorizationPlan>,
        elements: &[ElementMatrix],
        sizes: &[f64],
        free: &[StructuralDof],
    ) -> Result<Self, Error> {
        check_sizes(elements, sizes, free)?;
        let count = free.len();
        check_length(
            "degrees of freedom of the plan",
            plan.pattern.ncols(),
            count,
        )?;
        if plan.fingerprint != fingerprint(elements) {
            check_length("elements of the plan", 0, elements.len())?;
        }
        let mut entries = plan.assembled(elements, sizes);
        let singular = |dof: usize, ratio| {
            let StructuralDof { grid, direction } = free[dof];
            Err(Error::SingularStiffness {
                grid,
                direction: *DIRECTIONS.get(direction).unwrap_or(&'?'),
                ratio,
            })
        };
        let diagonal = &plan.pattern.col_ptr()[..count];
        if let Some(dof) = (0..count).find(|&dof| entries[diagonal[plan.turn[dof]]] <= 0.0) {
            return singular(dof, 0.0);
        }
        let scale = plan.scale(&mut entries, |entry| entry);
        let round_off = 32.0 * f64::EPSILON * (count as f64).sqrt();
        let start = start_vector(count);
        // A stiffness that is not positive definite to working precision is shifted to find out which motion is free.
        for shift in [0.0, SINGULAR_SHIFT] {
            diagonal.iter().for_each(|&place| entries[place] += shift);
            let (values, true) = plan.factor(&entries, true)? else {
                continue;
            };
            let factor = Self {
                plan: Arc::clone(plan),
                scale: DVector::from_element(count, 1.0),
                values,
            };
            let times = |x: &DVector<f64>| plan.times(&entries, x);
            // The first step toward the weakest motion and the check pass through the factor together.
            let both = factor.solved(DMatrix::from_rows(&[
                start.transpose(),
                times(&start).transpose(),
            ]));
            // Of a stiffness that had to be shifted the free motion is wanted, which takes every iteration.
            let enough = if shift == 0.0 {
                CLEARLY_HELD * round_off
            } else {
                f64::INFINITY
            };
            let (smallest, motion) = factor.weakest_motion(both.rows(0, 1).into_owned(), enough);
            if shift == 0.0 && smallest > round_off {
                check_solution(
                    "structural stiffness",
                    times,
                    |_| both.row(1).transpose(),
                    &start,
                )?;
                return Ok(Self { scale, ..factor });
            }
            let moved = |dof: usize| (motion[plan.turn[dof]] * scale[plan.turn[dof]]).abs();
            // Of equal ones the first.
            let most = (0..count)
                .rev()
                .max_by(|&a, &b| moved(a).total_cmp(&moved(b)));
            return singular(most.unwrap_or(0), smallest - shift);
        }
        let what = "structural stiffness";
        cholesky(what, &dense_stiffness(elements, sizes, count)?, 0.0)
            .and(Err(Error::NoConvergence(what)))
    }

    /// Deflections $q_S = K_S^{-1} Q_S$ (A.2) for every column of `loads` (lbf); inches.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless `loads` has one row per free DOF; [`Error::NotFinite`].
    pub fn solve(&self, loads: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        check_shape("loads", loads, self.scale.len(), loads.ncols())?;
        check_finite("loads", loads)?;
        self.solve_transposed(loads)
            .map(|deflections| deflections.transpose())
    }

    /// The same transposed (m × free SDOF), so that the deflections of one DOF lie together.
    pub(crate) fn solve_transposed(&self, loads: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        let (count, turn) = (loads.ncols(), &self.plan.turn);
        let (mut rows, mut is_reached) = (vec![0.0; loads.len()], vec![false; loads.nrows()]);
        for (&turn, loads) in turn.iter().zip(loads.row_iter()) {
            is_reached[turn] = loads.iter().any(|&load| load != 0.0);
            let row = rows[turn * count..].iter_mut().zip(loads.iter());
            row.for_each(|(value, load)| *value = load * self.scale[turn]);
        }
        self.forward(&mut rows, &mut is_reached);
        self.backward(&mut rows, count);
        let at =
            |column: usize, dof: usize| self.scale[turn[dof]] * rows[turn[dof] * count + column];
        finite("deflections", DMatrix::from_fn(count, loads.nrows(), at))
    }

    /// The flexibility $T^t K_S^{-1} T$ (A.5, d × d, in/lbf) by forward substitution alone:
    ///
    /// $$ T^t K_S^{-1} T = W^t W, \qquad W = L^{-1} S T $$
    ///
    /// Where no dynamic DOF's loads reach, $W$ is zero and nothing is done.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless $T$ has a row per free DOF; [`Error::NotFinite`].
    pub fn flexibility(&self, load_distribution: &LoadDistribution) -> Result<DMatrix<f64>, Error> {
        check_length(
            "load distribution",
            load_distribution.rows(),
            self.scale.len(),
        )?;
        let count = load_distribution.columns().len();
        let (mut rows, mut is_reached) = (
            vec![0.0; self.scale.len() * count],
            vec![false; self.scale.len()],
        );
        for (column, terms) in load_distribution.columns().iter().enumerate() {
            for &(dof, coefficient) in terms {
                let turn = self.plan.turn[dof];
                is_reached[turn] = true;
                rows[turn * count + column] += coefficient * self.scale[turn];
            }
        }
        self.forward(&mut rows, &mut is_reached);
        let mut sum = DMatrix::zeros(count, count);
        for (rows, _) in rows
            .chunks(PANEL * count)
            .zip(is_reached.chunks(PANEL))
            .filter(|(_, reached)| reached.contains(&true))
        {
            add_squares(&mut sum, rows);
        }
        sum.fill_upper_triangle_with_lower_triangle();
        finite("dynamic flexibility", sum)
    }

    /// $L^{-1}$ times right-hand sides in place, a DOF's values together in the order of elimination; blocks of DOF that are not
    /// reached are left alone.
    fn forward(&self, rows: &mut [f64], is_reached: &mut [bool]) {
        let (count, mut scratch) = (rows.len() / is_reached.len(), Vec::new());
        for block in self.blocks() {
            let end = block.start() + block.val().ncols();
            if !is_reached[block.start()..end].contains(&true) {
                continue;
            }
            let (done, later) = rows.split_at_mut(end * count);
            let own = &mut done[block.start() * count..];
            let mut own = MatMut::from_column_major_slice_mut(own, count, block.val().ncols());
            let (diagonal, below) = block.val().split_at_row(block.val().ncols());
            solve_lower_triangular_in_place(diagonal, own.as_mut().transpose_mut(), Par::Seq);
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
                is_reached[row] = true;
                let values = later[(row - end) * count..].iter_mut().zip(change);
                values.for_each(|(value, change)| *value -= change);
            }
        }
    }

    /// $L^{-t}$ times right-hand sides in the same way.
    fn backward(&self, rows: &mut [f64], count: usize) {
        let mut scratch = Vec::new();
        for block in self.blocks().rev() {
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
            solve_upper_triangular_in_place(diagonal.transpose(), own.transpose_mut(), Par::Seq);
        }
    }

    /// The factor by blocks of columns with the same rows, which the plan always asks for.
    fn blocks(&self) -> impl DoubleEndedIterator<Item = SupernodeRef<'_, usize, f64>> {
        let factor = match self.plan.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(symbolic) => {
                Some(SupernodalLltRef::new(symbolic, &self.values))
            }
            SymbolicCholeskyRaw::Simplicial(_) => None,
        };
        factor.into_iter().flat_map(|factor| {
            (0..factor.symbolic().n_supernodes()).map(move |at| factor.supernode(at))
        })
    }

    /// The solutions of the scaled problem for rows of loads, both in the order of elimination.
    fn solved(&self, mut rows: DMatrix<f64>) -> DMatrix<f64> {
        let count = rows.nrows();
        self.forward(rows.as_mut_slice(), &mut vec![true; self.scale.len()]);
        self.backward(rows.as_mut_slice(), count);
        rows
    }

    /// Smallest eigenvalue and its vector (a row) of the scaled stiffness, by inverse iteration from the solution for a unit vector; no
    /// more than its first estimates where these are above `enough`.
    fn weakest_motion(&self, mut motion: DMatrix<f64>, enough: f64) -> (f64, DMatrix<f64>) {
        let (mut smallest, mut left) = (1.0 / motion.normalize_mut(), INVERSE_ITERATIONS - 1);
        while left > 0 && smallest <= enough {
            motion = self.solved(motion);
            (smallest, left) = (1.0 / motion.normalize_mut(), left - 1);
        }
        (smallest, motion)
    }
}

/// Refuses sizes that are not positive and a structure without DOF.
fn check_sizes(
    elements: &[ElementMatrix],
    sizes: &[f64],
    free: &[StructuralDof],
) -> Result<(), Error> {
    for (element, &size) in elements.iter().zip(sizes) {
        positive("size", || format!("element {}", element.label), size)?;
    }
    at_least_one("free degrees of freedom", free.len())?;
    check_elements(elements, sizes, free.len())
}
