//! One weighted step from where a correlation ended: what the test still says there.

use super::comparison::Comparison;
use super::identifiability::{Identifiability, identifiability};
use super::noise::Noise;
use super::residuals::{jacobian, residuals};
use crate::method::error::Error;
use serde::Serialize;

/// One weighted step from where a correlation ended.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NextStep {
    /// Standard deviations of the test that it supposes.
    pub noise: Noise,
    /// What such a test sees of the parameters there.
    pub seen: Identifiability,
    /// The step in the logarithm of every factor.
    pub step: Vec<f64>,
}

impl NextStep {
    /// The undamped step at `model` of a test with errors of `noise`, whatever the bounds, with a prior of deviation $\tau$ about
    /// the place itself:
    ///
    /// $$ h = -(J^t J + I/\tau^2)^{-1} J^t r $$
    ///
    /// with the [`residuals`] $r$ and their [`jacobian`] $J$.
    ///
    /// # Errors
    /// Those of [`residuals`] and [`identifiability`]: [`Error::Value`] for deviations that are not positive.
    pub fn at(model: &Comparison, noise: Noise, prior_deviation: f64) -> Result<Self, Error> {
        let weights = vec![noise.weight(); model.model.test.len()];
        let jacobian = jacobian(model, &weights)?;
        let seen = identifiability(&jacobian, &vec![prior_deviation; jacobian.ncols()])?;
        let step = -(&seen.covariance * jacobian.tr_mul(&residuals(model, &weights)?));
        Ok(Self {
            noise,
            seen,
            step: step.data.into(),
        })
    }

    /// Parameters that it moves by more than their standard deviation, with the size of the move in these.
    pub fn moved(&self) -> Vec<(usize, f64)> {
        let moves = self.step.iter().zip(&self.seen.deviations);
        moves
            .map(|(step, deviation)| (step / deviation).abs())
            .enumerate()
            .filter(|(_, size)| *size > 1.0)
            .collect()
    }
}
