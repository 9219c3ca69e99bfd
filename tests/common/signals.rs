//! Signals for programs under test.

use rustix::process::{Pid, Signal, kill_process};
use std::ffi::OsStr;
use std::process::{Child, Command};

/// The signals that ask a program to stop, as `env` calls them.
pub const SIGNALS: [(Signal, &str); 3] = [
    (Signal::INT, "INT"),
    (Signal::TERM, "TERM"),
    (Signal::HUP, "HUP"),
];

/// What runs a program with signals as by default, where that can be said: tests in the background of a shell ignore
/// some.
pub fn undisturbed() -> &'static [&'static str] {
    let words = &["env", "--default-signal=INT,TERM,HUP"];
    let can = Command::new(words[0])
        .arg(words[1])
        .arg("true")
        .output()
        .is_ok_and(|output| output.status.success());
    if can { words } else { &[] }
}

/// The program `corfem`, perhaps run by another one.
pub fn corfem_run_by(run_by: &[&str]) -> Command {
    let program = assert_cmd::cargo::cargo_bin("corfem");
    let mut words = run_by.iter().map(OsStr::new).chain([program.as_os_str()]);
    let mut command = Command::new(words.next().unwrap());
    command.args(words);
    command
}

/// Sends a signal to a program, which may have ended already.
pub fn send(child: &Child, signal: Signal) {
    let _ = kill_process(Pid::from_child(child), signal);
}
