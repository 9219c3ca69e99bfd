//! The method, in the order of the paper: a text to be read in an evening.
//!
//! Plain functions over matrices, one section of the paper a file. The paper's symbols stand inside the functions, beside the
//! numbers of their equations; names and signatures are in words. What is no sentence of the paper is marked *ours*. Nothing here
//! knows of the other rooms.

pub mod structure;
pub mod elements;
pub mod appendix_a;
pub mod modes;
pub mod appendix_b;
pub mod sorting;
pub mod error_sum;
pub mod perturbation;
pub mod appendix_c;
pub mod changed_modes;
pub mod analysis;
pub mod derivatives;
pub mod step;
pub mod model;
pub mod inner_loop;
pub mod outer_loop;

pub mod error;
pub mod linear_algebra;
