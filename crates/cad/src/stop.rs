//! Whether a long computation goes on.

use trueness_geom::progress::{Cancelled, Progress};

/// An error where the result is no longer wanted.
pub(crate) fn go_on(progress: &dyn Progress) -> Result<(), Cancelled> {
    if progress.cancelled() { Err(Cancelled) } else { Ok(()) }
}
