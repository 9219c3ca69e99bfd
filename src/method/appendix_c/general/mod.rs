//! Appendix C in full: changes of stiffness and of $G$ together, left and right shapes, real or complex.
//! Tour: [chapter 2](crate::tour::chapter_02_recursion).
//!
//! With $k = U^t K V$ diagonal (C.10), $\beta = U^t \Delta K V$ and $\alpha = U^t \Delta G V$, the changed mode $j$ is
//! $V p_j$ with root $\gamma_j = \lambda_j + \Delta\lambda_j$ and
//!
//! $$ (A\gamma_j - G) p_j = 0, \qquad A = k + \beta, \quad G = k\Lambda + \alpha, \quad p_{jj} = 1
//!    \quad \text{(C.14 to C.19)}. $$
//!
//! The paper prints $k = g\Lambda$ before (C.13), where (C.5) gives $k\Lambda = g$, and $G$ for $G^t$ in the transposed
//! equations (C.4) to (C.9); more is in `paper/errata.md`. The same functions serve real and, with aerodynamic terms,
//! complex numbers. Stiffness alone is in [`super::recursive`].

pub mod complex_modes;
mod modal_change;

pub use crate::method::linear_algebra::Number;
pub use modal_change::ModalChange;

use super::recursive::check_order;
use super::{Perturbed, SMALLEST_SEPARATION, Settled};
use crate::method::error::Error;
use crate::method::linear_algebra::check_finite;
use nalgebra::{DMatrix, DVector};

/// Orders in a row that must leave the roots alone for a recursion with changes of mass to count as converged.
const QUIET_ORDERS: usize = 2;

/// The changed pencil in modal coordinates, $A = k + \beta$ and $G = k\Lambda + \alpha$ (n × n).
pub type Pencil<T> = (DMatrix<T>, DMatrix<T>);

/// First order (C.20, C.21 with $\alpha$ and a general $k$), where $\gamma_i = \lambda_i + \Delta\lambda_i$:
///
/// $$ \Delta\lambda_i = \frac{\alpha_{ii} - \beta_{ii}\lambda_i}{k_{ii} + \beta_{ii}}, \qquad
///    p_{ij} = -\frac{\beta_{ij}\gamma_j - \alpha_{ij}}{A_{ii}\gamma_j - G_{ii}} $$
///
/// Modes that the change does not couple may have equal roots.
///
/// # Errors
/// [`Error::Empty`], [`Error::WrongShape`], [`Error::NotFinite`] for bad input; [`Error::LostStiffness`] when some
/// $A_{ii}$ vanishes; [`Error::CoalescingModes`] when the denominator of coupled modes does.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_c::general::{ModalChange, first_order};
/// use nalgebra::{dmatrix, dvector};
///
/// // Twice the mass halves ω² = 4.
/// let change = ModalChange::of_vibrations(&dvector![4.0], dmatrix![0.0], dmatrix![1.0]);
/// assert_eq!(first_order(&change)?.roots[0], 1.0 / 2.0);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn first_order<T: Number>(change: &ModalChange<T>) -> Result<Perturbed<T>, Error> {
    recursive_1(change, 1)
}

/// Recursive 1 (C.22 with $\alpha$ and a general $k$) to a given order; with $\rho = r - 1$:
///
/// $$ \gamma_j^{(r)} = \frac{G_{jj} - \sum_{s\ne j} f_{js} p_{sj}^{(\rho)}}{A_{jj}}, \quad
///    p_{ij}^{(r)} = -\frac{\sum_{s\ne i} f_{is} p_{sj}^{(\rho)}}{f_{ii}},
///    \quad f_{is} = A_{is}\gamma_j^{(\rho)} - G_{is} $$
///
/// Order zero is $p = I$ with $\gamma_j = G_{jj}/A_{jj}$, so that order one is [`first_order`].
///
/// # Errors
/// As [`first_order`], and [`Error::Setting`] for order zero.
pub fn recursive_1<T: Number>(
    change: &ModalChange<T>,
    order: usize,
) -> Result<Perturbed<T>, Error> {
    Ok(settle(change, 0.0, order)?.perturbed)
}

/// [`recursive_1`] until two orders in a row change no root by more than `tolerance` (relative), at most to order
/// `orders`.
///
/// One quiet order is not enough: roots of two modes that only a change of mass couples move in every second order.
///
/// # Errors
/// As [`recursive_1`]; [`Error::UnsettledRoots`] as [`super::recursive_1_converged`].
pub fn recursive_1_converged<T: Number>(
    change: &ModalChange<T>,
    tolerance: f64,
    orders: usize,
) -> Result<Settled<T>, Error> {
    settle(change, tolerance, orders)?.check(tolerance, orders)
}

fn settle<T: Number>(
    change: &ModalChange<T>,
    tolerance: f64,
    orders: usize,
) -> Result<Settled<T>, Error> {
    check_order(orders)?;
    let pencil = change.pencil()?;
    let mut coupling = pencil.clone();
    coupling.0.fill_diagonal(T::zero());
    coupling.1.fill_diagonal(T::zero());
    // Order zero: the shapes before the change, and Rayleigh's quotients on them for roots.
    let shapes = DMatrix::identity(pencil.0.nrows(), pencil.0.nrows());
    let order_zero = Perturbed {
        roots: explicit_roots(&pencil, &shapes)?,
        shapes,
    };
    let mut now = next_order(&pencil, &coupling, order_zero)?;
    let (mut order, mut last_change, mut quiet_orders) = (1, 1.0, 0);
    while order < orders && quiet_orders < QUIET_ORDERS {
        let before = now.roots.clone();
        now = next_order(&pencil, &coupling, now)?;
        order += 1;
        // Round-off in the largest root is no change of a root that is smaller still.
        let floor = f64::EPSILON * before.map(T::modulus).max();
        let changes = before.zip_map(&now.roots, |old, new| {
            (new - old).modulus() / old.modulus().max(floor)
        });
        last_change = changes.fold(0.0, f64::max);
        quiet_orders = if last_change < tolerance {
            quiet_orders + 1
        } else {
            0
        };
    }
    Ok(Settled {
        perturbed: now,
        order,
        last_change,
    })
}

