//! Assembly of the structural stiffness from unit element matrices, and its factorization.
//! Tour: [chapter 6](crate::tour::chapter_06_condensation).

use crate::method::elements::{corner_volumes, unit_stiffness};
use crate::method::error::Error;
use crate::method::linear_algebra::{
    check_finite, check_length, check_shape, check_solution, cholesky, finite, finite_list, from_faer, to_faer,
};
use crate::method::modes::check_count;
use crate::method::structure::{DIRECTIONS, Element, StructuralDof, Structure, positive};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::cholesky::{LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, Mat, Par, Side, Spec};
use nalgebra::{DMatrix, DVector};

/// Steps of inverse iteration toward the weakest motion. Each reduces the other motions by the ratio of the two
/// smallest eigenvalues; when the matrix is singular the first step already gains ten decades.
const INVERSE_ITERATIONS: usize = 4;
/// Shift of the unit-diagonal stiffness that makes a singular one factorizable to find its free motion.
const SINGULAR_SHIFT: f64 = 1e-10;

/// One element's stiffness and mass for unit size at the free structural DOF it touches.
#[derive(Debug, Clone)]
pub struct ElementMatrix {
    /// The element's number.
    pub label: usize,
    /// Rows among the free DOF, in the order of `unit`.
    pub dof: Vec<usize>,
    /// Stiffness for a gage of 1 in or an area of 1 in², lbf/in.
    pub unit: DMatrix<f64>,
    /// Lumped mass for the same size at the same DOF, lbf·s²/in; zero for a material without density.
    pub unit_mass: DVector<f64>,
}

/// Refuses elements that do not fit their sizes or the DOF that there are.
fn check_elements(elements: &[ElementMatrix], sizes: &[f64], dof_count: usize) -> Result<(), Error> {
    check_length("element sizes", sizes.len(), elements.len())?;
    elements.iter().try_for_each(|ElementMatrix { dof, unit, unit_mass, .. }| {
        check_shape("element stiffness", unit, dof.len(), dof.len())?;
        check_length("element mass", unit_mass.len(), dof.len())?;
        dof.iter().try_for_each(|&row| check_count("degrees of freedom", row.saturating_add(1), dof_count))
    })
}

/// Unit stiffness and mass of every element, restricted to the free DOF, in the structure's order.
///
/// # Errors
/// [`Error::InElement`] around the geometry error of the first bad element.
pub fn element_matrices(structure: &Structure) -> Result<Vec<ElementMatrix>, Error> {
    let of_element = |element: &Element| {
        let &Element { label, kind, ref grids, material, .. } = element;
        let corners = structure.corners(element);
        let full = unit_stiffness(kind, &corners, &material).map_err(|error| error.in_element(label))?;
        let volumes = corner_volumes(kind, &corners)?;
        let all = grids.iter().flat_map(|&grid| (0..3).map(move |direction| structure.free_dof_index(grid, direction)));
        let (local, dof): (Vec<usize>, Vec<usize>) =
            all.enumerate().filter_map(|(local, dof)| Some((local, dof?))).unzip();
        let unit_mass = local.iter().map(|&row| material.density * volumes[row / 3]);
        let unit_mass = DVector::from_iterator(local.len(), unit_mass);
        Ok(ElementMatrix { label, unit_mass, unit: full.select_rows(&local).select_columns(&local), dof })
    };
    structure.elements().iter().map(of_element).collect()
}

/// The structural stiffness $K_S = \sum_e s_e K_e$ at the free DOF as a dense matrix, lbf/in.
///
/// `sizes` are the gages (in) and areas (in²) $s_e$, one per element; `dof_count` the number of free DOF.
///
/// # Errors
/// [`Error::WrongShape`], [`Error::TooMany`] for elements that do not fit their sizes or the DOF; [`Error::NotFinite`].
pub fn dense_stiffness(elements: &[ElementMatrix], sizes: &[f64], dof_count: usize) -> Result<DMatrix<f64>, Error> {
    check_elements(elements, sizes, dof_count)?;
    let mut stiffness = DMatrix::zeros(dof_count, dof_count);
    for (row, column, value) in entries(elements, sizes) {
        stiffness[(row, column)] += value;
    }
    finite("structural stiffness", stiffness)
}

