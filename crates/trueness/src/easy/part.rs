//! What is read from a file and written to one.

use super::error::Error;
use std::path::Path;
use trueness_files::write::{self, Loss};
use trueness_files::{Body, Input, Provenance, ReadOptions, SourceMesh, Warning, open};
use trueness_geom::align::Measured;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::Point;

/// A file that was read: a mesh, or points.
#[derive(Clone, Debug)]
pub struct Part {
    /// The mesh, millimeters, vertices at the same place made one. Of points the places alone, without faces.
    pub mesh: Mesh,
    /// The normals that an STL file stores with its facets, which [`check`](crate::check) compares with their corners.
    pub stored_normals: Option<Vec<[f32; 3]>>,
    /// Numbers in the file, from 0, of facets that were left out for a coordinate that is NaN or infinite: `mesh` has none of them.
    pub nonfinite_facets: Vec<u32>,
    /// Where it came from, and the unit in which its numbers were taken.
    pub provenance: Provenance,
    /// What was odd about the file.
    pub warnings: Vec<Warning>,
}

impl Part {
    /// Whether it has points alone.
    pub fn is_cloud(&self) -> bool {
        matches!(as_scan(&self.mesh), Measured::Points { .. })
    }

    /// The points, or the vertices of the mesh. (`trueness compare` counts the vertices of a file that shares them as they stand there,
    /// copies and unused ones too.)
    pub fn points(&self) -> &[Point] {
        &self.mesh.positions
    }
}

/// A mesh without faces is a cloud in these calls.
pub(super) fn as_scan(mesh: &Mesh) -> Measured<'_> {
    match mesh.faces.is_empty() {
        true => Measured::Points { points: &mesh.positions, normals: None },
        false => Measured::Mesh(mesh),
    }
}

/// Reads a mesh or points of any format and whatever is packed with gzip; `-` is standard input. The format is told by the
/// content, units are millimeters unless the file says otherwise. For options see [`crate::files::open`].
///
/// Memory: the file and several times that; points are read as a whole.
///
/// # Errors
/// [`Error::Read`] names file, place and remedy; [`Error::Cad`] for CAD models, [`Error::Splines`] for files with nothing but splines,
/// [`Error::Drawing`] for drawings.
///
/// ```
/// let part = trueness::read("../../corpus/bunny/zipper_res4.ply")?;
/// assert!(!part.is_cloud());
/// assert_eq!((part.points().len(), part.mesh.faces.len()), (453, 948));
/// # Ok::<(), trueness::Error>(())
/// ```
pub fn read(path: impl AsRef<Path>) -> Result<Part, Error> {
    of_input(open(path.as_ref(), &ReadOptions::default())?)
}

/// What an opened file holds.
pub(super) fn of_input(input: Input) -> Result<Part, Error> {
    let (provenance, mut warnings) = (input.provenance, input.warnings);
    let source = match input.body {
        Body::Mesh(source) => source,
        Body::Points(mut stream) => {
            let (mut positions, mut block) = (vec![], vec![]);
            loop {
                stream.next_block(&mut block)?;
                if block.is_empty() {
                    break;
                }
                positions.append(&mut block);
            }
            warnings.extend(stream.remarks().into_iter().map(Warning::Remark));
            SourceMesh { mesh: Mesh { positions, faces: vec![] }, ..SourceMesh::default() }
        }
        Body::Cad(_) => return Err(Error::Cad { path: provenance.path }),
        Body::Splines(_) => return Err(Error::Splines { path: provenance.path }),
        Body::Drawing(_) => return Err(Error::Drawing { path: provenance.path }),
    };
    let SourceMesh { mesh, stored_normals, nonfinite_facets, .. } = source;
    Ok(Part { mesh, stored_normals, nonfinite_facets, provenance, warnings })
}

/// Writes a mesh in the format of the path's extension; the file appears whole or not at all, in place of one that is there. Gives
/// what the format could not hold.
///
/// # Errors
/// [`Error::Write`]: an extension that no writer of meshes has, a face that names no vertex, what the system says.
///
/// ```
/// # let folder = std::env::temp_dir().join(format!("trueness-write-mesh-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder)?;
/// let part = trueness::read("../../corpus/bunny/zipper_res4.ply")?;
/// let file = folder.join("bunny.ply");
/// trueness::write_mesh(&file, &part.mesh)?;
/// assert_eq!(trueness::read(&file)?.mesh, part.mesh);
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_mesh(path: impl AsRef<Path>, mesh: &Mesh) -> Result<Loss, Error> {
    Ok(write::mesh(path.as_ref(), mesh)?)
}
