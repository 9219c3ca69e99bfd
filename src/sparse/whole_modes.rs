//! Modes at the degrees of freedom that have mass.

use super::WholeModel;
use super::elements::moving_mass_entries;
use super::modes::CountedModes;
use super::place::turn_alike;
use crate::method::error::Error;
use crate::method::linear_algebra::check_length;
use crate::method::modes::Modes;
use crate::method::structure::StructuralDof;
use crate::sparse::{BodyFinding, SparseMatrix, Support};
use nalgebra::{DMatrix, DVector};

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
    /// Their shapes at the rows of the stiffness, signed alike; none where these are the rows of `modes`.
    pub at_rows: DMatrix<f64>,
    /// Number of vibrations with a finite frequency that there are, where it was counted.
    pub counted: Option<usize>,
    /// Number of rigid-body modes beside them.
    pub rigid_body: usize,
    /// Findings about free motions that the digits of the stiffness leave open.
    pub doubtful: Vec<BodyFinding>,
    /// The part of every frequency that the digits of given matrices leave open, as a standard deviation; none of a deck.
    pub open: Vec<f64>,
}

/// The lowest vibrations of finite frequency of $K_S$ (free SDOF × free SDOF, lbf/in) and $T M T^t$ at the DOF that have mass, counted
/// as by [`WholeModel::modes`]: `most` of them, or all if there are fewer. `support` is that of $K_S$, whose rows are
/// called `name`.
///
/// # Errors
/// [`Error::WrongShape`] for a $T$ or masses that do not fit; the errors of [`WholeModel::modes`].
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
    let whole = WholeModel::supported(stiffness.clone(), mass, Vec::new(), support.clone())?;
    let (stiffness, mass) = whole.at(&[])?;
    let (CountedModes { vibrations, .. }, _) = whole.modes_of((&stiffness, &mass), most, None)?;
    let mut at_rows = vibrations.shapes;
    let shapes = t.transposed().times(&at_rows)?;
    let modes = Modes::signed(vibrations.omega_squared, shapes.clone());
    turn_alike(&mut at_rows, &shapes, &modes.shapes);
    let rigid_body = whole.rigid_bodies()?.rigid();
    // A held structure has no more vibrations than masses.
    let are_all = rigid_body == 0 && modes.len() == at.mass.len();
    Ok(WholeModes {
        dof: at.dof,
        counted: are_all.then_some(modes.len()),
        modes,
        at_rows,
        rigid_body,
        doubtful: whole.body_findings(name, None)?,
        open: Vec::new(),
    })
}
