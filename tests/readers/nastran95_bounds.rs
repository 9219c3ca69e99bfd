//! What a run of the external solver may not do, played by small shell scripts: outlive its end, be waited for through a
//! pipe, fill the memory, speak to the terminal.

#![cfg(unix)]

use crate::common::fake_solver::{fake, solver};
use crate::prelude::*;

#[test]
fn what_a_run_leaves_running_is_ended_with_it() {
    let outside = new_folder();
    let file = outside.path().join("process");
    let home = fake(&format!(
        "sleep 60 > /dev/null 2>&1 &\necho $! > {}",
        file.display()
    ));
    solver(&home).run("").unwrap();
    let process = fs::read_to_string(file).unwrap();
    let is_alive = || {
        let state =
            fs::read_to_string(format!("/proc/{}/stat", process.trim())).unwrap_or_default();
        state.split(' ').nth(2).is_some_and(|state| state != "Z")
    };
    let limit = Instant::now() + Duration::from_secs(20);
    while is_alive() && Instant::now() < limit {
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(!is_alive());
}

#[test]
fn what_is_no_file_or_too_large_is_not_read() {
    let found = |script: &str| {
        let home = fake(script);
        let mut solver = solver(&home);
        solver.output_limit = 10_000;
        solver.run("").expect_err(script).to_string()
    };
    for name in ["ftn15", "printed"] {
        let is_file = format!("NASTRAN-95: its {name} is not a regular file");
        assert_eq!(found(&format!("rm -f {name}; mkfifo {name}")), is_file);
        assert_eq!(
            found(&format!("rm -f {name}; ln -s /dev/zero {name}")),
            is_file
        );
    }
    // Stopped while it writes, and refused when it has ended.
    for script in [
        "while :; do echo too much; done",
        "head -c 10001 /dev/zero > \"$FTN15\"",
    ] {
        assert!(
            found(script).contains("more than the 10000 allowed"),
            "{script}"
        );
    }
}

/// A solver that puts a file where its folder was: what was printed cannot be looked for, which is not the same as not there.
#[test]
fn a_folder_that_is_gone_is_no_run_without_output() {
    let error = solver(&fake("rm -rf \"$DIRCTY\"; touch \"$DIRCTY\""))
        .run("")
        .expect_err("its folder is a file");
    let Some(FileError::File {
        path,
        action: "read",
        ..
    }) = error.downcast_ref()
    else {
        panic!("{error}")
    };
    assert!(path.ends_with("printed"), "{error}");
    fs::remove_file(path.parent().unwrap()).unwrap();
}

#[test]
fn words_of_the_solver_cannot_speak_to_the_terminal() {
    for script in [
        "printf ' FATAL \\033[31mred\\007\\n'",
        "printf '\\033[31mred\\007\\n'; exit 3",
    ] {
        let error = solver(&fake(script)).run("").expect_err(script).to_string();
        assert!(error.contains("\\u{1b}[31mred\\u{7}"), "{error}");
        assert!(!error.contains(char::is_control), "{error:?}");
    }
    let long = solver(&fake(
        "printf 'FATAL '; head -c 9000 /dev/zero | tr '\\0' x",
    ))
    .run("")
    .expect_err("a long line");
    assert!(
        long.to_string().len() < 500 && long.to_string().ends_with("x..."),
        "{long}"
    );
    let rubbish = fake("printf 'CORFEM\\n\\033[2Jxx\\n' > \"$FTN15\"");
    let error = solver(&rubbish)
        .matrices("", 1)
        .expect_err("rubbish")
        .to_string();
    assert!(error.contains("\"\\u{1b}[2Jxx\" is not"), "{error}");
}

#[test]
fn its_folder_is_its_owners_alone() {
    let answer = solver(&fake("ls -ld .")).run("").unwrap();
    assert!(
        answer.printed.starts_with("drwx------"),
        "{}",
        answer.printed
    );
}
