//! What the wing does under load and in vibration, and what others found.

use super::DeltaWing;
use super::planform::{STATIONS, upper_grid};
use crate::cases::published::PublishedTable;
use crate::files::deck::{self, DeckModes};
use crate::method::assembly::{FactorizedStiffness, element_matrices};
use crate::method::error::Error;
use nalgebra::DMatrix;

/// Direction of every load and measured deflection.
const Z: usize = 2;
/// The tables here have names instead of numbers.
const UNNUMBERED: usize = 0;

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
        let line = match self {
            Self::TrailingEdge => 0,
            Self::LeadingEdge => 1,
        };
        upper_grid(line, STATIONS.len() - 1)
    }
}

impl DeltaWing {
    /// All modes of finite frequency, at every DOF with mass: nothing is condensed.
    ///
    /// # Errors
    /// Those of [`Self::structure`] and [`deck::modes()`].
    pub fn modes(&self) -> Result<DeckModes, Error> {
        deck::modes(&self.bulk_data()?)
    }

    /// Deflections along $z$ at [`MEASURED_GRIDS`] under the tip load, in; downward is negative.
    ///
    /// # Errors
    /// Those of [`Self::structure`] and of the factorization.
    pub fn deflections(&self, load: TipLoad) -> Result<Vec<f64>, Error> {
        let structure = self.structure()?;
        let sizes: Vec<f64> = structure.elements().iter().map(|e| e.size).collect();
        let stiffness =
            FactorizedStiffness::new(&element_matrices(&structure)?, &sizes, structure.free_dof())?;
        // Of every grid named here z is free, by the rule of the supports.
        let row = |grid: usize| structure.free_dof_index(grid, Z);
        let mut loads = DMatrix::zeros(structure.free_dof().len(), 1);
        if let Some(row) = row(load.grid()) {
            loads[row] = -self.tip_load;
        }
        let deflected = stiffness.solve(&loads)?;
        let rows = MEASURED_GRIDS.iter().filter_map(|&grid| row(grid));
        Ok(rows.map(|row| deflected[row]).collect())
    }
}

/// What NASTRAN printed in 1995, what was measured, and what the analog computer gave: deflections at [`MEASURED_GRIDS`].
///
/// # Errors
/// [`Error::Table`] if the table were damaged.
pub fn known_deflections() -> Result<PublishedTable, Error> {
    PublishedTable::parse(
        UNNUMBERED,
        "paper/tables/delta_wing_deflections.csv",
        include_str!("../../../paper/tables/delta_wing_deflections.csv"),
    )
}

/// The same for the lowest three modes.
///
/// # Errors
/// [`Error::Table`] if the table were damaged.
pub fn known_frequencies() -> Result<PublishedTable, Error> {
    PublishedTable::parse(
        UNNUMBERED,
        "paper/tables/delta_wing_frequencies.csv",
        include_str!("../../../paper/tables/delta_wing_frequencies.csv"),
    )
}
