//! Whole models made of elements.

use super::LargeModel;
use super::{SparseMatrix, WholeModel, WholeParameter, WholeShare};
use crate::method::assembly::{ElementMatrix, stiffness_entries};
use crate::method::error::Error;
use crate::method::model::Scaled;

/// The entries (row, column, value) of an element's lumped mass for its size.
pub(crate) fn mass_entries(element: &ElementMatrix, size: f64) -> Vec<(usize, usize, f64)> {
    element
        .dof
        .iter()
        .zip(&element.unit_mass)
        .map(|(&row, unit)| (row, row, size * unit))
        .collect()
}

/// Those of $m t_1 t_2^t$, a mass that couples two motions of the degrees of freedom, or is that of one.
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

impl WholeModel {
    /// A finite element model at all its structural degrees of freedom, and the matrix $T^t$ that reads its dynamic ones:
    ///
    /// $$ K = \sum_e s_e K_e, \qquad M = T M_{points} T^t + \sum_e s_e M_e . $$
    ///
    /// It may hang free. Point masses of parameters are those of the model's own law ([`crate::method::model::ScaledStructure`]).
    ///
    /// # Errors
    /// Those of [`ScaledStructure::factor_ranges`](crate::method::model::ScaledStructure::factor_ranges) and [`WholeModel::new`].
    pub fn of(model: &LargeModel) -> Result<(Self, SparseMatrix), Error> {
        let (elements, structure, t) = (
            model.element_matrices(),
            model.structure(),
            model.load_distribution().columns(),
        );
        let (count, points) = (structure.free_dof().len(), model.mass());
        let size = |row: usize| structure.elements()[row].size;
        let stiffness = |row: usize| stiffness_entries(&elements[row], size(row));
        let lumped = |row: usize| mass_entries(&elements[row], size(row));
        let moving = |(i, j): (usize, usize)| moving_mass_entries(&t[i], &t[j], points[(i, j)]);
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
                    rows.map(|row| (elements[row].clone(), size(row))).collect(),
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
        let couplings = (0..t.len())
            .flat_map(|i| (0..t.len()).map(move |j| (i, j)))
            .filter(|&at| points[at] != 0.0);
        let mass = (0..elements.len())
            .flat_map(lumped)
            .chain(couplings.flat_map(moving))
            .collect();
        let stiffness = (0..elements.len()).flat_map(stiffness).collect();
        let (stiffness, mass) = (sparse("stiffness", stiffness)?, sparse("mass", mass)?);
        let whole = Self::new(stiffness, mass, parameters.collect::<Result<_, Error>>()?)?;
        let sensors = t
            .iter()
            .enumerate()
            .flat_map(|(i, terms)| terms.iter().map(move |&(dof, term)| (i, dof, term)));
        Ok((
            whole,
            SparseMatrix::new("sensors", t.len(), count, sensors.collect())?,
        ))
    }
}
