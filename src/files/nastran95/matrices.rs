//! From a model to the deck of one analysis, and from NASTRAN's matrices back to the model's.

use super::Matrices;
use crate::files::deck::BulkData;
use crate::files::error::FileError;
use crate::method::assembly::{dense_stiffness, lumped_mass};
use crate::method::error::Error;
use crate::method::model::FiniteElementModel;
use crate::method::structure::{Element, Grid, Structure};
use nalgebra::DMatrix;
use std::collections::HashMap;

/// DOF of a grid in KGG: translations, then rotations.
const GRID_DOF: usize = 6;
/// KAA and the sum of the element matrices are the same numbers added in another order.
const LARGEST_STIFFNESS_DIFFERENCE: f64 = 1e-9;
/// NASTRAN-95 holds masses in single precision.
const LARGEST_MASS_DIFFERENCE: f64 = 1e-6;

/// The model with every element a second time, alone, on fixed grids of its own after all others.
pub(super) fn with_single_elements(bulk: &BulkData) -> BulkData {
    let mut all = bulk.clone();
    let base = bulk.first_free_label();
    let position: HashMap<usize, _> = bulk.grids.iter().map(|grid| (grid.label, grid.position)).collect();
    for (row, element) in bulk.elements.iter().enumerate() {
        let first = base + all.grids.len() - bulk.grids.len();
        let corners = element.grids.iter().filter_map(|grid| position.get(grid));
        let corners = (first..).zip(corners);
        all.grids.extend(corners.map(|(label, &position)| Grid { label, position, constrained: [true; 3] }));
        let grids = (first..).take(element.grids.len()).collect();
        all.elements.push(Element { label: base + row, grids, ..element.clone() });
    }
    all
}

/// Entries that KGG, KAA and MAA have at most.
pub(super) fn numbers_in_answer(bulk: &BulkData) -> usize {
    let size = GRID_DOF.saturating_mul(bulk.grids.len());
    size.saturating_mul(size).saturating_mul(3)
}

/// Unit stiffness of every element at its free DOF, in the order of the model's structure, from the blocks of KGG.
pub(super) fn unit_stiffness(
    model: &FiniteElementModel,
    bulk: &BulkData,
    answer: &Matrices,
) -> Result<Vec<DMatrix<f64>>, FileError> {
    let mut block_of = HashMap::new();
    let mut start = GRID_DOF * bulk.grids.len();
    for element in &bulk.elements {
        block_of.insert(element.label, (start, element.size));
        start += GRID_DOF * element.grids.len();
    }
    let kgg = matrix(answer, "KGG", start)?;
    let structure = model.structure();
    let unit = |element: &Element| {
        let unknown = || Error::Unknown { owner: "the deck".into(), what: "element", label: element.label };
        let &(start, size) = block_of.get(&element.label).ok_or_else(unknown)?;
        let rows = free_rows(structure, element, start);
        Ok(kgg.select_rows(&rows).select_columns(&rows) / size)
    };
    structure.elements().iter().map(unit).collect()
}

/// Rows of KGG of an element's free DOF, its own grids beginning at `start`.
fn free_rows(structure: &Structure, element: &Element, start: usize) -> Vec<usize> {
    let corners = element.grids.iter().enumerate();
    corners
        .flat_map(|(corner, &grid)| (0..3).map(move |direction| (corner, grid, direction)))
        .filter(|&(_, grid, direction)| structure.free_dof_index(grid, direction).is_some())
        .map(|(corner, _, direction)| start + GRID_DOF * corner + direction)
        .collect()
}

/// Refuses an answer whose assembled matrices are not those of the model it was asked about: elements are told apart by
/// their place in KGG alone, and this check is what makes that safe.
pub(super) fn check_assembled(model: &FiniteElementModel, factors: &[f64], answer: &Matrices) -> Result<(), FileError> {
    let free = model.structure().free_dof();
    let sizes = model.sizes(factors)?;
    let stiffness = dense_stiffness(model.element_matrices(), &sizes, free.len())?;
    let t = model.load_distribution().dense();
    let lumped = lumped_mass(model.element_matrices(), &model.mass_sizes(factors)?, free.len())?;
    let mass = &t * model.point_masses(factors)? * t.transpose() + DMatrix::from_diagonal(&lumped);
    // NASTRAN's order is that of the grids' numbers.
    let mut order: Vec<usize> = (0..free.len()).collect();
    order.sort_by_key(|&row| (free[row].grid, free[row].direction));
    let same = |name: &str, meaning: &str, here: DMatrix<f64>, limit: f64| {
        let there = matrix(answer, name, free.len())?;
        let here = here.select_rows(&order).select_columns(&order);
        let difference = (there - &here).amax() / here.amax();
        let expected = || format!("{name} to be {meaning} within {limit:.0e} of its largest entry");
        let wrong = || FileError::answer(expected(), format!("them {difference:.1e} apart"));
        (difference <= limit).then_some(()).ok_or_else(wrong)
    };
    same("KAA", "the sum of its element matrices", stiffness, LARGEST_STIFFNESS_DIFFERENCE)?;
    same("MAA", "the masses the MPC equations distribute", mass, LARGEST_MASS_DIFFERENCE)
}

fn matrix<'a>(answer: &'a Matrices, name: &str, size: usize) -> Result<&'a DMatrix<f64>, FileError> {
    let found = match answer.get(name) {
        Some(matrix) if matrix.shape() == (size, size) => return Ok(matrix),
        Some(matrix) => format!("{} x {}", matrix.nrows(), matrix.ncols()),
        None => "none".to_owned(),
    };
    Err(FileError::answer(format!("a matrix {name} of {size} rows and columns"), found))
}
