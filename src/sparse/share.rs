//! Parts of the stiffness or mass that parameters scale.

use super::SparseMatrix;
use crate::method::error::Error;
use nalgebra::DMatrix;

/// Largest part of a test mode's generalized stiffness (or mass) below which a parameter counts as unseen: twice as much of it
/// would move no frequency by half a percent.
pub const UNSEEN_SHARE: f64 = 0.01;

/// Part of the stiffness or mass that one parameter scales.
#[derive(Debug, Clone, PartialEq)]
pub enum Share<M> {
    /// Of the stiffness, lbf/in, or rad²/s² in mass-orthonormal shapes.
    Stiffness(M),
    /// Of the mass, lbf·s²/in, or a fraction in mass-orthonormal shapes.
    Mass(M),
}

/// The part at d DOF (d × d), or in n shapes as $V^t K_e V$ or $V^t M_e V$ (n × n).
pub type ParameterMatrix = Share<DMatrix<f64>>;

/// The part of a whole model's matrices.
pub type WholeShare = Share<SparseMatrix>;

impl<M> Share<M> {
    /// The matrix, whatever it is a share of.
    pub fn matrix(&self) -> &M {
        match self {
            Self::Stiffness(matrix) | Self::Mass(matrix) => matrix,
        }
    }

    /// Another matrix that is the same share.
    pub(super) fn of<N>(&self, matrix: N) -> Share<N> {
        match self {
            Self::Stiffness(_) => Share::Stiffness(matrix),
            Self::Mass(_) => Share::Mass(matrix),
        }
    }

    /// True of a part of the mass.
    pub(super) fn is_mass(&self) -> bool {
        matches!(self, Self::Mass(_))
    }
}

impl WholeShare {
    /// The share at a factor, in shapes that are given transposed (m × DOF), m × m.
    pub(super) fn seen_by(
        &self,
        factor: f64,
        transposed_shapes: &DMatrix<f64>,
    ) -> Result<ParameterMatrix, Error> {
        Ok(self.of(factor * self.matrix().through(transposed_shapes)?))
    }
}