/// One order of Recursive 1.
fn next_order<T: Number>(
    (stiffness, g): &Pencil<T>,
    coupling: &Pencil<T>,
    mut now: Perturbed<T>,
) -> Result<Perturbed<T>, Error> {
    let (stiffness_sums, g_sums) = (&coupling.0 * &now.shapes, &coupling.1 * &now.shapes);
    for j in 0..g.nrows() {
        let gamma = now.roots[j];
        let sum = |i: usize| stiffness_sums[(i, j)] * gamma - g_sums[(i, j)];
        for i in (0..g.nrows()).filter(|&i| i != j) {
            let own = stiffness[(i, i)] * gamma;
            let difference = own - g[(i, i)];
            let separation = difference.modulus() / own.modulus();
            now.shapes[(i, j)] = match -sum(i) {
                numerator if numerator == T::zero() => numerator,
                numerator if separation > SMALLEST_SEPARATION => numerator / difference,
                _ => {
                    return Err(Error::CoalescingModes {
                        first: i,
                        second: j,
                        separation,
                    });
                }
            };
        }
        now.roots[j] = (g[(j, j)] - sum(j)) / stiffness[(j, j)];
    }
    check_finite_roots(&now.roots)?;
    check_finite("perturbed generalized shapes", &now.shapes)?;
    Ok(now)
}

/// Recursive 2 (C.24 in general) to a given order: explicit roots, and shapes from one linear solution per mode.
///
/// $$ \gamma_i^{(r)} = \frac{\sum_j G_{ij} p_{ji}^{(\rho)}}{\sum_j A_{ij} p_{ji}^{(\rho)}}, \qquad
///    \sum_{s \ne j}\big[A_{is}\gamma_j^{(r)} - G_{is}\big] p_{sj}^{(r)} = G_{ij} - A_{ij}\gamma_j^{(r)}, \ i \ne j $$
///
/// # Errors
/// As [`recursive_1`], and [`Error::CoalescingModes`] when the linear system of a mode is singular.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_c::general::{ModalChange, recursive_2};
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // First order has -0.3 / (5 - 2) of the second mode in the first; then 1 / (2 + 0.3 · -0.1).
/// let (k, beta) = (dvector![1.0, 5.0], dmatrix![1.0, 0.3; 0.3, 0.0]);
/// let change = ModalChange::of_vibrations(&k, beta, DMatrix::zeros(2, 2));
/// assert!((recursive_2(&change, 2)?.roots[0] - 1.0 / 1.97).abs() < 1e-15);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn recursive_2<T: Number>(
    change: &ModalChange<T>,
    order: usize,
) -> Result<Perturbed<T>, Error> {
    check_order(order)?;
    let pencil = change.pencil()?;
    let mut now = first_order(change)?;
    for _ in 2..=order {
        now.roots = explicit_roots(&pencil, &now.shapes)?;
        now.shapes = shapes_by_linear_solution(&pencil, &now.roots)?;
    }
    Ok(now)
}

/// The original formulae of 1947: first-order roots and shapes, then the root once more from those shapes.
///
/// # Errors
/// As [`first_order`].
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_c::general::{ModalChange, first_order, original, recursive_2};
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // The root is that of the second order of Recursive 2, the shape that of first order.
/// let (k, beta) = (dvector![1.0, 5.0], dmatrix![1.0, 0.3; 0.3, 0.0]);
/// let change = ModalChange::of_vibrations(&k, beta, DMatrix::zeros(2, 2));
/// let found = original(&change)?;
/// assert_eq!(found.roots, recursive_2(&change, 2)?.roots);
/// assert_eq!(found.shapes, first_order(&change)?.shapes);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn original<T: Number>(change: &ModalChange<T>) -> Result<Perturbed<T>, Error> {
    let Perturbed { shapes, .. } = first_order(change)?;
    Ok(Perturbed {
        roots: explicit_roots(&change.pencil()?, &shapes)?,
        shapes,
    })
}

/// Roots from given shapes, $\gamma_i = g_i/a_i$ with the diagonals $g$ of $Gp$ and $a$ of $Ap$ (C.24).
fn explicit_roots<T: Number>(
    (stiffness, g): &Pencil<T>,
    shapes: &DMatrix<T>,
) -> Result<DVector<T>, Error> {
    let roots = (g * shapes)
        .diagonal()
        .component_div(&(stiffness * shapes).diagonal());
    check_finite_roots(&roots)?;
    Ok(roots)
}

fn check_finite_roots<T: Number>(roots: &DVector<T>) -> Result<(), Error> {
    check_finite(
        "perturbed roots",
        &DMatrix::from_column_slice(roots.len(), 1, roots.as_slice()),
    )
}

/// Shapes that satisfy all equations but their own for given roots, one (n−1) × (n−1) solution per mode.
fn shapes_by_linear_solution<T: Number>(
    (stiffness, g): &Pencil<T>,
    roots: &DVector<T>,
) -> Result<DMatrix<T>, Error> {
    let size = roots.len();
    let mut shapes = DMatrix::identity(size, size);
    // One mode has no others, and nalgebra's solution of an empty system panics.
    for j in (0..size).filter(|_| size > 1) {
        let rows = (stiffness * roots[j] - g).remove_row(j);
        let solution = (rows.clone().remove_column(j).lu())
            .solve(&-rows.column(j))
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
