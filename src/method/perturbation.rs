//! Perturbation of roots and shapes by a change of stiffness alone (7, 8): what the loops run on.
//! Tour: [chapter 2](crate::tour::chapter_02_recursion).
//!
//! The modes before the change are $V$ with $V^t M V = I$ and $k = V^t K V = \mathrm{diag}(\omega^2)$. With
//! $\lambda = 1/\omega^2$ (the paper's root of $(K\lambda - M)v = 0$) a change of stiffness $\Delta K$ enters through
//! $\beta = V^t \Delta K V$ alone, both in rad²/s², and mode $j$ of the changed structure is $V p_j$ with root $\gamma_j$:
//!
//! $$ \big[k(\gamma_j - \Lambda) + \beta\gamma_j\big] p_j = 0, \qquad p_{jj} = 1. $$
//!
//! [`appendix_c`](crate::method::appendix_c) has the same with changes of mass, and unsymmetric and complex pencils.

use super::{
    error::{Error, Result, at_least_one},
    linear_algebra::{Matrix, Number, Vector, check_finite, check_matrix},
    modes::check_vibrations,
};

/// Denominator relative to the generalized stiffness below which two modes count as coalescing.
pub const SMALLEST_SEPARATION: f64 = 1e-9;

/// Relative change of a root at which Recursive 1 counts as converged: round-off.
pub const ROOT_TOLERANCE: f64 = 1e-13;
/// Most orders of Recursive 1.
pub const MOST_ORDERS: usize = 60;
/// Roots and generalized shapes after a change; complex where [`appendix_c`](crate::method::appendix_c) works on complex numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Perturbed<T = f64> {
    /// Changed roots $\gamma_i = \lambda_i + \Delta\lambda_i = 1/\omega_i^2$, s².
    pub roots: Vector<T>,
    /// Generalized shapes $p$ (n × n): column $j$ is mode $j$ in terms of the modes before the change, $p_{jj} = 1$.
    pub shapes: Matrix<T>,
}

/// First order (C.20, C.21):
///
/// $$ \Delta\lambda_i = -\frac{\lambda_i \beta_{ii}}{k_{ii} + \beta_{ii}}, \qquad
///    p_{ij} = -\frac{\beta_{ij}}{k_{ii} + \beta_{ii} - 1/\gamma_j}, \quad i \ne j $$
///
/// so that $\gamma_i = \lambda_i + \Delta\lambda_i = 1/(k_{ii} + \beta_{ii})$: Rayleigh's quotient on the old shape. Modes that
/// the change does not couple, $\beta_{ij} = 0$, may have equal roots.
///
/// # Errors
/// A change that does not fit or is not finite, a $k_{ii}$ or $k_{ii} + \beta_{ii}$ that is not positive, and a denominator of coupled
/// modes that vanishes.
///
/// # Example
///
/// ```rust
/// use corfem::method::perturbation::first_order;
/// use nalgebra::{dmatrix, dvector};
///
/// // k = (1, 5): the first root is 1 / (1 + 1), and takes on -0.3 / (5 - 2) of the second mode.
/// let found = first_order(&dvector![1.0, 5.0], &dmatrix![1.0, 0.3; 0.3, 0.0])?;
/// assert!((found.roots[0] - 0.5).abs() < 1e-15 && (found.shapes[(1, 0)] + 0.1).abs() < 1e-15);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn first_order(generalized_stiffness: &Vector, beta: &Matrix) -> Result<Perturbed> {
    let (k, size) = (generalized_stiffness, generalized_stiffness.len());
    at_least_one("modes", size)?;
    check_matrix("generalized stiffness change", beta, size, size)?;
    check_vibrations(k)?;
    let mut now = Perturbed {
        roots: (k + beta.diagonal()).map(f64::recip),
        shapes: Matrix::identity(size, size),
    };
    check_vibrations(&now.roots)?;
    update_shapes(k, beta, beta, &mut now)?;
    Ok(now)
}

