//! How the paper's own cases are shown, which the program has as a module of its commands, the studies behind its documents, and the wing
//! of the benches.

#[path = "../../paper/presentation/mod.rs"]
#[allow(dead_code, reason = "the program uses the rest")]
pub mod paper;

#[path = "../../paper/studies/mod.rs"]
#[allow(dead_code, reason = "the bench of studies uses the rest")]
pub mod studies;

#[path = "../../benches/wing/mod.rs"]
#[allow(dead_code, reason = "the benches use the rest")]
pub mod wing;
