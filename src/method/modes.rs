//! Natural modes: the symmetric-definite eigenproblem, its order, scale and sign.
//! Tour: [chapter 1](crate::tour::chapter_01_two_springs).

use super::{
    error::{Error, Result, at_least_one, check_count, positive},
    linear_algebra::{
        Matrix, Number, Vector, check_finite, check_matrix, check_shape, check_symmetric, cholesky,
        congruence, pencil_eigen,
    },
};
use std::f64::consts::TAU;

/// Components within this fraction of the largest count as equally large for the sign rule, so that round-off
/// in a symmetric shape does not choose its sign.
const SIGN_TIE: f64 = 1e-6;

/// Modes, measured or computed, in any order and of any scale. Every squared frequency is positive, and every shape has a component
/// that is not zero:
///
/// ```compile_fail,E0451
/// # use corfem::method::modes::Modes;
/// # use nalgebra::{dmatrix, dvector};
/// let still = Modes { omega_squared: dvector![0.0], shapes: dmatrix![0.0] };
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Squared circular frequencies $\omega_i^2$, rad²/s².
    pub(crate) omega_squared: Vector,
    /// Mode shapes, one per column (d × n).
    pub(crate) shapes: Matrix,
}

impl Modes {
    /// Modes from squared circular frequencies (rad²/s²) and shapes of any scale and sign, one per column (d × n).
    ///
    /// # Errors
    /// No modes, a shape without a frequency, an entry that is not finite, a squared frequency that is not positive, and a shape that is
    /// zero.
    pub fn new(omega_squared: Vector, shapes: Matrix) -> Result<Self> {
        at_least_one("modes", omega_squared.len())?;
        check_matrix("mode shapes", &shapes, shapes.nrows(), omega_squared.len())?;
        check_vibrations(&omega_squared)?;
        for (place, shape) in shapes.column_iter().enumerate() {
            positive("largest component", || mode(place), shape.amax())?;
        }
        Ok(Self {
            omega_squared,
            shapes,
        })
    }

    /// Computed modes, each with the sign by the rule ([`apply_sign_rule`]).
    pub(crate) fn signed(omega_squared: Vector, mut shapes: Matrix) -> Self {
        apply_sign_rule(&mut shapes);
        Self {
            omega_squared,
            shapes,
        }
    }

    /// Measured modes: frequencies in hertz, and shapes of any scale and sign, one per column (d × g).
    ///
    /// # Errors
    /// A frequency that is not positive, and what [`Self::new`] refuses.
    pub fn from_measured(frequencies_hz: &[f64], shapes: &Matrix) -> Result<Self> {
        for (place, &frequency) in frequencies_hz.iter().enumerate() {
            positive("frequency", || mode(place), frequency)?;
        }
        let frequencies = Vector::from_column_slice(frequencies_hz);
        Self::new(frequencies.map(|f| (TAU * f).powi(2)), shapes.clone())
    }

    /// Squared circular frequencies $\omega_i^2$, rad²/s².
    pub fn omega_squared(&self) -> &Vector {
        &self.omega_squared
    }

    /// Mode shapes, one per column (d × n).
    pub fn shapes(&self) -> &Matrix {
        &self.shapes
    }

    /// Number of modes.
    #[allow(clippy::len_without_is_empty, reason = "there is always one")]
    pub fn len(&self) -> usize {
        self.omega_squared.len()
    }

    /// Frequencies $f_i = \omega_i / 2\pi$, Hz (10).
    pub fn frequencies_hz(&self) -> Vec<f64> {
        self.omega_squared
            .iter()
            .map(|square| square.sqrt() / TAU)
            .collect()
    }

    /// The modes of the given places, in that order; a place may not exceed [`Self::len`].
    pub(crate) fn select(&self, places: &[usize]) -> Self {
        Self {
            omega_squared: self.omega_squared.select_rows(places),
            shapes: self.shapes.select_columns(places),
        }
    }

    /// The first `count` modes: the lowest ones of an eigensolution.
    ///
    /// # Errors
    /// No modes asked for, or more than there are.
    pub fn lowest(&self, count: usize) -> Result<Self> {
        check_count("modes", count, 1, self.len())?;
        Ok(self.select(&(0..count).collect::<Vec<_>>()))
    }

