//! Ctrl-C and its relatives: interrupt, termination, hang-up.
//!
//! The first signal asks the work to stop, which it does between two blocks. What has not stopped after a moment (waiting
//! for a pipe, say) is ended from here, as is everything at a second signal. Either way no unfinished file stays.

use crate::console;
use std::sync::atomic::{AtomicI32, Ordering};
use std::time::Duration;

/// The first signal that came; 0 for none.
static RECEIVED: AtomicI32 = AtomicI32::new(0);

/// Time that the work has for stopping by itself. The system then takes its memory back, which of gigabytes takes as long again,
/// and all of it shall be over within 0.2 s.
const MAX_STOPPING_TIME: Duration = Duration::from_millis(60);

/// Whether the work should stop.
pub fn received() -> bool {
    RECEIVED.load(Ordering::Relaxed) != 0
}

/// The exit status of a run that a signal ended: 128 and the signal's number, as shells have it.
pub fn status() -> u8 {
    match RECEIVED.load(Ordering::Relaxed) {
        0 => 130,
        signal => 128u8.saturating_add(u8::try_from(signal).unwrap_or(2)),
    }
}

/// Marks the signal; true if it is the first.
fn note(signal: i32) -> bool {
    RECEIVED.compare_exchange(0, signal, Ordering::Relaxed, Ordering::Relaxed).is_ok()
}

/// Ends the program where it stands.
fn end() -> ! {
    trueness_files::remove_unfinished(true);
    console::note("trueness: cancelled");
    std::process::exit(status().into())
}

/// From now on signals are heard. One that was set to be ignored (by `nohup`, or for a job in the background) stays
/// ignored.
#[cfg(unix)]
pub fn listen() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    // With a handler, a file that would grow beyond the limit of the shell is an error of the write, as a full disk is.
    let _ = signal_hook::flag::register(SIGXFSZ, std::sync::Arc::default());
    let wanted: Vec<i32> = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|s| !is_ignored(*s)).collect();
    // Without a handler signals end the program as they always do: nothing to report.
    let Ok(mut signals) = signal_hook::iterator::Signals::new(wanted) else { return };
    let hear = move || {
        for signal in signals.forever() {
            if !note(signal) {
                end();
            }
            std::thread::spawn(|| {
                std::thread::sleep(MAX_STOPPING_TIME);
                end()
            });
        }
    };
    let _ = std::thread::Builder::new().name("signals".into()).spawn(hear);
}

#[cfg(unix)]
#[expect(unsafe_code, reason = "there is no safe way to ask what a signal does at present")]
fn is_ignored(signal: i32) -> bool {
    // SAFETY: an action of zeros is a valid one to write over; a null pointer for the new action asks only.
    unsafe {
        let mut action: libc::sigaction = std::mem::zeroed();
        libc::sigaction(signal, std::ptr::null(), &mut action) == 0 && action.sa_sigaction == libc::SIG_IGN
    }
}

/// From now on the interrupt key is heard.
#[cfg(not(unix))]
pub fn listen() {
    let _ = ctrlc::set_handler(|| {
        if !note(2) {
            end();
        }
        std::thread::spawn(|| {
            std::thread::sleep(MAX_STOPPING_TIME);
            end()
        });
    });
}
