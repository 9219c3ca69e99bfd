//! Appendix A: from structural to dynamic degrees of freedom.
//! Tour: [chapter 6](crate::tour::chapter_06_condensation).

use crate::method::assembly::{ElementMatrix, FactorizedStiffness};
use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{check_shape, cholesky, symmetric_part};
use nalgebra::DMatrix;

/// Pivot of the flexibility relative to its diagonal below which a dynamic DOF is a combination of others.
const SMALLEST_FLEXIBILITY_PIVOT: f64 = 1e-13;

/// The stiffness at the dynamic DOF and the transformation that brought it there.
#[derive(Debug, Clone)]
pub struct Condensed {
    /// $K_D$, lbf/in (d × d).
    pub stiffness: DMatrix<f64>,
    /// $B^t = K_S^{-1} T K_D$: structural deflections for unit dynamic ones (free SDOF × d).
    pub transformation: DMatrix<f64>,
}

/// Dynamic stiffness and transformation for a load distribution $T$ (A.3, free SDOF × d).
///
/// $$ K_D^{-1} = T^t K_S^{-1} T, \qquad B^t = K_S^{-1} T K_D, \qquad q_S = B^t q_D $$
///
/// $T$ distributes dynamic loads to structural ones, $Q_S = T Q_D$; by equal work $q_D = T^t q_S$. When $T$ only
/// selects DOF this is static (Guyan) condensation. Source: the paper's (1), (2), (A.5), (A.7), (A.8), of which the
/// last two print $T^t$ for $T$ (`paper/errata.md`).
///
/// # Errors
/// [`Error::Empty`] without dynamic DOF; [`Error::WrongShape`] and [`Error::NotFinite`] for a bad $T$;
/// [`Error::Dependent`] when a dynamic DOF is a combination of those before it.
pub fn condense(structural: &FactorizedStiffness, load_distribution: &DMatrix<f64>) -> Result<Condensed, Error> {
    condense_deflections(load_distribution, structural.solve(load_distribution)?)
}

/// The same from the deflections $K_S^{-1} T$, whatever solved for them.
///
/// # Errors
/// Those of [`condense`].
pub(crate) fn condense_deflections(t: &DMatrix<f64>, deflections: DMatrix<f64>) -> Result<Condensed, Error> {
    check_shape("deflections", &deflections, t.nrows(), t.ncols())?;
    at_least_one("dynamic degrees of freedom", t.ncols())?;
    let flexibility = symmetric_part(&t.tr_mul(&deflections));
    let lower = cholesky("dynamic flexibility", &flexibility, SMALLEST_FLEXIBILITY_PIVOT)
        .map_err(|error| error.or_dependent("dynamic degree of freedom"))?;
    let mut inverse_factor = DMatrix::identity(t.ncols(), t.ncols());
    lower.solve_lower_triangular_unchecked_mut(&mut inverse_factor);
    let stiffness = inverse_factor.tr_mul(&inverse_factor);
    Ok(Condensed { transformation: deflections * &stiffness, stiffness })
}

/// Generalized stiffness of an element for unit size, $V_e^t K_e V_e$ with $V_e$ the rows of `shapes` (free SDOF × m)
/// at the element's own DOF, lbf/in per unit size for deflections in inches (m × m).
///
/// For `shapes` $= B^t$ it is the element's share of $K_D$, $B K_e B^t$ (A.9); the shares, times the sizes, sum to
/// $K_D$ exactly. For $V_S = B^t V$ it is that share seen through dynamic shapes $V$.
pub(crate) fn generalized_stiffness(shapes: &DMatrix<f64>, element: &ElementMatrix) -> DMatrix<f64> {
    let rows = shapes.select_rows(&element.dof);
    symmetric_part(&rows.tr_mul(&(&element.unit * &rows)))
}

/// Generalized mass of an element for unit size in the same way, $V_e^t M_e V_e$ with the lumped $M_e$ (m × m).
pub(crate) fn generalized_mass(shapes: &DMatrix<f64>, element: &ElementMatrix) -> DMatrix<f64> {
    let rows = shapes.select_rows(&element.dof);
    let mut weighted = rows.clone();
    weighted.column_iter_mut().for_each(|mut column| column.component_mul_assign(&element.unit_mass));
    symmetric_part(&rows.tr_mul(&weighted))
}
