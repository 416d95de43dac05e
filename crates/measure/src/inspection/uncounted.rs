//! Progress of a part of a task.

use trueness_geom::progress::Progress;

/// Hands on the wish to stop and counts nothing: for a part of a task that counts other things than its parts do.
#[derive(Clone, Copy)]
pub(super) struct Uncounted<'a>(pub &'a dyn Progress);

impl Progress for Uncounted<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
