//! A file of a mesh.

use super::{Loss, Writable};
use crate::{
    AtomicFile, Body, Format, Input, ReadOptions,
    error::{WriteError, WriteFault},
    open,
};
use std::path::{Path, PathBuf};
use trueness_geom::mesh::Mesh;

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
    /// The loss in the format.
    pub loss: Loss,
}

impl MeshFile {
    /// Writes a mesh in the format of the path's extension.
    ///
    /// Errors: those of [`mesh`].
    pub fn write(path: &Path, mesh: &Mesh) -> Result<MeshFile, WriteError> {
        let write = || {
            let (writer, _) = Writable::Mesh.writer(path, |f| f.mesh)?;
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
