//! Signals that end a run: what is being written is written to its end first, so that nothing is left half-done.

use std::sync::{Mutex, PoisonError};

/// The exit code of a process that a signal ended: this and the number of the signal.
const SIGNALLED: i32 = 128;

/// Held while files are written.
static WRITING: Mutex<()> = Mutex::new(());

/// Writes files; a signal waits until they are written.
pub(super) fn uninterrupted<T>(write: impl FnOnce() -> T) -> T {
    let _writing = WRITING.lock().unwrap_or_else(PoisonError::into_inner);
    write()
}

/// The same for what a checkpoint writes.
pub(super) fn guard(write: &mut dyn FnMut()) {
    uninterrupted(write);
}

fn end(signal: i32) {
    let _writing = WRITING.lock().unwrap_or_else(PoisonError::into_inner);
    std::process::exit(SIGNALLED + signal);
}

/// Watches for the signals by which a run is ended: Ctrl-C, the end of its terminal, the word of a system that shuts
/// down. Without a watcher the process still ends, but may leave a temporary file.
#[cfg(unix)]
pub(super) fn watch() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    let ignored = ignored();
    // A signal that was ignored when the process began stays so: `nohup btc learn …` outlives its terminal.
    let ends = [SIGHUP, SIGINT, SIGTERM].into_iter();
    let ends = ends.filter(|signal| ignored >> (signal - 1) & 1 == 0);
    let ends: Vec<i32> = ends.collect();
    // Where the system gives no thread, the signals keep their own meaning.
    let watching = std::thread::Builder::new().spawn(move || {
        let mut signals = Signals::new(ends).ok()?;
        signals.forever().next().map(end)
    });
    drop(watching);
}

/// The signals that are ignored, a bit each, as far as the system says.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.map_or(0, |mask| u64::from_str_radix(mask.trim(), 16).unwrap_or(0))
}

/// Watches for Ctrl-C.
#[cfg(not(unix))]
pub(super) fn watch() {
    let _ = ctrlc::set_handler(|| end(2));
}
