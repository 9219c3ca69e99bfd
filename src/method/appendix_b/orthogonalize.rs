//! Orthogonal test modes from nearly orthogonal ones (B.5 to B.7).

use crate::method::error::Error;
use crate::method::linear_algebra::{check_finite, check_shape, cholesky, symmetric_part};
use crate::method::modes::{Modes, solve};
use crate::method::sorting::pair_modes;
use nalgebra::DMatrix;

/// Squared sine of the angle between a shape and the span of those before it, below which it counts as dependent.
const SMALLEST_INDEPENDENT_PART: f64 = 1e-12;

/// Overlap of unit shapes that is the round-off of a product over some hundreds of DOF and counts as none: it would
/// turn two modes of one frequency by any angle.
const OVERLAP_ROUND_OFF: f64 = 1e-12;

/// Movement of a mode by orthogonalization.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Movement {
    /// Change of frequency relative to the raw one, $(f - f_G)/f_G$.
    pub frequency: f64,
    /// Mass norm of the change of shape, $\sqrt{(w - v)^t M (w - v)}$ with both scaled to unit generalized mass and
    /// signed alike: $2\sin(\theta/2)$ for an angle $\theta$ between them, about the fraction of other modes mixed in.
    pub shape: f64,
}

/// Orthogonal test modes and how far each one moved.
#[derive(Debug, Clone, PartialEq)]
pub struct Orthogonalized {
    /// The modes, $V^t M V = I$, in the order and with the signs of the raw ones.
    pub modes: Modes,
    /// Overlaps of the raw shapes: $m_1$ (B.6) with every shape scaled to unit generalized mass (n × n).
    pub overlap: DMatrix<f64>,
    /// Each mode's movement.
    pub movement: Vec<Movement>,
}

/// Generalized mass $m_1 = V^t M V$ (B.6), n × n, of shapes in columns (d × n) of any scale. Its off-diagonal entries
/// are the integrals of (B.5), which vanish for orthogonal modes.
///
/// # Errors
/// [`Error::WrongShape`] when shapes and mass do not fit; [`Error::Value`] for a product that is not finite.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_b::generalized_mass;
/// use nalgebra::{DMatrix, dmatrix};
///
/// // Both masses together, and against each other: orthogonal, with 1 + 1 each.
/// let mass = generalized_mass(&dmatrix![1.0, 1.0; 1.0, -1.0], &DMatrix::identity(2, 2))?;
/// assert_eq!(mass, dmatrix![2.0, 0.0; 0.0, 2.0]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn generalized_mass(shapes: &DMatrix<f64>, mass: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    check_shape("dynamic mass", mass, shapes.nrows(), shapes.nrows())?;
    let overlaps = shapes.tr_mul(&(mass * shapes));
    check_finite("generalized mass", &overlaps).map(|()| overlaps)
}

/// Combinations of the test shapes that are orthogonal in mass, and their frequencies (B.7).
///
/// In the raw shapes, scaled to unit generalized mass, the equations of motion are the symmetric-definite eigenproblem
///
/// $$ \mathrm{diag}(\omega_{Gi}^2  m_{1,ii})  q = \omega^2  m_1  q, \qquad q^t m_1 q = 1. $$
///
/// with the test frequencies $\omega_{Gi}$. Each new shape $V q$ takes the place and sign of the raw one it is paired
/// with. An overlap $e$ of two modes moves shapes by the order of $e$ and frequencies, mostly the higher, by that of
/// $e^2$; the sum of $1/\omega^2$ never changes. `mass` in lbf·s²/in (d × d).
///
/// # Errors
/// [`Error::WrongShape`] and [`Error::Value`] for data that does not fit or is not finite; [`Error::NotPositiveDefinite`] for the mass, or
/// a shape that is a combination of those before it.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_b::{generalized_mass, orthogonalize};
/// use corfem::method::modes::Modes;
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // The second shape has a tenth of the first in it.
/// let raw = Modes::new(dvector![1.0, 4.0], dmatrix![1.0, 0.1; 0.0, 1.0])?;
/// let mass = DMatrix::identity(2, 2);
/// let modes = orthogonalize(&raw, &mass)?.modes;
/// assert!((generalized_mass(modes.shapes(), &mass)? - &mass).amax() < 1e-14);
/// // The sum of 1/ω² is that of the raw modes, 1 + 1/4.
/// assert!((modes.omega_squared().map(f64::recip).sum() - 1.25).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn orthogonalize(raw: &Modes, mass: &DMatrix<f64>) -> Result<Orthogonalized, Error> {
    cholesky("dynamic mass", mass, 0.0)?;
    let unit = raw.scaled_with(mass)?.shapes;
    let overlap = symmetric_part(&generalized_mass(&unit, mass)?);
    let overlap = overlap.map(|m| if m.abs() < OVERLAP_ROUND_OFF { 0.0 } else { m });
    cholesky(
        "overlap of the test shapes",
        &overlap,
        SMALLEST_INDEPENDENT_PART,
    )?;
    let squares = DMatrix::from_diagonal(&raw.omega_squared);
    let combined = solve(&squares, &overlap, raw.len())?;
    let combined = pair_modes(&combined.shapes.tr_mul(&overlap))?.paired(&combined)?;
    let modes = Modes {
        shapes: &unit * combined.shapes,
        omega_squared: combined.omega_squared,
    };
    let difference = &modes.shapes - unit;
    let weighted = mass * &difference;
    let movements = (0..raw.len()).map(|mode| Movement {
        frequency: (modes.omega_squared[mode] / raw.omega_squared[mode]).sqrt() - 1.0,
        shape: difference.column(mode).dot(&weighted.column(mode)).sqrt(),
    });
    Ok(Orthogonalized {
        movement: movements.collect(),
        modes,
        overlap,
    })
}
