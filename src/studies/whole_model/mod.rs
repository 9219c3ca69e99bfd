//! A whole model without condensation: sparse matrices at every degree of freedom, and modes read at the sensors.

mod analysis;
mod condensation;
pub(crate) mod elements;
mod factor;
mod modes;
mod sparse;

pub use analysis::{WholeModel, WholeParameter, WholeShare};
pub use condensation::{CondensationError, LARGEST_CONDENSATION_ERROR};
pub use factor::Factor;
pub use modes::{FINITE, MOST_DENSE_ROWS, check_none_missed, lowest_modes};
pub use sparse::SparseMatrix;
