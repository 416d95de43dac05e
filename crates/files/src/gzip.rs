//! Packed files: unpacked as they are read, and never beyond a bound.

use crate::error::Fault;
use flate2::read::MultiGzDecoder;
use std::io::{self, Read};

/// So many unpacked bytes are allowed for each packed one, beyond [`ALWAYS_UNPACKED_BYTES`]. Text of points shrinks 3 to 10 times, a mesh
/// with much symmetry perhaps 50 times. Only pure repetition reaches the 1032 times of the method.
const MAX_UNPACKED_PER_PACKED: u64 = 200;
/// So many unpacked bytes are allowed at any ratio.
const ALWAYS_UNPACKED_BYTES: u64 = 64 << 20;

/// True if the bytes begin a gzip member.
pub(crate) fn is_gzip(head: &[u8]) -> bool {
    head.starts_with(&[0x1f, 0x8b, 8])
}

/// The unpacked bytes of `packed`, one member after the other.
pub(crate) fn unpack(packed: impl Read + Send + 'static) -> impl Read + Send {
    Bounded { inner: MultiGzDecoder::new(Counted { inner: packed, count: 0 }), out: 0 }
}

/// Counts the bytes that pass.
struct Counted<R> {
    inner: R,
    count: u64,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let n = self.inner.read(buffer)?;
        self.count += n as u64;
        Ok(n)
    }
}

/// Refuses to go on when far more comes out than went in.
struct Bounded<R: Read> {
    inner: MultiGzDecoder<Counted<R>>,
    out: u64,
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let n = self.inner.read(buffer).map_err(|e| io::Error::new(e.kind(), Packed::Damaged(e)))?;
        self.out += n as u64;
        if self.out > ALWAYS_UNPACKED_BYTES + MAX_UNPACKED_PER_PACKED * self.inner.get_ref().count {
            return Err(io::Error::other(Packed::Bomb));
        }
        Ok(n)
    }
}

/// A fault of packed bytes, carried through `io::Error`.
#[derive(Debug, thiserror::Error)]
enum Packed {
    #[error("bomb")]
    Bomb,
    #[error("{0}")]
    Damaged(io::Error),
}

/// The fault behind an error of reading: one of [`Packed`], or the system's.
pub(crate) fn fault(e: io::Error) -> Fault {
    match e.downcast::<Packed>() {
        Ok(Packed::Bomb) => Fault::Bomb { ratio: MAX_UNPACKED_PER_PACKED },
        Ok(Packed::Damaged(e)) => Fault::Gzip(e),
        Err(e) => Fault::Io(e),
    }
}
