//! Natural modes: the symmetric-definite eigenproblem, its order, scale and sign.
//! Tour: [chapter 1](crate::tour::chapter_01_two_springs).

use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{
    check_matrix, check_shape, check_symmetric, cholesky, pencil_eigen,
};
use crate::method::structure::positive;
use nalgebra::{DMatrix, DVector, DVectorView};
use std::f64::consts::PI;
use std::ops::Deref;

/// Components within this fraction of the largest count as equally large for the sign rule, so that round-off
/// in a symmetric shape does not choose its sign.
pub(crate) const SIGN_TIE: f64 = 1e-6;

/// A set of modes in any order and of any scale: measured ones, or those that a perturbation leads to. Every squared frequency is
/// positive, and every shape has a component that is not zero:
///
/// ```compile_fail,E0451
/// # use corfem::method::modes::ModeSet;
/// # use nalgebra::{dmatrix, dvector};
/// let still = ModeSet { omega_squared: dvector![0.0], shapes: dmatrix![0.0] };
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ModeSet {
    /// Squared circular frequencies $\omega_i^2$, rad²/s².
    pub(crate) omega_squared: DVector<f64>,
    /// Mode shapes, one per column (d × n).
    pub(crate) shapes: DMatrix<f64>,
}

impl ModeSet {
    /// Squared circular frequencies $\omega_i^2$, rad²/s².
    pub fn omega_squared(&self) -> &DVector<f64> {
        &self.omega_squared
    }

    /// Mode shapes, one per column (d × n).
    pub fn shapes(&self) -> &DMatrix<f64> {
        &self.shapes
    }

    /// Modes from squared circular frequencies (rad²/s²) and shapes of any scale and sign, one per column (d × g).
    ///
    /// # Errors
    /// [`Error::Empty`], [`Error::WrongShape`], [`Error::NotFinite`]; [`Error::NotPositive`] for a squared frequency that is not
    /// positive or a shape that is zero.
    pub fn new(omega_squared: DVector<f64>, shapes: DMatrix<f64>) -> Result<Self, Error> {
        at_least_one("test modes", omega_squared.len())?;
        let (rows, modes) = (shapes.nrows(), omega_squared.len());
        check_matrix("test mode shapes", &shapes, rows, modes)?;
        for (mode, (&square, shape)) in omega_squared.iter().zip(shapes.column_iter()).enumerate() {
            positive("squared frequency", || test_mode(mode), square)?;
            positive("largest component", || test_mode(mode), shape.amax())?;
        }
        Ok(Self {
            omega_squared,
            shapes,
        })
    }

    /// Measured modes: frequencies in hertz, and shapes of any scale and sign, one per column (d × g).
    ///
    /// # Errors
    /// Those of [`Self::new`]; [`Error::NotPositive`] for a frequency that is not positive.
    pub fn from_measured(frequencies_hz: &[f64], shapes: &DMatrix<f64>) -> Result<Self, Error> {
        for (mode, &frequency) in frequencies_hz.iter().enumerate() {
            positive("frequency", || test_mode(mode), frequency)?;
        }
        let omega_squared = frequencies_hz.iter().map(|f| (2.0 * PI * f).powi(2));
        let omega_squared = DVector::from_iterator(frequencies_hz.len(), omega_squared);
        Self::new(omega_squared, shapes.clone())
    }

    /// The same frequencies with other shapes (d × n), such as those that sensors see.
    ///
    /// # Errors
    /// Those of [`Self::new`].
    pub fn with_shapes(&self, shapes: DMatrix<f64>) -> Result<Self, Error> {
        Self::new(self.omega_squared.clone(), shapes)
    }

    /// Squared frequencies and shapes, for whoever makes other modes of them.
    pub fn into_parts(self) -> (DVector<f64>, DMatrix<f64>) {
        (self.omega_squared, self.shapes)
    }

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

    /// No modes, as of a test that has frequencies alone.
    pub(crate) fn none(dof_count: usize) -> Self {
        Self {
            omega_squared: DVector::zeros(0),
            shapes: DMatrix::zeros(dof_count, 0),
        }
    }

    /// The modes of the given places, in that order; a place may not exceed [`Self::len`].
    pub(crate) fn select(&self, places: &[usize]) -> Self {
        Self {
            omega_squared: self.omega_squared.select_rows(places),
            shapes: self.shapes.select_columns(places),
        }
    }

    /// Generalized masses $v_i^t M v_i$ of test modes (n), after refusing modes that have none.
    pub(crate) fn generalized_masses(&self, mass: &DMatrix<f64>) -> Result<Vec<f64>, Error> {
        check_shape("dynamic mass", mass, mass.nrows(), mass.nrows())?;
        check_shape("test mode shapes", &self.shapes, mass.nrows(), self.len())?;
        let of_mode = |(mode, shape): (usize, DVectorView<f64>)| {
            let generalized_mass = shape.dot(&(mass * shape));
            positive("generalized mass", || test_mode(mode), generalized_mass)?;
            Ok(generalized_mass)
        };
        self.shapes.column_iter().enumerate().map(of_mode).collect()
    }

