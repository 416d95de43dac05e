//! An archive of files that are stored as they are, of any size (APPNOTE.TXT 6.3: ZIP64 throughout).

use crate::AtomicFile;
use std::io::{self, Seek, SeekFrom, Write};

/// An archive being written. Each entry begins with a part whose bytes are only known at its end.
pub(super) struct Archive {
    file: AtomicFile,
    entries: Vec<Entry>,
    at: u64,
}

struct Entry {
    name: String,
    /// Where its local header is.
    start: u64,
    /// Bytes and checksum of what follows the part known at the end; then of all.
    length: u64,
    checksum: crc32fast::Hasher,
}

/// Stands for a size or place whose value is in the ZIP64 field.
const IN_ZIP64_FIELD: u32 = u32::MAX;
/// The version of the format that has ZIP64.
const ZIP64_VERSION: u16 = 45;
/// The first of January 1980, the earliest date of the format. A fixed date gives the same bytes for the same content.
const EARLIEST_DATE: u16 = 0x21;

impl Archive {
    pub fn new(file: AtomicFile) -> Archive {
        Archive { file, entries: vec![], at: 0 }
    }

    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)?;
        self.at += bytes.len() as u64;
        Ok(())
    }

    /// Begins an entry whose first `reserved` bytes are given to [`Archive::end`].
    pub fn begin(&mut self, name: &str, reserved: usize) -> io::Result<()> {
        let entry =
            Entry { name: name.into(), start: self.at, length: 0, checksum: crc32fast::Hasher::new() };
        let mut bytes = entry.local_header(0, 0);
        bytes.resize(bytes.len() + reserved, 0);
        self.entries.push(entry);
        self.put(&bytes)
    }

    /// Adds bytes to the entry begun last.
    pub fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        if let Some(entry) = self.entries.last_mut() {
            entry.length += bytes.len() as u64;
            entry.checksum.update(bytes);
        }
        self.put(bytes)
    }

    /// Ends the entry begun last, filling in its first bytes.
    pub fn end(&mut self, first: &[u8]) -> io::Result<()> {
        let Some(entry) = self.entries.last_mut() else { return Ok(()) };
        let mut checksum = crc32fast::Hasher::new();
        checksum.update(first);
        checksum.combine(&entry.checksum);
        entry.checksum = checksum;
        entry.length += first.len() as u64;
        let mut bytes = entry.local_header(entry.crc(), entry.length);
        bytes.extend(first);
        self.file.seek(SeekFrom::Start(entry.start))?;
        self.file.write_all(&bytes)?;
        self.file.seek(SeekFrom::Start(self.at))?;
        Ok(())
    }

    /// Writes the directory.
    pub fn finish(mut self) -> io::Result<AtomicFile> {
        let start = self.at;
        let count = self.entries.len() as u64;
        for entry in std::mem::take(&mut self.entries) {
            self.put(&entry.directory_entry())?;
        }
        let (end, mut bytes) = (self.at, Bytes::default());
        // ZIP64 end of directory, its locator, and the old end of directory that points to it.
        bytes.u32(0x0606_4b50).u64(44).u16(ZIP64_VERSION).u16(ZIP64_VERSION).u32(0).u32(0);
        bytes.u64(count).u64(count).u64(end - start).u64(start);
        bytes.u32(0x0706_4b50).u32(0).u64(end).u32(1);
        bytes.u32(0x0605_4b50).u16(0).u16(0).u16(count as u16).u16(count as u16);
        bytes.u32(IN_ZIP64_FIELD).u32(IN_ZIP64_FIELD).u16(0);
        self.put(&bytes.0)?;
        Ok(self.file)
    }
}

impl Entry {
    fn crc(&self) -> u32 {
        self.checksum.clone().finalize()
    }

    fn local_header(&self, crc: u32, length: u64) -> Vec<u8> {
        let mut b = Bytes::default();
        b.u32(0x0403_4b50).u16(ZIP64_VERSION).u16(0).u16(0).u16(0).u16(EARLIEST_DATE);
        b.u32(crc).u32(IN_ZIP64_FIELD).u32(IN_ZIP64_FIELD).u16(self.name.len() as u16).u16(20);
        b.0.extend(self.name.as_bytes());
        b.u16(1).u16(16).u64(length).u64(length);
        b.0
    }

    fn directory_entry(&self) -> Vec<u8> {
        let mut b = Bytes::default();
        b.u32(0x0201_4b50).u16(ZIP64_VERSION).u16(ZIP64_VERSION).u16(0).u16(0).u16(0).u16(EARLIEST_DATE);
        b.u32(self.crc()).u32(IN_ZIP64_FIELD).u32(IN_ZIP64_FIELD).u16(self.name.len() as u16).u16(28);
        b.u16(0).u16(0).u16(0).u32(0).u32(IN_ZIP64_FIELD);
        b.0.extend(self.name.as_bytes());
        b.u16(1).u16(24).u64(self.length).u64(self.length).u64(self.start);
        b.0
    }
}

/// Little-endian numbers one after the other.
#[derive(Default)]
struct Bytes(Vec<u8>);

impl Bytes {
    fn u16(&mut self, x: u16) -> &mut Self {
        self.0.extend(x.to_le_bytes());
        self
    }
    fn u32(&mut self, x: u32) -> &mut Self {
        self.0.extend(x.to_le_bytes());
        self
    }
    fn u64(&mut self, x: u64) -> &mut Self {
        self.0.extend(x.to_le_bytes());
        self
    }
}
