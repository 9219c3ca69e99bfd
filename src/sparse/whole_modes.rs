//! Modes of a structure at every degree of freedom that has mass, also where the mass matrix is singular.

use crate::method::error::Error;
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use crate::method::structure::StructuralDof;
use crate::sparse::factorization::FactorizedStiffness;
use crate::sparse::free_modes::{CountedModes, counted_modes};
use nalgebra::{DMatrix, DVector};

/// Eigenvalue of the weighted flexibility relative to the largest below which a frequency counts as infinite: far above
/// round-off, yet it keeps frequencies up to three million times the lowest.
const SMALLEST_ROOT: f64 = 1e-13;

/// The degrees of freedom that move with mass.
#[derive(Debug, Clone, PartialEq)]
pub struct MassDof {
    /// Which they are.
    pub dof: Vec<StructuralDof>,
    /// $T$ (free SDOF × d): $q_D = T^t q_S$.
    pub load_distribution: DMatrix<f64>,
    /// The mass on each, lbf·s²/in.
    pub mass: DVector<f64>,
}

/// Modes at the DOF that have mass.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeModes {
    /// Rows of the shapes.
    pub dof: Vec<StructuralDof>,
    /// Every vibration with a finite frequency.
    pub modes: Modes,
    /// How many rigid-body modes there are beside them.
    pub rigid_body: usize,
}

/// The same of a structure that hangs free, its rigid-body modes found by a shift, counted and left out ([`counted_modes`]).
///
/// `stiffness` is $K_S$ at all free SDOF (lbf/in).
///
/// # Errors
/// Those of [`counted_modes`].
pub fn free_whole_modes(stiffness: &DMatrix<f64>, at: MassDof) -> Result<WholeModes, Error> {
    let t = &at.load_distribution;
    let mass = t * DMatrix::from_diagonal(&at.mass) * t.transpose();
    let CountedModes {
        rigid_body,
        vibrations,
    } = counted_modes(stiffness, &mass)?;
    let modes = Modes::ascending(vibrations.omega_squared, t.tr_mul(&vibrations.shapes));
    Ok(WholeModes {
        dof: at.dof,
        modes,
        rigid_body: rigid_body.ncols(),
    })
}

/// All modes of finite frequency at the DOF that have mass.
///
/// With $F = T M^{1/2}$ the roots $\lambda = 1/\omega^2$ are the eigenvalues of
///
/// $$ F^t K_S^{-1} F y = \lambda y, \qquad v = M^{-1/2} y . $$
///
/// They are the modes of $(K_D, M)$, but need no inverse of the dynamic flexibility $T^t K_S^{-1} T$, which is singular
/// where the structure moves several masses as one.
///
/// # Errors
/// [`Error::WrongShape`] for a $T$ that does not fit the stiffness; [`Error::NotFinite`].
pub fn whole_modes(stiffness: &FactorizedStiffness, at: MassDof) -> Result<WholeModes, Error> {
    let root_mass = at.mass.map(f64::sqrt);
    let mut weighted = at.load_distribution;
    weighted
        .column_iter_mut()
        .zip(&root_mass)
        .for_each(|(mut column, root_mass)| column *= *root_mass);
    let flexibility = symmetric_part(&weighted.tr_mul(&stiffness.solve(&weighted)?));
    let (roots, vectors) = symmetric_eigen("weighted dynamic flexibility", &flexibility)?;
    // Ascending roots are descending frequencies.
    let largest = roots[roots.len() - 1];
    let finite: Vec<usize> = (0..roots.len())
        .rev()
        .filter(|&mode| roots[mode] > SMALLEST_ROOT * largest)
        .collect();
    let mut shapes = vectors.select_columns(&finite);
    shapes
        .column_iter_mut()
        .for_each(|mut shape| shape.component_div_assign(&root_mass));
    let omega_squared = roots.select_rows(&finite).map(f64::recip);
    Ok(WholeModes {
        dof: at.dof,
        modes: Modes::ascending(omega_squared, shapes),
        rigid_body: 0,
    })
}
