//! The manifest and its blobs.

use super::blob::{self, ByteKind, base64};
use super::entry::{Blob, Entry};

/// Objects of the manifest and the blobs they name.
#[derive(Default)]
pub struct Payload {
    /// `objects` of the manifest.
    pub objects: Vec<Entry>,
    /// Base64 of gzip; a blob's number is its place here.
    pub blobs: Vec<String>,
    /// Points drawn and points given, of measured clouds.
    pub points: (usize, usize),
    /// Farthest that what is drawn lies from what was given, millimeters.
    pub display_error: f64,
    /// Something was left out or coarsened beyond the grid's rounding.
    pub simplified: bool,
}

impl Payload {
    /// Bytes of all blobs in the page.
    pub fn len(&self) -> usize {
        self.blobs.iter().map(String::len).sum()
    }

    /// Adds a blob.
    pub(super) fn add(&mut self, bytes: &[u8], kind: ByteKind) -> Blob {
        self.blobs.push(base64(&blob::gzip(bytes, kind)));
        Blob { blob: self.blobs.len() - 1 }
    }
}
