//! The command line program: `corfem --help`.

#![warn(clippy::too_many_lines)]

mod program;

use std::process::ExitCode;

fn main() -> ExitCode {
    program::run()
}
