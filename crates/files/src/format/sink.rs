//! The input of the writer of a format.

use super::loss::Loss;
use crate::{AtomicFile, error::WriteFault};
use trueness_geom::{mesh::Mesh, space::Point};

/// Which values go with the points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// A deviation for each point, some of them without.
    pub deviation: bool,
    /// Beside the deviations the number of the reason why a point does not count.
    pub reason: bool,
    /// The number of a face for each point; formats other than tables leave it out.
    pub face: bool,
    /// A color for each point.
    pub color: bool,
}

/// Some of the points, in order.
#[derive(Clone, Copy, Debug, Default)]
pub struct Block<'a> {
    /// Positions, millimeters.
    pub points: &'a [Point],
    /// As many deviations, millimeters, NaN for a point that has none; nothing where the layout has none.
    pub deviation: &'a [f64],
    /// As many numbers of reasons, 0 for a point that counts; nothing where the layout has none.
    pub reason: &'a [u8],
    /// As many numbers of faces, `None` for a point that has none; nothing where the layout has none.
    pub face: &'a [Option<u64>],
    /// As many colors (red, green, blue); nothing where the layout has none.
    pub color: &'a [[u8; 3]],
}

impl Block<'_> {
    /// The values of the column `excluded`: the reasons, or without reasons 1 for each point that has no deviation.
    pub(crate) fn excluded(&self) -> impl Iterator<Item = u8> + '_ {
        let alone = if self.reason.is_empty() { self.deviation } else { &[] };
        self.reason.iter().copied().chain(alone.iter().map(|d| u8::from(d.is_nan())))
    }
}

/// Begins the points of a format, under one of its extensions.
pub(crate) type PointsWriter = fn(AtomicFile, Layout, &str) -> Result<Box<dyn PointsSink>, WriteFault>;
/// Writes a whole mesh.
pub(crate) type MeshWriter = fn(&mut AtomicFile, &Mesh) -> Result<Loss, WriteFault>;

/// Takes points block by block; the lengths of a block agree with the layout.
pub(crate) trait PointsSink: Send {
    fn write(&mut self, block: &Block) -> Result<(), WriteFault>;
    fn finish(self: Box<Self>) -> Result<AtomicFile, WriteFault>;
}
