//! Left and right modes of the general pencil (C.1), whose $G$ may be complex and unsymmetric, such as mass with
//! aerodynamic terms.

use crate::method::error::{Error, at_least_one, require};
use crate::method::linear_algebra::{Matrix, Vector, as_faer, check_matrix, cholesky, reduced};
use crate::method::modes::{Modes, SIGN_TIE, mode};
use nalgebra::Complex;

/// Neighboring magnitudes that differ by less than this fraction count as equal for the order of modes, so that
/// round-off does not choose the order of a conjugate pair.
const MAGNITUDE_TIE: f64 = 1e-9;

/// Cosine between a mode's left and right shapes below which the pencil counts as defective. Round-off splits a double
/// root that has one shape by about 1e-8 of its size, and its shapes by as much.
const SMALLEST_COSINE: f64 = 1e-7;

/// Roots with right and left shapes, biorthogonal with respect to the stiffness and to $G$ (C.8 to C.10).
#[derive(Debug, Clone, PartialEq)]
pub struct LeftRightModes<T> {
    /// Roots $\lambda_i$ of $(K\lambda - G)v = 0$, s²; $1/\omega_i^2$ for a vibration.
    pub roots: Vector<T>,
    /// Right shapes $V$, solutions of $(K\lambda - G)v = 0$ (C.1), one per column.
    pub right: Matrix<T>,
    /// Left shapes $U$, solutions of $(K\lambda - G)^t u = 0$ (C.2), one per column.
    pub left: Matrix<T>,
}

impl From<&Modes> for LeftRightModes<f64> {
    /// Modes of vibration: $\lambda = 1/\omega^2$ and $U = V$, for a symmetric pencil is its own transpose.
    fn from(modes: &Modes) -> Self {
        Self {
            roots: modes.omega_squared.map(f64::recip),
            right: modes.shapes.clone(),
            left: modes.shapes.clone(),
        }
    }
}

/// All modes of $(K\lambda - G)v = 0$ for a symmetric positive definite $K$ (lbf/in) and any $G$ (lbf·s²/in), d × d.
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
/// [`Error::NotPositiveDefinite`] for the stiffness; [`Error::WrongShape`] and [`Error::Value`] for a $G$ that does not fit or is not
/// finite, and for a pencil that has fewer shapes than DOF; [`Error::Count`] without DOF; [`Error::Failed`] without convergence.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_c::complex_modes::solve;
/// use nalgebra::{Complex, dmatrix};
///
/// // 4 λ - (1 + 2i) = 0.
/// let modes = solve(&dmatrix![4.0], &dmatrix![Complex::new(1.0, 2.0)])?;
/// assert!((modes.roots[0] - Complex::new(0.25, 0.5)).norm() < 1e-15);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn solve(
    stiffness: &Matrix,
    g: &Matrix<Complex<f64>>,
) -> Result<LeftRightModes<Complex<f64>>, Error> {
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
    // Shapes Y of unit length, each turned so that the first largest component of its v is real and positive.
    let mut right = Matrix::from_fn(size, size, |row, j| eigen.U()[(row, order[j])]);
    for mut shape in right.column_iter_mut() {
        let mut v = shape.clone_owned();
        lower.tr_solve_lower_triangular_unchecked_mut(&mut v);
        let largest = v.map(Complex::norm).max();
        let first = v
            .iter()
            .find(|value| value.norm() >= (1.0 - SIGN_TIE) * largest);
        let phase = first.map_or(Complex::from(1.0), |value| value / value.norm());
        shape /= phase * shape.norm();
    }
    // Left shapes of shapes that depend on each other are infinitely long.
    let endless = Matrix::from_element(size, size, Complex::from(f64::INFINITY));
    let mut left = right.clone().try_inverse().unwrap_or(endless).transpose();
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
    lower.tr_solve_lower_triangular_unchecked_mut(&mut right);
    lower.tr_solve_lower_triangular_unchecked_mut(&mut left);
    Ok(LeftRightModes {
        roots: Vector::from_fn(size, |j, _| root(order[j])),
        right,
        left,
    })
}
