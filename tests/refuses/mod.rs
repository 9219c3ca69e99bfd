//! What constructors and functions of the library refuse.

mod hostile;
pub mod appendix_c;
pub mod inner_loop;
pub mod limits_of_numbers;
pub mod mass_parameters;
pub mod model;
pub mod modes;
pub mod no_panic;
pub mod outer_loop;
pub mod structures;
