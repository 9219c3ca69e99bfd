//! The command line program: `corfem --help`.

mod program;

use std::process::ExitCode;

fn main() -> ExitCode {
    program::run()
}
