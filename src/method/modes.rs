//! Natural modes: the symmetric-definite eigenproblem, its order, scale and sign.

use crate::method::error::Error;
use crate::method::linear_algebra::{
    check_finite, check_shape, check_symmetric, cholesky, solve_lower, solve_lower_transposed,
    symmetric_eigen, symmetric_part,
};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

/// Components within this fraction of the largest count as equally large for the sign rule, so that round-off
/// in a symmetric shape does not choose its sign.
pub(crate) const SIGN_TIE: f64 = 1e-6;

/// Modes of vibration, in ascending order of frequency.
///
/// Shapes are mass-orthonormal, $V^t M V = I$ (3), and signed so that the first of their largest components
/// (within one part in a million) is positive.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Squared circular frequencies $\omega_i^2 = k_{ii} = 1/\lambda_i$, rad²/s².
    pub omega_squared: DVector<f64>,
    /// Mode shapes, one per column (d × n), in/(lbf·s²/in)^½.
    pub shapes: DMatrix<f64>,
}

impl Modes {
    /// Number of modes.
    pub fn len(&self) -> usize {
        self.omega_squared.len()
    }

    /// Whether there are no modes.
    pub fn is_empty(&self) -> bool {
        self.omega_squared.is_empty()
    }

    /// Frequencies $f_i = \omega_i / 2\pi$, Hz.
    pub fn frequencies_hz(&self) -> Vec<f64> {
        self.omega_squared
            .iter()
            .map(|omega_squared| omega_squared.sqrt() / (2.0 * PI))
            .collect()
    }

    /// The lowest `count` modes.
    ///
    /// # Errors
    /// [`Error::Empty`] for none; [`Error::TooMany`] for more than there are.
    pub fn lowest(&self, count: usize) -> Result<Self, Error> {
        check_count(count, self.len())?;
        Ok(Self {
            omega_squared: self.omega_squared.rows(0, count).into_owned(),
            shapes: self.shapes.columns(0, count).into_owned(),
        })
    }

    /// The same modes with every shape scaled to unit generalized mass with another mass matrix, $v^t M v = 1$.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for a mass that does not fit; [`Error::NotPositive`] for a generalized mass that is not.
    pub fn scaled_with(&self, mass: &DMatrix<f64>) -> Result<Self, Error> {
        check_shape("test mode shapes", &self.shapes, mass.nrows(), self.len())?;
        let mut shapes = self.shapes.clone();
        scale_to_unit_mass(&mut shapes, mass)?;
        Ok(Self {
            omega_squared: self.omega_squared.clone(),
            shapes,
        })
    }

    /// Modes from frequencies (Hz) and shapes of any scale, such as measured ones: each shape is scaled to unit
    /// generalized mass and signed by the rule; order is kept. Orthogonality is not enforced (Appendix B does).
    ///
    /// # Errors
    /// [`Error::Empty`], [`Error::WrongShape`], [`Error::NotFinite`]; [`Error::NotPositive`] for a frequency or
    /// a generalized mass that is not positive.
    pub fn from_measured(
        frequencies_hz: &[f64],
        shapes: &DMatrix<f64>,
        mass: &DMatrix<f64>,
    ) -> Result<Self, Error> {
        if frequencies_hz.is_empty() {
            return Err(Error::Empty { what: "test modes" });
        }
        check_symmetric("dynamic mass", mass)?;
        check_shape(
            "test mode shapes",
            shapes,
            mass.nrows(),
            frequencies_hz.len(),
        )?;
        check_finite("test mode shapes", shapes)?;
        let mut scaled = shapes.clone();
        for (mode, &frequency) in frequencies_hz.iter().enumerate() {
            crate::method::structure::positive("frequency", || owner(mode), frequency)?;
        }
        scale_to_unit_mass(&mut scaled, mass)?;
        apply_sign_rule(&mut scaled);
        Ok(Self {
            omega_squared: DVector::from_iterator(
                frequencies_hz.len(),
                frequencies_hz.iter().map(|f| (2.0 * PI * f).powi(2)),
            ),
            shapes: scaled,
        })
    }
}

fn owner(mode: usize) -> String {
    format!("test mode {mode} (from zero)")
}

fn scale_to_unit_mass(shapes: &mut DMatrix<f64>, mass: &DMatrix<f64>) -> Result<(), Error> {
    for (mode, mut shape) in shapes.column_iter_mut().enumerate() {
        let generalized_mass = shape.dot(&(mass * &shape));
        crate::method::structure::positive("generalized mass", || owner(mode), generalized_mass)?;
        shape /= generalized_mass.sqrt();
    }
    Ok(())
}

fn check_count(count: usize, available: usize) -> Result<(), Error> {
    if count == 0 {
        return Err(Error::Empty { what: "modes" });
    }
    if count > available {
        return Err(Error::TooMany {
            what: "modes",
            available,
            requested: count,
        });
    }
    Ok(())
}

/// The lowest `count` modes of $K v = \omega^2 M v$.
///
/// $$ V^t M V = I, \qquad V^t K V = \mathrm{diag}(\omega^2) $$
///
/// `stiffness` in lbf/in and `mass` in lbf·s²/in, both d × d. With $M = L L^t$ the problem becomes the symmetric
/// one of $L^{-1} K L^{-t}$, solved through faer.
///
/// # Errors
/// [`Error::WrongShape`], [`Error::NotFinite`], [`Error::NotSymmetric`] for bad matrices;
/// [`Error::NotPositiveDefinite`] naming the DOF for a mass that is not; [`Error::NotAVibration`] for a mode with
/// $\omega^2 \le 0$; [`Error::Empty`] or [`Error::TooMany`] for a bad `count`.
pub fn solve(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>, count: usize) -> Result<Modes, Error> {
    check_symmetric("dynamic stiffness", stiffness)?;
    check_shape("dynamic mass", mass, stiffness.nrows(), stiffness.nrows())?;
    check_count(count, stiffness.nrows())?;
    let lower = cholesky("dynamic mass", mass, 0.0)?;
    let mut reduced = stiffness.clone();
    solve_lower(&lower, &mut reduced);
    reduced.transpose_mut();
    solve_lower(&lower, &mut reduced);
    let (omega_squared, mut shapes) =
        symmetric_eigen("dynamic stiffness", &symmetric_part(&reduced))?;
    if let Some(mode) = omega_squared.iter().position(|&value| value <= 0.0) {
        return Err(Error::NotAVibration {
            mode,
            value: omega_squared[mode],
        });
    }
    solve_lower_transposed(&lower, &mut shapes);
    apply_sign_rule(&mut shapes);
    Modes {
        omega_squared,
        shapes,
    }
    .lowest(count)
}

/// Makes the first of the largest components of every column positive.
pub fn apply_sign_rule(shapes: &mut DMatrix<f64>) {
    for mut shape in shapes.column_iter_mut() {
        let largest = shape.amax();
        let first = shape
            .iter()
            .find(|component| component.abs() >= (1.0 - SIGN_TIE) * largest);
        if first.is_some_and(|&component| component < 0.0) {
            shape.neg_mut();
        }
    }
}
