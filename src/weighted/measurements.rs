//! A test with one sensor less or more, or with more modes, as a model has them.

use super::close_modes::members;
use super::comparison::Comparison;
use super::identifiability::covariance;
use super::residuals::{compared, jacobian};
use crate::method::error::Error;
use crate::method::sorting::Pairing;
use crate::sparse::{ModeWeight, gram};
use nalgebra::DMatrix;

/// Deviations of the logarithms of the factors by independent tests with their weights, and prior deviations.
///
/// # Errors
/// Those of [`jacobian`] and of the covariance.
pub(crate) fn deviations(
    tests: &[(&Comparison, &[ModeWeight])],
    priors: &[f64],
) -> Result<Vec<f64>, Error> {
    let mut information = DMatrix::zeros(priors.len(), priors.len());
    for (comparison, weights) in tests {
        information += gram(&jacobian(comparison, weights)?);
    }
    let covariance = covariance(information, priors)?;
    Ok(covariance.diagonal().iter().map(|own| own.sqrt()).collect())
}

impl Comparison {
    /// This comparison at some of its sensors. Weights of components that are not alike stay what they are over a component.
    pub(crate) fn at_sensors(&self, rows: &[usize]) -> Self {
        let mut own = self.clone();
        let model = &mut own.model;
        let weights = &mut own.test.component_weights;
        let shapes = [
            &mut model.basis,
            &mut model.exact.modes.shapes,
            &mut model.test.shapes,
            weights,
        ];
        let beyond = model.beyond.iter_mut().flatten();
        for matrix in shapes.into_iter().chain(beyond) {
            *matrix = matrix.select_rows(rows);
        }
        let largest = |of: &Self, j: usize| of.model.test.shapes.column(j).amax();
        for j in 0..own.model.test.len() {
            let scale = largest(&own, j) / largest(self, j);
            let mut weights = own.test.component_weights.column_mut(j);
            if weights.iter().any(|own| *own != 1.0) {
                weights *= scale;
            }
        }
        own
    }

    /// This comparison with one more sensor, which reads this of the basis (1 × N) and what the model says of the test; `beyond` is what
    /// modes beyond the basis add there to the slopes of the compared modes, nothing if it is empty.
    pub(crate) fn with_sensor(&self, basis: &DMatrix<f64>, beyond: &[DMatrix<f64>]) -> Self {
        let (mut own, model) = (self.clone(), &self.model);
        let (last, partners) = (model.basis.nrows(), &model.exact.pairing.analysis_mode);
        let mut reading = DMatrix::zeros(1, model.test.len());
        for j in 0..model.test.len() {
            let members = members(&model.exact.pairing, &self.test.together, j);
            let shares = compared(&model.basis, self, &members, j).1.shares;
            let of_unit = basis.select_columns(&members) * shares;
            reading[j] = of_unit[0] * model.test.shapes.column(j).amax();
        }
        let modes = basis.columns(0, model.exact.modes.len()).into_owned();
        let extend = |all: &mut DMatrix<f64>, row: &DMatrix<f64>| {
            *all = std::mem::take(all).insert_row(last, 1.0);
            all.set_row(last, &row.row(0));
        };
        extend(&mut own.model.basis, basis);
        extend(&mut own.model.exact.modes.shapes, &modes);
        extend(&mut own.model.test.shapes, &reading);
        extend(&mut own.test.component_weights, &reading.map(|_| 1.0));
        let nothing = DMatrix::zeros(1, model.shares.len());
        for (place, &mode) in partners.iter().enumerate() {
            let more = beyond.get(place).unwrap_or(&nothing);
            own.model.beyond[mode]
                .iter_mut()
                .for_each(|own| extend(own, more));
        }
        own
    }

    /// A comparison with one mode of this one's model as the model has it; `beyond` is what modes beyond the basis add to its slopes.
    pub(crate) fn of_mode(&self, mode: usize, beyond: DMatrix<f64>) -> Self {
        let mut model = self.model.clone();
        model.test = model.exact.modes.select(&[mode]);
        model.exact.pairing = Pairing {
            analysis_mode: vec![mode],
            sign: vec![1.0],
        };
        model.beyond[mode] = Some(beyond);
        model.into()
    }
}
