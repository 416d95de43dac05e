//! The trait that gives the bytes of a name.

use super::{Source, SourceBytes};
use crate::error::{Fault, Located, ReadError, Result};
use std::path::Path;

/// Bytes under names: those of the file system ([`FileSources`](super::FileSources)), of memory
/// ([`MemorySources`](super::MemorySources)), or of whatever else there is, such as uploads.
///
/// All that is read here is read through it, so that a task finds the same in a file and in memory.
pub trait Sources: Sync {
    /// The bytes that go by a name, from their start.
    ///
    /// # Errors
    /// [`Fault::Unnamed`] where nothing goes by it; those of the system.
    fn bytes(&self, name: &Path) -> std::result::Result<SourceBytes, Fault>;

    /// Whether what goes by a name can be read once only, as standard input and pipes can; false where nothing does.
    fn is_stream(&self, name: &Path) -> bool;

    /// How many bytes go by a name, where that is known without reading them.
    fn length(&self, name: &Path) -> Option<u64> {
        if self.is_stream(name) { None } else { self.bytes(name).ok()?.length() }
    }

    /// The name as messages have it.
    fn shown(&self, name: &Path) -> String {
        name.display().to_string()
    }

    /// SHA-256 of the bytes that go by a name, as they lie there (packed, where they are packed).
    ///
    /// # Errors
    /// A source that can be read once only, as it would be used up; errors of [`Sources::bytes`] and of reading.
    fn sha256(&self, name: &Path) -> std::result::Result<[u8; 32], Fault> {
        if self.is_stream(name) {
            let what = "what can be read once only has no fingerprint".into();
            return Err(Fault::Unsupported { what, remedy: "save it in a file" });
        }
        self.bytes(name)?.sha256().map_err(Fault::Io)
    }

    /// The whole text that goes by a name, unpacked and in UTF-8, of `longest` bytes at most; it may be empty.
    ///
    /// # Errors
    /// A longer one; one that is no text; those of [`Sources::bytes`] and of reading. They name the file.
    fn text(&self, name: &Path, longest: usize) -> std::result::Result<String, ReadError> {
        let source = self.bytes(name).map_err(Into::into).and_then(Source::of);
        match source.and_then(|source| text(source, longest)) {
            Err(Located { fault: Fault::Empty, .. }) => Ok(String::new()),
            read => read.map_err(|e| e.in_file(&self.shown(name))),
        }
    }
}

fn text(mut source: Source, longest: usize) -> Result<String> {
    let bytes = source.feed.ahead(longest.saturating_add(1))?;
    if bytes.len() > longest {
        return Err(Fault::TooLong { longest: longest as u64 }.into());
    }
    String::from_utf8(bytes.to_vec()).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        let line = crate::lines::line_of(e.as_bytes(), at);
        Fault::unexpected("text in UTF-8", &e.as_bytes()[at..]).at_line(line)
    })
}
