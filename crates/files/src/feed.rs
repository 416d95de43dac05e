//! Bytes of a file as a window that moves over it: the same for a file, a pipe and bytes in memory.
//!
//! Readers of points ask for so many bytes ahead, use them and step over them: memory stays bounded by the window.
//! Files are read, not mapped. If another process shortened a mapped file while it is read, the system would end the
//! program without a word. A read that meets the end too early is an error like any other. Mapping saves a copy
//! within memory, which is a small part of the time for parsing.

use crate::error::{Fault, Result};
use std::{
    fs::File,
    io::{ErrorKind, Read, Seek, SeekFrom},
    sync::Arc,
};

/// Bytes in memory, with however many others hold them.
#[derive(Clone)]
pub(crate) struct Shared(Arc<dyn AsRef<[u8]> + Send + Sync>);

impl Shared {
    pub fn new(bytes: impl AsRef<[u8]> + Send + Sync + 'static) -> Shared {
        Shared(Arc::new(bytes))
    }
}

impl AsRef<[u8]> for Shared {
    fn as_ref(&self) -> &[u8] {
        (*self.0).as_ref()
    }
}

/// Bytes not yet stepped over.
pub(crate) struct Feed {
    kind: FeedSource,
    /// Bytes read and not yet stepped over are `buffer[at..]`.
    buffer: Vec<u8>,
    at: usize,
    /// Bytes stepped over.
    position: u64,
}

enum FeedSource {
    /// A file of this length when it was opened.
    File { file: File, length: u64 },
    /// All of it; the buffer stays empty.
    Memory(Shared),
    /// Anything whose length shows only at its end.
    Stream { reader: Box<dyn Read + Send>, ended: bool },
}

/// At least this many bytes are read at a time.
const MIN_READ_BYTES: usize = 1 << 18;
/// A file that is needed whole is read by this many bytes at a time, so that memory grows with the bytes that are there.
const WHOLE_FILE_READ_BYTES: u64 = 64 << 20;

impl Feed {
    /// A regular file, from its start.
    pub fn file(file: File, length: u64) -> Feed {
        Feed::of(FeedSource::File { file, length })
    }
    pub fn memory(bytes: Vec<u8>) -> Feed {
        Feed::shared(Shared::new(bytes))
    }
    pub fn shared(bytes: Shared) -> Feed {
        Feed::of(FeedSource::Memory(bytes))
    }
    pub fn stream(reader: Box<dyn Read + Send>) -> Feed {
        Feed::of(FeedSource::Stream { reader, ended: false })
    }
    fn of(kind: FeedSource) -> Feed {
        Feed { kind, buffer: vec![], at: 0, position: 0 }
    }

    /// The next bytes, as far as they are in memory.
    fn buffered(&self) -> &[u8] {
        match &self.kind {
            FeedSource::Memory(bytes) => {
                let at = usize::try_from(self.position).unwrap_or(usize::MAX);
                bytes.as_ref().get(at..).unwrap_or_default()
            }
            _ => &self.buffer[self.at..],
        }
    }

    /// Bytes stepped over so far.
    pub fn position(&self) -> u64 {
        self.position
    }

    /// How many bytes are left, where that is known without reading them.
    pub fn left(&self) -> Option<u64> {
        match &self.kind {
            FeedSource::File { length, .. } => Some(length - self.position),
            FeedSource::Stream { ended: false, .. } => None,
            _ => Some(self.buffered().len() as u64),
        }
    }

    /// How many bytes are left; a stream is read to its end for this, and held.
    pub fn count_left(&mut self) -> Result<u64> {
        match self.left() {
            Some(left) => Ok(left),
            None => Ok(self.all()?.len() as u64),
        }
    }

    /// The next bytes: at least `want` of them, fewer only if the file ends before; possibly many more.
    pub fn ahead(&mut self, want: usize) -> Result<&[u8]> {
        let there = self.buffered().len();
        if there < want {
            let more = match &self.kind {
                FeedSource::File { length, .. } => *length > self.position + there as u64,
                FeedSource::Memory(_) => false,
                FeedSource::Stream { ended, .. } => !ended,
            };
            if more {
                self.buffer.drain(..self.at);
                self.at = 0;
                self.fill(want)?;
            }
        }
        Ok(self.buffered())
    }

    /// All bytes that are left.
    pub fn all(&mut self) -> Result<&[u8]> {
        self.ahead(usize::MAX)
    }

    /// Steps over `count` bytes, which must have been seen by [`Feed::ahead`].
    pub fn step(&mut self, count: usize) {
        let count = count.min(self.buffered().len());
        if !matches!(self.kind, FeedSource::Memory(_)) {
            self.at += count;
        }
        self.position += count as u64;
    }

    /// Fills `out` with the bytes from `from` on, counted from where the feed stands. A file is asked for no others.
    pub fn copy(&mut self, from: u64, out: &mut [u8]) -> Result<()> {
        let start = self.position + from;
        if let FeedSource::File { file, length } = &mut self.kind {
            file.seek(SeekFrom::Start(start))?;
            return file.read_exact(out).map_err(|e| match e.kind() {
                ErrorKind::UnexpectedEof => shrunk(file, *length).into(),
                _ => e.into(),
            });
        }
        let all = self.all()?;
        let part = usize::try_from(from).ok().and_then(|from| all.get(from..)?.get(..out.len()));
        out.copy_from_slice(part.ok_or_else(|| Fault::Io(ErrorKind::UnexpectedEof.into()))?);
        Ok(())
    }

