//! Appendix C in full: changes of stiffness and of $G$ together, left and right shapes, real or complex.
//!
//! With $k = U^t K V$ diagonal (C.10), $\beta = U^t \Delta K V$ and $\alpha = U^t \Delta G V$, the changed mode $j$ is
//! $V p_j$ with root $\gamma_j = \lambda_j + \Delta\lambda_j$ and
//!
//! $$ \big[k(\gamma_j - \Lambda) + \beta\gamma_j - \alpha\big]\, p_j = 0, \qquad p_{jj} = 1 \quad \text{(C.14 to C.19)}. $$
//!
//! The print has $\alpha = U\Delta G V^t$ and $\beta = U\Delta K V^t$; shapes are columns, so the transpose belongs to $U$. It
//! has $k = g\Lambda$ before (C.13), where (C.5) gives $k\Lambda = g$. There is no (C.23).
//!
//! One set of functions serves real numbers and complex ones: a change of mass of a structure in vacuum is real
//! throughout and must give real roots, aerodynamic terms make the same rows complex, and two copies of these
//! formulae would have to be kept equal by hand. The plain path for stiffness alone stays in [`super::recursive`].

pub mod complex_modes;
mod modal_change;

pub use modal_change::ModalChange;

use super::recursive::check_order;
use super::{Perturbed, Settled};
use crate::method::error::Error;
use crate::method::linear_algebra::check_finite;
use nalgebra::{ComplexField, DMatrix, DVector};

/// Orders in a row that must leave the roots alone for a recursion with mass changes to count as converged.
pub(super) const QUIET_ORDERS: usize = 2;

/// First order (C.20, C.21 with $\alpha$ and a general $k$):
///
/// $$ \Delta\lambda_i = \frac{\alpha_{ii} - \beta_{ii}\lambda_i}{k_{ii} + \beta_{ii}}, \qquad
///    p_{ij} = -\frac{\beta_{ij}\gamma_j - \alpha_{ij}}{k_{ii}(\gamma_j - \lambda_i) + \beta_{ii}\gamma_j - \alpha_{ii}} $$
///
/// # Errors
/// [`Error::Empty`], [`Error::WrongShape`], [`Error::NotFinite`] for bad input; [`Error::LostStiffness`] when
/// $k_{ii} + \beta_{ii}$ vanishes; [`Error::CoalescingModes`] when a denominator does.
pub fn first_order<T>(change: &ModalChange<T>) -> Result<Perturbed<T>, Error>
where
    T: ComplexField<RealField = f64> + Copy,
{
    change.check()?;
    let size = change.len();
    let roots = DVector::from_fn(size, |i, _| change.first_order_root(i));
    let mut shapes = DMatrix::identity(size, size);
    for j in 0..size {
        let gamma = roots[j];
        for i in (0..size).filter(|&i| i != j) {
            let coupled = change.alpha[(i, j)] - change.beta[(i, j)] * gamma;
            shapes[(i, j)] = change.quotient(coupled, gamma, (i, j))?;
        }
    }
    finite(Perturbed { roots, shapes })
}

/// Recursive 1 (C.22 with $\alpha$ and a general $k$) to a given order; with $\rho = r - 1$:
///
/// $$ (\Delta\lambda_i)_r = \frac{\alpha_{ii} - \beta_{ii}\lambda_i - \sum_{j\ne i}\big(\beta_{ij}(\gamma_i)_\rho - \alpha_{ij}\big)(p_{ji})_\rho}{k_{ii} + \beta_{ii}} $$
/// $$ (p_{ij})_r = -\frac{\beta_{ij}(\gamma_j)_\rho - \alpha_{ij} + \sum_{s\ne i,j}\big(\beta_{is}(\gamma_j)_\rho - \alpha_{is}\big)(p_{sj})_\rho}
///    {k_{ii}\big((\gamma_j)_\rho - \lambda_i\big) + \beta_{ii}(\gamma_j)_\rho - \alpha_{ii}} $$
///
/// # Errors
/// As [`first_order`], and [`Error::Setting`] for order zero.
pub fn recursive_1<T>(change: &ModalChange<T>, order: usize) -> Result<Perturbed<T>, Error>
where
    T: ComplexField<RealField = f64> + Copy,
{
    check_order(order)?;
    let coupling = Coupling::of(change);
    let mut now = first_order(change)?;
    for _ in 2..=order {
        now = coupling.next_order(change, now)?;
    }
    Ok(now)
}

