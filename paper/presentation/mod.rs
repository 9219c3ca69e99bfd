//! How the paper's own cases are shown: their tables and figures, the page that tells them, their history and matrices as JSON.
//!
//! The program has this as a module of its commands, the tests as one of theirs; it draws and writes with
//! [`corfem::present`].

pub mod figures;
pub mod json;
pub mod overview;
pub mod page;
pub mod report;
pub mod tables;
pub mod words;
