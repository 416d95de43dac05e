//! Writing points and meshes. Files appear whole or not at all.

mod held;
mod loss;
mod regions;
#[cfg(test)]
pub(crate) mod scratch;
pub(crate) mod spool;
mod values;
mod writable;

use crate::{
    AtomicFile, Body, FORMATS, Format, Input, ReadOptions,
    error::{WriteError, WriteFault},
    open,
};
pub use held::HeldPoints;
pub use loss::Loss;
pub use regions::{Pieces, regions};
use spool::Spool;
use std::path::{Path, PathBuf};
use trueness_geom::{mesh::Mesh, space::Point};
pub use values::{Values, values};
pub use writable::Writable;

/// Which values go with the points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// A deviation for each point, some of them without.
    pub deviation: bool,
    /// A colour for each point.
    pub colour: bool,
}

/// Some of the points, in order.
#[derive(Clone, Copy, Debug, Default)]
pub struct Block<'a> {
    /// Positions, millimetres.
    pub points: &'a [Point],
    /// As many deviations, millimetres, NaN for a point that has none; nothing where the layout has none.
    pub deviation: &'a [f64],
    /// As many colours (red, green, blue); nothing where the layout has none.
    pub colour: &'a [[u8; 3]],
}

/// Begins a file of points in the format of the path's extension (with or without deviations and colours).
///
/// Errors: an extension that no writer of points has; those of the system.
pub fn points(path: &Path, layout: Layout) -> Result<PointsFile, WriteError> {
    begin(path, layout).map(|(file, _)| file)
}

/// As [`points`], with a spool beside the file.
fn begin(path: &Path, layout: Layout) -> Result<(PointsFile, Spool), WriteError> {
    let begin = || {
        let (writer, extension) = by_extension(path, Writable::Points, |f| f.points)?;
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
    path: PathBuf,
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
            even("colours", this.layout.colour, block.colour.len())?;
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

/// Writes a mesh in the format of the path's extension. Gives what the format could not hold.
///
/// Errors: an extension that no writer of meshes has; a face that names no vertex; those of the system.
pub fn mesh(path: &Path, mesh: &Mesh) -> Result<Loss, WriteError> {
    let file = MeshFile::write(path, mesh)?;
    let loss = file.loss;
    file.finish()?;
    Ok(loss)
}

/// A mesh that is written, but not yet in its place. Unless it is finished, nothing of it remains.
pub struct MeshFile {
    file: AtomicFile,
    path: PathBuf,
    /// What the format could not hold.
    pub loss: Loss,
}

impl MeshFile {
    /// Writes a mesh in the format of the path's extension.
    ///
    /// Errors: those of [`mesh`].
    pub fn write(path: &Path, mesh: &Mesh) -> Result<MeshFile, WriteError> {
        let write = || {
            let (writer, _) = by_extension(path, Writable::Mesh, |f| f.mesh)?;
            let mut file = AtomicFile::create(path)?;
            let loss = writer(&mut file, mesh)?;
            Ok(MeshFile { file, path: path.into(), loss })
        };
        write().map_err(|e: WriteFault| e.in_file(path))
    }

    /// Reads the mesh as others will read it; `None` where that cannot be done: of a device or a pipe, or in a format
    /// that is only written.
    ///
    /// Errors: those of writing the rest, and of [`open`].
    pub fn read_back(&mut self) -> Result<Option<Mesh>, WriteError> {
        let extension = self.path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        let Some(format) = Format::by_extension(extension).filter(|f| f.reads()) else { return Ok(None) };
        let options = ReadOptions { format: Some(format), ..ReadOptions::default() };
        let place = match self.file.so_far() {
            Ok(Some(place)) => place,
            Ok(None) => return Ok(None),
            Err(e) => return Err(WriteFault::from(e).in_file(&self.path)),
        };
        match open(place, &options) {
            Ok(Input { body: Body::Mesh(source), .. }) => Ok(Some(source.mesh)),
            // No facets are left.
            Ok(_) => Ok(Some(Mesh::default())),
            Err(e) => Err(WriteFault::ReadBack(Box::new(e)).in_file(&self.path)),
        }
    }

    /// Puts the file in its place.
    pub fn finish(self) -> Result<(), WriteError> {
        self.file.commit().map_err(|e| WriteFault::from(e).in_file(&self.path))
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

/// The writer of a path's extension, and that extension.
fn by_extension<W>(
    path: &Path,
    what: Writable,
    writer: impl Fn(&Format) -> Option<W>,
) -> Result<(W, &'static str), WriteFault> {
    let ending = what.ending_of(path)?;
    let format = FORMATS.iter().find(|f| f.written_as.contains(&ending) && writer(f).is_some());
    format.and_then(|f| Some((writer(f)?, ending))).ok_or_else(|| what.unknown())
}

/// Positions of the corners of a face, if it has them.
pub(crate) fn corner_positions(
    mesh: &Mesh,
    face: usize,
    corners: &[u32; 3],
) -> Result<[Point; 3], WriteFault> {
    let mut out = [[0.0; 3]; 3];
    for (p, v) in out.iter_mut().zip(corners) {
        *p = *mesh.positions.get(*v as usize).ok_or(WriteFault::NoSuchVertex { face })?;
    }
    Ok(out)
}

/// The shortest digits that give the same number back.
pub(crate) fn push_number(text: &mut Vec<u8>, x: f64) {
    let mut digits = zmij::Buffer::new();
    let shown = digits.format(x);
    text.extend_from_slice(shown.strip_suffix(".0").unwrap_or(shown).as_bytes());
}
