//! Appendix C: Van de Vooren's perturbation of roots and shapes, in modal coordinates.
//!
//! The modes before the change are $V$ with $V^t M V = I$ and $k = V^t K V = \mathrm{diag}(\omega^2)$. With
//! $\lambda = 1/\omega^2$ (the paper's root of $(K\lambda - M)v = 0$) a change of stiffness $\Delta K$ enters through
//! $\beta = V^t \Delta K V$ alone, and mode $j$ of the changed structure is $V p_j$ with root $\gamma_j$:
//!
//! $$ \big[k(\gamma_j - \Lambda) + \beta\gamma_j\big] p_j = 0, \qquad p_{jj} = 1. $$
//!
//! Each function is one way of solving these equations without an eigensolution.

mod blocks;
pub mod close_roots;
pub mod complex_modes;
pub mod general;
pub mod held;
pub mod modal_change;
pub mod recursive;

pub use close_roots::{CloseRootsSettings, SolvedInBlocks, close_roots};
pub use held::first_order_held;
pub use modal_change::ModalChange;
pub(crate) use recursive::{check_input, check_root};
pub use recursive::{first_order, original, recursive_1, recursive_1_converged, recursive_2};

use crate::method::error::Error;
use crate::method::modes::Modes;
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// Denominator relative to the generalized stiffness below which two modes count as coalescing.
pub const SMALLEST_SEPARATION: f64 = 1e-9;

/// Relative change of a root in the last order allowed above which a recursion with a tolerance has not settled.
///
/// Between the tolerance, which is round-off, and this the recursion is slow but what it has left to go is little: a
/// thousandth of an error sum of some percent.
pub const LARGEST_UNSETTLED_CHANGE: f64 = 1e-6;

/// Roots and generalized shapes after a change; complex where [`general`] works on complex numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Perturbed<T = f64> {
    /// Changed roots $\gamma_i = \lambda_i + \Delta\lambda_i = 1/\omega_i^2$, s².
    pub roots: DVector<T>,
    /// Generalized shapes $p$ (n × n): column $j$ is mode $j$ in terms of the modes before the change, $p_{jj} = 1$
    /// (except by [`close_roots()`], which scales its shapes to unit generalized mass).
    pub shapes: DMatrix<T>,
    /// Order of approximation reached.
    pub order: usize,
    /// Largest relative change of a root in the last order.
    pub last_change: f64,
}

/// How modes are brought up to date after a step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum UpdateRule {
    /// Recursive 1 until the roots change by less than `tolerance`, at most `orders` of them. The primary rule.
    Recursive1Converged {
        /// Largest relative change of a root at which the recursion stops.
        tolerance: f64,
        /// Most orders.
        orders: usize,
    },
    /// Recursive 1 to a fixed order.
    Recursive1 {
        /// Order of approximation, from 1.
        order: usize,
    },
    /// Recursive 2 to a fixed order.
    Recursive2 {
        /// Order of approximation, from 1.
        order: usize,
    },
    /// First order alone.
    FirstOrder,
    /// The 1947 formulae: first-order shapes, second-order roots.
    Original,
    /// Recursive 1 with every block of close modes solved exactly; shapes scaled to unit generalized mass.
    CloseRoots(CloseRootsSettings),
    /// An eigensolution in the modal coordinates, what the perturbation replaces.
    Eigensolution,
}

impl UpdateRule {
    /// Refuses the roots of a rule that goes on until they settle, when they have not.
    pub(crate) fn check_settled(&self, last_change: f64) -> Result<(), Error> {
        let (tolerance, orders) = match *self {
            Self::Recursive1Converged { tolerance, orders } => (tolerance, orders),
            Self::CloseRoots(settings) => (settings.tolerance, settings.orders),
            _ => return Ok(()),
        };
        let largest = tolerance.max(LARGEST_UNSETTLED_CHANGE);
        if last_change <= largest {
            return Ok(());
        }
        Err(Error::UnsettledRoots {
            largest,
            orders,
            last_change,
        })
    }
}

impl Default for UpdateRule {
    /// Recursive 1 to roots converged to 1e-13, 60 orders at most.
    fn default() -> Self {
        Self::Recursive1Converged {
            tolerance: 1e-13,
            orders: 60,
        }
    }
}

/// Perturbed roots and shapes by the chosen rule.
///
/// `generalized_stiffness` is $k_{ii} = \omega_i^2$ (rad²/s²) and `beta` $= V^t \Delta K V$ (n × n).
///
/// # Errors
/// Those of the rule's own function.
pub fn perturb(
    generalized_stiffness: &DVector<f64>,
    beta: &DMatrix<f64>,
    rule: UpdateRule,
) -> Result<Perturbed, Error> {
    let k = generalized_stiffness;
    match rule {
        UpdateRule::Recursive1Converged { tolerance, orders } => {
            recursive_1_converged(k, beta, tolerance, orders)
        }
        UpdateRule::Recursive1 { order } => recursive_1(k, beta, order),
        UpdateRule::Recursive2 { order } => recursive_2(k, beta, order),
        UpdateRule::FirstOrder => first_order(k, beta),
        UpdateRule::Original => original(k, beta),
        UpdateRule::CloseRoots(settings) => {
            let alpha = DMatrix::zeros(beta.nrows(), beta.ncols());
            let change = ModalChange::of_vibrations(k, beta.clone(), alpha);
            close_roots(&change, settings).map(|solved| solved.perturbed)
        }
        UpdateRule::Eigensolution => eigensolution(k, beta),
    }
}

