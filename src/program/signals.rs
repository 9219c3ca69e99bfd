//! The signals that ask a program to stop: postponed while files are written, then obeyed.

use corfem::files::disk::process_status;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::SeqCst};

#[cfg(unix)]
const SIGNALS: [i32; 3] = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// True while the signals end the program at once, as they do by default.
static FREE: AtomicBool = AtomicBool::new(true);
/// The last signal that came while they were postponed; 0 for none.
static CAME: AtomicUsize = AtomicUsize::new(0);

/// Signals are postponed as long as any of these lives; one that came meanwhile then ends the program.
pub struct PostponedSignals(());

/// Postpones the first signal, which sets the flag; a second one ends the program at once.
pub fn postpone_first() -> (Arc<AtomicBool>, PostponedSignals) {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in asked_for() {
        // A program that cannot be told to stop still does its work.
        let _ = flag::register_conditional_default(signal, &FREE);
        let _ = flag::register_usize(signal, &CAME, signal as usize);
        let _ = flag::register(signal, Arc::clone(&stop));
        // Registered behind the handler that reads it, so that it counts from the next signal on.
        let _ = flag::register(signal, &FREE);
    }
    FREE.store(false, SeqCst);
    (stop, PostponedSignals(()))
}

impl Drop for PostponedSignals {
    fn drop(&mut self) {
        FREE.store(true, SeqCst);
        // A signal's number fits the type it came from.
        let came = CAME.load(SeqCst) as i32;
        if came != 0 {
            let _ = signal_hook::low_level::emulate_default_handler(came);
        }
    }
}

/// The signals, but for those the program was started to ignore, as `nohup` starts it.
fn asked_for() -> impl Iterator<Item = i32> {
    let status = process_status();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored
        .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .unwrap_or(0);
    SIGNALS
        .into_iter()
        .filter(move |signal| ignored >> (signal - 1) & 1 == 0)
}