/// [`recursive_1`] until two orders in a row change no root by more than `tolerance` (relative), at most to order
/// `orders`.
///
/// One quiet order is not enough here: a change of mass enters the sum for a root without the root itself, so that with
/// two modes the roots move in every second order only.
///
/// # Errors
/// As [`recursive_1`]; [`Error::UnsettledRoots`] as [`super::recursive_1_converged`].
pub fn recursive_1_converged<T>(
    change: &ModalChange<T>,
    tolerance: f64,
    orders: usize,
) -> Result<Settled<T>, Error>
where
    T: ComplexField<RealField = f64> + Copy,
{
    check_order(orders)?;
    let coupling = Coupling::of(change);
    let mut now = first_order(change)?;
    let (mut order, mut last_change, mut quiet_orders) = (1, 1.0, 0);
    while order < orders && quiet_orders < QUIET_ORDERS {
        let before = now.roots.clone();
        now = coupling.next_order(change, now)?;
        order += 1;
        last_change = largest_change(&before, &now.roots);
        quiet_orders = if last_change < tolerance {
            quiet_orders + 1
        } else {
            0
        };
    }
    Settled {
        perturbed: now,
        order,
        last_change,
    }
    .check(orders)
}

/// $\beta$ and $\alpha$ without their diagonals.
struct Coupling<T> {
    beta: DMatrix<T>,
    alpha: DMatrix<T>,
}

impl<T> Coupling<T>
where
    T: ComplexField<RealField = f64> + Copy,
{
    fn of(change: &ModalChange<T>) -> Self {
        let (mut beta, mut alpha) = (change.beta.clone(), change.alpha.clone());
        beta.fill_diagonal(T::zero());
        alpha.fill_diagonal(T::zero());
        Self { beta, alpha }
    }

    /// One order of Recursive 1.
    fn next_order(
        &self,
        change: &ModalChange<T>,
        mut now: Perturbed<T>,
    ) -> Result<Perturbed<T>, Error> {
        // As for stiffness alone: with p_jj = 1 and no diagonals, the products hold all the sums of this order.
        let (stiffness_sums, g_sums) = (&self.beta * &now.shapes, &self.alpha * &now.shapes);
        for j in 0..change.len() {
            let gamma = now.roots[j];
            let sum = |i: usize| stiffness_sums[(i, j)] * gamma - g_sums[(i, j)];
            for i in (0..change.len()).filter(|&i| i != j) {
                now.shapes[(i, j)] = change.quotient(-sum(i), gamma, (i, j))?;
            }
            now.roots[j] = change.first_order_root(j) - sum(j) / change.own_stiffness(j);
        }
        finite(now)
    }
}

/// Recursive 2 (C.24 with $\alpha$ and a general $k$) to a given order: explicit roots, and shapes from one linear
/// solution per mode.
///
/// $$ (\Delta\lambda_i)_r = \frac{A_i - \lambda_i S_i}{k_{ii} + S_i}, \qquad S_i = \sum_j \beta_{ij}(p_{ji})_\rho, \quad
///    A_i = \sum_j \alpha_{ij}(p_{ji})_\rho \quad (j = i \text{ included}) $$
/// $$ \sum_{s \ne j}\big[k_{is}((\gamma_j)_r - \lambda_i) + \beta_{is}(\gamma_j)_r - \alpha_{is}\big](p_{sj})_r
///    = \alpha_{ij} - \beta_{ij}(\gamma_j)_r, \qquad i \ne j $$
///
/// # Errors
/// As [`first_order`], [`Error::Setting`] for order zero, and [`Error::CoalescingModes`] when the linear system of
/// a mode is singular.
pub fn recursive_2<T>(change: &ModalChange<T>, order: usize) -> Result<Perturbed<T>, Error>
where
    T: ComplexField<RealField = f64> + Copy,
{
    check_order(order)?;
    let mut now = first_order(change)?;
    for _ in 2..=order {
        let roots = explicit_roots(change, &now.shapes)?;
        now = finite(Perturbed {
            shapes: shapes_by_linear_solution(change, &roots)?,
            roots,
        })?;
    }
    Ok(now)
}

