//! Point clouds, whole or in blocks.

use crate::space::Point;

/// Points that arrive block by block, in the order of their file: the `i`-th point ever delivered *is* point `i`.
pub trait PointStream {
    /// Why the stream broke off.
    type Error;
    /// Number of points in all, where it is known beforehand. A file of several scans may announce the first alone.
    fn expected(&self) -> Option<u64>;
    /// Replaces the contents of `block` by the next points. An empty block ends the stream.
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<(), Self::Error>;
}
