//! Meshes whose facets look out of the material, as a section needs them.

use crate::task::TaskError;
use trueness_document::{InputRecord, Role};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_solid::repair::{self, RepairError};

/// The mesh with its facets turned outwards where they were not; what was changed is told with the file.
pub fn faced(mesh: &Mesh, record: &mut InputRecord, progress: &dyn Progress) -> Result<Mesh, TaskError> {
    let found = repair::faced(mesh, record.role == Role::Reference, progress);
    let found = found.map_err(|e| match e {
        RepairError::Cancelled(e) => e.into(),
        e => TaskError::unanswerable(format!("{}: {e}", record.path)),
    })?;
    let of = mesh.faces.len();
    for (facets, what) in [
        (found.doubled, "are there twice and are left out"),
        (found.turned, "run the other way round than their neighbors and are turned over"),
        (found.inverted, "are of shells that look inwards and are turned over"),
    ] {
        if facets > 0 {
            record.warnings.push(format!(
                "{}: {facets} of {of} facets {what} for the section; trueness check tells where, trueness repair mends the file",
                record.path
            ));
        }
    }
    Ok(found.mesh)
}
