//! The method, in the order of the paper.

pub mod appendix_a;
pub mod appendix_b;
pub mod appendix_c;
pub mod assembly;
pub mod derivatives;
pub mod elements;
pub mod error;
pub mod error_sum;
pub mod inner_loop;
pub mod linear_algebra;
pub mod modal;
pub mod model;
pub mod modes;
pub mod outer_loop;
pub mod pairing;
pub mod parameters;
pub mod step;
pub mod structure;
pub mod whole_modes;
