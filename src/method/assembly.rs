//! Assembly of the structural stiffness from unit element matrices.
//! Tour: [chapter 6](crate::tour::chapter_06_condensation).

use crate::method::elements::{corner_volumes, unit_stiffness};
use crate::method::error::Error;
use crate::method::geometry::Geometry;
use crate::method::linear_algebra::{check_length, check_shape};
use crate::method::modes::check_count;
use crate::method::structure::{Element, Structure};
use nalgebra::{DMatrix, DVector};

/// One element's stiffness and mass for unit size at the free structural DOF it touches.
#[derive(Debug, Clone, PartialEq)]
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
pub(crate) fn check_elements(
    elements: &[ElementMatrix],
    sizes: &[f64],
    dof_count: usize,
) -> Result<(), Error> {
    check_length("element sizes", sizes.len(), elements.len())?;
    elements
        .iter()
        .try_for_each(|element| check_element(element, dof_count))
}

/// Refuses an element that does not fit the DOF that there are.
pub(crate) fn check_element(element: &ElementMatrix, dof_count: usize) -> Result<(), Error> {
    let ElementMatrix {
        dof,
        unit,
        unit_mass,
        ..
    } = element;
    check_shape("element stiffness", unit, dof.len(), dof.len())?;
    check_length("element mass", unit_mass.len(), dof.len())?;
    check_dof(dof, dof_count)
}

/// Refuses DOF beyond those that there are.
pub(crate) fn check_dof(dof: &[usize], dof_count: usize) -> Result<(), Error> {
    dof.iter()
        .try_for_each(|&row| check_count("degrees of freedom", row.saturating_add(1), dof_count))
}

/// Unit stiffness and mass of every element, restricted to the free DOF, in the structure's order.
///
/// # Example
///
/// ```rust
/// use corfem::chain::rods;
/// use corfem::method::assembly::element_matrices;
/// use nalgebra::dmatrix;
///
/// // The first rod's end at the wall has no free DOF.
/// let elements = element_matrices(&rods(&[100.0, 50.0], [true, false])?);
/// assert_eq!((elements[0].dof.clone(), elements[0].unit.clone()), (vec![0], dmatrix![1.0]));
/// assert_eq!(elements[1].unit, dmatrix![1.0, -1.0; -1.0, 1.0]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn element_matrices(structure: &Structure) -> Vec<ElementMatrix> {
    element_by_element(structure).collect()
}

/// The same, one after the other.
pub(crate) fn element_by_element(structure: &Structure) -> impl Iterator<Item = ElementMatrix> {
    let of_element = move |(element, geometry): (&Element, &Geometry)| {
        let dof = element.grids.iter().flat_map(|&grid| {
            (0..3).map(move |direction| structure.free_dof_index(grid, direction))
        });
        let (local, dof): (Vec<usize>, Vec<usize>) = dof
            .enumerate()
            .filter_map(|(local, dof)| Some((local, dof?)))
            .unzip();
        let full = unit_stiffness(geometry, &element.material);
        let volumes = corner_volumes(geometry);
        let unit_mass = local
            .iter()
            .map(|&row| element.material.density * volumes[row / 3]);
        ElementMatrix {
            label: element.label,
            unit_mass: DVector::from_iterator(local.len(), unit_mass),
            unit: full.select_rows(&local).select_columns(&local),
            dof,
        }
    };
    let elements = structure.elements().iter();
    elements.zip(structure.geometry()).map(of_element)
}

/// The structural stiffness $K_S = \sum_e s_e K_e$ at the free DOF as a dense matrix, lbf/in.
///
/// `sizes` are the gages (in) and areas (in²) $s_e$, one per element; `dof_count` the number of free DOF.
///
/// # Errors
/// [`Error::WrongShape`], [`Error::TooMany`] for elements that do not fit their sizes or the DOF.
///
/// # Example
///
/// ```rust
/// use corfem::chain::rods;
/// use corfem::method::assembly::{dense_stiffness, element_matrices};
/// use nalgebra::dmatrix;
///
/// let elements = element_matrices(&rods(&[100.0, 50.0], [true, false])?);
/// let stiffness = dense_stiffness(&elements, &[100.0, 50.0], 2)?;
/// assert_eq!(stiffness, dmatrix![150.0, -50.0; -50.0, 50.0]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn dense_stiffness(
    elements: &[ElementMatrix],
    sizes: &[f64],
    dof_count: usize,
) -> Result<DMatrix<f64>, Error> {
    check_elements(elements, sizes, dof_count)?;
    let mut stiffness = DMatrix::zeros(dof_count, dof_count);
    for (row, column, value) in elements
        .iter()
        .zip(sizes)
        .flat_map(|(element, &size)| stiffness_entries(element, size))
    {
        stiffness[(row, column)] += value;
    }
    Ok(stiffness)
}

/// The lumped mass of elements of the given sizes at every free DOF, lbf·s²/in.
///
/// # Errors
/// Those of [`dense_stiffness`].
pub fn lumped_mass(
    elements: &[ElementMatrix],
    sizes: &[f64],
    dof_count: usize,
) -> Result<DVector<f64>, Error> {
    check_elements(elements, sizes, dof_count)?;
    let mut lumped = DVector::zeros(dof_count);
    for (element, size) in elements.iter().zip(sizes) {
        for (&row, unit) in element.dof.iter().zip(&element.unit_mass) {
            lumped[row] += size * unit;
        }
    }
    Ok(lumped)
}

/// Row, column and value of every entry of $s_e K_e$.
pub(crate) fn stiffness_entries(
    element: &ElementMatrix,
    size: f64,
) -> impl Iterator<Item = (usize, usize, f64)> {
    let ElementMatrix { dof, unit, .. } = element;
    let column = move |b| (0..dof.len()).map(move |a| (dof[a], dof[b], size * unit[(a, b)]));
    (0..dof.len()).flat_map(column)
}
