//! A test with one sensor less or more, as a model has it.

use super::close_modes::members;
use super::comparison::Comparison;
use super::identifiability::covariance;
use super::residuals::{compared, jacobian};
use crate::method::error::Error;
use crate::sparse::{ModeWeight, gram};
use nalgebra::DMatrix;

/// Deviations of the logarithms of the factors by a test with its weights, and prior deviations.
///
/// # Errors
/// The errors of [`jacobian`] and of the covariance.
pub(crate) fn deviations(
    comparison: &Comparison,
    weights: &[ModeWeight],
    priors: &[f64],
) -> Result<Vec<f64>, Error> {
    let information = gram(&jacobian(comparison, weights)?);
    let deviations = covariance(information, priors)?.map_diagonal(f64::sqrt);
    Ok(deviations.as_slice().to_vec())
}

impl Comparison {
    /// Matrices with a row for every sensor: the basis, the modes, the test's shapes, the weights of components, and slopes beyond the basis,
    /// of modes in ascending order.
    fn by_sensors(&mut self) -> impl Iterator<Item = &mut DMatrix<f64>> {
        let (model, weights) = (&mut self.model, &mut self.test.component_weights);
        let shapes = [
            &mut model.basis,
            &mut model.exact.modes.shapes,
            &mut model.test.shapes,
            weights,
        ];
        shapes.into_iter().chain(model.slopes.iter_mut().flatten())
    }

    fn largest(&self, j: usize) -> f64 {
        self.model.test.shapes.column(j).amax()
    }

    /// This comparison with the noise of another, which is a part of the largest reading there.
    fn with_noise_of(mut self, other: &Self) -> Self {
        for j in 0..self.model.test.len() {
            let scale = self.largest(j) / other.largest(j);
            self.test.component_weights.column_mut(j).scale_mut(scale);
        }
        self
    }

    /// This comparison at some of its sensors, each with the noise that it has.
    pub(crate) fn at_sensors(&self, rows: &[usize]) -> Self {
        let mut own = self.clone();
        own.by_sensors()
            .for_each(|matrix| *matrix = matrix.select_rows(rows));
        own.with_noise_of(self)
    }

    /// This comparison with one more sensor of the same noise, which reads this of the basis (1 × N) and what the model says of the test; `beyond` is what
    /// modes beyond the basis add there to the slopes that are known, of modes in ascending order.
    pub(crate) fn with_sensor(&self, basis: DMatrix<f64>, slopes: Vec<DMatrix<f64>>) -> Self {
        let exact = &self.model.exact;
        let reading = |_, j| {
            let members = members(
                &exact.modes.omega_squared,
                &exact.pairing,
                &self.test.together,
                j,
            );
            let shares = compared(&self.model.basis, self, &members, j).1.shares;
            (basis.select_columns(&members) * shares)[0] * self.largest(j)
        };
        let reading = DMatrix::from_fn(1, self.model.test.len(), reading);
        let (modes, ones) = (
            basis.columns(0, exact.modes.len()).into_owned(),
            reading.map(|_| 1.0),
        );
        let rows = [basis, modes, reading, ones].into_iter().chain(slopes);
        let (mut own, last) = (self.clone(), self.model.basis.nrows());
        for (matrix, row) in own.by_sensors().zip(rows) {
            *matrix = std::mem::take(matrix).insert_row(last, 0.0);
            matrix.set_row(last, &row.row(0));
        }
        own.with_noise_of(self)
    }
}
