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

/// The rigid-body vectors $\Phi_{ij} = n_i \cdot u_j(x_i)$ (dynamic DOF × motions): what motion $j$ shows at DOF $i$.
/// Translations have no unit, rotations are in inches per radian.
///
/// # Errors
/// [`Error::Empty`] without motions or without DOF; [`Error::NotFinite`] for a position that is not.
pub fn rigid_body_vectors(motions: &[Motion], dofs: &[MeasuringPoint]) -> Result<DMatrix<f64>, Error> {
    for (what, count) in [("rigid-body motions", motions.len()), ("dynamic degrees of freedom", dofs.len())] {
        if count == 0 {
            return Err(Error::Empty { what });
        }
    }
    let vectors = DMatrix::from_fn(dofs.len(), motions.len(), |i, j| {
        dofs[i].direction.dot(&motions[j].displacement(dofs[i].position))
    });
    check_finite("rigid-body vectors", &vectors)?;
    Ok(vectors)
}
