//! What condensation to the sensors costs: the condensed modes beside those of the whole model.

use super::{SparseMatrix, WholeModel};
use crate::method::error::Error;
use crate::method::modes::{ModeSet, check_count, solve};
use crate::method::pairing::{modal_assurance, pair_modes};
use serde::Serialize;

/// Largest part by which condensation may raise a frequency that is compared, twice the loop's own tolerance on frequencies: beyond it
/// the correlation would correct elements for what the choice of measuring points did.
pub const LARGEST_CONDENSATION_ERROR: f64 = 0.01;
/// Motion at the sensors relative to that of the mode that moves them most below which a mode is not seen.
const UNSEEN: f64 = 1e-9;

/// How a condensed mode differs from the whole model's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CondensationError {
    /// The whole model's frequency, Hz.
    pub whole_hz: f64,
    /// How much higher the condensed frequency is, a fraction.
    pub frequency: f64,
    /// One minus the modal assurance criterion of the two shapes at the sensors.
    pub shape: f64,
}

impl WholeModel {
    /// The `count` lowest modes that move a sensor, with their shapes there (sensors × count).
    ///
    /// # Errors
    /// Those of [`Self::modes`]; [`Error::TooMany`] when fewer move a sensor.
    pub fn seen_modes(
        &self,
        factors: &[f64],
        sensors: &SparseMatrix,
        count: usize,
    ) -> Result<ModeSet, Error> {
        let mut wanted = count;
        loop {
            let (modes, is_all) = match self.modes(factors, wanted) {
                Err(Error::TooMany { available, .. }) if available > 0 => {
                    (self.modes(factors, available)?, true)
                }
                found => (found?, false),
            };
            let mut set = modes.vibrations;
            set.shapes = sensors.times(&set.shapes)?;
            let most = set.shapes.amax();
            let seen =
                (0..set.len()).filter(|&mode| set.shapes.column(mode).amax() > UNSEEN * most);
            let seen: Vec<usize> = seen.take(count).collect();
            if seen.len() == count {
                return Ok(set.select(&seen));
            }
            if is_all {
                check_count("modes that move a sensor", count, seen.len())?;
            }
            wanted *= 2;
        }
    }

    /// What condensation to the sensors does to each of the lowest `count` modes.
    ///
    /// Condensed modes are a Ritz approximation, so that the sum of what it does is never a gain. Each is compared with the whole
    /// model's mode of its shape.
    ///
    /// # Errors
    /// Those of [`Self::condensed`], [`Self::seen_modes`] and [`solve`].
    pub fn condensation_errors(
        &self,
        factors: &[f64],
        sensors: &SparseMatrix,
        count: usize,
    ) -> Result<Vec<CondensationError>, Error> {
        let (condensed, mass) = self.condensed(factors, sensors)?;
        let condensed = solve(&condensed.stiffness, &mass, count)?;
        let whole = self.seen_modes(factors, sensors, count)?;
        let assurance = modal_assurance(&whole.shapes, &condensed.shapes)?;
        let (whole_hz, partners) = (
            whole.frequencies_hz(),
            pair_modes(&assurance)?.analysis_mode,
        );
        let error = |(mode, condensed_hz): (usize, f64)| CondensationError {
            whole_hz: whole_hz[partners[mode]],
            frequency: condensed_hz / whole_hz[partners[mode]] - 1.0,
            shape: 1.0 - assurance[(partners[mode], mode)],
        };
        Ok(condensed
            .frequencies_hz()
            .into_iter()
            .enumerate()
            .map(error)
            .collect())
    }
}
