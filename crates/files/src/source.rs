//! Where bytes come from: a file or standard input; unpacked and turned into UTF-8 if need be.

use crate::{
    error::{Fault, Result},
    feed::Feed,
    gzip, unicode,
};
use std::{
    fs::File,
    io::{self, Read},
    path::Path,
};

/// Opened bytes and what is known of them.
pub(crate) struct Source {
    pub feed: Feed,
    /// Size on disk, 0 where unknown.
    pub bytes: u64,
    pub gzip: bool,
}

/// How much of a file is looked at before its format is decided.
pub(crate) const HEAD: usize = 1 << 16;

impl Source {
    /// Opens a path; `-` is standard input.
    pub fn open(path: &Path) -> Result<Source> {
        if path == Path::new("-") {
            return Source { feed: Feed::stream(Box::new(io::stdin())), bytes: 0, gzip: false }.unpacked();
        }
        let file = File::open(path)?;
        let about = file.metadata()?;
        if about.is_dir() {
            return Err(Fault::Foreign("a folder").into());
        }
        // Pipes and devices do not say how long they are.
        if !about.is_file() {
            return Source { feed: Feed::stream(Box::new(file)), bytes: 0, gzip: false }.unpacked();
        }
        let bytes = about.len();
        let mut head = [0; 3];
        let packed = bytes >= 3 && (&file).read_exact(&mut head).is_ok() && gzip::is_gzip(&head);
        if packed {
            let again = io::BufReader::with_capacity(1 << 18, File::open(path)?);
            let feed = Feed::stream(Box::new(gzip::unpack(again)));
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
            self.feed = Feed::stream(Box::new(gzip::unpack(Rest(self.feed))));
            self.gzip = true;
        }
        self.recoded()
    }

    /// Turns text in UTF-16 into UTF-8. Such files are small: they come from spreadsheets.
    fn recoded(mut self) -> Result<Source> {
        let head = self.feed.ahead(HEAD)?;
        crate::feed::not_empty(head)?;
        if let Some(code) = unicode::utf16(head) {
            let text = unicode::to_utf8(self.feed.all()?, code)?;
            self.feed = Feed::memory(text);
        }
        Ok(self)
    }
}

/// A feed read as a stream, below the unpacking.
struct Rest(Feed);

impl Read for Rest {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let there = self.0.ahead(1).map_err(|e| io::Error::other(e.fault))?;
        let n = there.len().min(buffer.len());
        buffer[..n].copy_from_slice(&there[..n]);
        self.0.step(n);
        Ok(n)
    }
}