    /// Reads until the buffer, of which nothing is stepped over, holds `want` bytes or the end is met.
    fn fill(&mut self, want: usize) -> Result<()> {
        let (buffer, position) = (&mut self.buffer, self.position);
        match &mut self.kind {
            FeedSource::Memory(_) => Ok(()),
            FeedSource::File { file, length } => {
                let want = (want.max(MIN_READ_BYTES) as u64).min(*length - position);
                file.seek(SeekFrom::Start(position + buffer.len() as u64))?;
                reserve(buffer, want)?;
                while (buffer.len() as u64) < want {
                    let most = (want - buffer.len() as u64).min(WHOLE_FILE_READ_BYTES);
                    let got = file.by_ref().take(most).read_to_end(buffer)?;
                    if (got as u64) < most {
                        return Err(shrunk(file, *length).into());
                    }
                }
                Ok(())
            }
            FeedSource::Stream { reader, ended } => {
                while buffer.len() < want {
                    // The buffer grows with the bytes that were really read, never to the size that some header promises.
                    let more =
                        MIN_READ_BYTES.max(buffer.len() / 2).min(want - buffer.len()).max(MIN_READ_BYTES)
                            as u64;
                    let got = reader.by_ref().take(more).read_to_end(buffer).map_err(crate::gzip::fault)?;
                    if (got as u64) < more {
                        *ended = true;
                        break;
                    }
                }
                Ok(())
            }
        }
    }
}

/// Makes room for `want` bytes in all, or says how much memory is missing instead of ending the program.
fn reserve(buffer: &mut Vec<u8>, want: u64) -> Result<()> {
    let room = usize::try_from(want).map(|want| want.saturating_sub(buffer.len()));
    let reserved = room.ok().and_then(|room| buffer.try_reserve_exact(room).ok());
    reserved.ok_or_else(|| Fault::Memory { bytes: want }.into())
}

/// The file ended before the length it had when it was opened.
fn shrunk(file: &File, length: u64) -> Fault {
    Fault::Shrunk { length, now: file.metadata().map_or(0, |about| about.len()) }
}

/// Refuses a file without bytes.
pub(crate) fn not_empty(bytes: &[u8]) -> Result<()> {
    if bytes.is_empty() { Err(Fault::Empty.into()) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of `length` bytes, each its place modulo 251, and a feed of it.
    fn file(name: &str, length: usize) -> (crate::write::scratch::Folder, std::path::PathBuf, Feed) {
        let folder = crate::write::scratch::Folder::new();
        let path = folder.path().join(name);
        let bytes: Vec<u8> = (0..length).map(|i| (i % 251) as u8).collect();
        std::fs::write(&path, bytes).unwrap();
        let feed = Feed::file(File::open(&path).unwrap(), length as u64);
        (folder, path, feed)
    }

    #[test]
    fn windows_of_every_size_give_the_same_bytes() {
        let length = 600_000;
        let (_folder, path, mut of_file) = file("a", length);
        let bytes = std::fs::read(&path).unwrap();
        let mut of_memory = Feed::memory(bytes.clone());
        let mut of_stream = Feed::stream(Box::new(std::io::Cursor::new(bytes.clone())));
        assert_eq!(
            (of_file.left(), of_memory.left(), of_stream.left()),
            (Some(600_000), Some(600_000), None)
        );
        for feed in [&mut of_file, &mut of_memory, &mut of_stream] {
            let (mut at, mut want) = (0, 1);
            while at < length {
                let there = feed.ahead(want).unwrap();
                assert!(there.len() >= want.min(length - at));
                assert_eq!(there, &bytes[at..at + there.len()]);
                let step = (want / 2 + 1).min(length - at);
                feed.step(step);
                at += step;
                assert_eq!(feed.position(), at as u64);
                want = want % 300_000 + 7919;
            }
            assert!(feed.all().unwrap().is_empty());
            assert_eq!(feed.left(), Some(0));
        }
    }

    #[test]
    fn any_place_of_a_file_can_be_copied() {
        let (_folder, path, mut of_file) = file("a", 1000);
        let mut of_memory = Feed::memory(std::fs::read(&path).unwrap());
        for feed in [&mut of_file, &mut of_memory] {
            feed.ahead(20).unwrap();
            feed.step(10);
            let mut out = [0; 4];
            feed.copy(300, &mut out).unwrap();
            assert_eq!(out, [59, 60, 61, 62]);
            assert_eq!(feed.ahead(3).unwrap()[..3], [10, 11, 12]);
            assert!(feed.copy(987, &mut out).is_err());
        }
    }

    #[test]
    fn a_file_that_shrinks_is_an_error_that_says_so() {
        let (_folder, path, mut feed) = file("a", 1 << 20);
        feed.ahead(1000).unwrap();
        let writer = std::fs::OpenOptions::new().write(true).open(&path).unwrap();
        writer.set_len(1 << 19).unwrap();
        assert!(feed.ahead(1 << 18).is_ok());
        let said = feed.all().unwrap_err().fault.to_string();
        assert!(said.contains("1048576") && said.contains("524288"), "{said}");
        let said = feed.copy(1 << 19, &mut [0; 8]).unwrap_err().fault.to_string();
        assert!(said.contains("524288"), "{said}");
    }

    #[test]
    fn more_memory_than_there_can_be_is_an_error() {
        // A hole takes no room on the disk.
        let (_folder, path, _) = file("a", 10);
        let length = 1 << 62;
        let mut feed = Feed::file(File::open(&path).unwrap(), length);
        let said = feed.all().unwrap_err().fault;
        assert!(matches!(said, Fault::Memory { bytes } if bytes == length), "{said}");
    }
}
