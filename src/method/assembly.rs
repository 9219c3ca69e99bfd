//! Assembly of the structural stiffness from unit element matrices, and its factorization.

use crate::method::elements::mass::corner_volumes;
use crate::method::elements::unit_stiffness;
use crate::method::error::Error;
use crate::method::linear_algebra::{check_shape, cholesky};
use crate::method::structure::{DIRECTIONS, StructuralDof, Structure, positive};
use faer::Side;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use nalgebra::{DMatrix, DVector};

/// Steps of inverse iteration toward the weakest motion. Each divides what is left of the others by the
/// ratio of the two smallest eigenvalues; for the verdict "singular" the first already gains ten decades.
const INVERSE_ITERATIONS: usize = 4;
/// Shift of the unit-diagonal stiffness that makes a singular one factorizable to find its free motion.
const SINGULAR_SHIFT: f64 = 1e-10;

/// One element's stiffness for unit size at the free structural DOF it touches.
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

/// Unit stiffness of every element, restricted to the free DOF, in the structure's order.
///
/// # Errors
/// [`Error::InElement`] around the geometry error of the first bad element.
pub fn element_matrices(structure: &Structure) -> Result<Vec<ElementMatrix>, Error> {
    structure
        .elements()
        .iter()
        .map(|element| {
            let corners = structure.corners(element);
            let full = unit_stiffness(element.kind, &corners, &element.material)
                .map_err(|error| error.in_element(element.label))?;
            let (local, dof): (Vec<usize>, Vec<usize>) = element
                .grids
                .iter()
                .flat_map(|&grid| (0..3).map(move |direction| (grid, direction)))
                .enumerate()
                .filter_map(|(local, (grid, direction))| {
                    Some((local, structure.free_dof_index(grid, direction)?))
                })
                .unzip();
            let volumes = corner_volumes(element.kind, &corners)?;
            let unit_mass = local
                .iter()
                .map(|&row| element.material.density * volumes[row / 3]);
            Ok(ElementMatrix {
                label: element.label,
                unit_mass: DVector::from_iterator(dof.len(), unit_mass),
                unit: full.select_rows(&local).select_columns(&local),
                dof,
            })
        })
        .collect()
}

/// The structural stiffness $K_S = \sum_e s_e K_e$ at the free DOF as a dense matrix, lbf/in.
///
/// `sizes` are the gages and areas $s_e$, one per element; `dof_count` the number of free DOF.
///
/// # Errors
/// [`Error::WrongShape`] unless there is one size per element.
pub fn dense_stiffness(
    elements: &[ElementMatrix],
    sizes: &[f64],
    dof_count: usize,
) -> Result<DMatrix<f64>, Error> {
    let mut stiffness = DMatrix::zeros(dof_count, dof_count);
    for_each_entry(elements, sizes, |row, column, value| {
        stiffness[(row, column)] += value;
    })?;
    Ok(stiffness)
}

fn for_each_entry(
    elements: &[ElementMatrix],
    sizes: &[f64],
    mut add: impl FnMut(usize, usize, f64),
) -> Result<(), Error> {
    let given = DMatrix::from_column_slice(sizes.len(), 1, sizes);
    check_shape("element sizes", &given, elements.len(), 1)?;
    for (element, &size) in elements.iter().zip(sizes) {
        for (b, &column) in element.dof.iter().enumerate() {
            for (a, &row) in element.dof.iter().enumerate() {
                add(row, column, size * element.unit[(a, b)]);
            }
        }
    }
    Ok(())
}

