//! Writes binary STL.

use super::binary::record;
use crate::{
    AtomicFile,
    error::WriteFault,
    format::{corners::corner_positions, loss::Loss},
};
use std::io::Write;
use trueness_geom::{mesh::Mesh, space::normal};

/// This many facets become bytes at a time.
const STL_FACETS_PER_WRITE: usize = 1 << 14;

/// Writes the faces with their normals, zero where a face has none. Vertices that no face uses are lost.
pub(super) fn mesh(file: &mut AtomicFile, mesh: &Mesh) -> Result<Loss, WriteFault> {
    let Ok(count) = u32::try_from(mesh.faces.len()) else {
        return Err(WriteFault::TooMany { format: "stl", what: "faces", count: mesh.faces.len() as u64 });
    };
    // Anything but "solid", for readers that take that for ASCII.
    let mut header = [b' '; 80];
    header[..24].copy_from_slice(b"binary STL, millimetres.");
    file.write_all(&header)?;
    file.write_all(&count.to_le_bytes())?;
    let mut bytes = Vec::new();
    for (i, faces) in mesh.faces.chunks(STL_FACETS_PER_WRITE).enumerate() {
        bytes.clear();
        for (j, face) in faces.iter().enumerate() {
            let corners = corner_positions(mesh, i * STL_FACETS_PER_WRITE + j, face)?;
            let normal = normal(corners).unwrap_or([0.0; 3]);
            bytes.extend(record(normal.map(|x| x as f32), corners.map(|p| p.map(|x| x as f32))));
        }
        file.write_all(&bytes)?;
    }
    Ok(Loss::of_single_precision(&mesh.positions))
}
