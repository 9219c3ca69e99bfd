//! Whole models of springs and masses as sparse matrices.

use crate::prelude::*;

/// A matrix by the entries that are not zero.
///
/// # Errors
/// Those of [`SparseMatrix::new`].
pub fn sparse(matrix: &DMatrix<f64>) -> Result<SparseMatrix, Error> {
    SparseMatrix::of_dense("matrix", matrix)
}

/// The lowest vibrations of two matrices.
///
/// # Errors
/// Those of [`WholeModel::modes`].
pub fn lowest_modes(
    stiffness: &SparseMatrix,
    mass: &SparseMatrix,
    count: usize,
) -> Result<CountedModes, Error> {
    WholeModel::new(stiffness.clone(), mass.clone(), Vec::new())?.modes(&[], count)
}

/// The motions that a stiffness leaves free.
///
/// # Errors
/// Those of [`WholeModel::rigid_bodies`].
pub fn free_motions(stiffness: &SparseMatrix, support: &Support) -> Result<RigidBodies, Error> {
    let mass = masses(&vec![1.0; stiffness.rows()]);
    let whole = WholeModel::supported(stiffness.clone(), mass, Vec::new(), support.clone())?;
    whole.rigid_bodies().cloned()
}

/// All modes of finite frequency.
///
/// # Errors
/// Those of [`lowest_modes`].
pub fn counted_modes(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> Result<CountedModes, Error> {
    let (stiffness, mass) = (sparse(stiffness)?, sparse(mass)?);
    match lowest_modes(&stiffness, &mass, stiffness.rows()) {
        Err(Error::Count {
            what: FINITE,
            most: available,
            ..
        }) => lowest_modes(&stiffness, &mass, available),
        found => found,
    }
}

/// The stiffness of springs between degrees of freedom (two, or one and the ground).
pub fn springs(count: usize, springs: &[(usize, Option<usize>, f64)]) -> SparseMatrix {
    let entries = springs.iter().flat_map(|&(a, b, k)| match b {
        Some(b) => vec![(a, a, k), (b, b, k), (a, b, -k), (b, a, -k)],
        None => vec![(a, a, k)],
    });
    SparseMatrix::new("stiffness", count, count, entries.collect()).unwrap()
}

/// Equal springs in a row between points.
pub fn chain_of_springs(ends: ChainEnds, count: usize, spring: f64) -> SparseMatrix {
    let mut all = (1..count)
        .map(|row| (row, Some(row - 1), spring))
        .collect_vec();
    match ends {
        ChainEnds::FreeFree => {}
        ChainEnds::FixedFree => all.push((0, None, spring)),
        ChainEnds::FixedFixed => all.extend([(0, None, spring), (count - 1, None, spring)]),
    }
    springs(count, &all)
}

/// A diagonal mass.
pub fn masses(values: &[f64]) -> SparseMatrix {
    let entries = values
        .iter()
        .enumerate()
        .map(|(row, &value)| (row, row, value));
    SparseMatrix::new("mass", values.len(), values.len(), entries.collect()).unwrap()
}

/// A building of as many stories as stiffnesses, one mass a floor, each story a parameter.
pub fn shear_building(stories: &[f64], mass: f64, range: Option<Bounds>) -> WholeModel {
    let count = stories.len();
    let story = |floor: usize| (floor, floor.checked_sub(1), stories[floor]);
    let parameters = (0..count).map(|floor| WholeParameter {
        name: format!("story {}", floor + 1),
        share: WholeShare::Stiffness(springs(count, &[story(floor)])),
        range,
    });
    let all = (0..count).map(story).collect_vec();
    WholeModel::new(
        springs(count, &all),
        masses(&vec![mass; count]),
        parameters.collect(),
    )
    .unwrap()
}

/// Modes of a whole model as sensors see them.
pub fn seen_by(sensors: &SparseMatrix, modes: &Modes) -> Modes {
    let shapes = sensors.times(modes.shapes()).unwrap();
    Modes::new(modes.omega_squared().clone(), shapes).unwrap()
}

/// Sensors that read single degrees of freedom.
pub fn sensors_at(rows: &[usize], count: usize) -> SparseMatrix {
    let entries = rows
        .iter()
        .enumerate()
        .map(|(sensor, &row)| (sensor, row, 1.0))
        .collect();
    SparseMatrix::new("sensors", rows.len(), count, entries).unwrap()
}

/// A model of dense matrices with every part as a parameter, and sensors at all its degrees of freedom.
///
/// # Errors
/// What [`WholeModel::new`] refuses.
pub fn of_dense(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    shares: &[ParameterMatrix],
) -> Result<(WholeModel, SparseMatrix), Error> {
    use corfem::sparse::Share::{Mass, Stiffness};
    let parameter = |(place, share): (usize, &ParameterMatrix)| {
        Ok(WholeParameter {
            name: place.to_string(),
            share: match share {
                Stiffness(matrix) => WholeShare::Stiffness(sparse(matrix)?),
                Mass(matrix) => WholeShare::Mass(sparse(matrix)?),
            },
            range: None,
        })
    };
    let parameters = shares.iter().enumerate().map(parameter);
    let parameters = parameters.collect::<Result<_, Error>>()?;
    let whole = WholeModel::new(sparse(stiffness)?, sparse(mass)?, parameters)?;
    let sensors = sparse(&eye(mass.nrows()))?;
    Ok((whole, sensors))
}
