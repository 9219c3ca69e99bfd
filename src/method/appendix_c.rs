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
//! complex numbers. Stiffness alone is in [`perturbation`](crate::method::perturbation).

use super::{
    error::{Error, Result, at_least_one, require},
    linear_algebra::{
        Matrix, Number, Vector, as_faer, check_finite, check_matrix, check_shape, cholesky, reduced,
    },
    modes::{apply_sign_rule, mode},
    perturbation::{Perturbed, component},
};
use nalgebra::Complex;

/// Neighboring magnitudes that differ by less than this fraction count as equal for the order of modes, so that
/// round-off does not choose the order of a conjugate pair.
const MAGNITUDE_TIE: f64 = 1e-9;

/// Cosine between a mode's left and right shapes below which the pencil counts as defective. Round-off splits a double
/// root that has one shape by about 1e-8 of its size, and its shapes by as much.
const SMALLEST_COSINE: f64 = 1e-7;

/// Roots with right and left shapes, biorthogonal with respect to the stiffness and to $G$ (C.8 to C.10).
#[derive(Debug, Clone)]
pub struct LeftRightModes<T> {
    /// Roots $\lambda_i$ of $(K\lambda - G)v = 0$, s²; $1/\omega_i^2$ for a vibration.
    pub roots: Vector<T>,
    /// Right shapes $V$, solutions of $(K\lambda - G)v = 0$ (C.1), one per column.
    pub right: Matrix<T>,
    /// Left shapes $U$, solutions of $(K\lambda - G)^t u = 0$ (C.2), one per column.
    pub left: Matrix<T>,
}

/// All modes of the general pencil (C.1), $(K\lambda - G)v = 0$, for a symmetric positive definite $K$ (lbf/in) and any $G$ (lbf·s²/in),
/// d × d, complex and unsymmetric such as mass with aerodynamic terms.
///
/// With $K = L L^t$ this is the ordinary eigenproblem of $L^{-1} G L^{-t}$, solved through faer. With its shapes in the
/// columns of $Y$,
///
/// $$ V = L^{-t} Y, \qquad U = L^{-t} Y^{-t}, \qquad U^t K V = I, \qquad U^t G V = \Lambda. $$
///
/// - Order: by falling $|\lambda|$; roots of equal magnitude (to one part in 10⁹) by rising argument from −π to π.
/// - Scale: $v^* K v = 1$ with $v^*$ the conjugate transpose, and $u^t K v = 1$.
/// - Phase: the first of the largest components of $v$ (within one part in a million) is real and positive.
///
/// # Errors
/// A stiffness that is not positive definite, a $G$ that does not fit or is not finite, and a pencil that has fewer shapes than DOF.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_c::solve;
/// use nalgebra::{Complex, dmatrix};
///
/// // 4 λ - (1 + 2i) = 0.
/// let modes = solve(&dmatrix![4.0], &dmatrix![Complex::new(1.0, 2.0)])?;
/// assert!((modes.roots[0] - Complex::new(0.25, 0.5)).norm() < 1e-15);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn solve(stiffness: &Matrix, g: &Matrix<Complex<f64>>) -> Result<LeftRightModes<Complex<f64>>> {
    let (what, size) = ("mass and aerodynamic terms", stiffness.nrows());
    at_least_one("degrees of freedom", size)?;
    let lower = cholesky("stiffness", stiffness, 0.0)?.map(Complex::from);
    check_matrix(what, g, size, size)?;
    let eigen = as_faer(&reduced(&lower, g))
        .eigen()
        .map_err(|_| Error::no_convergence(what))?;
    let root = |i: usize| eigen.S()[i];
    let mut order: Vec<usize> = (0..size).collect();
    order.sort_by(|&a, &b| root(b).norm().total_cmp(&root(a).norm()));
    let is_tie = |&a: &usize, &b: &usize| root(b).norm() >= (1.0 - MAGNITUDE_TIE) * root(a).norm();
    for equal in order.chunk_by_mut(is_tie) {
        equal.sort_by(|&a, &b| root(a).arg().total_cmp(&root(b).arg()));
    }
    let mut right = Matrix::from_fn(size, size, |row, j| eigen.U()[(row, order[j])]);
    for mut shape in right.column_iter_mut() {
        shape.normalize_mut();
    }
    lower.tr_solve_lower_triangular_unchecked_mut(&mut right);
    apply_sign_rule(&mut right);
    let y = lower.tr_mul(&right);
    // Left shapes of shapes that depend on each other are infinitely long.
    let endless = Matrix::from_element(size, size, Complex::from(f64::INFINITY));
    let mut left = y.try_inverse().unwrap_or(endless).transpose();
    for (place, shape) in left.column_iter().enumerate() {
        let (what, cosine) = ("cosine of left and right shapes", 1.0 / shape.norm());
        require(
            cosine > SMALLEST_COSINE,
            what,
            || mode(place),
            cosine,
            "above 1e-7",
        )?;
    }
    lower.tr_solve_lower_triangular_unchecked_mut(&mut left);
    Ok(LeftRightModes {
        roots: Vector::from_fn(size, |j, _| root(order[j])),
        right,
        left,
    })
}

