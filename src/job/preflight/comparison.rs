//! Model and test side by side: their cross-orthogonality and how well they agree.

use crate::method::error::Error;
use crate::method::modes::{Modes, solve};
use crate::method::pairing::{Pairing, pair_modes};
use nalgebra::DMatrix;

/// Model and test side by side.
pub(super) struct Comparison<'a> {
    mass: &'a DMatrix<f64>,
    pub analysis: Modes,
    /// $V_F^t M$ (n × d).
    projection: DMatrix<f64>,
}

impl<'a> Comparison<'a> {
    pub fn new(stiffness: &DMatrix<f64>, mass: &'a DMatrix<f64>) -> Result<Self, Error> {
        let analysis = solve(stiffness, mass, mass.nrows())?;
        let projection = analysis.shapes.tr_mul(mass);
        Ok(Self {
            mass,
            analysis,
            projection,
        })
    }

    /// Cross-orthogonality with test shapes of any scale; none for a shape without generalized mass.
    pub fn cross(&self, shapes: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let mut cross = &self.projection * shapes;
        let weighted = self.mass * shapes;
        for (mode, mut column) in cross.column_iter_mut().enumerate() {
            let generalized_mass = shapes.column(mode).dot(&weighted.column(mode));
            if generalized_mass <= 0.0 {
                return None;
            }
            column /= generalized_mass.sqrt();
        }
        Some(cross)
    }

    /// The agreement of test shapes where it exceeds `least`: the mean of the paired magnitudes of cross-orthogonality.
    pub fn agreement_above(&self, shapes: &DMatrix<f64>, least: f64) -> Option<f64> {
        let cross = self.cross(shapes)?;
        // Every mode paired with its best bounds the agreement, and costs no sorting.
        let bound =
            cross.column_iter().map(|column| column.amax()).sum::<f64>() / cross.ncols() as f64;
        if bound <= least {
            return None;
        }
        let values = paired_values(&cross, &pair_modes(&cross).ok()?);
        let agreement = values.iter().sum::<f64>() / values.len() as f64;
        (agreement > least).then_some(agreement)
    }
}

/// The magnitudes of cross-orthogonality of the pairs, in the order of the test modes.
pub(super) fn paired_values(cross: &DMatrix<f64>, pairing: &Pairing) -> Vec<f64> {
    pairing
        .analysis_mode
        .iter()
        .enumerate()
        .map(|(test, &mode)| cross[(mode, test)].abs())
        .collect()
}

/// A symmetric matrix with rows and columns in another order.
pub(super) fn reordered(matrix: &DMatrix<f64>, order: &[usize]) -> DMatrix<f64> {
    matrix.select_rows(order).select_columns(order)
}
