//! Balance of forces and moments in each test mode (B.1 to B.4), and the rigid-body motions on which they do work.

use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{
    check_finite, check_matrix, check_shape, check_symmetric, cholesky, pencil_eigen,
};
use crate::method::modes::Modes;
use nalgebra::{DMatrix, Unit, Vector3};

/// Rigid-body stiffness, relative to $\omega^2$ times the rigid-body mass, above which a structure counts as supported:
/// soft suspensions have modes below a fifth of every test frequency, supported structures a ratio of one or more.
pub const LARGEST_SUSPENSION_RATIO: f64 = 0.04;

/// Fraction of a rigid-body vector's generalized mass, independent of the vectors before it, below which it counts as
/// dependent. Round-off leaves about 1e-15; a reference axis a thousand lengths away leaves 1e-7.
const SMALLEST_INDEPENDENT_PART: f64 = 1e-12;

/// Test shapes whose forces and moments balance.
#[derive(Debug, Clone, PartialEq)]
pub struct Balanced {
    /// Balanced shapes $v_i + \Phi r_i$ (d × n), at the scale of the raw ones.
    pub shapes: DMatrix<f64>,
    /// Coefficients $r$ of the rigid-body vectors (m × n); a rotation has a translation's unit per inch.
    pub coefficients: DMatrix<f64>,
    /// Each change relative to its shape in the mass norm, $\sqrt{(\Phi r_i)^t M \Phi r_i} /\sqrt{v_i^t M v_i}$.
    pub change: Vec<f64>,
}

/// Adds to every test shape the rigid-body motion that balances its forces and moments.
///
/// With $R_i = \omega_i^2 M - K$ and the rigid-body vectors in the columns of $\Phi$, the coefficients solve
///
/// $$ \Phi^t R_i  (v_i + \Phi r_i) = 0, $$
///
/// for the symmetric case, $\Phi = (\lbrace 1 \rbrace, \lbrace x \rbrace)$, (B.3) and (B.4). On a free structure $K\Phi = 0$, and the
/// balanced shape is the part of the raw one orthogonal in mass to every rigid-body motion. The equations are solved in
/// the suspension modes $\hat\Phi = \Phi L^{-t} Y$ ($L L^t = \Phi^t M \Phi$), mass-orthonormal and with diagonal $K$:
///
/// $$ \hat\Phi^t K \hat\Phi = \mathrm{diag}(\mu), \qquad
///    \hat r_{ki} = -\frac{\hat\phi_k^t R_i v_i}{\omega_i^2 - \mu_k}, \qquad r_i = L^{-t} Y \hat r_i. $$
///
/// `stiffness` in lbf/in and `mass` in lbf·s²/in (d × d), suspension springs included and aerodynamic forces left out
/// (`paper/interpretation.md`); `rigid_body` $= \Phi$ (d × m), see [`super::rigid_body_vectors`].
///
/// # Errors
/// [`Error::WrongShape`] and [`Error::Value`] for data that does not fit or is not finite; [`Error::NotPositiveDefinite`] when the
/// balance equations are singular; [`Error::Supported`] when some $\lvert\mu_k\rvert$ exceeds [`LARGEST_SUSPENSION_RATIO`] of a mode's
/// $\omega_i^2$: the structure is held, or the mode is itself a rigid-body mode on the suspension.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_b::balance;
/// use corfem::method::modes::Modes;
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // Two free unit masses on a spring move against each other; measured with 0.05 of both together.
/// let raw = Modes::new(dvector![2.0], dmatrix![1.0; -0.9])?;
/// let stiffness = dmatrix![1.0, -1.0; -1.0, 1.0];
/// let balanced = balance(&raw, &stiffness, &DMatrix::identity(2, 2), &dmatrix![1.0; 1.0])?;
/// assert!((balanced.shapes - dmatrix![0.95; -0.95]).amax() < 1e-14);
/// assert!((balanced.coefficients[0] + 0.05).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn balance(
    raw: &Modes,
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    rigid_body: &DMatrix<f64>,
) -> Result<Balanced, Error> {
    let (dof_count, motion_count) = (mass.nrows(), rigid_body.ncols());
    cholesky("dynamic mass", mass, 0.0)?;
    let size = raw.generalized_masses(mass)?;
    check_shape("dynamic stiffness", stiffness, dof_count, dof_count)?;
    check_symmetric("dynamic stiffness", stiffness)?;
    at_least_one("rigid-body vectors", motion_count)?;
    check_matrix("rigid-body vectors", rigid_body, dof_count, motion_count)?;
    let through = |matrix: &DMatrix<f64>| rigid_body.tr_mul(&(matrix * rigid_body));
    let lower = cholesky("rigid-body mass", &through(mass), SMALLEST_INDEPENDENT_PART)?;
    // μ, zero on a free structure, and L⁻ᵗ Y (m × m).
    let what = "rigid-body stiffness";
    let (mu, from_suspension) = pencil_eigen(what, &through(stiffness), &lower, motion_count)?;
    let (omega_squared, limit) = (&raw.omega_squared, LARGEST_SUSPENSION_RATIO);
    for mode in 0..raw.len() {
        let ratio = mu.amax() / omega_squared[mode];
        if ratio > limit {
            return Err(Error::Supported { mode, ratio, limit });
        }
    }
    let motions = rigid_body * &from_suspension;
    let inertia = motions.tr_mul(&(mass * &raw.shapes));
    let elastic = motions.tr_mul(&(stiffness * &raw.shapes));
    let amplitudes = DMatrix::from_fn(motion_count, raw.len(), |k, i| {
        (elastic[(k, i)] - omega_squared[i] * inertia[(k, i)]) / (omega_squared[i] - mu[k])
    });
    let shapes = &raw.shapes + motions * &amplitudes;
    check_finite("balanced test mode shapes", &shapes)?;
    let changes = amplitudes.column_iter().zip(size);
    let change = changes.map(|(added, size)| added.norm() / size.sqrt());
    Ok(Balanced {
        change: change.collect(),
        coefficients: from_suspension * &amplitudes,
        shapes,
    })
}

