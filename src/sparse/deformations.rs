//! Elements by the few ways in which they deform.

use crate::method::appendix_a::ElementMatrix;
use crate::method::error::Error;
use crate::method::linear_algebra::{check_shape, check_symmetric, symmetric_eigen};
use nalgebra::{DMatrix, DVector};

/// Stiffness of a way to deform, relative to the element's largest, below which it is the round-off of a rigid motion.
const SMALLEST_DEFORMATION: f64 = 1e-14;

/// An [`ElementMatrix`] by the few ways in which its element deforms, a rod and a shear panel in one, a membrane in five or, warped,
/// six:
///
/// $$ K_e = \sum_r k_r w_r w_r^t $$
///
/// Cholesky steps with pivots find them, $k_r$ the pivot and $w_r$ its column with a one there, down to $10^{-14}$ of the largest
/// entry: less is the round-off of a rigid motion. For an indefinite matrix, which elasticity does not make, eigenvalues and
/// eigenvectors are taken instead.
#[derive(Debug, Clone, PartialEq)]
pub struct Deformations {
    label: usize,
    dof: Vec<usize>,
    /// The $k_r$, lbf/in.
    stiffness: Vec<f64>,
    /// The $w_r$ one behind the other.
    shapes: Vec<f64>,
}

impl Deformations {
    /// The ways in which an element deforms.
    ///
    /// # Errors
    /// [`Error::WrongShape`] and [`Error::Value`] for a stiffness that does not fit the DOF, or is not symmetric and finite.
    ///
    /// # Example
    ///
    /// ```rust
    /// use corfem::chain::rods;
    /// use corfem::method::appendix_a::element_matrices;
    /// use corfem::sparse::Deformations;
    ///
    /// let structure = rods(&[100.0, 50.0], [true, false])?;
    /// let rod = element_matrices(&structure).last().expect("two rods");
    /// let found = Deformations::of(&rod)?;
    /// assert_eq!((found.count(), found.matrix()), (1, rod));
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn of(element: &ElementMatrix) -> Result<Self, Error> {
        let ElementMatrix { label, dof, unit } = element;
        check_shape("element stiffness", unit, dof.len(), dof.len())?;
        check_symmetric("element stiffness", unit)?;
        let mut rest = unit.as_slice().to_vec();
        // The largest entry of a semidefinite matrix stands on its diagonal.
        let smallest = SMALLEST_DEFORMATION * unit.diagonal().amax();
        let (mut stiffness, mut shapes, mut column) = (Vec::new(), Vec::new(), Vec::new());
        while let Some(pivot) = take_deformation(&mut rest, dof.len(), smallest, &mut column) {
            stiffness.push(pivot);
            shapes.extend(column.iter().map(|entry| entry / pivot));
        }
        if rest.iter().any(|entry| entry.abs() > smallest) {
            let (values, vectors) = symmetric_eigen("element stiffness", unit)?;
            (stiffness, shapes) = (values.data.into(), vectors.data.into());
        }
        shapes.shrink_to_fit();
        Ok(Self {
            label: *label,
            dof: dof.clone(),
            stiffness,
            shapes,
        })
    }

    /// The element's number.
    pub fn label(&self) -> usize {
        self.label
    }

    /// Rows among the free DOF.
    pub fn dof(&self) -> &[usize] {
        &self.dof
    }

    /// The element at those of its rows that are among some, ascending, and counted there.
    pub(super) fn at_rows(&self, rows: &[usize]) -> Self {
        let places: Vec<_> = self
            .dof
            .iter()
            .map(|row| rows.binary_search(row).ok())
            .collect();
        let kept = |(place, motion): (&Option<usize>, &f64)| place.map(|_| *motion);
        let of_way = |(_, shape): (f64, &[f64])| {
            places
                .iter()
                .zip(shape)
                .filter_map(kept)
                .collect::<Vec<_>>()
        };
        Self {
            label: self.label,
            stiffness: self.stiffness.clone(),
            shapes: self.ways().flat_map(of_way).collect(),
            dof: places.iter().copied().flatten().collect(),
        }
    }

    /// Number of ways in which the element deforms.
    pub fn count(&self) -> usize {
        self.stiffness.len()
    }

    /// Every $k_r$ with its $w_r$.
    fn ways(&self) -> impl Iterator<Item = (f64, &[f64])> {
        let shapes = self.shapes.chunks_exact(self.dof.len().max(1));
        self.stiffness.iter().copied().zip(shapes)
    }

    /// The element by its matrix again.
    pub fn matrix(&self) -> ElementMatrix {
        let mut unit = DMatrix::zeros(self.dof.len(), self.dof.len());
        for (stiffness, shape) in self.ways() {
            let shape = DVector::from_column_slice(shape);
            unit.syger(stiffness, &shape, &shape, 1.0);
        }
        unit.fill_upper_triangle_with_lower_triangle();
        ElementMatrix {
            label: self.label,
            dof: self.dof.clone(),
            unit,
        }
    }
}

/// Subtracts $a a^t/p$ from a symmetric matrix, with its largest pivot $p$ and the column $a$ of it, and returns the pivot, if one
/// is left.
pub(super) fn take_deformation(
    matrix: &mut [f64],
    order: usize,
    smallest: f64,
    column: &mut Vec<f64>,
) -> Option<f64> {
    let diagonal = |at: usize| matrix[at * (order + 1)];
    // Ties go to the first.
    let pivot = (0..order)
        .rev()
        .max_by(|&a, &b| diagonal(a).total_cmp(&diagonal(b)))?;
    let value = Some(diagonal(pivot)).filter(|value| *value > smallest && value.is_finite())?;
    column.clear();
    column.extend_from_slice(&matrix[pivot * order..][..order]);
    for (entries, factor) in matrix
        .chunks_exact_mut(order)
        .zip(column.iter())
        .filter(|(_, factor)| **factor != 0.0)
    {
        // The quotient first: the product of two entries may leave the range of numbers, and the pivot would not vanish.
        let part = factor / value;
        entries
            .iter_mut()
            .zip(column.iter())
            .for_each(|(entry, of)| *entry -= of * part);
    }
    Some(value)
}
