//! The rigid-body motions whose forces and moments a free structure's modes balance.

use crate::method::error::Error;
use crate::method::linear_algebra::check_finite;
use nalgebra::{DMatrix, Unit, Vector3};

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

/// The motions of the symmetric boundary condition: with z alone measured, $\{1\}$ and $\{x\}$ of (B.1) and (B.2).
///
/// Fore-and-aft motion is symmetric too; add [`Motion::ForeAft`] where x is measured.
pub const SYMMETRIC: [Motion; 2] = [Motion::Plunge, Motion::Pitch];

/// The motions of the antisymmetric boundary condition: side force, rolling moment, yawing moment.
///
/// Where z alone is measured only [`Motion::Roll`] is seen, and the other two must be left out.
pub const ANTISYMMETRIC: [Motion; 3] = [Motion::Side, Motion::Roll, Motion::Yaw];

impl Motion {
    /// Displacement of a point (in) under the motion's unit: 1 in of translation, or 1 rad of rotation in the linear
    /// theory, in per rad.
    ///
    /// Rotations are signed so that yaw turns x towards y, roll y towards z, and pitch x towards z, which lifts the
    /// tail: roll $(0, -z, y)$, pitch $(-z, 0, x)$, yaw $(-y, x, 0)$.
    pub fn displacement(self, position: Vector3<f64>) -> Vector3<f64> {
        let (x, y, z) = (position.x, position.y, position.z);
        match self {
            Self::ForeAft => Vector3::x(),
            Self::Side => Vector3::y(),
            Self::Plunge => Vector3::z(),
            Self::Roll => Vector3::new(0.0, -z, y),
            Self::Pitch => Vector3::new(-z, 0.0, x),
            Self::Yaw => Vector3::new(-y, x, 0.0),
        }
    }
}

/// The rigid-body vectors $\Phi$ (dynamic DOF × motions): what each motion shows at each DOF,
/// $\Phi_{ij} = n_i \cdot u_j(x_i)$.
///
/// Translations have no unit, rotations are in inches per radian.
///
/// # Errors
/// [`Error::Empty`] without motions or without DOF; [`Error::NotFinite`] for a position that is not.
pub fn rigid_body_vectors(
    motions: &[Motion],
    dofs: &[MeasuringPoint],
) -> Result<DMatrix<f64>, Error> {
    for (what, count) in [
        ("rigid-body motions", motions.len()),
        ("dynamic degrees of freedom", dofs.len()),
    ] {
        if count == 0 {
            return Err(Error::Empty { what });
        }
    }
    let vectors = DMatrix::from_fn(dofs.len(), motions.len(), |i, j| {
        dofs[i]
            .direction
            .dot(&motions[j].displacement(dofs[i].position))
    });
    check_finite("rigid-body vectors", &vectors)?;
    Ok(vectors)
}
