//! Appendix C: Van de Vooren's perturbation of roots and shapes, in modal coordinates.
//! Tour: [chapter 2](crate::tour::chapter_02_recursion).
//!
//! The modes before the change are $V$ with $V^t M V = I$ and $k = V^t K V = \mathrm{diag}(\omega^2)$. With
//! $\lambda = 1/\omega^2$ (the paper's root of $(K\lambda - M)v = 0$) a change of stiffness $\Delta K$ enters through
//! $\beta = V^t \Delta K V$ alone, and mode $j$ of the changed structure is $V p_j$ with root $\gamma_j$:
//!
//! $$ \big[k(\gamma_j - \Lambda) + \beta\gamma_j\big] p_j = 0, \qquad p_{jj} = 1. $$
//!
//! Every function here solves these equations in one way or another:
//!
//! - [`recursive`]: first order and Recursive 1 for a change of stiffness alone;
//! - [`general`]: all of it, Recursive 2 and the formulae of 1947 too, with changes of mass, complex and unsymmetric pencils;
//! - [`eigensolution`]: exactly, which is what the others approach.

pub mod general;
pub mod recursive;

pub use recursive::{first_order, recursive_1, recursive_1_converged};

use crate::method::error::Error;
use crate::method::linear_algebra::{Number, check_shape};
use crate::method::modes::solve;
use crate::method::pairing::pair_modes;
use crate::method::structure::positive;
use general::ModalChange;
use nalgebra::{DMatrix, DVector};

/// Denominator relative to the generalized stiffness below which two modes count as coalescing.
pub const SMALLEST_SEPARATION: f64 = 1e-9;

/// Relative change of a root in the last order allowed above which a recursion has not settled: a thousandth of an error sum of
/// some percent. Below it the recursion may be slow, but what it still has to go is little.
pub const LARGEST_UNSETTLED_CHANGE: f64 = 1e-6;

/// One minus the cosine of two generalized shapes below which they are those of one mode, if their roots agree to [`SAME_ROOT`]:
/// where roots have settled to 1e-6, shapes of one mode agree to better than a hundredth, and those of two modes are orthogonal.
const SAME_SHAPE: f64 = 1e-2;
/// Relative distance of two roots below which they are one.
const SAME_ROOT: f64 = 1e-3;

/// Roots and generalized shapes after a change; complex where [`general`] works on complex numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Perturbed<T = f64> {
    /// Changed roots $\gamma_i = \lambda_i + \Delta\lambda_i = 1/\omega_i^2$, s².
    pub roots: DVector<T>,
    /// Generalized shapes $p$ (n × n): column $j$ is mode $j$ in terms of the modes before the change, $p_{jj} = 1$.
    pub shapes: DMatrix<T>,
}

impl Perturbed {
    /// Refuses roots that are not positive and finite.
    pub(crate) fn check_roots(&self) -> Result<(), Error> {
        let lost = self
            .roots
            .iter()
            .position(|&root| !(root > 0.0 && root.is_finite()));
        lost.map_or(Ok(()), |mode| {
            Err(Error::LostRoot {
                mode,
                value: self.roots[mode],
            })
        })
    }
}

/// What a recursion that goes on until its roots settle has reached.
#[derive(Debug, Clone, PartialEq)]
pub struct Settled<T = f64> {
    /// Roots and shapes of the last order.
    pub perturbed: Perturbed<T>,
    /// The last order.
    pub order: usize,
    /// Largest relative change of a root in it: how far the recursion may still have had to go.
    pub last_change: f64,
}

impl<T: Number> Settled<T> {
    /// Accepts a recursion whose roots have settled to its tolerance, or nearly so, on as many modes as there are: a strong change
    /// can lead two modes to one, and then another is missed.
    fn check(self, tolerance: f64, orders: usize) -> Result<Self, Error> {
        let (largest, last_change) = (tolerance.max(LARGEST_UNSETTLED_CHANGE), self.last_change);
        // NaN has not settled either.
        if last_change.is_nan() || last_change > largest {
            return Err(Error::UnsettledRoots {
                largest,
                orders,
                last_change,
            });
        }
        let Perturbed { roots, shapes } = &self.perturbed;
        for (second, shape) in shapes.column_iter().enumerate() {
            for (first, other) in shapes.column_iter().enumerate().take(second) {
                let cosine = other.dotc(&shape).modulus() / (other.norm() * shape.norm());
                let separation = (roots[second] / roots[first] - T::one()).modulus();
                if 1.0 - cosine < SAME_SHAPE && separation < SAME_ROOT {
                    return Err(Error::CoalescingModes {
                        first,
                        second,
                        separation,
                    });
                }
            }
        }
        Ok(self)
    }
}

/// Exact roots and shapes of $k + \beta$ with $k\Lambda + \alpha$ in the modal coordinates: what the perturbation approaches,
/// and what it saves.
///
/// Modes stand in the order of the modes they are most like, so that column $j$ continues mode $j$, and are scaled to
/// $p_{jj} = 1$ like the perturbed shapes.
///
/// # Errors
/// [`Error::Empty`], [`Error::WrongShape`], [`Error::NotFinite`], [`Error::LostStiffness`] for bad input; those of [`solve`];
/// [`Error::LostRoot`]; [`Error::CoalescingModes`] when a new mode has no part in the mode it continues.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_c::eigensolution;
/// use corfem::method::appendix_c::general::ModalChange;
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // Two and five on the diagonal of k + β and 0.3 beside it: 3.5 ∓ √(1.5² + 0.3²).
/// let (k, beta) = (dvector![1.0, 5.0], dmatrix![1.0, 0.3; 0.3, 0.0]);
/// let exact = eigensolution(&ModalChange::of_vibrations(&k, beta, DMatrix::zeros(2, 2)))?;
/// assert!((1.0 / exact.roots[0] - (3.5 - 2.34_f64.sqrt())).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn eigensolution(change: &ModalChange<f64>) -> Result<Perturbed, Error> {
    let (stiffness, mass) = change.pencil()?;
    let modes = solve(&stiffness, &mass, stiffness.nrows())?;
    // Rows of the shape matrix are the old modes, so its transpose is the cross-orthogonality of new with old.
    let pairing = pair_modes(&modes.shapes.transpose())?;
    let mut continued = modes.select(&pairing.analysis_mode);
    for (j, mut shape) in continued.shapes.column_iter_mut().enumerate() {
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
    let found = Perturbed {
        roots: continued.omega_squared.map(f64::recip),
        shapes: continued.shapes,
    };
    found.check_roots().map(|()| found)
}

/// Scales every generalized shape to unit changed generalized mass, $p_j^t(I + \alpha)p_j = 1$, keeping its sign.
///
/// `alpha` $= V^t \Delta M V$ (n × n); the shapes $V p$ are then orthonormal in the changed mass.
///
/// # Errors
/// [`Error::WrongShape`]; [`Error::NotPositive`] naming the mode whose changed generalized mass is not.
pub fn normalize_with_mass(shapes: &mut DMatrix<f64>, alpha: &DMatrix<f64>) -> Result<(), Error> {
    check_shape(
        "generalized mass change",
        alpha,
        shapes.nrows(),
        shapes.nrows(),
    )?;
    let moved = alpha * &*shapes;
    for (mode, mut shape) in shapes.column_iter_mut().enumerate() {
        let mass = shape.norm_squared() + shape.dot(&moved.column(mode));
        positive(
            "changed generalized mass",
            || format!("mode {mode} (from zero)"),
            mass,
        )?;
        shape /= mass.sqrt();
    }
    Ok(())
}
