//! What all result documents have in common.

use serde::Serialize;
use serde::de::DeserializeOwned;

/// A result document. It tells by what stands in it alone: read back from its file it tells the same.
pub trait ResultDocument: Serialize + DeserializeOwned {
    /// Whether what was found is as it should be: exit status and head of the page follow from it.
    fn conforms(&self) -> bool;
}
