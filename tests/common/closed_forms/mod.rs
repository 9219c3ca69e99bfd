//! Closed forms: structures whose answers can be written down.

pub mod analytical;
pub mod two_dof;
pub mod uniform_chain;
