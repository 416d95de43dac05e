//! A case that takes too long ends the program: it cannot be stopped otherwise.

use cpu_time::ProcessTime;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// The case under way: since when, and where it lies.
static UNDER_WAY: Mutex<Option<(Instant, PathBuf)>> = Mutex::new(None);

/// A case counts as hanging, too, when it has waited this many times as long without using the processor.
const IDLE: f64 = 30.0;

/// Begins to watch: more than `seconds` of processor time for one case are a finding. On a busy machine a case takes
/// longer by the clock, which is none.
pub fn begin(seconds: f64) {
    std::thread::spawn(move || {
        let (mut case, mut processor) = (None, ProcessTime::now());
        loop {
            std::thread::sleep(Duration::from_millis(200));
            let now = UNDER_WAY.lock().map(|u| u.clone()).unwrap_or_default();
            let since = now.as_ref().map(|(since, _)| *since);
            if since != case {
                (case, processor) = (since, ProcessTime::now());
            }
            let Some((since, file)) = now else { continue };
            let (used, waited) = (processor.elapsed().as_secs_f64(), since.elapsed().as_secs_f64());
            if used > seconds || waited > IDLE * seconds {
                println!("FOUND a case that takes longer than {seconds} s: {}", file.display());
                std::process::exit(1);
            }
        }
    });
}

/// What `job` returns, watched as the case in `file`.
pub fn over<T>(file: &Path, job: impl FnOnce() -> T) -> T {
    let set = |case| drop(UNDER_WAY.lock().map(|mut u| *u = case));
    set(Some((Instant::now(), file.into())));
    let result = job();
    set(None);
    result
}
