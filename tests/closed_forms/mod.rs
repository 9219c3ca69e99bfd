//! Closed forms against what they are the closed form of.

pub mod analytical;
