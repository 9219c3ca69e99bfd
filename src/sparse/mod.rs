//! The method's analysis at any size: compressed matrices, an ordering, a factorization with its inertia, and counted modes.
//!
//! [`crate::method`] says what is computed; here it is computed fast. Each fast form equals the plain one by a property of the
//! specification.

mod checks;
mod condensation;
mod deformations;
pub(crate) mod elements;
pub mod factorization;
mod gradient;
mod lowest_modes;
mod matrix;
mod ordering;
pub mod random;
mod residual_vectors;
pub(crate) mod rigid_bodies;
mod subspace;
pub mod whole_modes;
mod whole_model;

pub use checks::check_solution;
pub(crate) use checks::{
    add_squares, places_above, start_vector, take_product, transposed_product,
};
pub use condensation::{LargeCondensation, LargeModel};
pub use deformations::Deformations;
pub use factorization::Factor;
pub use gradient::{PackedModel, derivative};
pub use lowest_modes::{CountedModes, FINITE, MOST_DENSE_ROWS, lowest_modes};
pub use matrix::SparseMatrix;
pub use rigid_bodies::RigidBodies;
pub use whole_model::{WholeModel, WholeParameter, WholeShare};
