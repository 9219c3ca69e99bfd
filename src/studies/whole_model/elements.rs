//! Whole models made of elements.

use super::{SparseMatrix, WholeModel, WholeParameter, WholeShare};
use crate::method::assembly::ElementMatrix;
use crate::method::error::Error;
use crate::method::model::{FiniteElementModel, Scaled};

/// The entries (row, column, value) of an element's stiffness for its size.
pub(crate) fn stiffness_entries(element: &ElementMatrix, size: f64) -> Vec<(usize, usize, f64)> {
    let count = element.dof.len();
    let places = (0..count).flat_map(|b| (0..count).map(move |a| (a, b)));
    places.map(|(a, b)| (element.dof[a], element.dof[b], size * element.unit[(a, b)])).collect()
}

/// Those of its lumped mass.
pub(crate) fn mass_entries(element: &ElementMatrix, size: f64) -> Vec<(usize, usize, f64)> {
    element.dof.iter().zip(&element.unit_mass).map(|(&row, unit)| (row, row, size * unit)).collect()
}

/// Those of $m t_1 t_2^t$, a mass that couples two motions of the degrees of freedom, or is that of one.
pub(crate) fn moving_mass_entries(
    motion: &[(usize, f64)],
    other: &[(usize, f64)],
    mass: f64,
) -> Vec<(usize, usize, f64)> {
    let pairs = motion.iter().flat_map(|a| other.iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| (a.0, b.0, mass * a.1 * b.1)).collect()
}

impl WholeModel {
    /// A finite element model at all its structural degrees of freedom, and the matrix $T^t$ that reads its dynamic ones:
    ///
    /// $$ K = \sum_e s_e K_e, \qquad M = T M_{points} T^t + \sum_e s_e M_e . $$
    ///
    /// It may hang free. Point masses of parameters are those of the model's own law ([`FiniteElementModel`]).
    ///
    /// # Errors
    /// Those of [`FiniteElementModel::factor_ranges`] and [`WholeModel::new`].
    pub fn of(model: &FiniteElementModel) -> Result<(Self, SparseMatrix), Error> {
        let (elements, structure) = (model.element_matrices(), model.structure());
        let count = structure.free_dof().len();
        let sizes: Vec<f64> = structure.elements().iter().map(|element| element.size).collect();
        let (t, points) =
            (model.load_distribution().columns(), model.point_masses(&vec![1.0; model.parameters().len()])?);
        let sparse = |what, entries| SparseMatrix::new(what, count, count, entries);
        let couplings = (0..t.len()).flat_map(|i| (0..t.len()).map(move |j| (i, j))).filter(|&at| points[at] != 0.0);
        let moving = couplings.flat_map(|at| moving_mass_entries(&t[at.0], &t[at.1], points[at]));
        let all = || elements.iter().zip(&sizes);
        let stiffness = all().flat_map(|(element, &size)| stiffness_entries(element, size)).collect();
        let lumped = all().flat_map(|(element, &size)| mass_entries(element, size));
        let mass = lumped.chain(moving).collect();
        let parameters = model.parameters().iter().zip(model.rows()).zip(model.factor_ranges()?);
        let parameters = parameters.map(|((parameter, rows), range)| {
            let of = |entries_of: &dyn Fn(usize) -> Vec<(usize, usize, f64)>| {
                sparse("matrix of a parameter", rows.iter().flat_map(|&row| entries_of(row)).collect())
            };
            let share = match parameter.scaled {
                Scaled::Stiffness => WholeShare::Stiffness(of(&|row| stiffness_entries(&elements[row], sizes[row]))?),
                Scaled::ElementMass => WholeShare::Mass(of(&|row| mass_entries(&elements[row], sizes[row]))?),
                Scaled::PointMass => {
                    WholeShare::Mass(of(&|dof| moving_mass_entries(&t[dof], &t[dof], points[(dof, dof)]))?)
                }
            };
            Ok(WholeParameter { name: parameter.name.clone(), share, range })
        });
        let whole = Self::new(
            sparse("stiffness", stiffness)?,
            sparse("mass", mass)?,
            parameters.collect::<Result<_, Error>>()?,
        )?;
        let sensors = t.iter().enumerate().flat_map(|(i, terms)| terms.iter().map(move |&(dof, term)| (i, dof, term)));
        Ok((whole, SparseMatrix::new("sensors", t.len(), count, sensors.collect())?))
    }
}