/// The lumped mass of elements of the given sizes at every free DOF, lbf·s²/in.
///
/// # Errors
/// Those of [`dense_stiffness`].
pub fn lumped_mass(elements: &[ElementMatrix], sizes: &[f64], dof_count: usize) -> Result<DVector<f64>, Error> {
    check_elements(elements, sizes, dof_count)?;
    let mut lumped = DVector::zeros(dof_count);
    for (element, size) in elements.iter().zip(sizes) {
        for (&row, unit) in element.dof.iter().zip(&element.unit_mass) {
            lumped[row] += size * unit;
        }
    }
    finite_list("lumped mass", lumped.data.into()).map(DVector::from_vec)
}

/// Row, column and value of every entry of every $s_e K_e$.
fn entries(elements: &[ElementMatrix], sizes: &[f64]) -> impl Iterator<Item = (usize, usize, f64)> {
    elements.iter().zip(sizes).flat_map(|(ElementMatrix { dof, unit, .. }, size)| {
        let column = move |b| (0..dof.len()).map(move |a| (dof[a], dof[b], size * unit[(a, b)]));
        (0..dof.len()).flat_map(column)
    })
}

/// The structural stiffness, factorized once and solved many times.
///
/// Held as $K_S = S^{-1} L L^t S^{-1}$ with a sparse Cholesky factor $L$, where the diagonal $S$ scales $K_S$ to unit
/// diagonal.
#[derive(Debug)]
pub struct FactorizedStiffness {
    scale: DVector<f64>,
    factor: SparseFactor,
}

/// A sparse Cholesky factor, computed and applied in one thread whatever the library's global setting: the library's parallel
/// kernels have open reports of wrong results on large matrices.
#[derive(Debug)]
struct SparseFactor {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
}

impl SparseFactor {
    /// None for a matrix that is not positive definite to working precision.
    fn new(matrix: &SparseColMat<usize, f64>) -> Result<Option<Self>, Error> {
        let failed = Error::NoConvergence;
        let what = "sparse Cholesky";
        let amd = SymmetricOrdering::Amd;
        let symbolic = factorize_symbolic_cholesky(matrix.symbolic(), Side::Lower, amd, Default::default());
        let symbolic = symbolic.map_err(|_| failed(what))?;
        let mut values = vec![0.0; symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| failed(what))?;
        let (none, stack) = (LltRegularization::default(), MemStack::new(&mut memory));
        let matrix = matrix.as_ref();
        let done =
            symbolic.factorize_numeric_llt(&mut values, matrix, Side::Lower, none, Par::Seq, stack, Spec::default());
        let is_definite = done.is_ok();
        Ok(is_definite.then_some(Self { symbolic, values }))
    }

    /// Solves for every column in place.
    fn solve(&self, columns: &mut Mat<f64>) {
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(columns.ncols(), Par::Seq);
        let (factor, mut memory) = (LltRef::new(&self.symbolic, &self.values), MemBuffer::new(scratch));
        factor.solve_in_place_with_conj(Conj::No, columns.as_mut(), Par::Seq, MemStack::new(&mut memory));
    }

