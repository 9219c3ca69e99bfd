//! First order (C.20, C.21) and Recursive 1 (C.22) for a change of stiffness alone and real mass-orthonormal modes: what the
//! loops run on.
//! Tour: [chapter 2](crate::tour::chapter_02_recursion).
//!
//! Throughout, $k_{ii} = \omega_i^2 = 1/\lambda_i$ and $\beta = V^t \Delta K V$, both in rad²/s².

use super::{Perturbed, SMALLEST_SEPARATION, Settled};
use crate::method::error::{Error, at_least_one, setting};
use crate::method::linear_algebra::{check_finite, check_matrix};
use nalgebra::{DMatrix, DVector};

/// First order (C.20, C.21):
///
/// $$ \Delta\lambda_i = -\frac{\lambda_i \beta_{ii}}{k_{ii} + \beta_{ii}}, \qquad
///    p_{ij} = -\frac{\beta_{ij}}{k_{ii} + \beta_{ii} - 1/\gamma_j} $$
///
/// so that $\gamma_i = \lambda_i + \Delta\lambda_i = 1/(k_{ii} + \beta_{ii})$: Rayleigh's quotient on the old shape. Modes that
/// the change does not couple, $\beta_{ij} = 0$, may have equal roots.
///
/// # Errors
/// [`Error::WrongShape`], [`Error::NotFinite`] for bad input; [`Error::LostRoot`] when $k_{ii} + \beta_{ii} \le 0$;
/// [`Error::CoalescingModes`] when the denominator of coupled modes vanishes.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_c::first_order;
/// use nalgebra::{dmatrix, dvector};
///
/// // k = (1, 5): the first root is 1 / (1 + 1), and takes on -0.3 / (5 - 2) of the second mode.
/// let found = first_order(&dvector![1.0, 5.0], &dmatrix![1.0, 0.3; 0.3, 0.0])?;
/// assert!((found.roots[0] - 0.5).abs() < 1e-15 && (found.shapes[(1, 0)] + 0.1).abs() < 1e-15);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn first_order(
    generalized_stiffness: &DVector<f64>,
    beta: &DMatrix<f64>,
) -> Result<Perturbed, Error> {
    check_input(generalized_stiffness, beta)?;
    let size = generalized_stiffness.len();
    let roots = (generalized_stiffness + beta.diagonal()).map(f64::recip);
    let mut now = Perturbed {
        roots,
        shapes: DMatrix::identity(size, size),
    };
    now.check_roots()?;
    update_shapes(generalized_stiffness, beta, beta, &mut now)?;
    Ok(now)
}

/// Recursive 1 (7, 8, C.22) to a given order, from first order on. Superscripts in parentheses are orders, which the
/// paper writes as outer subscripts; with $\rho = r - 1$:
///
/// $$ \Delta\lambda_i^{(r)} = -\frac{\beta_{ii}\lambda_i + \gamma_i^{(\rho)} \sum_{j\ne i}\beta_{ij}p_{ji}^{(\rho)}}{k_{ii}+\beta_{ii}}, \qquad
///    p_{ij}^{(r)} = -\frac{\beta_{ij} + \sum_{s\ne i,j}\beta_{is}p_{sj}^{(\rho)}}{k_{ii}+\beta_{ii} - 1/\gamma_j^{(\rho)}} $$
///
/// The print has $p_{ij}$ where the row of mode $i$ needs $p_{ji}$, and the root of row $i$ in the denominator of
/// $p_{ij}$, where that of mode $j$ belongs (`paper/errata.md`).
///
/// # Errors
/// As [`first_order`], and [`Error::Setting`] for order zero.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_c::recursive_1;
/// use nalgebra::{dmatrix, dvector};
///
/// let found = recursive_1(&dvector![1.0, 5.0], &dmatrix![1.0, 0.3; 0.3, 0.0], 2)?;
/// // First order is 0.5 with -0.1 of the second mode; the second order 1 - (1 + 0.5 · 0.3 · -0.1) / 2.
/// assert!((found.roots[0] - 0.5075).abs() < 1e-15);
/// // The change of the exact one is a three-thousandth: ω² = 3.5 - √(1.5² + 0.3²).
/// assert!((found.roots[0] * (3.5 - 2.34_f64.sqrt()) - 1.0).abs() < 1e-4);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn recursive_1(
    generalized_stiffness: &DVector<f64>,
    beta: &DMatrix<f64>,
    order: usize,
) -> Result<Perturbed, Error> {
    Ok(settle(generalized_stiffness, beta, 0.0, order)?.perturbed)
}

