//! Whole models made of elements.

use super::{Deformations, LargeModel};
use super::{SparseMatrix, WholeModel, WholeParameter, WholeShare};
use crate::method::assembly::{ElementMatrix, stiffness_entries};
use crate::method::elements::unit_stiffness;
use crate::method::error::Error;
use crate::method::model::Scaled;
use crate::method::structure::Structure;

/// The entries (row, column, value) of an element's lumped mass for its size.
pub(crate) fn mass_entries(element: &ElementMatrix, size: f64) -> Vec<(usize, usize, f64)> {
    element
        .dof
        .iter()
        .zip(&element.unit_mass)
        .map(|(&row, unit)| (row, row, size * unit))
        .collect()
}

/// Entries of $m t_1 t_2^t$: a mass that couples two motions of the degrees of freedom, or moves with one.
pub(crate) fn moving_mass_entries(
    motion: &[(usize, f64)],
    other: &[(usize, f64)],
    mass: f64,
) -> Vec<(usize, usize, f64)> {
    let pairs = motion
        .iter()
        .flat_map(|a| other.iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| (a.0, b.0, mass * a.1 * b.1)).collect()
}

/// Each element's stiffness in units of its own largest entry, summed over the structure. Every $K_e$ is semidefinite, so that the null
/// space is that of any $\sum_e s_e K_e$,
///
/// $$ v^t K v = \sum_e s_e v^t K_e v = 0 \quad \text{if and only if} \quad K_e v = 0 \text{ for all } e, $$
///
/// and no element is stiffer than another. The largest entry is that of the element free of supports; entries at the free ones that
/// are only the round-off of its direction are dropped.
///
/// # Errors
/// The errors of [`SparseMatrix::new`] for entries beyond the range of numbers.
pub(crate) fn resisting(
    structure: &Structure,
    elements: &[ElementMatrix],
) -> Result<SparseMatrix, Error> {
    let count = structure.free_dof().len();
    let whole = structure.elements().iter().zip(structure.geometry());
    let parts = elements
        .iter()
        .zip(whole)
        .flat_map(|(matrix, (element, geometry))| {
            let largest = unit_stiffness(geometry, &element.material)
                .amax()
                .max(matrix.unit.amax());
            let parts = stiffness_entries(matrix, 1.0 / largest);
            parts
                .into_iter()
                .filter(|entry| entry.2.abs() > 4.0 * f64::EPSILON)
        });
    SparseMatrix::new("stiffness of the elements", count, count, parts.collect())
}

impl WholeModel {
    /// A finite element model at all its structural degrees of freedom, and the matrix $T^t$ that reads its dynamic ones:
    ///
    /// $$ K = \sum_e s_e K_e, \qquad M = T M_{points} T^t + \sum_e s_e M_e . $$
    ///
    /// It may hang free. Point masses of parameters are those of the model's own law ([`crate::method::model::ScaledStructure`]).
    ///
    /// # Errors
    /// The errors of [`ScaledStructure::factor_ranges`](crate::method::model::ScaledStructure::factor_ranges) for the parameters,
    /// and of [`WholeModel::new`].
    pub fn of(model: &LargeModel) -> Result<(Self, SparseMatrix), Error> {
        let elements: Vec<ElementMatrix> =
            model.elements().iter().map(Deformations::matrix).collect();
        let (structure, t) = (model.structure(), model.load_distribution());
        let (count, points) = (structure.free_dof().len(), model.mass());
        let size = |row: usize| structure.elements()[row].size;
        let stiffness = |row: usize| stiffness_entries(&elements[row], size(row));
        let lumped = |row: usize| mass_entries(&elements[row], size(row));
        let moving = |(i, j): (usize, usize)| {
            moving_mass_entries(&t.motion(i), &t.motion(j), points[(i, j)])
        };
        let sparse = |what, entries| SparseMatrix::new(what, count, count, entries);
        let parameters = model
            .parameters()
            .iter()
            .zip(model.rows())
            .zip(model.factor_ranges()?);
        let parameters = parameters.map(|((parameter, rows), range)| {
            let (rows, part) = (rows.iter().copied(), |entries| {
                sparse("matrix of a parameter", entries)
            });
            let share = match parameter.scaled {
                Scaled::Stiffness => WholeShare::Elements(
                    rows.map(|row| (model.elements()[row].clone(), size(row)))
                        .collect(),
                ),
                Scaled::ElementMass => WholeShare::Mass(part(rows.flat_map(lumped).collect())?),
                Scaled::PointMass => {
                    WholeShare::Mass(part(rows.flat_map(|dof| moving((dof, dof))).collect())?)
                }
            };
            Ok(WholeParameter {
                name: parameter.name.clone(),
                share,
                range,
            })
        });
        let couplings = (0..t.columns())
            .flat_map(|i| (0..t.columns()).map(move |j| (i, j)))
            .filter(|&at| points[at] != 0.0);
        let mass = (0..elements.len())
            .flat_map(lumped)
            .chain(couplings.flat_map(moving))
            .collect();
        let stiffness = (0..elements.len()).flat_map(stiffness).collect();
        let (stiffness, mass) = (sparse("stiffness", stiffness)?, sparse("mass", mass)?);
        let whole = Self::new(stiffness, mass, parameters.collect::<Result<_, Error>>()?)?
            .with_resisting(resisting(structure, &elements)?)?;
        Ok((whole, t.transposed()))
    }
}