/// [`perturb`] for changes of stiffness and mass together: the same rules through [`general`].
///
/// # Errors
/// Those of the rule's own function; [`Error::LostRoot`] when a root is not positive.
pub fn perturb_with_mass(change: &ModalChange<f64>, rule: UpdateRule) -> Result<Perturbed, Error> {
    let perturbed = match rule {
        UpdateRule::Recursive1Converged { tolerance, orders } => {
            general::recursive_1_converged(change, tolerance, orders)
        }
        UpdateRule::Recursive1 { order } => general::recursive_1(change, order),
        UpdateRule::Recursive2 { order } => general::recursive_2(change, order),
        UpdateRule::FirstOrder => general::first_order(change),
        UpdateRule::Original => general::original(change),
        UpdateRule::CloseRoots(settings) => {
            close_roots(change, settings).map(|solved| solved.perturbed)
        }
        UpdateRule::Eigensolution => eigensolution_with_mass(change),
    }?;
    for (mode, &root) in perturbed.roots.iter().enumerate() {
        recursive::check_root(mode, root)?;
    }
    Ok(perturbed)
}

/// Exact roots and shapes of $k + \beta$ in the modal coordinates: the perturbation's limit, and its yardstick.
///
/// Column $j$ is scaled to $p_{jj} = 1$ like the perturbed shapes; modes are kept in the order of the modes they
/// are most like, so that column $j$ continues mode $j$.
///
/// # Errors
/// [`Error::WrongShape`], [`Error::NotFinite`] for bad input; those of [`crate::method::modes::solve`];
/// [`Error::CoalescingModes`] when a new mode has no part in the mode it continues.
pub fn eigensolution(
    generalized_stiffness: &DVector<f64>,
    beta: &DMatrix<f64>,
) -> Result<Perturbed, Error> {
    check_input(generalized_stiffness, beta)?;
    let size = generalized_stiffness.len();
    let changed = DMatrix::from_diagonal(generalized_stiffness) + beta;
    let modes = crate::method::modes::solve(&changed, &DMatrix::identity(size, size), size)?;
    continuing(&modes)
}

/// [`eigensolution`] for changes of stiffness and mass together: exact roots and shapes of $k + \beta$ with
/// $k\Lambda + \alpha$.
///
/// # Errors
/// As [`eigensolution`], and [`Error::Empty`], [`Error::WrongShape`], [`Error::NotFinite`], [`Error::LostStiffness`] as every
/// rule on a [`ModalChange`].
pub fn eigensolution_with_mass(change: &ModalChange<f64>) -> Result<Perturbed, Error> {
    change.check()?;
    let k = &change.generalized_stiffness;
    let stiffness = DMatrix::from_diagonal(k) + &change.beta;
    let mass = DMatrix::from_diagonal(&k.component_mul(&change.roots)) + &change.alpha;
    continuing(&crate::method::modes::solve(
        &stiffness,
        &mass,
        change.len(),
    )?)
}

/// Modes found in the modal coordinates, each in the place and at the scale of the mode it continues.
fn continuing(modes: &Modes) -> Result<Perturbed, Error> {
    // Rows of the shape matrix are the old modes, so its transpose is the cross-orthogonality of new with old.
    let pairing = crate::method::pairing::pair_modes(&modes.shapes.transpose())?;
    let mut shapes = modes.shapes.select_columns(&pairing.analysis_mode);
    for (j, mut shape) in shapes.column_iter_mut().enumerate() {
        let own = shape[j];
        if own.abs() < SMALLEST_SEPARATION {
            return Err(Error::CoalescingModes {
                first: j,
                second: j,
                separation: own.abs(),
            });
        }
        shape /= own;
    }
    Ok(Perturbed {
        roots: modes
            .omega_squared
            .select_rows(&pairing.analysis_mode)
            .map(f64::recip),
        shapes,
        order: 0,
        last_change: 0.0,
    })
}

/// Scales every generalized shape to unit changed generalized mass, $p_j^t(I + \alpha)p_j = 1$, keeping its sign.
///
/// `alpha` $= V^t \Delta M V$ (n × n); the shapes $V p$ are then orthonormal in the changed mass.
///
/// # Errors
/// [`Error::WrongShape`]; [`Error::NotPositive`] naming the mode whose changed generalized mass is not.
pub fn normalize_with_mass(shapes: &mut DMatrix<f64>, alpha: &DMatrix<f64>) -> Result<(), Error> {
    crate::method::linear_algebra::check_shape(
        "generalized mass change",
        alpha,
        shapes.nrows(),
        shapes.nrows(),
    )?;
    for (mode, mut shape) in shapes.column_iter_mut().enumerate() {
        let mass = shape.norm_squared() + shape.dot(&(alpha * &shape));
        let owner = || format!("mode {mode} (from zero)");
        crate::method::structure::positive("changed generalized mass", owner, mass)?;
        shape /= mass.sqrt();
    }
    Ok(())
}

/// Scales every generalized shape to unit generalized mass, $p_j^t p_j = 1$, keeping $p_{jj} > 0$.
pub fn normalize(shapes: &mut DMatrix<f64>) {
    for mut shape in shapes.column_iter_mut() {
        shape.normalize_mut();
    }
}
