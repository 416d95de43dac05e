//! Meshes whose facets look out of the material, as a section needs them.

use crate::progress::Stage;
use trueness_geom::mesh::Mesh;
use trueness_geom::repair::{self, Change, RepairError};
use trueness_inspect::results::{InputRecord, Role};

/// The mesh with its facets turned outwards where they were not; what was changed is told with the file.
pub fn faced(mesh: &Mesh, record: &mut InputRecord, stage: &Stage) -> anyhow::Result<Mesh> {
    let found = repair::faced(mesh, record.role == Role::Reference, stage);
    let found = found.map_err(|e| match e {
        RepairError::Cancelled(e) => e.into(),
        e => anyhow::anyhow!("{}: {e}", record.path),
    })?;
    record.warnings.extend(told(&found.changes, mesh.faces.len()));
    Ok(found.mesh)
}

/// One sentence for each kind of change.
fn told(changes: &[Change], of: usize) -> Vec<String> {
    let mut kinds: Vec<(&str, usize)> = vec![];
    for change in changes {
        match kinds.iter_mut().find(|(what, _)| *what == change.what) {
            Some((_, facets)) => *facets += change.facets,
            None => kinds.push((change.what, change.facets)),
        }
    }
    let sentence = |(what, facets): (&str, usize)| {
        format!(
            "{what} for the section: {facets} of {of} facets; trueness check lists them, trueness repair mends the file"
        )
    };
    kinds.into_iter().map(sentence).collect()
}
