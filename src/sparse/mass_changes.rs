//! Changes of mass: the recursion that follows them, and rigid-body modes beside the vibrations.

use crate::method::appendix_c::Pencil;
use crate::method::error::{Error, positive};
use crate::method::linear_algebra::{Number, check_shape};
use crate::method::modes::mode;
use crate::method::perturbation::{MOST_ORDERS, ROOT_TOLERANCE, Settled};
use nalgebra::DMatrix;

/// Orders in a row that must leave the roots alone for a recursion with changes of mass to count as converged.
const QUIET_ORDERS: usize = 2;

/// A change of all parameters, seen through the vibrations of the basis.
pub(super) struct Change {
    /// $\beta = \sum_{stiffness} (s_e - 1) V^t K_e V$.
    pub beta: DMatrix<f64>,
    /// $\alpha = \sum_{mass} (s_e - 1) V^t M_e V$, less what rigid-body modes carry.
    pub alpha: DMatrix<f64>,
    /// The identity, or what [`apart_from_rigid_bodies`] makes of it.
    pub apart: DMatrix<f64>,
}

/// Shapes in terms of the basis (N × N) that a change of mass, `alpha` $= V^t \Delta M V$ (N × N), leaves apart: the `count` vibrations and
/// the rigid-body modes $R$ behind them.
///
/// Rigid-body modes carry no strain energy and do not change. Vibrations are made orthogonal to them by subtracting $R q$,
///
/// $$ V - R q, \qquad (I + \alpha_{RR}) q = \alpha_{RV} . $$
///
/// The stiffness is that in $V$, the change of mass $\alpha_{VV} - \alpha_{VR} q$, and the roots $1/\omega^2$ of rigid-body modes, which would be infinite, are not needed.
pub(super) fn apart_from_rigid_bodies(
    mut apart: DMatrix<f64>,
    alpha: &DMatrix<f64>,
    count: usize,
) -> Result<DMatrix<f64>, Error> {
    let rigid = alpha.nrows() - count;
    let own = DMatrix::identity(rigid, rigid) + alpha.view((count, count), (rigid, rigid));
    let factor = own.cholesky().ok_or(Error::NotPositiveDefinite {
        what: "mass of the rigid-body modes",
        row: 0,
    })?;
    let along = factor.solve(&alpha.view((count, 0), (rigid, count)).into_owned());
    apart
        .view_mut((count, 0), (rigid, count))
        .copy_from(&-along);
    let mut orthonormal = apart.view_mut((count, count), (rigid, rigid));
    factor
        .l()
        .tr_solve_lower_triangular_unchecked_mut(&mut orthonormal);
    Ok(apart)
}

/// Generalized shapes of vibrations and rigid-body modes (N × N) from those of the vibrations (n × n).
pub(super) fn with_rigid_bodies(apart: &DMatrix<f64>, vibrations: &DMatrix<f64>) -> DMatrix<f64> {
    let mut both = DMatrix::identity(apart.nrows(), apart.nrows());
    both.view_mut((0, 0), vibrations.shape())
        .copy_from(vibrations);
    apart * both
}

/// Scales every generalized shape to unit changed generalized mass, $p_j^t(I + \alpha)p_j = 1$, keeping its sign.
///
/// `alpha` $= V^t \Delta M V$ (n × n); the shapes $V p$ are then orthonormal in the changed mass.
///
/// # Errors
/// [`Error::WrongShape`]; [`Error::Value`] naming the mode whose changed generalized mass is not positive.
pub fn normalize_with_mass(shapes: &mut DMatrix<f64>, alpha: &DMatrix<f64>) -> Result<(), Error> {
    let size = shapes.nrows();
    check_shape("generalized mass change", alpha, size, size)?;
    let moved = alpha * &*shapes;
    for (place, mut shape) in shapes.column_iter_mut().enumerate() {
        let mass = shape.norm_squared() + shape.dot(&moved.column(place));
        positive("changed generalized mass", || mode(place), mass)?;
        shape /= mass.sqrt();
    }
    Ok(())
}

impl<T: Number> Pencil<T> {
    /// Recursive 1 until two orders in a row change no root by more than [`ROOT_TOLERANCE`] (relative), at most to order
    /// [`MOST_ORDERS`].
    ///
    /// One quiet order is not enough: roots of two modes that only a change of mass couples move in every second order.
    ///
    /// # Errors
    /// [`Error::Value`] for a root that is not finite; [`Error::UnsettledRoots`] and [`Error::CoalescingModes`] as for a change of
    /// [stiffness alone](crate::method::perturbation::recursive_1_converged).
    pub fn recursive_1_converged(&self) -> Result<Settled<T>, Error> {
        let mut perturbed = self.order_zero()?;
        let (mut order, mut last_change, mut quiet_orders) = (0, 1.0, 0);
        while order < MOST_ORDERS && quiet_orders < QUIET_ORDERS {
            let before = perturbed.roots.clone();
            perturbed = self.next_order(perturbed)?;
            order += 1;
            // Round-off in the largest root is no change of a root that is smaller still.
            let floor = f64::EPSILON * before.map(T::modulus).max();
            let change = |old: T, new: T| (new - old).modulus() / old.modulus().max(floor);
            last_change = before.zip_map(&perturbed.roots, change).fold(0.0, f64::max);
            // The roots of first order are those of order zero.
            let is_quiet = last_change < ROOT_TOLERANCE && order > 1;
            quiet_orders = if is_quiet { quiet_orders + 1 } else { 0 };
        }
        Settled::prove(perturbed, (order, last_change), self.a(), self.g())
    }
}
