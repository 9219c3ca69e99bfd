//! A whole model without condensation: sparse matrices at every degree of freedom, and modes read at the sensors.

mod sparse;

pub use sparse::SparseMatrix;
