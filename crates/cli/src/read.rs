//! Files of the command line, read and described for the result document.

use crate::exit::{Usage, not_negative};
use anyhow::{Context, bail};
use std::path::Path;
use trueness_files::{Body, Input, PointSource, ReadOptions, SourceMesh, Weld};
use trueness_geom::space::Point;
use trueness_inspect::results::{InputRecord, Role};

/// Reads a mesh; points are refused with a remedy.
pub fn mesh(path: &Path, options: &ReadOptions) -> anyhow::Result<(SourceMesh, InputRecord)> {
    let Input { provenance, body, warnings } = trueness_files::open(path, options)?;
    let record = record(Role::Reference, &provenance, &warnings);
    match body {
        Body::Mesh(mesh) => {
            let counts = (mesh.mesh.positions.len() as u64, Some(mesh.mesh.faces.len() as u64));
            Ok((mesh, InputRecord { points: counts.0, facets: counts.1, ..record }))
        }
        Body::Points(_) => bail!(
            "{}: it holds points without facets, but a reference must be a mesh (STL, PLY, OBJ, OFF); \
             give the points first and the mesh after them",
            path.display()
        ),
    }
}

/// What `--weld` asks for.
pub fn weld(distance: Option<f64>) -> Result<Weld, Usage> {
    distance.map_or(Ok(Weld::Same), |d| Ok(Weld::Within(not_negative("weld", d)?)))
}

/// All points of a source.
pub fn all_points(mut source: PointSource) -> anyhow::Result<Vec<Point>> {
    let (mut all, mut block): (Vec<Point>, Vec<Point>) = (Vec::new(), Vec::new());
    loop {
        source.next_block(&mut block)?;
        if block.is_empty() {
            return Ok(all);
        }
        all.extend_from_slice(&block);
    }
}

/// What the document says about a file; its counts and hash are filled in later.
pub fn record(
    role: Role,
    provenance: &trueness_files::Provenance,
    warnings: &[trueness_files::Warning],
) -> InputRecord {
    InputRecord {
        role,
        path: provenance.path.clone(),
        format: format!("{}{}", provenance.format, if provenance.gzip { "+gzip" } else { "" }),
        bytes: provenance.bytes,
        sha256: None,
        sha256_reason: None,
        unit_assumed: provenance.unit_assumed.name().into(),
        points: 0,
        facets: None,
        warnings: warnings.iter().map(ToString::to_string).collect(),
    }
}

/// Fills in the hash of a file as it lies on disk.
pub fn hash(record: &mut InputRecord) -> anyhow::Result<()> {
    if record.path == "-" {
        record.sha256_reason = Some("read from standard input".into());
        return Ok(());
    }
    let digest = trueness_files::sha256(Path::new(&record.path))
        .with_context(|| format!("{}: it changed or vanished while it was read", record.path))?;
    record.sha256 = Some(digest.iter().map(|b| format!("{b:02x}")).collect());
    Ok(())
}
