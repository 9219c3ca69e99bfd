//! Signals for programs under test.

use rustix::process::{Pid, Signal, kill_process};
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

/// Sends a signal to a program, which may have ended already.
pub fn send(child: &Child, signal: Signal) {
    let _ = kill_process(Pid::from_child(child), signal);
}
