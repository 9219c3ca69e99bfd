//! How the paper's own cases are shown, which the program has as a module of its commands, and the studies behind its documents.

#[path = "../../paper/presentation/mod.rs"]
#[allow(dead_code, reason = "the program uses the rest")]
pub mod paper;

#[path = "../../paper/studies/mod.rs"]
pub mod studies;
