//! Work beside Python: on threads of our own, without the interpreter's lock, stopped by signals and by what the callback raises.

use crate::errors;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::Duration;
use trueness::geom::progress::Progress;
use trueness::task::{Stage, Watch};

/// Time between two looks at signals. Work stops within some milliseconds, and all shall be over within 0.2 s.
const TICK: Duration = Duration::from_millis(40);

/// Time between two tries of a lock.
const WAIT: Duration = Duration::from_millis(1);

/// The threads, and the process that they belong to.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads of this process. Those of a process that was forked do not live on in the new one, which gets its own.
fn pool() -> Result<Arc<ThreadPool>, String> {
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some((_, own)) = pool.as_ref().filter(|(of, _)| *of == process) {
        return Ok(own.clone());
    }
    let made = Arc::new(ThreadPoolBuilder::new().build().map_err(|e| e.to_string())?);
    // The old one has no threads any more that could be told to end.
    std::mem::forget(pool.replace((process, made.clone())));
    Ok(made)
}

/// What the work tells and asks.
#[derive(Default)]
pub struct Watcher {
    cancelled: AtomicBool,
    done: AtomicU64,
    stage: Mutex<Option<(&'static str, &'static str, Option<u64>)>>,
}

impl Progress for Watcher {
    fn advance(&self, items: u64) {
        self.done.fetch_add(items, Ordering::Relaxed);
    }
    fn cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}

/// A stage under way.
struct Under<'a>(&'a Watcher);

impl Progress for Under<'_> {
    fn advance(&self, items: u64) {
        self.0.advance(items);
    }
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

impl Stage for Under<'_> {
    fn finish(self: Box<Self>) {}
}

impl Watch for Watcher {
    fn stage(&self, name: &'static str, unit: &'static str, total: Option<u64>) -> Box<dyn Stage + '_> {
        self.begin(name, unit, total);
        Box::new(Under(self))
    }
}

impl Watcher {
    /// Begins a stage.
    pub fn begin(&self, name: &'static str, unit: &'static str, total: Option<u64>) {
        let mut stage = self.stage.lock().unwrap_or_else(PoisonError::into_inner);
        (*stage, _) = (Some((name, unit, total)), self.done.store(0, Ordering::Relaxed));
    }

    /// Hears signals, and tells the callback how far the work is.
    fn tick(&self, py: Python, progress: Option<&Py<PyAny>>) -> PyResult<()> {
        py.check_signals()?;
        let stage = *self.stage.lock().unwrap_or_else(PoisonError::into_inner);
        if let (Some(progress), Some((name, unit, total))) = (progress, stage) {
            progress.call1(py, (name, self.done.load(Ordering::Relaxed), total, unit))?;
        }
        Ok(())
    }
}

/// Locks what only one call may prepare, or use. Work never locks: a thread that waits for a part of its own work may take up that of another
/// call meanwhile.
///
/// # Errors
/// What a signal's handler raised.
pub fn lock<'a, T>(py: Python, mutex: &'a Mutex<T>) -> PyResult<MutexGuard<'a, T>> {
    loop {
        match mutex.try_lock() {
            Ok(guard) => return Ok(guard),
            Err(TryLockError::Poisoned(guard)) => return Ok(guard.into_inner()),
            Err(TryLockError::WouldBlock) => {
                py.check_signals()?;
                py.detach(|| std::thread::sleep(WAIT));
            }
        }
    }
}

/// Runs `work` on the threads of this process without the interpreter's lock, and meanwhile hears signals and tells `progress`.
///
/// # Errors
/// What a signal's handler or the callback raised; a panic of the work.
pub fn run<T: Send>(
    py: Python,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&Watcher) -> T + Send,
) -> PyResult<T> {
    let pool = pool().map_err(|text| errors::internal(py, text))?;
    let watcher = Watcher::default();
    let (answered, raised) =
        py.detach(|| pool.in_place_scope(|scope| watch(scope, &watcher, progress, work)));
    if let Some(raised) = raised {
        return Err(raised);
    }
    let answer = answered.map_err(|text| errors::internal(py, text))?;
    watcher.tick(py, progress)?;
    Ok(answer)
}

/// Starts the work and looks at signals until it is over; its answer, and what was raised meanwhile.
fn watch<'a, T: Send + 'a>(
    scope: &rayon::Scope<'a>,
    watcher: &'a Watcher,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&Watcher) -> T + Send + 'a,
) -> (Result<T, String>, Option<PyErr>) {
    let (send, receive) = channel();
    scope.spawn(move |_| {
        // Nobody else sees what a panic leaves behind.
        let _ = send.send(catch_unwind(AssertUnwindSafe(|| work(watcher))));
    });
    let mut raised = None;
    loop {
        match receive.recv_timeout(TICK) {
            Ok(Ok(answer)) => return (Ok(answer), raised),
            Ok(Err(cause)) => {
                let text = cause.downcast_ref::<String>().cloned();
                let text = text.or_else(|| cause.downcast_ref::<&str>().map(|s| (*s).into()));
                return (Err(text.unwrap_or_else(|| "no message".into())), raised);
            }
            Err(RecvTimeoutError::Disconnected) => return (Err("the work has no answer".into()), raised),
            Err(RecvTimeoutError::Timeout) if raised.is_none() => {
                raised = Python::attach(|py| watcher.tick(py, progress)).err();
                watcher.cancelled.store(raised.is_some(), Ordering::Relaxed);
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
    }
}
