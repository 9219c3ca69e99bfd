//! The figures of the box and of its cases.

pub mod box_elements;
pub mod cases;
pub mod comparisons;
pub mod cover_gages;

pub use cases::{SHOWN, case_figures};
pub use comparisons::comparison_figures;