/// [`recursive_1`] until no root changes by more than `tolerance` (relative), at most to order `orders`.
///
/// # Errors
/// As [`recursive_1`]; [`Error::UnsettledRoots`] when the last order allowed still changes a root by more than
/// [`super::LARGEST_UNSETTLED_CHANGE`], as happens where roots are close; [`Error::CoalescingModes`] when two of them settle on one
/// mode, as a strong change can make them.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_c::recursive_1_converged;
/// use nalgebra::{dmatrix, dvector};
///
/// // The eigenvalues of k + β, with 2 and 5 on its diagonal and 0.3 beside it, are 3.5 ∓ √(1.5² + 0.3²).
/// let (k, beta) = (dvector![1.0, 5.0], dmatrix![1.0, 0.3; 0.3, 0.0]);
/// let found = recursive_1_converged(&k, &beta, 1e-13, 60)?;
/// assert!((1.0 / found.perturbed.roots[0] - (3.5 - 2.34_f64.sqrt())).abs() < 1e-12);
/// assert!(found.order < 15, "{}", found.order);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn recursive_1_converged(
    generalized_stiffness: &DVector<f64>,
    beta: &DMatrix<f64>,
    tolerance: f64,
    orders: usize,
) -> Result<Settled, Error> {
    settle(generalized_stiffness, beta, tolerance, orders)?.check(tolerance, orders)
}

fn settle(
    k: &DVector<f64>,
    beta: &DMatrix<f64>,
    tolerance: f64,
    orders: usize,
) -> Result<Settled, Error> {
    check_order(orders)?;
    let mut now = first_order(k, beta)?;
    let mut coupling = beta.clone();
    coupling.fill_diagonal(0.0);
    let (mut order, mut last_change) = (1, 1.0);
    while order < orders && last_change >= tolerance {
        // With p_jj = 1 and no diagonal in the coupling, column j of the product is β_ij + Σ_{s≠i,j} β_is p_sj off
        // the diagonal and Σ_{i≠j} β_ji p_ij on it: all the sums of this order at once.
        let sums = &coupling * &now.shapes;
        update_shapes(k, beta, &sums, &mut now)?;
        last_change = 0.0;
        for (j, gamma) in now.roots.iter_mut().enumerate() {
            let lambda = 1.0 / k[j];
            let root =
                lambda - (beta[(j, j)] * lambda + *gamma * sums[(j, j)]) / (k[j] + beta[(j, j)]);
            last_change = (root / *gamma - 1.0).abs().max(last_change);
            *gamma = root;
        }
        now.check_roots()?;
        order += 1;
    }
    Ok(Settled {
        perturbed: now,
        order,
        last_change,
    })
}

/// Shapes from the present roots and the sums over the others, $p_{ij} = -S_{ij}/(k_{ii} + \beta_{ii} - 1/\gamma_j)$: zero
/// where nothing couples the modes, refused where something does and the denominator vanishes.
fn update_shapes(
    k: &DVector<f64>,
    beta: &DMatrix<f64>,
    sums: &DMatrix<f64>,
    now: &mut Perturbed,
) -> Result<(), Error> {
    for j in 0..k.len() {
        for i in (0..k.len()).filter(|&i| i != j) {
            let own = k[i] + beta[(i, i)];
            let difference = own - 1.0 / now.roots[j];
            now.shapes[(i, j)] = if sums[(i, j)] == 0.0 {
                0.0
            } else if difference.abs() > SMALLEST_SEPARATION * own {
                -sums[(i, j)] / difference
            } else {
                return Err(Error::CoalescingModes {
                    first: i,
                    second: j,
                    separation: (difference / own).abs(),
                });
            };
        }
    }
    check_finite("perturbed shapes", &now.shapes)
}

pub(crate) fn check_order(order: usize) -> Result<(), Error> {
    setting("order", "at least 1", order as f64, order > 0)
}

/// Refuses generalized stiffnesses that are not vibrations and a change that does not fit them.
pub(crate) fn check_input(k: &DVector<f64>, beta: &DMatrix<f64>) -> Result<(), Error> {
    at_least_one("modes", k.len())?;
    check_matrix("generalized stiffness change", beta, k.len(), k.len())?;
    match k
        .iter()
        .position(|&value| value <= 0.0 || !value.is_finite())
    {
        None => Ok(()),
        Some(mode) => Err(Error::NotAVibration {
            mode,
            value: k[mode],
        }),
    }
}
