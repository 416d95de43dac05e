//! Whom a task tells how far it is.

use trueness_geom::progress::{Progress, Silent};

/// The unit of stages whose work is of several kinds, so that no number of points or facets says how much is done: each step is one look
/// at a point, a facet or a pair of them.
pub const STEPS: &str = "steps";

/// Hears of the stages of a task, one after the other, and may stop it.
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
