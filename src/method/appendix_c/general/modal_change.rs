//! What the general formulae work on: a change of stiffness and of $G$ seen through the modes before it.

use super::complex_modes::LeftRightModes;
use super::{Number, Pencil};
use crate::method::appendix_c::SMALLEST_SEPARATION;
use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{check_matrix, check_shape};
use nalgebra::{DMatrix, DVector};

/// Generalized stiffness between a left and another right mode, relative to their own, above which shapes count as not
/// biorthogonal. Round-off leaves about 1e-14 times their condition.
const LARGEST_COUPLING: f64 = 1e-8;

/// A change of $K$ and of $G$ seen through the modes before it.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalChange<T> {
    /// $k_{ii} = u_i^t K v_i$ (n).
    pub generalized_stiffness: DVector<T>,
    /// Roots $\lambda_i$ before the change, s² (n).
    pub roots: DVector<T>,
    /// $\beta = U^t \Delta K V$ (n × n).
    pub beta: DMatrix<T>,
    /// $\alpha = U^t \Delta G V$ (n × n).
    pub alpha: DMatrix<T>,
}

impl ModalChange<f64> {
    /// A change seen through mass-orthonormal modes of vibration, whose $k_{ii} = \omega_i^2$ (rad²/s²) and
    /// $\lambda_i = 1/\omega_i^2$: `beta` $= V^t\Delta K V$ and `alpha` $= V^t \Delta M V$ (n × n).
    pub fn of_vibrations(
        omega_squared: &DVector<f64>,
        beta: DMatrix<f64>,
        alpha: DMatrix<f64>,
    ) -> Self {
        Self {
            generalized_stiffness: omega_squared.clone(),
            roots: omega_squared.map(f64::recip),
            beta,
            alpha,
        }
    }
}

impl<T: Number> ModalChange<T> {
    /// Changes of stiffness (lbf/in) and of $G$ (lbf·s²/in), all d × d, seen through the modes before them.
    ///
    /// # Errors
    /// [`Error::WrongShape`], [`Error::NotFinite`] for input that does not fit; [`Error::NotOrthonormal`] when
    /// $U^t K V$ is not diagonal (C.10).
    pub fn new(
        stiffness: &DMatrix<T>,
        modes: &LeftRightModes<T>,
        stiffness_change: &DMatrix<T>,
        g_change: &DMatrix<T>,
    ) -> Result<Self, Error> {
        let (dof_count, count) = modes.right.shape();
        check_shape("left shapes", &modes.left, dof_count, count)?;
        for (what, matrix) in [
            ("stiffness", stiffness),
            ("stiffness change", stiffness_change),
            ("change of mass and aerodynamic terms", g_change),
        ] {
            check_matrix(what, matrix, dof_count, dof_count)?;
        }
        let through_modes = |matrix: &DMatrix<T>| modes.left.tr_mul(&(matrix * &modes.right));
        let k = through_modes(stiffness);
        for second in 0..count {
            for first in (0..count).filter(|&first| first != second) {
                let own = (k[(first, first)] * k[(second, second)]).modulus().sqrt();
                let found = k[(first, second)].modulus() / own;
                if found.is_nan() || found > LARGEST_COUPLING {
                    let what = "relative generalized stiffness of left and right modes";
                    return Err(Error::NotOrthonormal {
                        what,
                        first,
                        second,
                        expected: 0.0,
                        found,
                    });
                }
            }
        }
        let (beta, alpha) = (through_modes(stiffness_change), through_modes(g_change));
        Ok(Self {
            generalized_stiffness: k.diagonal(),
            roots: modes.roots.clone(),
            beta,
            alpha,
        })
    }

    /// The same change seen by the transposed pencil (C.2); the changed left modes are $U$ times its shapes.
    pub fn transposed(&self) -> Self {
        Self {
            beta: self.beta.transpose(),
            alpha: self.alpha.transpose(),
            ..self.clone()
        }
    }

    /// The changed pencil, after refusing what does not fit or has lost its stiffness $A_{ii}$.
    pub fn pencil(&self) -> Result<Pencil<T>, Error> {
        let size = self.roots.len();
        at_least_one("modes", size)?;
        let k = &self.generalized_stiffness;
        let column =
            |vector: &DVector<T>| DMatrix::from_column_slice(vector.len(), 1, vector.as_slice());
        for (what, matrix, columns) in [
            ("generalized stiffness", &column(k), 1),
            ("roots", &column(&self.roots), 1),
            ("generalized stiffness change", &self.beta, size),
            (
                "generalized change of mass and aerodynamic terms",
                &self.alpha,
                size,
            ),
        ] {
            check_matrix(what, matrix, size, columns)?;
        }
        let stiffness = DMatrix::from_diagonal(k) + &self.beta;
        for mode in 0..size {
            let ratio = stiffness[(mode, mode)].modulus() / k[mode].modulus();
            if ratio.is_nan() || ratio <= SMALLEST_SEPARATION {
                return Err(Error::LostStiffness { mode, ratio });
            }
        }
        Ok((
            stiffness,
            DMatrix::from_diagonal(&k.component_mul(&self.roots)) + &self.alpha,
        ))
    }
}
