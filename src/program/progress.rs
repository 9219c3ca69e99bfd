//! Progress on standard error, where that is a terminal and nobody asked for quiet.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// Work of unknown length: time and words.
pub fn spinner(quiet: bool) -> ProgressBar {
    shown(
        ProgressBar::new_spinner(),
        "{spinner} {elapsed} {msg}",
        quiet,
    )
}

/// Does work while showing its name and time.
pub fn during<T>(quiet: bool, words: &'static str, work: impl FnOnce() -> T) -> T {
    let bar = spinner(quiet);
    bar.set_message(words);
    let done = work();
    bar.finish_and_clear();
    done
}

fn shown(bar: ProgressBar, template: &str, quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    bar.set_style(
        ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_spinner()),
    );
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
