//! Files that are read as a whole.

use crate::task::{Meaning, TaskError};
use std::path::Path;
use trueness_files::Sources;

/// All bytes that go by a name, as they lie there; `None` where there are more than `longest`. `what` they are is for messages.
pub fn bytes(
    sources: &dyn Sources,
    path: &Path,
    what: &str,
    longest: usize,
) -> Result<Option<Vec<u8>>, TaskError> {
    let read = sources.bytes(path).and_then(|bytes| bytes.head(longest.saturating_add(1)));
    let bytes = read.meaning(|| format!("{}: the {what} cannot be read; check the path", path.display()))?;
    Ok(Some(bytes).filter(|bytes| bytes.len() <= longest))
}

/// The SHA-256 of what goes by a name, hexadecimal, where it can be told.
pub fn digest(sources: &dyn Sources, path: &Path) -> Option<String> {
    Some(hexadecimal(sources.sha256(path).ok()?))
}

/// A SHA-256 as documents have it.
pub(super) fn hexadecimal(digest: [u8; 32]) -> String {
    digest.iter().map(|b| format!("{b:02x}")).collect()
}
