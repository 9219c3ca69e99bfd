//! Files of other programs, and the programs themselves.

pub mod deck;
pub mod error;
pub mod nastran95;
