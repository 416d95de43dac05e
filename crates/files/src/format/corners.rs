//! Corners of facets that are written.

use crate::error::WriteFault;
use trueness_geom::{mesh::Mesh, space::Point};

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
