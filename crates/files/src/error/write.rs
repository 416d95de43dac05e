//! Why a file was not written: what went wrong, remedy.

use super::ReadError;
use std::{io, path::Path};

/// A file that could not be written. Nothing is left of it.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {fault}; nothing was written")]
pub struct WriteError {
    /// The file's name as it was given.
    pub file: String,
    /// The fault.
    #[source]
    pub fault: WriteFault,
}

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteFault {
    /// The system refused; on a full disk, [`io::ErrorKind::StorageFull`].
    #[error("{}", advice(.0))]
    Io(#[from] io::Error),
    /// Someone meant it to stay as it is.
    #[error("it is protected against writing: choose another name, or lift the protection")]
    Protected,
    /// No writer goes by this file's extension.
    #[error("{what} cannot be written under this name; end it in one of {known}")]
    UnknownFormat {
        /// `points` or `a mesh`.
        what: &'static str,
        /// The extensions there are.
        known: String,
    },
    /// More than the format can number.
    #[error("{count} {what} are more than {format} can hold; choose another format")]
    TooMany {
        /// Name of the format.
        format: &'static str,
        /// Name of the things counted.
        what: &'static str,
        /// How many there are.
        count: u64,
    },
    /// The written file cannot be read again.
    #[error("it was written, but cannot be read again: {0}")]
    ReadBack(Box<ReadError>),
    /// A face names a vertex that the mesh does not have.
    #[error("face {face} names a vertex that does not exist; check the mesh first")]
    NoSuchVertex {
        /// Number of the face, from 0.
        face: usize,
    },
    /// A block has not as many deviations or colors as points.
    #[error("{points} points with {values} {what}")]
    Uneven {
        /// `deviations`, `reasons` or `colors`.
        what: &'static str,
        /// Points in the block.
        points: usize,
        /// Values in the block.
        values: usize,
    },
}

impl WriteError {
    /// The error of the system about writing to `path`.
    pub fn new(path: &Path, error: io::Error) -> WriteError {
        WriteFault::from(error).in_file(path)
    }
}

impl WriteFault {
    /// Whether the question was wrong, not the answer: another name must be given.
    pub fn is_wrong_usage(&self) -> bool {
        matches!(self, WriteFault::UnknownFormat { .. })
    }
    pub(crate) fn in_file(self, path: &Path) -> WriteError {
        WriteError { file: path.display().to_string(), fault: self }
    }
}

/// The message of the system, with a remedy where there is one.
fn advice(e: &io::Error) -> String {
    match e.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "no space is left there: free some or choose another place".into()
        }
        io::ErrorKind::NotFound => "the folder does not exist: make it first".into(),
        io::ErrorKind::PermissionDenied => "not permitted: choose another place".into(),
        io::ErrorKind::IsADirectory => "this is a folder: name a file in it".into(),
        io::ErrorKind::NotADirectory => {
            "what should be its folder is not a folder: choose another place".into()
        }
        io::ErrorKind::ReadOnlyFilesystem => "nothing can be written there: choose another place".into(),
        io::ErrorKind::InvalidFilename => "no file can have this name: choose a shorter one".into(),
        _ => e.to_string(),
    }
}