/// The original formulae of 1947: first-order roots and shapes, then the root once more from those shapes.
///
/// # Errors
/// As [`first_order`].
pub fn original<T>(change: &ModalChange<T>) -> Result<Perturbed<T>, Error>
where
    T: ComplexField<RealField = f64> + Copy,
{
    let Perturbed { shapes, .. } = first_order(change)?;
    finite(Perturbed {
        roots: explicit_roots(change, &shapes)?,
        shapes,
    })
}

/// Roots from given shapes, $\gamma_i = \lambda_i + (A_i - \lambda_i S_i)/(k_{ii} + S_i)$ (C.24).
fn explicit_roots<T>(change: &ModalChange<T>, shapes: &DMatrix<T>) -> Result<DVector<T>, Error>
where
    T: ComplexField<RealField = f64> + Copy,
{
    let roots = DVector::from_fn(change.len(), |i, _| {
        let stiffness_sum = (change.beta.row(i) * shapes.column(i))[0];
        let g_sum = (change.alpha.row(i) * shapes.column(i))[0];
        let lambda = change.roots[i];
        lambda
            + (g_sum - lambda * stiffness_sum) / (change.generalized_stiffness[i] + stiffness_sum)
    });
    check_finite_roots(&roots)?;
    Ok(roots)
}

/// Shapes that satisfy all rows but their own for given roots, one (n−1) × (n−1) solution per mode.
fn shapes_by_linear_solution<T>(
    change: &ModalChange<T>,
    roots: &DVector<T>,
) -> Result<DMatrix<T>, Error>
where
    T: ComplexField<RealField = f64> + Copy,
{
    let size = change.len();
    let mut shapes = DMatrix::identity(size, size);
    if size == 1 {
        // One mode has no others, and the library's solution of an empty system panics.
        return Ok(shapes);
    }
    for (j, &gamma) in roots.iter().enumerate() {
        let mut rows = change.beta.clone() * gamma - &change.alpha;
        for i in 0..size {
            rows[(i, i)] += change.generalized_stiffness[i] * (gamma - change.roots[i]);
        }
        let right = -rows.column(j).remove_row(j);
        let solution = rows
            .remove_row(j)
            .remove_column(j)
            .lu()
            .solve(&right)
            .filter(|solution| solution.iter().all(|value| value.is_finite()))
            .ok_or(Error::CoalescingModes {
                first: j,
                second: j,
                separation: 0.0,
            })?;
        shapes.set_column(j, &solution.insert_row(j, T::one()));
    }
    Ok(shapes)
}

/// Largest change of a root relative to itself, or to round-off in the largest root where that is more.
fn largest_change<T>(before: &DVector<T>, after: &DVector<T>) -> f64
where
    T: ComplexField<RealField = f64> + Copy,
{
    let floor = f64::EPSILON * before.iter().map(|root| root.modulus()).fold(0.0, f64::max);
    before
        .iter()
        .zip(after.iter())
        .map(|(&old, &new)| (new - old).modulus() / old.modulus().max(floor))
        .fold(0.0, f64::max)
}

/// Passes on what is finite, so that a recursion that runs away never returns NaN.
fn finite<T>(perturbed: Perturbed<T>) -> Result<Perturbed<T>, Error>
where
    T: ComplexField<RealField = f64> + Copy,
{
    check_finite_roots(&perturbed.roots)?;
    check_finite("perturbed generalized shapes", &perturbed.shapes)?;
    Ok(perturbed)
}

fn check_finite_roots<T>(roots: &DVector<T>) -> Result<(), Error>
where
    T: ComplexField<RealField = f64> + Copy,
{
    check_finite(
        "perturbed roots",
        &DMatrix::from_column_slice(roots.len(), 1, roots.as_slice()),
    )
}
