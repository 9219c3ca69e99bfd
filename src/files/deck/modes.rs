//! Modes of any deck, also of one whose mass matrix is singular.

use super::model::BulkData;
use crate::method::assembly::{FactorizedStiffness, element_matrices};
use crate::method::error::Error;
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use crate::method::structure::StructuralDof;
use nalgebra::{DMatrix, DVector};

/// Eigenvalue of the weighted flexibility relative to the largest below which a root counts as infinite.
///
/// It is far above the round-off of the flexibility (1e-15 or so) and below any frequency that means something: the
/// highest one kept may be three million times the lowest.
const SMALLEST_ROOT: f64 = 1e-13;

/// The modes of a deck at the DOF that have mass.
#[derive(Debug, Clone, PartialEq)]
pub struct DeckModes {
    /// Rows of the shapes.
    pub dof: Vec<StructuralDof>,
    /// Every mode with a finite frequency.
    pub modes: Modes,
}

/// All modes of finite frequency of the model that a deck describes.
///
/// The dynamic DOF are those with mass: dependent ones through their MPC equations, free ones as they are
/// ([`BulkData::dynamic_dof`]). With $F = T M^{1/2}$ the roots $\lambda = 1/\omega^2$ are the eigenvalues of
///
/// $$ F^t K_S^{-1} F\, y = \lambda\, y, \qquad v = M^{-1/2} y, $$
///
/// the modes of $(K_D, M)$ without a $K_D$: no root is lost or invented where masses are more than the structure can
/// tell apart, which would leave the dynamic flexibility $T^t K_S^{-1} T$ without an inverse.
///
/// # Errors
/// Those of [`BulkData::structure`], [`BulkData::dynamic_dof`], the elements and the factorization of $K_S$.
pub fn modes(model: &BulkData) -> Result<DeckModes, Error> {
    let structure = model.structure()?;
    let dynamic = model.dynamic_dof(&structure)?;
    let sizes: Vec<f64> = model.elements.iter().map(|element| element.size).collect();
    let stiffness =
        FactorizedStiffness::new(&element_matrices(&structure)?, &sizes, structure.free_dof())?;
    let root_mass = dynamic.mass.map(f64::sqrt);
    let weighted = scale_columns(&dynamic.load_distribution, &root_mass);
    let flexibility = symmetric_part(&weighted.tr_mul(&stiffness.solve(&weighted)?));
    let (roots, vectors) = symmetric_eigen("weighted dynamic flexibility", &flexibility)?;
    // Ascending roots are descending frequencies.
    let largest = roots[roots.len() - 1];
    let finite: Vec<usize> = (0..roots.len())
        .rev()
        .filter(|&mode| roots[mode] > SMALLEST_ROOT * largest)
        .collect();
    let mut shapes = vectors.select_columns(&finite);
    for (mut row, root_mass) in shapes.row_iter_mut().zip(root_mass.iter()) {
        row /= *root_mass;
    }
    let omega_squared = roots.select_rows(&finite).map(f64::recip);
    Ok(DeckModes {
        dof: dynamic.dof,
        modes: Modes::ascending(omega_squared, shapes),
    })
}

/// $A\,\mathrm{diag}(s)$.
fn scale_columns(matrix: &DMatrix<f64>, scale: &DVector<f64>) -> DMatrix<f64> {
    let mut scaled = matrix.clone();
    for (mut column, scale) in scaled.column_iter_mut().zip(scale.iter()) {
        column *= *scale;
    }
    scaled
}
