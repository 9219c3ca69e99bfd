//! The method, in the order of the paper.

pub mod error;
pub mod linear_algebra;

pub mod structure;

pub mod elements;

pub mod assembly;

pub mod appendix_a;

pub mod modes;
pub mod whole_modes;

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
