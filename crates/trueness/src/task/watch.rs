//! Whom a task tells how far it is.

use trueness_geom::progress::{Progress, Silent};

/// The unit of stages whose work is of several kinds, so that no number of points or facets says how much is done: each step is one look
/// at a point, a facet or a pair of them.
pub const STEPS: &str = "steps";

/// Hears of the stages of a task, one after the other, and may stop it.
///
/// This one keeps the names of the stages, counts what is done in the last one, and stops after so many items:
/// ```
/// use std::sync::Mutex;
/// use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
/// use trueness::files::MemorySources;
/// use trueness::geom::progress::Progress;
/// use trueness::task::{ErrorKind, Request, Stage, Watch};
/// use trueness::tasks::check::CheckRequest;
///
/// struct Listener {
///     stages: Mutex<Vec<String>>,
///     done: AtomicU64,
///     most: u64,
/// }
/// struct UnderWay<'a>(&'a Listener);
///
/// impl Watch for Listener {
///     fn stage(&self, name: &'static str, unit: &'static str, total: Option<u64>) -> Box<dyn Stage + '_> {
///         let total = total.map_or("some".into(), |n| n.to_string());
///         self.stages.lock().expect("no one fails").push(format!("{name}: {total} {unit}"));
///         self.done.store(0, Relaxed);
///         Box::new(UnderWay(self))
///     }
/// }
/// impl Progress for UnderWay<'_> {
///     fn advance(&self, items: u64) {
///         self.0.done.fetch_add(items, Relaxed);
///     }
///     fn cancelled(&self) -> bool {
///         self.0.done.load(Relaxed) > self.0.most
///     }
/// }
/// impl Stage for UnderWay<'_> {
///     fn finish(self: Box<Self>) {}
/// }
///
/// // The bytes may come from anywhere: here they lie in memory, under a name.
/// let bytes = std::fs::read("../../corpus/bunny/zipper_res4.ply")?;
/// let sources: MemorySources = [("bunny.ply", bytes)].into_iter().collect();
/// let request = CheckRequest { mesh: "bunny.ply".into(), ..CheckRequest::default() };
/// let listener = |most| Listener { stages: Mutex::default(), done: AtomicU64::new(0), most };
///
/// let patient = listener(u64::MAX);
/// let done = request.run(&sources, &patient)?;
/// assert_eq!(done.document.facets, 948);
/// assert_eq!(*patient.stages.lock().expect("no one fails"), ["checking: 948 facets"]);
///
/// let hasty = listener(100);
/// let stopped = request.run(&sources, &hasty).err().expect("it was stopped");
/// assert_eq!(stopped.kind(), ErrorKind::Cancelled);
/// assert!(hasty.done.load(Relaxed) > 100);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Watch: Sync {
    /// Begins a stage of `total` items (unknown: `None`), each a `unit`. It ends when it is dropped; see [`ended`].
    fn stage(&self, name: &'static str, unit: &'static str, total: Option<u64>) -> Box<dyn Stage + '_>;

    /// Hears of something beside the result, such as a leftover file that was removed.
    fn note(&self, _text: &str) {}

    /// Bytes of memory that there are for the task, where that is known. What needs more is refused before it begins.
    fn memory(&self) -> Option<u64> {
        None
    }
}

/// A stage under way: hears of its items, and says whether to stop.
pub trait Stage: Progress {
    /// The stage has its answer: all of it is done.
    fn finish(self: Box<Self>);
}

/// Ends a stage: as finished where there is an answer, else as cut short.
pub fn ended<T, E>(stage: Box<dyn Stage + '_>, answer: Result<T, E>) -> Result<T, E> {
    if answer.is_ok() {
        stage.finish();
    }
    answer
}

/// Nobody is told, and nothing is stopped.
impl Watch for Silent {
    fn stage(&self, _: &'static str, _: &'static str, _: Option<u64>) -> Box<dyn Stage + '_> {
        Box::new(Silent)
    }
}

impl Stage for Silent {
    fn finish(self: Box<Self>) {}
}
