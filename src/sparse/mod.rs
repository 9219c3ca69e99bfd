//! The method's analysis at any size: compressed matrices, an ordering, a factorization with its inertia, and counted modes.
//!
//! [`crate::method`] says what is computed; here it is computed fast. Each fast form equals the plain one by a property of the
//! specification.

mod assignment;
mod assurance;
mod basis;
mod checks;
#[doc(hidden)]
pub mod elements;
#[doc(hidden)]
pub mod factorization;
mod free;
mod mass_changes;
mod matrix;
mod modes;
mod ordering;
mod place;
pub mod random;
mod sensor_model;
mod share;
pub(crate) mod visibility;
pub mod whole_modes;
mod whole_model;

pub(crate) use assignment::pair_cheaply;
pub use assignment::pair_optimally;
pub(crate) use assurance::cosines;
#[doc(hidden)]
pub use assurance::modal_assurance;
pub(crate) use basis::Basis;
#[doc(hidden)]
pub(crate) use checks::{
    finite, gram, inverse_of_positive, places_above, solve_lower, solve_positive, take_product,
    transposed_product,
};
pub use factorization::{Factor, Work};
pub use free::{BodyFinding, Places, RigidBodies, Support};
#[doc(hidden)]
pub use mass_changes::normalize_with_mass;
pub(crate) use matrix::HalfUnit;
pub use matrix::SparseMatrix;
pub use modes::{CountedModes, FINITE, MOST_DENSE_ROWS};
pub(crate) use place::{Place, is_held};
pub use sensor_model::{Candidates, ModeWeight, Pair, SensorModel};
pub(crate) use sensor_model::{check_weights, is_one_root, moves_of};
pub use share::{ParameterMatrix, Share, UNSEEN_SHARE, WholeShare};
pub use whole_model::{WholeModel, WholeParameter};

use crate::method::modes::Modes;
use nalgebra::{DMatrix, DVector};

/// No modes, as of a test that has frequencies alone.
pub(crate) fn no_modes(dof_count: usize) -> Modes {
    Modes {
        omega_squared: DVector::zeros(0),
        shapes: DMatrix::zeros(dof_count, 0),
    }
}
