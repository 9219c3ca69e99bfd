//! Modes at the degrees of freedom that have mass.

use super::elements::moving_mass_entries;
use super::factorization::FactorizationPlan;
use super::lowest_modes::{CountedModes, modes_at_most};
use crate::method::error::Error;
use crate::method::linear_algebra::check_length;
use crate::method::modes::Modes;
use crate::method::structure::StructuralDof;
use crate::sparse::rigid_bodies::BodyFinding;
use crate::sparse::{RigidBodies, SparseMatrix, Support};
use nalgebra::DVector;
use std::sync::Arc;

/// The degrees of freedom that move with mass.
#[derive(Debug, Clone, PartialEq)]
pub struct MassDof {
    /// Degrees of freedom with mass.
    pub dof: Vec<StructuralDof>,
    /// $T$ (free SDOF × d): $q_D = T^t q_S$.
    pub load_distribution: SparseMatrix,
    /// The mass on each, lbf·s²/in.
    pub mass: DVector<f64>,
}

/// Modes at the DOF that have mass.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeModes {
    /// Rows of the shapes; none where matrices do not name theirs.
    pub dof: Vec<StructuralDof>,
    /// Vibrations with a finite frequency, from the lowest.
    pub modes: Modes,
    /// Number of vibrations with a finite frequency that there are, where it was counted.
    pub counted: Option<usize>,
    /// Number of rigid-body modes beside them.
    pub rigid_body: usize,
    /// Findings about free motions that the digits of the stiffness leave open.
    pub doubtful: Vec<BodyFinding>,
}

/// The lowest vibrations of finite frequency of $K_S$ (free SDOF × free SDOF, lbf/in) and $T M T^t$ at the DOF that have mass, counted
/// as by [`lowest_modes`](super::lowest_modes()): `most` of them, or all if there are fewer. `support` is that of $K_S$, whose rows are
/// called `name`.
///
/// # Errors
/// [`Error::WrongShape`] for a $T$ or masses that do not fit; the errors of [`lowest_modes`](super::lowest_modes()).
pub fn whole_modes(
    stiffness: &SparseMatrix,
    at: MassDof,
    most: usize,
    support: &Support,
    name: impl Fn(usize) -> String,
) -> Result<WholeModes, Error> {
    let (t, rows) = (&at.load_distribution, stiffness.rows());
    check_length("load distribution", t.rows(), rows)?;
    check_length("masses", at.mass.len(), t.columns())?;
    let entries = at.mass.iter().enumerate().flat_map(|(column, &mass)| {
        let motion: Vec<_> = t.column(column).collect();
        moving_mass_entries(&motion, &motion, mass)
    });
    let mass = SparseMatrix::new("mass", rows, rows, entries.collect())?;
    let matrices = [stiffness, &mass].into_iter().chain(&support.resisting);
    let matrices: Vec<_> = matrices.collect();
    let plan = Arc::new(FactorizationPlan::of_sum(&matrices)?);
    let bodies = RigidBodies::by(&plan, "stiffness", stiffness, support)?;
    let (CountedModes { vibrations, .. }, _) =
        modes_at_most((stiffness, &mass), (most, most), None, &bodies, &plan)?;
    let shapes = t.transposed().times(&vibrations.shapes)?;
    Ok(WholeModes {
        dof: at.dof,
        modes: Modes::signed(vibrations.omega_squared, shapes),
        counted: None,
        rigid_body: bodies.rigid(),
        doubtful: bodies.findings(&mass, name),
    })
}
