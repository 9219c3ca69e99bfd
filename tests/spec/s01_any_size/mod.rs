//! The text and the machine: fast forms beside plain ones, of any size.

pub mod condensation;
pub mod factorization;
pub mod free_modes;
pub mod residual_vectors;
pub mod whole_model;
pub mod whole_model_modes;
pub mod whole_model_pencils;
pub mod wing;