/// Recursive 1 (7, 8, C.22) to a given order, from first order on. Superscripts in parentheses are orders, which the
/// paper writes as outer subscripts; with $\rho = r - 1$:
///
/// $$ \Delta\lambda_i^{(r)} = -\frac{\beta_{ii}\lambda_i + \gamma_i^{(\rho)} \sum_{j\ne i}\beta_{ij}p_{ji}^{(\rho)}}{k_{ii}+\beta_{ii}}, \qquad
///    p_{ij}^{(r)} = -\frac{\beta_{ij} + \sum_{s\ne i,j}\beta_{is}p_{sj}^{(\rho)}}{k_{ii}+\beta_{ii} - 1/\gamma_j^{(\rho)}}, \quad i \ne j $$
///
/// The print has $p_{ij}$ where the row of mode $i$ needs $p_{ji}$, and the root of row $i$ in the denominator of
/// $p_{ij}$, where that of mode $j$ belongs (`paper/errata.md`).
///
/// # Errors
/// Order zero, and what [`first_order`] refuses, which it starts with, in later orders too.
///
/// # Example
///
/// ```rust
/// use corfem::method::perturbation::recursive_1;
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
    generalized_stiffness: &Vector,
    beta: &Matrix,
    order: usize,
) -> Result<Perturbed> {
    Ok(settle(generalized_stiffness, beta, 0.0, order)?.0)
}

/// Recursive 1 until no root changes by more than [`ROOT_TOLERANCE`] (relative), at most to order [`MOST_ORDERS`].
///
/// # Errors
/// Every error of [`recursive_1`], a recursion whose last order still changes a root by more than [`LARGEST_UNSETTLED_CHANGE`], as happens
/// where roots are close, and two modes that settle on one, as a strong change can make them.
///
/// # Example
///
/// ```rust
/// use corfem::method::perturbation::recursive_1_converged;
/// use nalgebra::{dmatrix, dvector};
///
/// // The eigenvalues of k + β, with 2 and 5 on its diagonal and 0.3 beside it, are 3.5 ∓ √(1.5² + 0.3²).
/// let (k, beta) = (dvector![1.0, 5.0], dmatrix![1.0, 0.3; 0.3, 0.0]);
/// let found = recursive_1_converged(&k, &beta)?;
/// assert!((1.0 / found.perturbed.roots[0] - (3.5 - 2.34_f64.sqrt())).abs() < 1e-12);
/// assert!(found.order < 15, "{}", found.order);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn recursive_1_converged(generalized_stiffness: &Vector, beta: &Matrix) -> Result<Settled> {
    let k = generalized_stiffness;
    let (found, ended) = settle(k, beta, ROOT_TOLERANCE, MOST_ORDERS)?;
    let a = Matrix::from_diagonal(k) + beta;
    Settled::prove(found, ended, &a, &Matrix::identity(k.len(), k.len()))
}

/// Recursive 1 to an order, or until no root changes by as much as `tolerance`; with the last order and the largest relative change of
/// a root in it.
fn settle(
    k: &Vector,
    beta: &Matrix,
    tolerance: f64,
    orders: usize,
) -> Result<(Perturbed, (usize, f64))> {
    at_least_one("order", orders)?;
    let mut perturbed = first_order(k, beta)?;
    let mut coupling = beta.clone();
    coupling.fill_diagonal(0.0);
    let (mut order, mut last_change) = (1, 1.0);
    while order < orders && last_change >= tolerance {
        // With p_jj = 1 and no diagonal in the coupling, column j of the product is β_ij + Σ_{s≠i,j} β_is p_sj off
        // the diagonal and Σ_{i≠j} β_ji p_ij on it: all the sums of this order at once.
        let sums = &coupling * &perturbed.shapes;
        update_shapes(k, beta, &sums, &mut perturbed)?;
        last_change = 0.0;
        for (j, gamma) in perturbed.roots.iter_mut().enumerate() {
            let lambda = 1.0 / k[j];
            let root =
                lambda - (beta[(j, j)] * lambda + *gamma * sums[(j, j)]) / (k[j] + beta[(j, j)]);
            last_change = (root / *gamma - 1.0).abs().max(last_change);
            *gamma = root;
        }
        check_vibrations(&perturbed.roots)?;
        order += 1;
    }
    Ok((perturbed, (order, last_change)))
}

/// Shapes from the present roots and the sums over the others, $p_{ij} = -S_{ij}/(k_{ii} + \beta_{ii} - 1/\gamma_j)$.
fn update_shapes(k: &Vector, beta: &Matrix, sums: &Matrix, now: &mut Perturbed) -> Result<()> {
    for j in 0..k.len() {
        for i in (0..k.len()).filter(|&i| i != j) {
            let (own, other) = (k[i] + beta[(i, i)], 1.0 / now.roots[j]);
            now.shapes[(i, j)] = component(sums[(i, j)], own, other, [i, j])?;
        }
    }
    check_finite("perturbed shapes", &now.shapes)
}