/// The factorized structural stiffness: factorized once, solved many times.
///
/// Held as $K_S = S^{-1} L L^t S^{-1}$, $S$ the diagonal that scales $K_S$ to unit diagonal, with a sparse
/// Cholesky factor.
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
    /// [`Error::WrongShape`] for a wrong number of sizes; [`Error::NotPositive`] naming the element of a size that
    /// is not;
    /// [`Error::SingularStiffness`] naming the grid and direction that nothing constrains, when the smallest
    /// eigenvalue of the unit-diagonal stiffness is within round-off of zero; [`Error::NotPositiveDefinite`] for
    /// element matrices that are not semidefinite.
    pub fn new(
        elements: &[ElementMatrix],
        sizes: &[f64],
        free: &[StructuralDof],
    ) -> Result<Self, Error> {
        for (element, &size) in elements.iter().zip(sizes) {
            positive("size", || format!("element {}", element.label), size)?;
        }
        if free.is_empty() {
            return Err(Error::Empty {
                what: "free degrees of freedom",
            });
        }
        let mut diagonal = DVector::<f64>::zeros(free.len());
        for_each_entry(elements, sizes, |row, column, value| {
            if row == column {
                diagonal[row] += value;
            }
        })?;
        if let Some(dof) = diagonal.iter().position(|&entry| entry <= 0.0) {
            return Err(singular(free[dof], 0.0));
        }
        let scale = diagonal.map(|entry| 1.0 / entry.sqrt());
        let factorize = |shift| factorize_scaled(elements, sizes, &scale, shift);
        let round_off = 32.0 * f64::EPSILON * (free.len() as f64).sqrt();
        if let Some(factor) = factorize(0.0)? {
            let (smallest, motion) = weakest_motion(&factor, free.len());
            if smallest > round_off {
                return Ok(Self { scale, factor });
            }
            return Err(singular(free[most_moved(&motion, &scale)], smallest));
        }
        // Not positive definite to working precision: shift it to find out which motion is free.
        match factorize(SINGULAR_SHIFT)? {
            Some(factor) => {
                let (smallest, motion) = weakest_motion(&factor, free.len());
                Err(singular(
                    free[most_moved(&motion, &scale)],
                    smallest - SINGULAR_SHIFT,
                ))
            }
            None => {
                let what = "structural stiffness";
                let dense = dense_stiffness(elements, sizes, free.len())?;
                cholesky(what, &dense, 0.0).and(Err(Error::NoConvergence { what }))
            }
        }
    }

    /// Deflections $q_S = K_S^{-1} Q_S$ (A.2) for every column of `loads` (lbf); inches.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless `loads` has one row per free DOF; [`Error::NotFinite`].
    pub fn solve(&self, loads: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
        check_shape("loads", loads, self.scale.len(), loads.ncols())?;
        crate::method::linear_algebra::check_finite("loads", loads)?;
        let mut right = faer::Mat::from_fn(loads.nrows(), loads.ncols(), |row, column| {
            self.scale[row] * loads[(row, column)]
        });
        self.factor.solve_in_place(&mut right);
        Ok(DMatrix::from_fn(
            loads.nrows(),
            loads.ncols(),
            |row, column| self.scale[row] * right[(row, column)],
        ))
    }
}

/// Sparse Cholesky factor of the stiffness scaled to unit diagonal, plus `shift` on the diagonal;
/// `None` when it is not positive definite.
fn factorize_scaled(
    elements: &[ElementMatrix],
    sizes: &[f64],
    scale: &DVector<f64>,
    shift: f64,
) -> Result<Option<Llt<usize, f64>>, Error> {
    let size = scale.len();
    let mut triplets: Vec<_> = (0..size).map(|i| Triplet::new(i, i, shift)).collect();
    for_each_entry(elements, sizes, |row, column, value| {
        if row >= column {
            triplets.push(Triplet::new(
                row,
                column,
                value * scale[row] * scale[column],
            ));
        }
    })?;
    let matrix = SparseColMat::try_new_from_triplets(size, size, &triplets).map_err(|_| {
        Error::NoConvergence {
            what: "sparse assembly",
        }
    })?;
    Ok(matrix.sp_cholesky(Side::Lower).ok())
}

/// Smallest eigenvalue and its vector of a factorized matrix, by inverse iteration.
fn weakest_motion(factor: &Llt<usize, f64>, size: usize) -> (f64, DVector<f64>) {
    // A start with no symmetry: the golden ratio's multiples are never commensurate with a mesh.
    let golden = 0.618_033_988_749_894_8;
    let mut motion = DVector::from_fn(size, |i, _| 0.5 + (golden * (i + 1) as f64).fract());
    motion.normalize_mut();
    let mut smallest = 1.0;
    for _ in 0..INVERSE_ITERATIONS {
        let mut next = faer::Mat::from_fn(size, 1, |i, _| motion[i]);
        factor.solve_in_place(&mut next);
        let next = DVector::from_fn(size, |i, _| next[(i, 0)]);
        let growth = next.norm();
        smallest = 1.0 / growth;
        motion = next / growth;
    }
    (smallest, motion)
}

/// The DOF that moves most in a motion of the scaled stiffness.
fn most_moved(motion: &DVector<f64>, scale: &DVector<f64>) -> usize {
    motion.component_mul(scale).iamax()
}

fn singular(dof: StructuralDof, ratio: f64) -> Error {
    Error::SingularStiffness {
        grid: dof.grid,
        direction: DIRECTIONS[dof.direction],
        ratio,
    }
}
