//! Appendix A: the structural stiffness, and from structural to dynamic degrees of freedom.
//! Tour: [chapter 7](crate::tour::chapter_07_condensation).

use super::{
    elements::unit_stiffness,
    error::{Error, Result, at_least_one, check_places},
    linear_algebra::{
        Matrix, check_length, check_matrix, check_shape, cholesky, congruence, round_off,
        symmetric_part,
    },
    modes::generalized_mass,
    structure::Structure,
};

/// Pivot of the flexibility relative to its diagonal below which a dynamic DOF is a combination of others.
const SMALLEST_PIVOT: f64 = 1e-13;

/// Stiffness of one element of unit size at the free structural DOF it touches.
#[derive(Debug, Clone)]
pub struct ElementMatrix {
    /// The element's number.
    pub label: usize,
    /// Rows among the free DOF, in the order of `unit`.
    pub dof: Vec<usize>,
    /// Stiffness for a gage of 1 in or an area of 1 in², lbf/in.
    pub unit: Matrix,
}

/// Unit stiffness of every element, restricted to the free DOF, in the structure's order.
///
/// # Example
///
/// ```rust
/// use corfem::chain::rods;
/// use corfem::method::appendix_a::element_matrices;
/// use nalgebra::dmatrix;
///
/// // The first rod's end at the wall has no free DOF.
/// let elements: Vec<_> = element_matrices(&rods(&[100.0, 50.0], [true, false])?).collect();
/// assert_eq!((elements[0].dof.clone(), elements[0].unit.clone()), (vec![0], dmatrix![1.0]));
/// assert_eq!(elements[1].unit, dmatrix![1.0, -1.0; -1.0, 1.0]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn element_matrices(structure: &Structure) -> impl Iterator<Item = ElementMatrix> {
    let elements = structure.elements().iter().zip(structure.corners());
    elements.map(move |(element, corners)| {
        let of_grid = |&grid| (0..3).map(move |axis| structure.free_dof_index(grid, axis));
        let rows = element.grids.iter().flat_map(of_grid).enumerate();
        let (local, dof): (Vec<usize>, Vec<usize>) =
            rows.filter_map(|(local, row)| Some((local, row?))).unzip();
        let full = unit_stiffness(element.kind, corners, &element.material);
        ElementMatrix {
            label: element.label,
            unit: full.select_rows(&local).select_columns(&local),
            dof,
        }
    })
}

/// Structural stiffness $K_S = \sum_e t_e K_e$ at the free DOF, lbf/in.
///
/// `sizes` are the gages (in) and areas (in²) $t_e$, one per element; `dof_count` the number of free DOF.
///
/// # Errors
/// Another number of sizes, a matrix that does not fit its DOF, and a DOF beyond those that there are.
///
/// # Example
///
/// ```rust
/// use corfem::chain::rods;
/// use corfem::method::appendix_a::{assemble, element_matrices};
/// use nalgebra::dmatrix;
///
/// let elements: Vec<_> = element_matrices(&rods(&[100.0, 50.0], [true, false])?).collect();
/// let stiffness = assemble(&elements, &[100.0, 50.0], 2)?;
/// assert_eq!(stiffness, dmatrix![150.0, -50.0; -50.0, 50.0]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn assemble(elements: &[ElementMatrix], sizes: &[f64], dof_count: usize) -> Result<Matrix> {
    check_length("element sizes", sizes.len(), elements.len())?;
    let mut stiffness = Matrix::zeros(dof_count, dof_count);
    for (ElementMatrix { dof, unit, .. }, size) in elements.iter().zip(sizes) {
        check_shape("element stiffness", unit, dof.len(), dof.len())?;
        check_places("degrees of freedom", dof, dof_count)?;
        for (a, &row) in dof.iter().enumerate() {
            for (b, &column) in dof.iter().enumerate() {
                stiffness[(row, column)] += size * unit[(a, b)];
            }
        }
    }
    Ok(stiffness)
}

