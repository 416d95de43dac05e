//! The common part of both kinds of STL.

use crate::assemble::Corner;

/// A facet of either kind of file.
pub(super) trait Facet: Copy + Send + Sync {
    /// Position in the precision of the file.
    type Position: Corner;
    fn corner(&self, k: usize) -> Self::Position;
    /// The stored normal, which may be anything.
    fn normal(&self) -> [f32; 3];
    /// Whether all corners are finite.
    fn finite(&self) -> bool;
}
