//! Closed forms: structures whose answers can be written down, for tests and for learning.

pub mod analytical;
pub mod spring_chain;
pub mod two_dof;
