//! Programs of `golden/` that check by themselves, run where their language is.

use crate::prelude::*;

fn passes(script: &str) {
    let mut command = Command::new("python3");
    command.args([script, env!("CARGO_BIN_EXE_corfem")]);
    let done = command.current_dir(in_root("")).output().unwrap();
    assert!(
        done.status.success(),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
}

#[test]
#[ignore = "needs python3"]
fn answers_are_marked_by_mistake_and_chapter() {
    passes("golden/mark_check.py");
}

#[test]
#[ignore = "needs python3, and a C compiler of Linux"]
fn cases_and_jobs_are_the_same_under_other_rounding() {
    passes("golden/rounding/check.py");
}
