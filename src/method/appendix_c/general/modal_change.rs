//! What Appendix C works on: a change of stiffness and of $G$, seen through the modes before it.

use super::complex_modes::LeftRightModes;
use crate::method::appendix_c::SMALLEST_SEPARATION;
use crate::method::error::Error;
use crate::method::linear_algebra::{check_finite, check_shape};
use nalgebra::{ComplexField, DMatrix, DVector};

/// Generalized stiffness between a left and another right mode, relative to their own, above which the shapes are
/// refused as not biorthogonal. Round-off leaves about 1e-14 times the condition of the shapes.
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
    /// A change seen through mass-orthonormal modes of vibration: $k_{ii} = \omega_i^2$ (rad²/s²), $\lambda_i = 1/\omega_i^2$,
    /// `beta` $= V^t\Delta K V$ and `alpha` $= V^t \Delta M V$ (n × n).
    pub fn of_vibrations(omega_squared: &DVector<f64>, beta: DMatrix<f64>, alpha: DMatrix<f64>) -> Self {
        Self { generalized_stiffness: omega_squared.clone(), roots: omega_squared.map(f64::recip), beta, alpha }
    }
}

impl<T: ComplexField<RealField = f64> + Copy> ModalChange<T> {
    /// Changes `stiffness_change` (lbf/in) and `g_change` (lbf·s²/in) of a pencil with the given stiffness, all
    /// d × d, seen through its modes.
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
            check_shape(what, matrix, dof_count, dof_count)?;
            check_finite(what, matrix)?;
        }
        let through_modes = |matrix: &DMatrix<T>| modes.left.tr_mul(&(matrix * &modes.right));
        let k = through_modes(stiffness);
        for second in 0..count {
            for first in (0..count).filter(|&first| first != second) {
                let own = (k[(first, first)] * k[(second, second)]).modulus().sqrt();
                let found = k[(first, second)].modulus() / own;
                let apart = found <= LARGEST_COUPLING;
                if !apart {
                    let what = "relative generalized stiffness of left and right modes";
                    return Err(Error::NotOrthonormal { what, first, second, expected: 0.0, found });
                }
            }
        }
        Ok(Self {
            generalized_stiffness: k.diagonal(),
            roots: modes.roots.clone(),
            beta: through_modes(stiffness_change),
            alpha: through_modes(g_change),
        })
    }

    /// The same change seen by the transposed pencil (C.2), whose generalized shapes belong to the left modes:
    /// the changed left modes are $U$ times them.
    pub fn transposed(&self) -> Self {
        Self { beta: self.beta.transpose(), alpha: self.alpha.transpose(), ..self.clone() }
    }

    /// Number of modes.
    pub fn len(&self) -> usize {
        self.roots.len()
    }

    /// Whether there are no modes.
    pub fn is_empty(&self) -> bool {
        self.roots.is_empty()
    }

    /// Refuses what the formulae cannot work on.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let size = self.len();
        if size == 0 {
            return Err(Error::Empty { what: "modes" });
        }
        let column = |vector: &DVector<T>| DMatrix::from_column_slice(vector.len(), 1, vector.as_slice());
        let k = column(&self.generalized_stiffness);
        check_shape("generalized stiffness", &k, size, 1)?;
        check_finite("generalized stiffness", &k)?;
        check_finite("roots", &column(&self.roots))?;
        for (what, matrix) in [
            ("generalized stiffness change", &self.beta),
            ("generalized change of mass and aerodynamic terms", &self.alpha),
        ] {
            check_shape(what, matrix, size, size)?;
            check_finite(what, matrix)?;
        }
        for mode in 0..size {
            let ratio = self.own_stiffness(mode).modulus() / k[mode].modulus();
            let stays = ratio > SMALLEST_SEPARATION;
            if !stays {
                return Err(Error::LostStiffness { mode, ratio });
            }
        }
        Ok(())
    }

    /// $k_{ii} + \beta_{ii}$.
    pub(crate) fn own_stiffness(&self, i: usize) -> T {
        self.generalized_stiffness[i] + self.beta[(i, i)]
    }

    /// $\lambda_i + (\alpha_{ii} - \beta_{ii}\lambda_i)/(k_{ii} + \beta_{ii})$, the root to first order.
    pub(crate) fn first_order_root(&self, i: usize) -> T {
        let lambda = self.roots[i];
        lambda + (self.alpha[(i, i)] - self.beta[(i, i)] * lambda) / self.own_stiffness(i)
    }

    /// A shape's component, `numerator` over $k_{ii}(\gamma_j - \lambda_i) + \beta_{ii}\gamma_j - \alpha_{ii}$: zero where nothing
    /// couples the modes, refused where something does and the denominator vanishes.
    pub(crate) fn quotient(&self, numerator: T, gamma: T, (i, j): (usize, usize)) -> Result<T, Error> {
        if numerator == T::zero() {
            return Ok(numerator);
        }
        let difference =
            self.generalized_stiffness[i] * (gamma - self.roots[i]) + self.beta[(i, i)] * gamma - self.alpha[(i, i)];
        let own = (self.own_stiffness(i) * gamma).modulus();
        if difference.modulus() > SMALLEST_SEPARATION * own {
            return Ok(numerator / difference);
        }
        let separation = difference.modulus() / own;
        Err(Error::CoalescingModes { first: i, second: j, separation })
    }
}
