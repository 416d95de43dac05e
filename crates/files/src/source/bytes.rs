//! The bytes of a source.

use crate::error::Fault;
use crate::feed::Shared;
use crate::source::hash;
use std::fs::File;
use std::io::{self, Cursor, Read};

/// The bytes of a source, from their start and as they lie there (packed, where they are packed).
pub struct SourceBytes(pub(super) Kind);

pub(super) enum Kind {
    /// A regular file of this length.
    File { file: File, length: u64 },
    /// Bytes whose number shows only at their end.
    Stream(Box<dyn Read + Send>),
    /// All of them.
    Memory(Shared),
}

impl SourceBytes {
    /// The bytes of an open file. A pipe or a device becomes a stream.
    ///
    /// # Errors
    /// Errors of the system; a folder.
    pub fn of_file(file: File) -> io::Result<SourceBytes> {
        let about = file.metadata()?;
        if about.is_dir() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        Ok(SourceBytes(match about.is_file() {
            true => Kind::File { file, length: about.len() },
            // Pipes and devices do not say how long they are.
            false => Kind::Stream(Box::new(file)),
        }))
    }

    /// The bytes that a reader gives, once.
    pub fn stream(reader: impl Read + Send + 'static) -> SourceBytes {
        SourceBytes(Kind::Stream(Box::new(reader)))
    }

    /// Bytes in memory; they are not copied.
    pub fn memory(bytes: impl AsRef<[u8]> + Send + Sync + 'static) -> SourceBytes {
        SourceBytes::shared(Shared::new(bytes))
    }

    pub(super) fn shared(bytes: Shared) -> SourceBytes {
        SourceBytes(Kind::Memory(bytes))
    }

    /// Their number, where it is known without reading them.
    pub fn length(&self) -> Option<u64> {
        match &self.0 {
            Kind::File { length, .. } => Some(*length),
            Kind::Stream(_) => None,
            Kind::Memory(bytes) => Some(bytes.as_ref().len() as u64),
        }
    }

    /// The first `count` of them, or all where there are fewer.
    ///
    /// # Errors
    /// Errors of reading.
    pub fn head(self, count: usize) -> Result<Vec<u8>, Fault> {
        let mut head = vec![];
        let read = match self.0 {
            Kind::File { file, .. } => file.take(count as u64).read_to_end(&mut head),
            Kind::Stream(reader) => reader.take(count as u64).read_to_end(&mut head),
            Kind::Memory(bytes) => Cursor::new(bytes).take(count as u64).read_to_end(&mut head),
        };
        read.map(|_| head).map_err(Fault::Io)
    }

    /// Their SHA-256.
    ///
    /// # Errors
    /// Errors of reading. Cost: one pass, about 2 GB/s where the processor has instructions for it.
    pub fn sha256(self) -> io::Result<[u8; 32]> {
        match self.0 {
            Kind::File { file, .. } => hash::sha256(file),
            Kind::Stream(reader) => hash::sha256(reader),
            Kind::Memory(bytes) => hash::sha256(Cursor::new(bytes)),
        }
    }
}
