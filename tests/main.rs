//! The method's specification: one test program, in folders that mirror the rooms of `src/`, in the order of the text,
//! and in `evidence` the studies whose tables `paper/*.md` quotes.

mod common;
mod ledgers;

mod sparse;
mod method;
mod closed_forms;
mod cases;
mod studies;
mod files;
mod present;
mod program;

mod evidence;
