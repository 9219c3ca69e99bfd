//! The method's specification as one test program. `contents` follows the paper, and its names sort first and in its order; `extensions` is
//! what is not the paper. `refuses` holds what is refused, `evidence` what the studies of `paper/studies` must show and the comparisons with
//! other programs, `readers` a user's files (its lists `files/*.toml` first), `presentation` tables, figures and the program (by
//! `program/transcripts`), `ledgers` the lists of documents held against the code.

#[macro_use]
mod common;
mod equations;
mod ledgers;

use common::presentation::paper;

mod contents;

mod extensions;

mod refuses;

mod evidence;

mod readers;

mod presentation;

use common::prelude;
