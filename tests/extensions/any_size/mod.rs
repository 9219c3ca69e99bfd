//! The text and the machine: fast forms beside plain ones, of any size.

pub mod brackets;
pub mod clusters;
pub mod condensation;
pub mod deflections;
pub mod exact_slopes;
pub mod factorization;
pub mod free_modes;

pub mod rigid_bodies;
pub mod whole_model;
pub mod whole_model_modes;
pub mod whole_model_pencils;
pub mod wing;
