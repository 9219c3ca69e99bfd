//! Assembly of the structural stiffness from unit element matrices, and its factorization.

use crate::method::elements::{corner_volumes, unit_stiffness};
use crate::method::error::Error;
use crate::method::linear_algebra::{
    check_finite, check_length, check_shape, check_solution, cholesky, from_faer, to_faer,
};
use crate::method::structure::{DIRECTIONS, Element, StructuralDof, Structure, positive};
use faer::linalg::solvers::SolveCore;
use faer::sparse::linalg::{LltError, solvers::Llt};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, Mat, Side};
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
/// [`Error::WrongShape`] unless there is one size per element.
pub fn dense_stiffness(elements: &[ElementMatrix], sizes: &[f64], dof_count: usize) -> Result<DMatrix<f64>, Error> {
    check_length("element sizes", sizes.len(), elements.len())?;
    let mut stiffness = DMatrix::zeros(dof_count, dof_count);
    for (row, column, value) in entries(elements, sizes) {
        stiffness[(row, column)] += value;
    }
    Ok(stiffness)
}

/// The lumped mass of elements of the given sizes at every free DOF, lbf·s²/in.
pub fn lumped_mass(elements: &[ElementMatrix], sizes: &[f64], dof_count: usize) -> DVector<f64> {
    let mut lumped = DVector::zeros(dof_count);
    for (element, size) in elements.iter().zip(sizes) {
        for (&row, unit) in element.dof.iter().zip(&element.unit_mass) {
            lumped[row] += size * unit;
        }
    }
    lumped
}

/// Row, column and value of every entry of every $s_e K_e$.
fn entries(elements: &[ElementMatrix], sizes: &[f64]) -> impl Iterator<Item = (usize, usize, f64)> {
    elements.iter().zip(sizes).flat_map(|(ElementMatrix { dof, unit, .. }, size)| {
        let column = move |b| (0..dof.len()).map(move |a| (dof[a], dof[b], size * unit[(a, b)]));
        (0..dof.len()).flat_map(column)
    })
}

/// The structural stiffness, factorized once and solved many times: $K_S = S^{-1} L L^t S^{-1}$ with a sparse Cholesky factor
/// $L$, where the diagonal $S$ scales $K_S$ to unit diagonal.
#[derive(Debug)]
pub struct FactorizedStiffness {
    scale: DVector<f64>,
    factor: Llt<usize, f64>,
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
        check_length("element sizes", sizes.len(), elements.len())?;
        let mut diagonal = DVector::<f64>::zeros(count);
        for (row, _, value) in entries(elements, sizes).filter(|(row, column, _)| row == column) {
            diagonal[row] += value;
        }
        let singular = |dof: usize, ratio| {
            let StructuralDof { grid, direction } = free[dof];
            Err(Error::SingularStiffness { grid, direction: DIRECTIONS[direction], ratio })
        };
        if let Some(dof) = diagonal.iter().position(|&entry| entry <= 0.0) {
            return singular(dof, 0.0);
        }
        let scale = diagonal.map(|entry| 1.0 / entry.sqrt());
        let scaled =
            || entries(elements, sizes).map(|(row, column, value)| (row, column, value * scale[row] * scale[column]));
        let times = |x: &DVector<f64>| {
            let mut product = DVector::zeros(count);
            scaled().for_each(|(row, column, value)| product[row] += value * x[column]);
            product
        };
        let what = "structural stiffness";
        let round_off = 32.0 * f64::EPSILON * (count as f64).sqrt();
        // A stiffness that is not positive definite to working precision is shifted to find out which motion is free.
        for shift in [0.0, SINGULAR_SHIFT] {
            let lower = scaled().filter(|(row, column, _)| row >= column);
            let shifted = (0..count).map(|i| (i, i, shift)).chain(lower);
            let triplets: Vec<_> = shifted.map(|(row, column, value)| Triplet::new(row, column, value)).collect();
            let matrix = SparseColMat::try_new_from_triplets(count, count, &triplets);
            let matrix: SparseColMat<usize, f64> = matrix.map_err(|_| Error::NoConvergence("sparse assembly"))?;
            let factor = match matrix.sp_cholesky(Side::Lower) {
                Ok(factor) => factor,
                Err(LltError::Numeric(_)) => continue,
                Err(LltError::Generic(_)) => return Err(Error::NoConvergence("sparse Cholesky")),
            };
            let (smallest, motion) = weakest_motion(&factor, count);
            if shift == 0.0 && smallest > round_off {
                check_solution(what, times, |right| solved(&factor, right), &start_vector(count))?;
                return Ok(Self { scale, factor });
            }
            return singular(motion.component_mul(&scale).iamax(), smallest - shift);
        }
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
        let mut columns = to_faer(&scaled(loads.clone()));
        self.factor.solve_in_place_with_conj(Conj::No, columns.as_mut());
        Ok(scaled(from_faer(columns.as_ref())))
    }
}

/// The solution for one right side.
fn solved(factor: &Llt<usize, f64>, right: &DVector<f64>) -> DVector<f64> {
    let mut column = Mat::from_fn(right.len(), 1, |i, _| right[i]);
    factor.solve_in_place_with_conj(Conj::No, column.as_mut());
    DVector::from_fn(right.len(), |i, _| column[(i, 0)])
}

/// Smallest eigenvalue and its vector of a factorized matrix, by inverse iteration.
fn weakest_motion(factor: &Llt<usize, f64>, size: usize) -> (f64, DVector<f64>) {
    let (mut motion, mut smallest) = (start_vector(size), 1.0);
    for _ in 0..INVERSE_ITERATIONS {
        motion = solved(factor, &motion);
        smallest = 1.0 / motion.normalize_mut();
    }
    (smallest, motion)
}

/// A unit vector with no symmetry: the golden ratio's multiples are never commensurate with a mesh.
fn start_vector(size: usize) -> DVector<f64> {
    let golden = 0.618_033_988_749_894_8;
    DVector::from_fn(size, |i, _| 0.5 + (golden * (i + 1) as f64).fract()).normalize()
}
