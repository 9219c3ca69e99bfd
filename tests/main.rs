//! The method's specification: one test program, in folders that mirror the rooms of `src/`, in the order of the text.

mod common;

mod cases;
mod files;
mod ledgers;
mod method;
mod present;
mod program;
mod studies;
