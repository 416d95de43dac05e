//! A file of points, written block by block.

use super::Writable;
use crate::format::sink::{Block, Layout, PointsSink};
use crate::format::spool::Spool;
use crate::{
    AtomicFile,
    error::{WriteError, WriteFault},
};
use std::path::{Path, PathBuf};

/// Begins a file of points in the format of the path's extension (with or without deviations, reasons and colors).
///
/// Errors: an extension that no writer of points has; those of the system.
pub fn points(path: &Path, layout: Layout) -> Result<PointsFile, WriteError> {
    begin(path, layout).map(|(file, _)| file)
}

/// As [`points`], with a spool beside the file.
pub(super) fn begin(path: &Path, layout: Layout) -> Result<(PointsFile, Spool), WriteError> {
    let begin = || {
        let (writer, extension) = Writable::Points.writer(path, |f| f.points)?;
        let file = AtomicFile::create(path)?;
        let spool = Spool::beside(&file);
        Ok((writer(file, layout, extension)?, spool))
    };
    let (writing, spool) = begin().map_err(|e: WriteFault| e.in_file(path))?;
    Ok((PointsFile { writing, layout, path: path.into(), count: 0 }, spool))
}

/// A file of points being written. Unless it is finished, nothing of it remains.
pub struct PointsFile {
    writing: Box<dyn PointsSink>,
    layout: Layout,
    pub(super) path: PathBuf,
    count: u64,
}

impl PointsFile {
    /// Adds points. Memory is bounded by the size of the blocks.
    pub fn write(&mut self, block: &Block) -> Result<(), WriteError> {
        let points = block.points.len();
        let even = |what, there: bool, values: usize| {
            let expected = if there { points } else { 0 };
            if values == expected { Ok(()) } else { Err(WriteFault::Uneven { what, points, values }) }
        };
        let write = |this: &mut Self| {
            even("deviations", this.layout.deviation, block.deviation.len())?;
            even("reasons", this.layout.reason, block.reason.len())?;
            even("faces", this.layout.face, block.face.len())?;
            even("colors", this.layout.color, block.color.len())?;
            this.count += points as u64;
            this.writing.write(block)
        };
        write(self).map_err(|e| e.in_file(&self.path))
    }

    /// Puts the file in its place. Gives the number of points.
    pub fn finish(self) -> Result<u64, WriteError> {
        let commit = |writing: Box<dyn PointsSink>| Ok(writing.finish()?.commit()?);
        commit(self.writing).map_err(|e: WriteFault| e.in_file(&self.path))?;
        Ok(self.count)
    }
}