/// Generalized stiffness between a left and another right mode, relative to their own, above which shapes count as not
/// biorthogonal. Round-off leaves about 1e-14 times their condition.
const LARGEST_COUPLING: f64 = 1e-8;

/// Pencil after a change of $K$ and of $G$, seen through the modes before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Pencil<T> {
    a: Matrix<T>,
    g: Matrix<T>,
}

impl Pencil<f64> {
    /// A change seen through mass-orthonormal modes of vibration, whose $k_{ii} = \omega_i^2$ (rad²/s²) and
    /// $k_{ii} \lambda_i = 1$: `beta` $= V^t\Delta K V$ and `alpha` $= V^t \Delta M V$ (n × n).
    ///
    /// # Errors
    /// No modes, and changes that do not fit or are not finite.
    pub fn of_vibrations(omega_squared: &Vector, beta: &Matrix, alpha: &Matrix) -> Result<Self> {
        let size = omega_squared.len();
        at_least_one("modes", size)?;
        check_matrix("generalized stiffness change", beta, size, size)?;
        check_matrix("generalized mass change", alpha, size, size)?;
        Ok(Self {
            a: Matrix::from_diagonal(omega_squared) + beta,
            g: Matrix::identity(size, size) + alpha,
        })
    }
}

impl<T: Number> Pencil<T> {
    /// Changes of stiffness (lbf/in) and of $G$ (lbf·s²/in), all d × d, seen through the modes before them.
    ///
    /// # Errors
    /// Input that does not fit or is not finite, and a $U^t K V$ that is not diagonal (C.10).
    pub fn new(
        stiffness: &Matrix<T>,
        modes: &LeftRightModes<T>,
        stiffness_change: &Matrix<T>,
        g_change: &Matrix<T>,
    ) -> Result<Self> {
        let (dof_count, count) = modes.right.shape();
        check_shape("left shapes", &modes.left, dof_count, count)?;
        let through_modes = |what, matrix: &Matrix<T>| {
            check_matrix(what, matrix, dof_count, dof_count)?;
            Ok(modes.left.tr_mul(&(matrix * &modes.right)))
        };
        let k = through_modes("stiffness", stiffness)?;
        for j in 0..count {
            for i in (0..count).filter(|&i| i != j) {
                let found = k[(i, j)].modulus() / (k[(i, i)] * k[(j, j)]).modulus().sqrt();
                let (what, owner) = ("coupling of left and right shapes", || {
                    format!("modes {i} and {j}")
                });
                require(found <= LARGEST_COUPLING, what, owner, found, "zero")?;
            }
        }
        let k = Matrix::from_diagonal(&k.diagonal());
        Ok(Self {
            g: &k * Matrix::from_diagonal(&modes.roots) + through_modes("change of G", g_change)?,
            a: k + through_modes("stiffness change", stiffness_change)?,
        })
    }

    /// $A = k + \beta$ (n × n).
    pub fn a(&self) -> &Matrix<T> {
        &self.a
    }

