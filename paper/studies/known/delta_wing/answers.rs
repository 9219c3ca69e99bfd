//! What the wing does under load and in vibration, and what others found.

use super::super::weighed::lumped_mass;
use super::{DeltaWing, STATIONS, upper_grid};
use corfem::files::test_data::row_name;
use corfem::method::appendix_a::{ElementMatrix, assemble, element_matrices};
use corfem::method::error::Error;
use corfem::method::structure::Structure;
use corfem::sparse::factorization::Factor;
use corfem::sparse::whole_modes::{MassDof, WholeModes, whole_modes};
use corfem::sparse::{SparseMatrix, Support};
use corfem::torque_box::error::CaseError;
use corfem::torque_box::published::PublishedTable;
use nalgebra::DMatrix;

/// Direction of every load and measured deflection.
const Z: usize = 2;

/// Upper grids whose deflections were measured and printed.
pub const MEASURED_GRIDS: [usize; 9] = [14, 15, 16, 34, 35, 36, 54, 55, 74];

/// Which end of the tip is loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TipLoad {
    /// At the trailing edge, grid 16.
    TrailingEdge,
    /// At the leading edge, grid 36.
    LeadingEdge,
}

impl TipLoad {
    /// The grid that is loaded.
    pub fn grid(self) -> usize {
        upper_grid(usize::from(self == Self::LeadingEdge), STATIONS.len() - 1)
    }
}

impl DeltaWing {
    /// All modes at every free DOF, each of which has mass of covers and webs: nothing is condensed.
    ///
    /// # Errors
    /// Those of [`Self::structure`], of the factorization and of [`whole_modes`].
    pub fn modes(&self) -> Result<WholeModes, Error> {
        let (structure, elements, sizes, _) = self.parts()?;
        let mass = lumped_mass(&structure);
        let dof = structure.free_dof().to_vec();
        let dense = assemble(&elements, &sizes, dof.len())?;
        let t = DMatrix::identity(dof.len(), dof.len());
        let stiffness = SparseMatrix::of_dense("stiffness", &dense)?;
        whole_modes(
            &stiffness,
            MassDof {
                load_distribution: SparseMatrix::of_dense("load distribution", &t)?,
                dof,
                mass,
            },
            usize::MAX,
            &Support::default(),
            |row| row_name(row, &[]),
        )
    }

    /// The structure, its unit element matrices, sizes and stiffness.
    fn parts(&self) -> Result<(Structure, Vec<ElementMatrix>, Vec<f64>, Factor), Error> {
        let structure = self.structure()?;
        let elements: Vec<_> = element_matrices(&structure).collect();
        let sizes: Vec<f64> = structure.elements().iter().map(|e| e.size).collect();
        let dense = assemble(&elements, &sizes, structure.free_dof().len())?;
        let stiffness = Factor::new("stiffness", &SparseMatrix::of_dense("stiffness", &dense)?)?;
        Ok((structure, elements, sizes, stiffness))
    }

    /// Deflections along $z$ at [`MEASURED_GRIDS`] under the tip load, in; downward is negative.
    ///
    /// # Errors
    /// Those of [`Self::structure`] and of the factorization.
    pub fn deflections(&self, load: TipLoad) -> Result<Vec<f64>, Error> {
        let (structure, .., stiffness) = self.parts()?;
        // The z of every grid named here is free, whatever the depths and sizes of the wing are.
        let row = |grid: usize| structure.free_dof_index(grid, Z);
        let loaded = row(load.grid());
        let at = |dof, _| {
            if Some(dof) == loaded {
                -self.tip_load
            } else {
                0.0
            }
        };
        let deflected = stiffness.solve(&DMatrix::from_fn(structure.free_dof().len(), 1, at))?;
        Ok(MEASURED_GRIDS
            .iter()
            .filter_map(|&grid| Some(deflected[row(grid)?]))
            .collect())
    }
}

/// Deflections at [`MEASURED_GRIDS`] that NASTRAN printed in 1995, that were measured, that the analog computer gave.
///
/// # Errors
/// [`CaseError::Table`] if the table were damaged.
pub fn known_deflections() -> Result<PublishedTable, CaseError> {
    let text = include_str!("../../../tables/delta_wing_deflections.csv");
    PublishedTable::parse(0, "paper/tables/delta_wing_deflections.csv", text)
}

/// The same for the lowest three modes.
///
/// # Errors
/// [`CaseError::Table`] if the table were damaged.
pub fn known_frequencies() -> Result<PublishedTable, CaseError> {
    let text = include_str!("../../../tables/delta_wing_frequencies.csv");
    PublishedTable::parse(0, "paper/tables/delta_wing_frequencies.csv", text)
}