/// A dynamic degree of freedom: a measuring point and the direction measured there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuringPoint {
    /// Position, in: x aft, y outboard, z up, from the reference axes.
    pub position: Vector3<f64>,
    /// Direction of motion.
    pub direction: Unit<Vector3<f64>>,
}

/// A rigid-body motion, named by the force or moment that does work on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// Translation along x: drag.
    ForeAft,
    /// Translation along y: side force.
    Side,
    /// Translation along z: vertical force.
    Plunge,
    /// Rotation about x: rolling moment.
    Roll,
    /// Rotation about y: pitching moment.
    Pitch,
    /// Rotation about z: yawing moment.
    Yaw,
}

/// The motions of the symmetric boundary condition: with z alone measured, $\lbrace 1 \rbrace$ and $\lbrace x \rbrace$ of (B.1) and (B.2).
/// Where x is measured, add [`Motion::ForeAft`], which is symmetric too.
pub const SYMMETRIC: [Motion; 2] = [Motion::Plunge, Motion::Pitch];

/// The motions of the antisymmetric boundary condition. Where z alone is measured only [`Motion::Roll`] is seen, and
/// the other two must be left out.
pub const ANTISYMMETRIC: [Motion; 3] = [Motion::Side, Motion::Roll, Motion::Yaw];

impl Motion {
    /// Displacement of a point (in) under 1 in of translation, or per radian of rotation in the linear theory.
    ///
    /// Yaw turns x towards y, roll y towards z, and pitch x towards z, which lifts the tail.
    pub fn displacement(self, position: Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::ForeAft => Vector3::x(),
            Self::Side => Vector3::y(),
            Self::Plunge => Vector3::z(),
            Self::Roll => Vector3::new(0.0, -position.z, position.y),
            Self::Pitch => Vector3::new(-position.z, 0.0, position.x),
            Self::Yaw => Vector3::new(-position.y, position.x, 0.0),
        }
    }
}

/// Rigid-body vectors $\Phi_{ij} = n_i \cdot u_j(x_i)$ (dynamic DOF × motions): what motion $j$ shows at DOF $i$.
/// Translations have no unit, rotations are in inches per radian.
///
/// # Errors
/// [`Error::Count`] without motions or without DOF; [`Error::Value`] for a position that is not finite.
pub fn rigid_body_vectors(
    motions: &[Motion],
    dofs: &[MeasuringPoint],
) -> Result<DMatrix<f64>, Error> {
    at_least_one("rigid-body motions", motions.len())?;
    at_least_one("dynamic degrees of freedom", dofs.len())?;
    let vectors = DMatrix::from_fn(dofs.len(), motions.len(), |i, j| {
        let shown = motions[j].displacement(dofs[i].position);
        dofs[i].direction.dot(&shown)
    });
    check_finite("rigid-body vectors", &vectors).map(|()| vectors)
}