    /// $G = k\Lambda + \alpha$ (n × n).
    pub fn g(&self) -> &Matrix<T> {
        &self.g
    }

    /// Change seen by the transposed pencil (C.2); the changed left modes are $U$ times its shapes.
    pub fn transposed(&self) -> Self {
        Self {
            a: self.a.transpose(),
            g: self.g.transpose(),
        }
    }

    /// First order (C.20, C.21 with $\alpha$ and a general $k$), where $\gamma_i = \lambda_i + \Delta\lambda_i$:
    ///
    /// $$ \Delta\lambda_i = \frac{\alpha_{ii} - \beta_{ii}\lambda_i}{k_{ii} + \beta_{ii}}, \qquad
    ///    p_{ij} = -\frac{\beta_{ij}\gamma_j - \alpha_{ij}}{A_{ii}\gamma_j - G_{ii}}, \quad i \ne j $$
    ///
    /// Modes that the change does not couple may have equal roots.
    ///
    /// # Errors
    /// A root that is not finite, as where some $A_{ii}$ vanishes, and a denominator of coupled modes that vanishes.
    ///
    /// # Example
    ///
    /// ```rust
    /// use corfem::method::appendix_c::Pencil;
    /// use nalgebra::{dmatrix, dvector};
    ///
    /// // Twice the mass halves ω² = 4.
    /// let pencil = Pencil::of_vibrations(&dvector![4.0], &dmatrix![0.0], &dmatrix![1.0])?;
    /// assert_eq!(pencil.first_order()?.roots[0], 1.0 / 2.0);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn first_order(&self) -> Result<Perturbed<T>> {
        self.recursive_1(1)
    }

    /// Recursive 1 (C.22 with $\alpha$ and a general $k$) to a given order; with $\rho = r - 1$:
    ///
    /// $$ \gamma_j^{(r)} = \frac{G_{jj} - \sum_{s\ne j} f_{js} p_{sj}^{(\rho)}}{A_{jj}}, \quad
    ///    p_{ij}^{(r)} = -\frac{\sum_{s\ne i} f_{is} p_{sj}^{(\rho)}}{f_{ii}},
    ///    \quad f_{is} = A_{is}\gamma_j^{(\rho)} - G_{is}, \quad i \ne j $$
    ///
    /// Order zero is $p = I$ with $\gamma_j = G_{jj}/A_{jj}$, so that order one is [`Self::first_order`].
    ///
    /// # Errors
    /// Order zero, a root that is not finite, and a denominator of coupled modes that vanishes.
    pub fn recursive_1(&self, order: usize) -> Result<Perturbed<T>> {
        at_least_one("order", order)?;
        (0..order).try_fold(self.order_zero()?, |now, _| self.next_order(now))
    }

    /// Order zero: the shapes before the change, and Rayleigh's quotients on them for roots.
    pub(crate) fn order_zero(&self) -> Result<Perturbed<T>> {
        self.with_explicit_roots(Matrix::identity(self.g.nrows(), self.g.nrows()))
    }

    /// One more order of Recursive 1.
    pub(crate) fn next_order(&self, mut now: Perturbed<T>) -> Result<Perturbed<T>> {
        let (mut a, mut g, size) = (self.a.clone(), self.g.clone(), self.g.nrows());
        a.fill_diagonal(T::zero());
        g.fill_diagonal(T::zero());
        let (a_sums, g_sums) = (a * &now.shapes, g * &now.shapes);
        for j in 0..size {
            let gamma = now.roots[j];
            let sum = |i: usize| a_sums[(i, j)] * gamma - g_sums[(i, j)];
            for i in (0..size).filter(|&i| i != j) {
                let (own, other) = (self.a[(i, i)] * gamma, self.g[(i, i)]);
                now.shapes[(i, j)] = component(sum(i), own, other, [i, j])?;
            }
            now.roots[j] = (self.g[(j, j)] - sum(j)) / self.a[(j, j)];
        }
        finite(now)
    }

    /// Recursive 2 (C.24 in general) to a given order: explicit roots, and shapes from one linear solution per mode.
    ///
    /// $$ \gamma_i^{(r)} = \frac{\sum_j G_{ij} p_{ji}^{(\rho)}}{\sum_j A_{ij} p_{ji}^{(\rho)}}, \qquad
    ///    \sum_{s \ne j}\big[A_{is}\gamma_j^{(r)} - G_{is}\big] p_{sj}^{(r)} = G_{ij} - A_{ij}\gamma_j^{(r)}, \ i \ne j $$
    ///
    /// # Errors
    /// Order zero, a root that is not finite, a denominator of coupled modes that vanishes, and a singular linear system of a mode.
    ///
    /// # Example
    ///
    /// ```rust
    /// use corfem::method::appendix_c::Pencil;
    /// use nalgebra::{DMatrix, dmatrix, dvector};
    ///
    /// // First order has -0.3 / (5 - 2) of the second mode in the first; then 1 / (2 + 0.3 · -0.1).
    /// let (k, beta) = (dvector![1.0, 5.0], dmatrix![1.0, 0.3; 0.3, 0.0]);
    /// let pencil = Pencil::of_vibrations(&k, &beta, &DMatrix::zeros(2, 2))?;
    /// assert!((pencil.recursive_2(2)?.roots[0] - 1.0 / 1.97).abs() < 1e-15);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn recursive_2(&self, order: usize) -> Result<Perturbed<T>> {
        at_least_one("order", order)?;
        let (mut now, size) = (self.first_order()?, self.g.nrows());
        for _ in 2..=order {
            now = self.with_explicit_roots(now.shapes)?;
            // One mode has no others, and nalgebra's solution of an empty system panics.
            for j in (0..size).filter(|_| size > 1) {
                // The shape satisfies all equations but its own.
                let rows = (&self.a * now.roots[j] - &self.g).remove_row(j);
                let others = rows.clone().remove_column(j).lu().solve(&-rows.column(j));
                let others = others.ok_or(Error::CoalescingModes {
                    first: j,
                    second: j,
                    separation: 0.0,
                })?;
                now.shapes.set_column(j, &others.insert_row(j, T::one()));
            }
            now = finite(now)?;
        }
        Ok(now)
    }

    /// Original formulae of 1947: first-order roots and shapes, then the root once more from those shapes.
    ///
    /// # Errors
    /// A root that is not finite, and a denominator of coupled modes that vanishes.
    ///
    /// # Example
    ///
    /// ```rust
    /// use corfem::method::appendix_c::Pencil;
    /// use nalgebra::{DMatrix, dmatrix, dvector};
    ///
    /// // The root is that of the second order of Recursive 2, the shape that of first order.
    /// let (k, beta) = (dvector![1.0, 5.0], dmatrix![1.0, 0.3; 0.3, 0.0]);
    /// let pencil = Pencil::of_vibrations(&k, &beta, &DMatrix::zeros(2, 2))?;
    /// let found = pencil.original()?;
    /// assert_eq!(found.roots, pencil.recursive_2(2)?.roots);
    /// assert_eq!(found.shapes, pencil.first_order()?.shapes);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn original(&self) -> Result<Perturbed<T>> {
        self.with_explicit_roots(self.first_order()?.shapes)
    }

    /// Given shapes with their roots, $\gamma_i = g_i/a_i$ with the diagonals $g$ of $Gp$ and $a$ of $Ap$ (C.24).
    fn with_explicit_roots(&self, shapes: Matrix<T>) -> Result<Perturbed<T>> {
        let (a, g) = (&self.a * &shapes, &self.g * &shapes);
        let roots = g.diagonal().component_div(&a.diagonal());
        finite(Perturbed { roots, shapes })
    }
}

/// Accepts roots and shapes that are finite; the root of a mode without stiffness is not.
fn finite<T: Number>(found: Perturbed<T>) -> Result<Perturbed<T>> {
    check_finite("perturbed roots", &Matrix::from_diagonal(&found.roots))?;
    check_finite("perturbed generalized shapes", &found.shapes)?;
    Ok(found)
}
