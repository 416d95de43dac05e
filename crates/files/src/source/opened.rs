//! Bytes ready to be parsed: unpacked and turned into UTF-8 if need be.

use super::bytes::{Kind, SourceBytes};
use crate::{
    error::{Fault, Result},
    feed::Feed,
    gzip, unicode,
};
use std::{
    fs::File,
    io::{self, BufReader, Cursor, Read, Seek},
};

/// Opened bytes and what is known of them.
pub(crate) struct Source {
    pub feed: Feed,
    /// Size as they lie there, packed or not; 0 where unknown.
    pub bytes: u64,
    pub gzip: bool,
}

/// The first bytes of a file, up to this number, decide its format.
pub(crate) const SNIFFED_BYTES: usize = 1 << 16;

impl Source {
    /// The source of bytes from their start.
    pub fn of(bytes: SourceBytes) -> Result<Source> {
        match bytes.0 {
            Kind::Stream(reader) => Source { feed: Feed::stream(reader), bytes: 0, gzip: false }.unpacked(),
            Kind::File { file, length } => Source::of_file(file, length),
            Kind::Memory(shared) => {
                let bytes = shared.as_ref().len() as u64;
                let gzip = gzip::is_gzip(shared.as_ref());
                let feed = match gzip {
                    true => Feed::stream(Box::new(gzip::unpack(Cursor::new(shared)))),
                    false => Feed::shared(shared),
                };
                Source { feed, bytes, gzip }.recoded()
            }
        }
    }

    fn of_file(mut file: File, bytes: u64) -> Result<Source> {
        let mut head = [0; 3];
        let packed = bytes >= 3 && file.read_exact(&mut head).is_ok() && gzip::is_gzip(&head);
        if packed {
            file.rewind()?;
            let packed = BufReader::with_capacity(1 << 18, file);
            let feed = Feed::stream(Box::new(gzip::unpack(packed)));
            return Source { feed, bytes, gzip: true }.recoded();
        }
        if bytes == 0 {
            return Err(Fault::Empty.into());
        }
        let feed = Feed::file(file, bytes);
        Source { feed, bytes, gzip: false }.recoded()
    }

    /// Unpacks a stream whose first bytes say that it is packed.
    fn unpacked(mut self) -> Result<Source> {
        let head = self.feed.ahead(3)?;
        if gzip::is_gzip(head) {
            self.feed = Feed::stream(Box::new(gzip::unpack(FeedReader(self.feed))));
            self.gzip = true;
        }
        self.recoded()
    }

    /// Turns text in UTF-16 into UTF-8. Such files are small: they come from spreadsheets.
    fn recoded(mut self) -> Result<Source> {
        let head = self.feed.ahead(SNIFFED_BYTES)?;
        crate::feed::not_empty(head)?;
        if let Some(code) = unicode::utf16(head) {
            let text = unicode::to_utf8(self.feed.all()?, code)?;
            self.feed = Feed::memory(text);
        }
        Ok(self)
    }
}

/// A feed read as a stream, below the unpacking.
struct FeedReader(Feed);

impl Read for FeedReader {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let there = self.0.ahead(1).map_err(|e| io::Error::other(e.fault))?;
        let n = there.len().min(buffer.len());
        buffer[..n].copy_from_slice(&there[..n]);
        self.0.step(n);
        Ok(n)
    }
}