/// Generalized shape of the first of two modes in the second, $-S/(a - b)$: zero where nothing couples them, refused where something does
/// and the denominator vanishes beside $a$.
pub(crate) fn component<T: Number>(sum: T, a: T, b: T, modes: [usize; 2]) -> Result<T> {
    let ([first, second], difference) = (modes, a - b);
    let separation = difference.modulus() / a.modulus();
    match sum {
        sum if sum == T::zero() => Ok(T::zero()),
        sum if separation > SMALLEST_SEPARATION => Ok(-sum / difference),
        _ => Err(Error::CoalescingModes {
            first,
            second,
            separation,
        }),
    }
}

/// Relative change of a root in the last order allowed above which a recursion has not settled: a thousandth of an error sum of
/// some percent. How far a slow recursion still has to go, its residuals tell.
pub const LARGEST_UNSETTLED_CHANGE: f64 = 1e-6;

/// Relative error of a root up to which residuals prove it: half as much in nine frequencies moves the error sum by less than a
/// hundredth of the inner loop's tolerance.
pub const LARGEST_ROOT_ERROR: f64 = 1e-4;

/// One minus the cosine of two generalized shapes below which they are those of one mode, if their roots agree to [`SAME_ROOT`]:
/// where roots have settled to 1e-6, shapes of one mode agree to better than a hundredth, and those of two modes are orthogonal.
const SAME_SHAPE: f64 = 1e-2;
/// Relative distance of two roots below which they are one.
const SAME_ROOT: f64 = 1e-3;

/// Result of a recursion that goes on until its roots settle.
#[derive(Debug, Clone, PartialEq)]
pub struct Settled<T = f64> {
    /// Roots and shapes of the last order.
    pub perturbed: Perturbed<T>,
    /// The last order.
    pub order: usize,
    /// Largest relative change of a root in it: how far the recursion may still have had to go.
    pub last_change: f64,
    /// Bound on the relative error of every root.
    pub root_error: f64,
}

impl<T: Number> Settled<T> {
    /// Accepts a recursion on $(A\gamma - G)p = 0$ whose roots have settled, or nearly so, on as many modes as there are, and are proven
    /// by their residuals: a strong change can lead two modes to one, and then another is missed.
    ///
    /// With $E = (AP)^{-1}(GP - AP\Gamma)$ the exact roots are the eigenvalues of $\Gamma + E$. By Gershgorin's theorem they lie in discs
    /// about the $\gamma_j$, as many in every group of discs as it has members, of radius
    ///
    /// $$ |\gamma_j| \sum_s |E_{js}| / \sqrt{|\gamma_j \gamma_s|} . $$
    pub(crate) fn prove(
        perturbed: Perturbed<T>,
        (order, last_change): (usize, f64),
        a: &Matrix<T>,
        g: &Matrix<T>,
    ) -> Result<Self> {
        let Perturbed { roots, shapes } = &perturbed;
        let ap = a * shapes;
        let residual = g * shapes - &ap * Matrix::from_diagonal(roots);
        // A root below round-off of the largest counts as that.
        let sizes = roots.map(T::modulus);
        let floor = f64::EPSILON * sizes.max();
        let scale = sizes.map(|size| size.max(floor).sqrt().recip());
        let of_roots = &scale * scale.transpose();
        let radius = |e: Matrix<T>| e.map(T::modulus).component_mul(&of_roots).column_sum();
        // NaN proves nothing, and has not settled either.
        let radii = ap
            .lu()
            .solve(&residual)
            .map(radius)
            .filter(|it| !it.sum().is_nan());
        let root_error = radii.map_or(f64::INFINITY, |radii| radii.max());
        let is_settled = last_change <= LARGEST_UNSETTLED_CHANGE;
        for second in 0..roots.len() {
            for first in (0..second).filter(|_| is_settled) {
                let (p, q) = (shapes.column(first), shapes.column(second));
                let cosine = p.dotc(&q).modulus() / (p.norm() * q.norm());
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
        match is_settled && root_error <= LARGEST_ROOT_ERROR {
            true => Ok(Self {
                perturbed,
                order,
                last_change,
                root_error,
            }),
            false => Err(Error::UnsettledRoots {
                orders: order,
                last_change,
                root_error,
            }),
        }
    }
}
