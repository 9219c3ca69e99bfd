//! What condensation to the dynamic DOF costs: the condensed modes beside those of the whole structure.

use super::{CondensedModel, FiniteElementModel};
use crate::method::appendix_b::{Movement, MovementLimits, orthogonalize};
use crate::method::assembly::{FactorizedStiffness, lumped_mass};
use crate::method::error::Error;
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use crate::method::modes::{ModeSet, check_count, solve};
use crate::method::pairing::{modal_assurance, pair_modes};
use nalgebra::DMatrix;
use serde::Serialize;

/// Largest part by which condensation may raise a frequency that is compared: twice the loop's own tolerance on frequencies.
/// Beyond it the correlation would correct elements for what the choice of measuring points did.
pub const LARGEST_CONDENSATION_ERROR: f64 = 0.01;
/// Root of the whole structure relative to the largest below which its frequency counts as infinite.
const SMALLEST_ROOT: f64 = 1e-13;

/// How a condensed mode differs from the whole structure's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CondensationError {
    /// The whole structure's frequency, Hz.
    pub whole_hz: f64,
    /// How much higher the condensed frequency is, a fraction.
    pub frequency: f64,
    /// One minus the modal assurance criterion of the two shapes at the dynamic DOF.
    pub shape: f64,
}

impl FiniteElementModel {
    /// The `count` lowest modes of the whole structure with their shapes at the dynamic DOF (d × count).
    ///
    /// The mass of the elements stays at the structure's own DOF instead of following $B$. With $T M_{points} T^t + M_S = F F^t$,
    ///
    /// $$ F^t K_S^{-1} F y = \lambda y, \qquad \omega^2 = 1/\lambda, \qquad q_D = \omega^2 T^t K_S^{-1} F y . $$
    ///
    /// Where all mass is at the dynamic DOF they are the condensed modes. Modes that do not move any dynamic DOF are left out.
    ///
    /// # Errors
    /// Those of [`Self::condense`]; [`Error::Empty`] or [`Error::TooMany`] for a bad `count`.
    pub fn whole_modes(&self, factors: &[f64], count: usize) -> Result<ModeSet, Error> {
        let (sizes, mass_sizes) = (self.sizes(factors)?, self.mass_sizes(factors)?);
        let free = self.structure.free_dof();
        let stiffness = FactorizedStiffness::new(&self.element_matrices, &sizes, free)?;
        let lumped = lumped_mass(&self.element_matrices, &mass_sizes, free.len())?;
        let (values, vectors) = symmetric_eigen("point masses", &self.point_masses(factors)?)?;
        let root = vectors * DMatrix::from_diagonal(&values.map(|value| value.max(0.0).sqrt()));
        let heavy: Vec<usize> = (0..free.len()).filter(|&row| lumped[row] > 0.0).collect();
        let points = self.load_distribution.ncols();
        let mut f = (&self.load_distribution * root).resize_horizontally(points + heavy.len(), 0.0);
        for (column, &row) in heavy.iter().enumerate() {
            f[(row, points + column)] = lumped[row].sqrt();
        }
        let deflections = stiffness.solve(&f)?;
        let (roots, vectors) = symmetric_eigen("whole flexibility", &symmetric_part(&f.tr_mul(&deflections)))?;
        let measured = self.load_distribution.tr_mul(&(deflections * vectors));
        // Ascending roots are descending frequencies.
        let seen = |mode: &usize| roots[*mode] > SMALLEST_ROOT * roots.max() && measured.column(*mode).amax() > 0.0;
        let places: Vec<usize> = (0..roots.len()).rev().filter(seen).collect();
        check_count("modes of the whole structure", count, places.len())?;
        let omega_squared = roots.select_rows(&places[..count]).map(f64::recip);
        let mut shapes = measured.select_columns(&places[..count]);
        shapes.column_iter_mut().zip(&omega_squared).for_each(|(mut shape, omega_squared)| shape *= *omega_squared);
        Ok(ModeSet { omega_squared, shapes })
    }

    /// What condensation to the dynamic DOF does to each of the lowest `count` modes.
    ///
    /// Condensed modes are a Ritz approximation, so that the sum of what it does is never a gain. Each is compared with the whole
    /// structure's mode of its shape.
    ///
    /// # Errors
    /// Those of [`Self::whole_modes`] and [`solve`].
    pub fn condensation_errors(&self, factors: &[f64], count: usize) -> Result<Vec<CondensationError>, Error> {
        let CondensedModel { stiffness, mass, .. } = self.condense(factors)?;
        let condensed = solve(&stiffness, &mass, count)?;
        let whole = self.whole_modes(factors, count)?;
        let assurance = modal_assurance(&whole.shapes, &condensed.shapes)?;
        let (whole_hz, partners) = (whole.frequencies_hz(), pair_modes(&assurance)?.analysis_mode);
        let error = |(mode, condensed_hz): (usize, f64)| CondensationError {
            whole_hz: whole_hz[partners[mode]],
            frequency: condensed_hz / whole_hz[partners[mode]] - 1.0,
            shape: 1.0 - assurance[(partners[mode], mode)],
        };
        Ok(condensed.frequencies_hz().into_iter().enumerate().map(error).collect())
    }

    /// Limits of [`crate::method::appendix_b::examine`] that do not blame the test for condensation: raised by what
    /// orthogonalization with the condensed mass moves the model's own `count` lowest whole modes.
    ///
    /// # Errors
    /// Those of [`Self::whole_modes`] and [`orthogonalize`].
    pub fn limits_allowing_for_condensation(
        &self,
        factors: &[f64],
        count: usize,
        limits: &MovementLimits,
    ) -> Result<MovementLimits, Error> {
        let moved = orthogonalize(&self.whole_modes(factors, count)?, &self.condense(factors)?.mass)?.movement;
        let most = |of: fn(&Movement) -> f64| moved.iter().map(of).fold(0.0, f64::max);
        let (frequency, shape) = (most(|moved| moved.frequency.abs()), most(|moved| moved.shape));
        Ok(MovementLimits { frequency: limits.frequency + frequency, shape: limits.shape + shape, ..*limits })
    }
}
