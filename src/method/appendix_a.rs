//! Appendix A: from structural to dynamic degrees of freedom.
//! Tour: [chapter 6](crate::tour::chapter_06_condensation).

use crate::method::assembly::ElementMatrix;
use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{
    check_matrix, cholesky, round_off, solve_lower, symmetric_part,
};
use nalgebra::DMatrix;

/// Pivot of the flexibility relative to its diagonal below which a dynamic DOF is a combination of others.
pub(crate) const SMALLEST_FLEXIBILITY_PIVOT: f64 = 1e-13;

/// The stiffness at the dynamic DOF and the transformation that brought it there.
#[derive(Debug, Clone)]
pub struct Condensed {
    /// $K_D$, lbf/in (d × d).
    pub stiffness: DMatrix<f64>,
    /// $B^t = K_S^{-1} T K_D$: structural deflections for unit dynamic ones (free SDOF × d).
    pub transformation: DMatrix<f64>,
}

/// Dynamic stiffness and transformation of a structural stiffness $K_S$ (lbf/in, free SDOF × free SDOF) for a load
/// distribution $T$ (A.3, free SDOF × d).
///
/// $$ K_D^{-1} = T^t K_S^{-1} T, \qquad B^t = K_S^{-1} T K_D, \qquad q_S = B^t q_D $$
///
/// $T$ distributes dynamic loads to structural ones, $Q_S = T Q_D$; by equal work $q_D = T^t q_S$. When $T$ only
/// selects DOF this is static (Guyan) condensation. Source: the paper's (1), (2), (A.4) to (A.8), of which the
/// last two print $T^t$ for $T$ (`paper/errata.md`).
///
/// # Errors
/// [`Error::NotPositiveDefinite`] for a structure that nothing holds; [`Error::Empty`] without dynamic DOF;
/// [`Error::WrongShape`] and [`Error::NotFinite`] for a bad $T$; [`Error::Dependent`] when a dynamic DOF is a combination of
/// those before it.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_a::condense;
/// use nalgebra::dmatrix;
///
/// // Two springs of 100 and 50 lbf/in in a row, held at one end.
/// let stiffness = dmatrix![150.0, -50.0; -50.0, 50.0];
/// // To the tip: one spring of 1 / (1/100 + 1/50), and the middle goes a third as far.
/// let condensed = condense(&stiffness, &dmatrix![0.0; 1.0])?;
/// assert!((condensed.stiffness[0] - 100.0 / 3.0).abs() < 1e-12);
/// assert!((condensed.transformation[0] - 1.0 / 3.0).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn condense(
    stiffness: &DMatrix<f64>,
    load_distribution: &DMatrix<f64>,
) -> Result<Condensed, Error> {
    let dynamic_count = load_distribution.ncols();
    at_least_one("dynamic degrees of freedom", dynamic_count)?;
    let what = "load distribution";
    check_matrix(what, load_distribution, stiffness.nrows(), dynamic_count)?;
    let lower = cholesky("structural stiffness", stiffness, 0.0)?;
    check_held(stiffness, &lower)?;
    // With K_S = L Lᵗ and W = L⁻¹ T: Tᵗ K_S⁻¹ T = Wᵗ W, and K_S⁻¹ T = L⁻ᵗ W.
    let half = solve_lower(&lower, load_distribution.clone());
    let stiffness = dynamic_stiffness(&half.tr_mul(&half))?;
    let mut deflections = half;
    lower.tr_solve_lower_triangular_unchecked_mut(&mut deflections);
    Ok(Condensed {
        transformation: deflections * &stiffness,
        stiffness,
    })
}

/// Refuses a stiffness that may be singular for all that its numbers tell, by its Cholesky factor, and names the row of the smallest pivot.
///
/// Scaled to unit diagonal, $A = S K_S S$, it must have
///
/// $$ \frac{1}{\lVert L^{-1} S^{-1} \rVert_F^2} > 32 \varepsilon \sqrt n , $$
///
/// one divided by the trace of $A^{-1}$, which is at most the smallest eigenvalue; the right side is what round-off leaves of one that is
/// zero ([`round_off`]). The pivots do not tell: one that follows a small one is as wrong as round-off divided by it.
fn check_held(stiffness: &DMatrix<f64>, lower: &DMatrix<f64>) -> Result<(), Error> {
    let scale = stiffness.diagonal().map(f64::sqrt);
    let inverse_factor = solve_lower(lower, DMatrix::from_diagonal(&scale));
    if 1.0 / inverse_factor.norm_squared() > round_off(scale.len()) {
        return Ok(());
    }
    Err(Error::NotPositiveDefinite {
        what: "structural stiffness",
        dof: lower.diagonal().component_div(&scale).imin(),
    })
}

/// The dynamic stiffness $K_D$ (lbf/in) of its inverse, the flexibility (in/lbf), both d × d.
pub(crate) fn dynamic_stiffness(flexibility: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    let lower = cholesky(
        "dynamic flexibility",
        flexibility,
        SMALLEST_FLEXIBILITY_PIVOT,
    )
    .map_err(|error| error.or_dependent("dynamic degree of freedom"))?;
    let identity = DMatrix::identity(flexibility.nrows(), flexibility.nrows());
    let inverse_factor = solve_lower(&lower, identity);
    Ok(inverse_factor.tr_mul(&inverse_factor))
}

/// An element's share of the stiffness for shapes at the structural DOF, $s_e V_e^t K_e V_e$ (A.9), where $V_e$ are the rows of
/// `structural_shapes` (free SDOF × m) at its own DOF.
///
/// For $B^t$ it is the element's share of $K_D$, $s_e B K_e B^t$; the shares sum to $K_D$ exactly.
pub(crate) fn generalized_stiffness(
    element: &ElementMatrix,
    size: f64,
    structural_shapes: &DMatrix<f64>,
) -> DMatrix<f64> {
    let own = structural_shapes.select_rows(&element.dof);
    size * symmetric_part(&own.tr_mul(&(&element.unit * &own)))
}

/// Its share of the mass in the same way, $s_e V_e^t M_e V_e$ with the lumped $M_e$.
pub(crate) fn generalized_mass(
    element: &ElementMatrix,
    size: f64,
    structural_shapes: &DMatrix<f64>,
) -> DMatrix<f64> {
    let own = structural_shapes.select_rows(&element.dof);
    size * symmetric_part(&own.tr_mul(&(DMatrix::from_diagonal(&element.unit_mass) * &own)))
}
