//! Closed forms: structures whose answers can be written down.

pub mod analytical;
pub mod uniform_chain;
