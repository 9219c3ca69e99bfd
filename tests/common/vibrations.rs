//! Strategies of vibrating systems: pencils, modal problems under a change, chains of springs; and the slow, obvious
//! ways of computing what the crate computes, through nalgebra where the crate goes through faer.

use crate::prelude::*;

/// Stiffness and mass of 1 to 6 DOF with the mass's condition number. The stiffness has condition numbers up to
/// 1e10, as stiff and soft elements in one structure give; masses up to 1e4, which is a wide structure.
pub fn pencil() -> impl Strategy<Value = (DMatrix<f64>, DMatrix<f64>, f64)> {
    (1..=6_usize).prop_flat_map(|size| {
        (positive_definite(size, 10.0), positive_definite(size, 4.0)).prop_map(
            |((stiffness, _), (mass, exponents))| {
                let span = exponents.iter().fold(0.0_f64, |a, &b| a.max(b))
                    - exponents.iter().fold(f64::INFINITY, |a, &b| a.min(b));
                (stiffness, mass, 10f64.powf(span))
            },
        )
    })
}

/// A change of stiffness in modal coordinates: $k$ and the direction $S$ of $\beta = \varepsilon S$.
#[derive(Debug, Clone)]
pub struct Change {
    /// Generalized stiffness, rad²/s².
    pub stiffness: DVector<f64>,
    /// Direction of the change, symmetric, rad²/s².
    pub direction: DMatrix<f64>,
}

impl Change {
    /// β for a size ε of the change.
    pub fn beta(&self, size: f64) -> DMatrix<f64> {
        size * &self.direction
    }
}

/// Generalized stiffnesses from 100 rad²/s² up, each 2 to 4 times the one before: separate roots, so that orders of
/// convergence show at changes of a few percent.
pub fn separated_spectrum(size: usize) -> impl Strategy<Value = DVector<f64>> {
    prop::collection::vec(2.0..4.0_f64, size).prop_map(|ratios| {
        let mut value = 50.0;
        DVector::from_iterator(
            ratios.len(),
            ratios.into_iter().map(|ratio| {
                value *= ratio;
                value
            }),
        )
    })
}

/// Any symmetric change of 1 to 5 modes, up to three times their stiffness: far beyond where the perturbation holds.
pub fn any_change() -> impl Strategy<Value = Change> {
    (1..=5_usize).prop_flat_map(|size| {
        (separated_spectrum(size), super::strategies::symmetric(size)).prop_map(
            |(stiffness, entries)| {
                let direction = DMatrix::from_fn(stiffness.len(), stiffness.len(), |i, j| {
                    3.0 * entries[(i, j)] * (stiffness[i] * stiffness[j]).sqrt()
                });
                Change {
                    stiffness,
                    direction,
                }
            },
        )
    })
}

/// A chain of masses from the ground on: spring 0 to the ground, spring s between masses s − 1 and s. Every spring is
/// a parameter. Its modes are always separate, because its matrices are tridiagonal.
#[derive(Debug, Clone)]
pub struct Chain {
    /// Spring stiffnesses, lbf/in.
    pub springs: Vec<f64>,
    /// Masses, lbf·s²/in.
    pub masses: Vec<f64>,
}

impl Chain {
    /// A chain of `count` springs of 1000 lbf/in and masses of 0.01 lbf·s²/in.
    pub fn uniform(count: usize) -> Self {
        Self {
            springs: vec![1000.0; count],
            masses: vec![0.01; count],
        }
    }

    /// The mass matrix, lbf·s²/in.
    pub fn mass(&self) -> DMatrix<f64> {
        DMatrix::from_diagonal(&DVector::from_column_slice(&self.masses))
    }

    /// The model with its springs multiplied by factors: the analysis of a structure whose B never changes.
    pub fn model(&self, factors: &[f64]) -> DynamicModel {
        let count = self.masses.len();
        let shares = (0..count)
            .map(|s| spring_stiffness(count, s, factors[s] * self.springs[s]))
            .collect_vec();
        DynamicModel {
            stiffness: shares.iter().sum(),
            mass: self.mass(),
            shares,
        }
    }

    /// All exact modes with its springs multiplied by factors.
    pub fn modes(&self, factors: &[f64]) -> Modes {
        let model = self.model(factors);
        solve(&model.stiffness, &model.mass, self.masses.len()).unwrap()
    }
}

/// A chain of `count` springs and masses that differ by a factor of two at most.
pub fn chain(count: usize) -> impl Strategy<Value = Chain> {
    (
        prop::collection::vec(1000.0..2000.0_f64, count),
        prop::collection::vec(0.01..0.02_f64, count),
    )
        .prop_map(|(springs, masses)| Chain { springs, masses })
}

/// A chain of three to five masses, and the factors on its springs that its test modes have: each 10 to 40 % off, up
/// or down, so that the error sum is well away from zero, where it has a kink.
pub fn chain_and_truth() -> impl Strategy<Value = (Chain, Vec<f64>)> {
    (3..=5_usize).prop_flat_map(|count| {
        let factor = (1.1..1.4_f64, any::<bool>())
            .prop_map(|(factor, soft)| if soft { 1.0 / factor } else { factor });
        (chain(count), prop::collection::vec(factor, count))
    })
}

/// Squared circular frequencies (ascending) and mass-orthonormal shapes through nalgebra: M^(−1/2) from M's own
/// eigenvectors, then the symmetric eigenproblem of M^(−1/2) K M^(−1/2).
pub fn modes_by_nalgebra(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
) -> (DVector<f64>, DMatrix<f64>) {
    let of_mass = mass.clone().symmetric_eigen();
    let root = DMatrix::from_diagonal(&of_mass.eigenvalues.map(|value| 1.0 / value.sqrt()));
    let inverse_root = &of_mass.eigenvectors * root * of_mass.eigenvectors.transpose();
    let reduced = &inverse_root * stiffness * &inverse_root;
    let eigen = (0.5 * (&reduced + reduced.transpose())).symmetric_eigen();
    let mut order = (0..stiffness.nrows()).collect_vec();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    (
        eigen.eigenvalues.select_rows(&order),
        inverse_root * eigen.eigenvectors.select_columns(&order),
    )
}

/// The error sum written from its definition on all exact modes through nalgebra, paired and signed by their
/// mass-weighted products.
pub fn error_sum_by_definition(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>, test: &Modes) -> f64 {
    let (omega_squared, shapes) = modes_by_nalgebra(stiffness, mass);
    let cross = shapes.transpose() * mass * test.shapes();
    let (mut frequency, mut shape) = (0.0, 0.0);
    for (j, i) in pairs_by_sorting(&cross).into_iter().enumerate() {
        let (analysis, measured) = (shapes.column(i), test.shapes().column(j));
        frequency += (omega_squared[i].sqrt() / test.omega_squared()[j].sqrt() - 1.0).powi(2);
        let sign = cross[(i, j)].signum();
        let difference = sign * analysis / analysis.amax() - measured / measured.amax();
        shape += difference.norm_squared() / difference.len() as f64;
    }
    frequency.sqrt() + shape.sqrt()
}