/// Stiffness at the dynamic DOF, and the transformation that brought it there.
#[derive(Debug, Clone)]
pub struct Condensed {
    /// $K_D$, lbf/in (d × d).
    pub stiffness: Matrix,
    /// $B^t = K_S^{-1} T K_D$: structural deflections for unit dynamic ones (free SDOF × d).
    pub transformation: Matrix,
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
/// A structure that nothing holds, a dynamic DOF that is a combination of those before it, no dynamic DOF, and a $T$ that does not fit or
/// is not finite.
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
pub fn condense(stiffness: &Matrix, load_distribution: &Matrix) -> Result<Condensed> {
    let (free_count, dynamic_count) = (stiffness.nrows(), load_distribution.ncols());
    at_least_one("dynamic degrees of freedom", dynamic_count)?;
    check_matrix(
        "load distribution",
        load_distribution,
        free_count,
        dynamic_count,
    )?;
    let lower = cholesky("structural stiffness", stiffness, 0.0)?;
    // Scaled to unit diagonal, A = S K_S S, a stiffness that holds every motion has no eigenvalue within round-off of zero. The
    // smallest is at least 1 / trace(A⁻¹) = 1 / ‖L⁻¹ S⁻¹‖². The pivots do not tell, for one that follows a small one is as wrong as
    // round-off divided by it; the smallest pivot names the row.
    let scale = stiffness.diagonal().map(f64::sqrt);
    let scaled = lower.solve_lower_triangular_unchecked(&Matrix::from_diagonal(&scale));
    let is_held = 1.0 / scaled.norm_squared() > round_off(scale.len());
    if !is_held {
        return Err(Error::NotPositiveDefinite {
            what: "structural stiffness",
            row: lower.diagonal().component_div(&scale).imin(),
        });
    }
    // With K_S = L Lᵗ and W = L⁻¹ T: Tᵗ K_S⁻¹ T = Wᵗ W, and K_S⁻¹ T = L⁻ᵗ W.
    let half = lower.solve_lower_triangular_unchecked(load_distribution);
    let flexibility = half.tr_mul(&half);
    let dynamic = cholesky("dynamic flexibility", &flexibility, SMALLEST_PIVOT)?;
    // And with the flexibility F = D Dᵗ: F⁻¹ = D⁻ᵗ D⁻¹.
    let identity = Matrix::identity(dynamic_count, dynamic_count);
    let inverse = dynamic.solve_lower_triangular_unchecked(&identity);
    let stiffness = inverse.tr_mul(&inverse);
    let deflections = lower.tr_solve_lower_triangular_unchecked(&half);
    Ok(Condensed {
        transformation: deflections * &stiffness,
        stiffness,
    })
}

/// Dynamic mass of a structural mass $M_S$ (lbf·s²/in, free SDOF × free SDOF) and the transformation $B^t$ of [`condense`] (free SDOF × d),
/// lbf·s²/in (d × d).
///
/// $$ M = B M_S B^t $$
///
/// It has the kinetic energy of the structural mass in every motion $q_S = B^t q_D$. Source: the paper's (A.9).
///
/// # Errors
/// A mass that does not fit the transformation, and a product that is not finite.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_a::dynamic_mass;
/// use nalgebra::dmatrix;
///
/// // Masses of 9 in the middle and 1 at the tip, where the middle goes a third as far: 9/3² + 1.
/// let mass = dynamic_mass(&dmatrix![9.0, 0.0; 0.0, 1.0], &dmatrix![1.0 / 3.0; 1.0])?;
/// assert!((mass[0] - 2.0).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn dynamic_mass(structural_mass: &Matrix, transformation: &Matrix) -> Result<Matrix> {
    let mass = generalized_mass(transformation, structural_mass)?;
    Ok(symmetric_part(&mass))
}

/// Share of an element in the stiffness for shapes at the structural DOF, $t_e V_e^t K_e V_e$ (A.9), where $V_e$ are the rows of
/// `structural_shapes` (free SDOF × m) at its own DOF.
///
/// For $B^t$ it is the element's share of $K_D$, $t_e B K_e B^t$; the shares sum to $K_D$ exactly.
pub fn generalized_stiffness(
    element: &ElementMatrix,
    size: f64,
    structural_shapes: &Matrix,
) -> Matrix {
    let own = structural_shapes.select_rows(&element.dof);
    size * symmetric_part(&congruence(&element.unit, &own))
}
