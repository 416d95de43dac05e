//! The quantities of points beside their positions, for files that keep each quantity together.

use super::{
    sink::{Block, Layout},
    spool::Spool,
};
use crate::{AtomicFile, error::WriteFault};

/// Values that follow the positions; they are held beside the file until all positions are in it.
pub(crate) struct Columns {
    /// Which of them the file has.
    pub layout: Layout,
    /// Points so far.
    pub count: u64,
    /// Deviations, 8 bytes each.
    pub deviation: Spool,
    /// Why a point does not count, one byte each.
    pub excluded: Spool,
    /// Colors, 3 bytes each.
    pub color: Spool,
}

impl Columns {
    /// None yet.
    pub fn beside(file: &AtomicFile, layout: Layout) -> Columns {
        let spool = || Spool::beside(file);
        Columns { layout, count: 0, deviation: spool(), excluded: spool(), color: spool() }
    }

    /// Keeps those of the block, and gives the bytes of its positions to `positions`, some at a time.
    pub fn write(
        &mut self,
        block: &Block,
        mut positions: impl FnMut(&[u8]) -> std::io::Result<()>,
    ) -> Result<(), WriteFault> {
        for points in block.points.chunks(1 << 14) {
            let bytes: Vec<u8> = points.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
            positions(&bytes)?;
        }
        self.deviation.write(block.deviation.iter().flat_map(|d| d.to_le_bytes()))?;
        self.excluded.write(block.excluded())?;
        self.color.write(block.color.iter().flatten().copied())?;
        self.count += block.points.len() as u64;
        Ok(())
    }
}
