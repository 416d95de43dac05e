//! Where bytes come from: files, memory, streams, each under a name; unpacked and turned into UTF-8 if need be.

mod bytes;
mod file_sources;
mod hash;
mod memory_sources;
mod opened;
mod sources;

pub use bytes::SourceBytes;
pub use file_sources::{FileSources, sha256};
pub use memory_sources::MemorySources;
pub(crate) use opened::{SNIFFED_BYTES, Source};
pub use sources::Sources;