    /// The same modes with every shape scaled to unit generalized mass, $v^t M v = 1$ (3). Orthogonality is not enforced;
    /// Appendix B does that.
    ///
    /// # Errors
    /// [`Error::Empty`]; [`Error::WrongShape`] for a mass (d × d, lbf·s²/in) or shapes that do not fit; [`Error::NotFinite`];
    /// [`Error::NotPositive`] for a squared frequency or a generalized mass that is not positive.
    pub fn scaled_with(&self, mass: &DMatrix<f64>) -> Result<Self, Error> {
        let mut scaled = self.clone();
        for (mut shape, generalized_mass) in scaled
            .shapes
            .column_iter_mut()
            .zip(self.generalized_masses(mass)?)
        {
            shape /= generalized_mass.sqrt();
        }
        Ok(scaled)
    }
}

fn test_mode(mode: usize) -> String {
    format!("test mode {mode} (from zero)")
}

/// Modes of vibration as an eigensolution finds them: ascending in frequency, with mass-orthonormal shapes (3),
///
/// $$ V^t M V = I, \qquad V^t K V = \mathrm{diag}(\omega^2), $$
///
/// in in/(lbf·s²/in)^½, signed so that the first of their largest components (within one part in a million) is positive.
/// Nothing outside this crate can make or change one, so every `Modes` keeps that promise; it is read as a [`ModeSet`]:
///
/// ```compile_fail,E0423
/// # use corfem::method::modes::{ModeSet, Modes};
/// # use nalgebra::{dmatrix, dvector};
/// // Measured modes are not an eigensolution.
/// let modes = Modes(ModeSet::new(dvector![9.0], dmatrix![1.0]).unwrap());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Modes(ModeSet);

impl Deref for Modes {
    type Target = ModeSet;

    fn deref(&self) -> &ModeSet {
        &self.0
    }
}

impl From<Modes> for ModeSet {
    /// The same modes without the promise, such as modes of one model that serve as another's test.
    fn from(modes: Modes) -> Self {
        modes.0
    }
}

impl Modes {
    /// Orthonormal modes in ascending order, their signs by the rule.
    pub(crate) fn ascending(omega_squared: DVector<f64>, mut shapes: DMatrix<f64>) -> Self {
        apply_sign_rule(&mut shapes);
        Self(ModeSet {
            omega_squared,
            shapes,
        })
    }

    /// The same of the shapes that sensors see, with the columns of `whole` turned like them.
    pub(crate) fn seen(
        omega_squared: DVector<f64>,
        seen: &DMatrix<f64>,
        whole: &mut DMatrix<f64>,
    ) -> Self {
        let modes = Self::ascending(omega_squared, seen.clone());
        for mode in (0..seen.ncols()).filter(|&mode| modes.shapes.column(mode) != seen.column(mode))
        {
            whole.column_mut(mode).neg_mut();
        }
        modes
    }

    /// The lowest `count` modes.
    ///
    /// # Errors
    /// [`Error::Empty`] for none; [`Error::TooMany`] for more than there are.
    pub fn lowest(&self, count: usize) -> Result<Self, Error> {
        check_count("modes", count, self.len())?;
        Ok(Self(self.select(&(0..count).collect::<Vec<_>>())))
    }
}

/// Requires at least one and at most as many as there are.
pub(crate) fn check_count(
    what: &'static str,
    requested: usize,
    available: usize,
) -> Result<(), Error> {
    match requested {
        0 => Err(Error::Empty { what }),
        _ if requested > available => Err(Error::TooMany {
            what,
            available,
            requested,
        }),
        _ => Ok(()),
    }
}

/// The lowest `count` modes of $K v = \omega^2 M v$ for `stiffness` in lbf/in and `mass` in lbf·s²/in, both d × d.
///
/// With $M = L L^t$ it becomes the symmetric problem of $L^{-1} K L^{-t}$.
///
/// # Errors
/// Those of [`check_symmetric`] for the stiffness and [`cholesky`] for the mass; [`Error::NotAVibration`] for a mode with
/// $\omega^2 \le 0$; [`Error::Empty`] or [`Error::TooMany`] for a bad `count`.
///
/// # Example
///
/// ```rust
/// use corfem::method::modes::solve;
/// use nalgebra::{DMatrix, dmatrix};
///
/// // Two unit masses on three unit springs: together on two of them, apart on all, ω² = 1 and 3.
/// let modes = solve(&dmatrix![2.0, -1.0; -1.0, 2.0], &DMatrix::identity(2, 2), 2)?;
/// assert!((modes.omega_squared()[0] - 1.0).abs() < 1e-14);
/// assert!((modes.omega_squared()[1] - 3.0).abs() < 1e-14);
/// assert!((modes.shapes()[(0, 0)] - 0.5_f64.sqrt()).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn solve(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>, count: usize) -> Result<Modes, Error> {
    check_symmetric("dynamic stiffness", stiffness)?;
    check_shape("dynamic mass", mass, stiffness.nrows(), stiffness.nrows())?;
    check_count("modes", count, stiffness.nrows())?;
    let lower = cholesky("dynamic mass", mass, 0.0)?;
    let (omega_squared, shapes) = pencil_eigen("dynamic stiffness", stiffness, &lower, count)?;
    if let Some(mode) = omega_squared.iter().position(|&value| value <= 0.0) {
        return Err(Error::NotAVibration {
            mode,
            value: omega_squared[mode],
        });
    }
    Ok(Modes::ascending(
        omega_squared.rows(0, count).into_owned(),
        shapes,
    ))
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
