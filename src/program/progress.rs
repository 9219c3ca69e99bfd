//! Progress on standard error, where a terminal is and nobody asked for quiet.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// Work of unknown length: time and words.
pub fn spinner(quiet: bool) -> ProgressBar {
    shown(ProgressBar::new_spinner(), "{spinner} {elapsed} {msg}", quiet)
}

/// So many things to do.
pub fn bar(quiet: bool, count: u64) -> ProgressBar {
    shown(ProgressBar::new(count), "{wide_bar} {pos} of {len}, {eta} left", quiet)
}

fn shown(bar: ProgressBar, template: &str, quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_spinner()));
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