    /// Modes with every shape scaled to unit generalized mass, $v^t M v = 1$ (3). Orthogonality is not enforced;
    /// Appendix B does that.
    ///
    /// # Errors
    /// A mass (d × d, lbf·s²/in) that does not fit the shapes, and a generalized mass that is not positive.
    pub fn scaled_with(&self, mass: &Matrix) -> Result<Self> {
        let own = generalized_mass(&self.shapes, mass)?.diagonal();
        let mut scaled = self.clone();
        for (place, mut shape) in scaled.shapes.column_iter_mut().enumerate() {
            positive("generalized mass", || mode(place), own[place])?;
            shape /= own[place].sqrt();
        }
        Ok(scaled)
    }
}

/// Generalized mass $m_1 = V^t M V$ (B.6), n × n, of shapes in columns (d × n) of any scale. Its off-diagonal entries
/// are the integrals of (B.5), which vanish for orthogonal modes.
///
/// # Errors
/// A mass that does not fit the shapes, and a product that is not finite.
///
/// # Example
///
/// ```rust
/// use corfem::method::modes::generalized_mass;
/// use nalgebra::{DMatrix, dmatrix};
///
/// // Both masses together, and against each other: orthogonal, with 1 + 1 each.
/// let mass = generalized_mass(&dmatrix![1.0, 1.0; 1.0, -1.0], &DMatrix::identity(2, 2))?;
/// assert_eq!(mass, dmatrix![2.0, 0.0; 0.0, 2.0]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn generalized_mass(shapes: &Matrix, mass: &Matrix) -> Result<Matrix> {
    check_shape("mass", mass, shapes.nrows(), shapes.nrows())?;
    let overlaps = congruence(mass, shapes);
    check_finite("generalized mass", &overlaps).map(|()| overlaps)
}

/// Name of a mode in errors.
pub(crate) fn mode(place: usize) -> String {
    format!("mode {place} (from zero)")
}

/// Lowest `count` modes of $K v = \omega^2 M v$ for `stiffness` in lbf/in and `mass` in lbf·s²/in, both d × d.
///
/// With $M = L L^t$ it becomes the symmetric problem of $L^{-1} K L^{-t}$. They ascend, with
///
/// $$ V^t M V = I, \qquad V^t K V = \mathrm{diag}(\omega^2), $$
///
/// in in/(lbf·s²/in)^½, signed so that the first of their largest components (within one part in a million) is positive.
///
/// # Errors
/// Matrices that do not fit, or are not symmetric and finite, a mass that is not positive definite, a mode with $\omega^2 \le 0$, and no
/// modes or more than there are.
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
pub fn solve(stiffness: &Matrix, mass: &Matrix, count: usize) -> Result<Modes> {
    check_symmetric("dynamic stiffness", stiffness)?;
    check_shape("dynamic mass", mass, stiffness.nrows(), stiffness.nrows())?;
    check_count("modes", count, 1, stiffness.nrows())?;
    let lower = cholesky("dynamic mass", mass, 0.0)?;
    let (omega_squared, shapes) = pencil_eigen("dynamic stiffness", stiffness, &lower, count)?;
    check_vibrations(&omega_squared)?;
    Ok(Modes::signed(
        omega_squared.rows(0, count).into_owned(),
        shapes,
    ))
}

/// Refuses squared frequencies or roots that are not positive and finite.
pub(crate) fn check_vibrations(squares: &Vector) -> Result<()> {
    for (mode, &value) in squares.iter().enumerate() {
        if !(value > 0.0 && value.is_finite()) {
            return Err(Error::NotAVibration { mode, value });
        }
    }
    Ok(())
}

/// Sign rule: makes the first of the largest components of every column, real or complex, real and positive.
pub fn apply_sign_rule<T: Number>(shapes: &mut Matrix<T>) {
    for mut shape in shapes.column_iter_mut() {
        let least = (1.0 - SIGN_TIE) * shape.map(T::modulus).max();
        if let Some(&first) = shape.iter().find(|component| component.modulus() >= least) {
            shape /= first.signum();
        }
    }
}
