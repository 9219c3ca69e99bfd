//! Models of elements at all their degrees of freedom.

use corfem::method::appendix_a::{ElementMatrix, element_matrices};
use corfem::method::error::Error;
use corfem::method::model::{FiniteElementModel, Parameter};
use corfem::method::step::Bounds;
use corfem::method::structure::Structure;
use corfem::sparse::elements::{lumped_masses, support};
use corfem::sparse::{SparseMatrix, WholeModel, WholeParameter, WholeShare};
use nalgebra::DMatrix;
use std::collections::HashMap;

/// A finite element model at all its structural degrees of freedom, and the matrix $T^t$ that reads its dynamic ones.
///
/// # Errors
/// What [`of_elements`] refuses.
pub fn of(model: &FiniteElementModel) -> Result<(WholeModel, SparseMatrix), Error> {
    let t = SparseMatrix::of_dense("load distribution", model.load_distribution())?;
    let whole = of_elements(
        model.structure(),
        &t,
        model.mass(),
        model.parameters(),
        &model.factor_ranges()?,
    )?;
    Ok((whole, t.transposed()))
}

/// Elements with their lumped masses and those of points that may move as one with others, $M = \sum_e M_e + T M_{points} T^t$; it may
/// hang free.
///
/// # Errors
/// What [`WholeModel::new`] refuses.
pub fn of_elements(
    structure: &Structure,
    t: &SparseMatrix,
    points: &DMatrix<f64>,
    parameters: &[Parameter],
    ranges: &[Option<Bounds>],
) -> Result<WholeModel, Error> {
    let (all, count) = (structure.elements(), structure.free_dof().len());
    let matrices: Vec<_> = element_matrices(structure).collect();
    let entries = |ElementMatrix { dof, unit, .. }: &ElementMatrix, size: f64| {
        let places = (0..dof.len()).flat_map(|a| (0..dof.len()).map(move |b| (a, b)));
        let entry = |(a, b)| (dof[a], dof[b], size * unit[(a, b)]);
        places.map(entry).collect::<Vec<_>>()
    };
    let stiffness = matrices.iter().zip(all);
    let stiffness = stiffness.flat_map(|(matrix, element)| entries(matrix, element.size));
    let row_of: HashMap<usize, usize> = all.iter().map(|element| element.label).zip(0..).collect();
    let parameter = |(parameter, &range): (&Parameter, &Option<Bounds>)| {
        let rows = parameter.elements.iter().map(|label| row_of[label]);
        let share = rows.flat_map(|row| entries(&matrices[row], all[row].size));
        let share = SparseMatrix::new("share", count, count, share.collect())?;
        Ok(WholeParameter {
            name: parameter.name.clone(),
            share: WholeShare::Stiffness(share),
            range,
        })
    };
    let parameters = parameters.iter().zip(ranges).map(parameter);
    let motion = |column: usize| t.entries().filter(move |entry| entry.1 == column);
    let coupled = (0..t.columns()).flat_map(|i| (0..t.columns()).map(move |j| (i, j)));
    let mass = coupled
        .filter(|&at| points[at] != 0.0)
        .flat_map(|(i, j)| motion(i).flat_map(move |a| motion(j).map(move |b| (i, j, a, b))))
        .map(|(i, j, a, b)| (a.0, b.0, points[(i, j)] * a.2 * b.2));
    let lumped = all.iter().zip(structure.corners());
    let lumped = lumped.flat_map(|(element, own)| lumped_masses(structure, element, own));
    let mass = mass.chain(lumped.map(|(row, mass)| (row, row, mass)));
    let sparse = |what, entries| SparseMatrix::new(what, count, count, entries);
    let (stiffness, mass) = (stiffness.collect(), mass.collect());
    WholeModel::supported(
        sparse("stiffness", stiffness)?,
        sparse("mass", mass)?,
        parameters.collect::<Result<_, Error>>()?,
        support(structure, &matrices)?,
    )
}
