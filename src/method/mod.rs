//! The method, in the order of the paper: a text to be read in an evening.
//!
//! Plain functions over matrices, one step of the paper a file. The paper's symbols stand inside the functions, beside the
//! numbers of their equations; names and signatures are in words. Nothing here knows of the other rooms.

pub mod error;
pub mod linear_algebra;

pub mod geometry;
pub mod structure;
pub mod elements;
pub mod assembly;
pub mod appendix_a;
pub mod modes;
pub mod appendix_b;
pub mod model;
pub mod pairing;
pub mod error_sum;
pub mod appendix_c;
pub mod state;
pub mod derivatives;
pub mod step;
pub mod inner_loop;
pub mod outer_loop;
pub mod verdict;
