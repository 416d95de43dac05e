//! Bytes of a file as a window that moves over it: the same for a mapped file and for a stream.
//!
//! Readers of points ask for so many bytes ahead, use them and step over them. A mapped file gives its own pages
//! and drops those stepped over, a stream keeps one buffer: either way memory stays bounded by the window.

use crate::error::{Fault, Result};
use memmap2::Mmap;
use std::io::{ErrorKind, Read};

/// Bytes not yet stepped over.
pub(crate) struct Feed {
    kind: Kind,
    /// Bytes stepped over.
    position: u64,
}

enum Kind {
    Mapped { map: Mmap, at: usize },
    Owned { bytes: Vec<u8>, at: usize },
    Stream { reader: Box<dyn Read + Send>, buffer: Vec<u8>, at: usize, ended: bool },
}

/// Least number of bytes asked of a stream at a time.
const READ: usize = 1 << 18;

impl Feed {
    pub fn mapped(map: Mmap) -> Feed {
        Feed { kind: Kind::Mapped { map, at: 0 }, position: 0 }
    }
    pub fn owned(bytes: Vec<u8>) -> Feed {
        Feed { kind: Kind::Owned { bytes, at: 0 }, position: 0 }
    }
    pub fn stream(reader: Box<dyn Read + Send>) -> Feed {
        Feed { kind: Kind::Stream { reader, buffer: vec![], at: 0, ended: false }, position: 0 }
    }

    /// Bytes stepped over so far.
    pub fn position(&self) -> u64 {
        self.position
    }

    /// How many bytes are left, where that is known without reading them.
    pub fn left(&self) -> Option<u64> {
        match &self.kind {
            Kind::Mapped { map, at } => Some((map.len() - at) as u64),
            Kind::Owned { bytes, at } => Some((bytes.len() - at) as u64),
            Kind::Stream { buffer, at, ended, .. } => ended.then(|| (buffer.len() - at) as u64),
        }
    }

    /// The next bytes: at least `want` of them, fewer only if the file ends before; possibly many more.
    pub fn ahead(&mut self, want: usize) -> Result<&[u8]> {
        match &mut self.kind {
            Kind::Mapped { map, at } => Ok(&map[*at..]),
            Kind::Owned { bytes, at } => Ok(&bytes[*at..]),
            Kind::Stream { reader, buffer, at, ended } => {
                if buffer.len() - *at < want && !*ended {
                    buffer.drain(..*at);
                    *at = 0;
                    *ended = fill(reader.as_mut(), buffer, want)?;
                }
                Ok(&buffer[*at..])
            }
        }
    }

    /// All bytes that are left.
    pub fn all(&mut self) -> Result<&[u8]> {
        self.ahead(usize::MAX)
    }

    /// Steps over `count` bytes, which must have been seen by [`Feed::ahead`].
    pub fn step(&mut self, count: usize) {
        match &mut self.kind {
            Kind::Mapped { map, at } => {
                let from = *at;
                *at = (*at + count).min(map.len());
                forget(map, from, *at);
            }
            Kind::Owned { bytes, at } => *at = (*at + count).min(bytes.len()),
            Kind::Stream { buffer, at, .. } => *at = (*at + count).min(buffer.len()),
        }
        self.position += count as u64;
    }
}

/// Reads until `buffer` holds `want` bytes. True if the end was met.
fn fill(reader: &mut dyn Read, buffer: &mut Vec<u8>, want: usize) -> Result<bool> {
    while buffer.len() < want {
        let old = buffer.len();
        // The buffer grows with what was really read, never to what some header promises.
        let more = READ.max(old / 2).min(want - old).max(READ);
        buffer.resize(old + more, 0);
        let got = match reader.read(&mut buffer[old..]) {
            Ok(n) => n,
            Err(e) if e.kind() == ErrorKind::Interrupted => {
                buffer.truncate(old);
                continue;
            }
            Err(e) => {
                buffer.truncate(old);
                return Err(crate::gzip::fault(e).into());
            }
        };
        buffer.truncate(old + got);
        if got == 0 {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Takes the pages of a range out of memory, so that what has been read does not count as ours any longer.
#[cfg(unix)]
#[expect(
    unsafe_code,
    reason = "dropping pages of a map is unsafe in general, and harmless for an unchanged file"
)]
fn forget(map: &Mmap, from: usize, to: usize) {
    const LARGE: usize = 1 << 21;
    let (from, to) = (from / LARGE * LARGE, to / LARGE * LARGE);
    if to > from {
        // SAFETY: the map is shared, of a file, and never written to: a page dropped is read again from the file.
        // An error only means that the pages stay.
        let _ = unsafe { map.unchecked_advise_range(memmap2::UncheckedAdvice::DontNeed, from, to - from) };
    }
}

#[cfg(not(unix))]
fn forget(_: &Mmap, _: usize, _: usize) {}

/// What is left of a feed, for readers that need a file as a whole.
pub(crate) fn not_empty(bytes: &[u8]) -> Result<()> {
    if bytes.is_empty() { Err(Fault::Empty.into()) } else { Ok(()) }
}