    fn solved(&self, right: &DVector<f64>) -> DVector<f64> {
        let mut column = Mat::from_fn(right.len(), 1, |i, _| right[i]);
        self.solve(&mut column);
        DVector::from_fn(right.len(), |i, _| column[(i, 0)])
    }
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
    pub fn new(elements: &[ElementMatrix], sizes: &[f64], free: &[StructuralDof]) -> Result<Self, Error> {
        for (element, &size) in elements.iter().zip(sizes) {
            positive("size", || format!("element {}", element.label), size)?;
        }
        let count = free.len();
        if count == 0 {
            return Err(Error::Empty { what: "free degrees of freedom" });
        }
        check_elements(elements, sizes, count)?;
        let mut diagonal = DVector::<f64>::zeros(count);
        for (row, _, value) in entries(elements, sizes).filter(|(row, column, _)| row == column) {
            diagonal[row] += value;
        }
        let singular = |dof: usize, ratio| {
            let StructuralDof { grid, direction } = free[dof];
            Err(Error::SingularStiffness { grid, direction: *DIRECTIONS.get(direction).unwrap_or(&'?'), ratio })
        };
        if let Some(dof) = diagonal.iter().position(|&entry| entry <= 0.0) {
            return singular(dof, 0.0);
        }
        let scale = diagonal.map(|entry| 1.0 / entry.sqrt());
        let factorize = |shift: f64| {
            let shifts = (0..count).map(|i| Triplet::new(i, i, shift));
            let lower = entries(elements, sizes).filter(|(row, column, _)| row >= column);
            let scaled =
                lower.map(|(row, column, value)| Triplet::new(row, column, value * scale[row] * scale[column]));
            SparseColMat::try_new_from_triplets(count, count, &shifts.chain(scaled).collect::<Vec<_>>())
                .map_err(|_| Error::NoConvergence("sparse assembly"))
                .and_then(|matrix| SparseFactor::new(&matrix))
        };
        let times = |x: &DVector<f64>| {
            let mut product = DVector::zeros(count);
            for (row, column, value) in entries(elements, sizes) {
                product[row] += value * scale[row] * scale[column] * x[column];
            }
            product
        };
        let round_off = 32.0 * f64::EPSILON * (count as f64).sqrt();
        // A stiffness that is not positive definite to working precision is shifted to find out which motion is free.
        for shift in [0.0, SINGULAR_SHIFT] {
            let Some(factor) = factorize(shift)? else { continue };
            let (smallest, motion) = weakest_motion(&factor, count);
            if shift == 0.0 && smallest > round_off {
                check_solution("structural stiffness", times, |right| factor.solved(right), &start_vector(count))?;
                return Ok(Self { scale, factor });
            }
            return singular(motion.component_mul(&scale).iamax(), smallest - shift);
        }
        let what = "structural stiffness";
        cholesky(what, &dense_stiffness(elements, sizes, count)?, 0.0).and(Err(Error::NoConvergence(what)))
    }

    /// Deflections $q_S = K_S^{-1} Q_S$ (A.2) for every column of `loads` (lbf); inches.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless `loads` has one row per free DOF; [`Error::NotFinite`].
    pub fn solve(&self, loads: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        check_shape("loads", loads, self.scale.len(), loads.ncols())?;
        check_finite("loads", loads)?;
        let scaled = |mut matrix: DMatrix<f64>| {
            matrix.column_iter_mut().for_each(|mut column| column.component_mul_assign(&self.scale));
            matrix
        };
        let mut solved = to_faer(&scaled(loads.clone()));
        self.factor.solve(&mut solved);
        finite("deflections", scaled(from_faer(solved.as_ref())))
    }
}

/// Smallest eigenvalue and its vector of a factorized matrix, by inverse iteration.
fn weakest_motion(factor: &SparseFactor, size: usize) -> (f64, DVector<f64>) {
    let (mut motion, mut smallest) = (start_vector(size), 1.0);
    for _ in 0..INVERSE_ITERATIONS {
        motion = factor.solved(&motion);
        smallest = 1.0 / motion.normalize_mut();
    }
    (smallest, motion)
}

/// A unit vector with no symmetry: the golden ratio's multiples are never commensurate with a mesh.
fn start_vector(size: usize) -> DVector<f64> {
    let golden = 0.618_033_988_749_894_8;
    DVector::from_fn(size, |i, _| 0.5 + (golden * (i + 1) as f64).fract()).normalize()
}
