//! CAD models: what documents say of their files, and their facets for what works on meshes.

use super::places::{describe, out_of_range, refusal};
use crate::task::TaskError;
use std::path::Path;
use trueness_cad::tessellate::{Fineness, TessellateError, Tessellation};
use trueness_cad::trimmed::Trimmed;
use trueness_document::{CadInputRecord, IncompleteRecord, InputRecord, Role};
use trueness_files::cad::CadFile;
use trueness_files::{FacetRegions, SourceMesh};
use trueness_geom::closest::MAX_VERTEX;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_measure::cad_faces::CadFaces;

/// How far facets may lie from the faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Chord {
    /// Millimeters.
    Within(f64),
    /// A share of the diagonal.
    Share(f64),
}

impl Chord {
    /// For what is measured on facets: a hundredth of a millimeter for a part of 200 mm.
    pub const MEASURED: Chord = Chord::Share(5e-5);
    /// For what is only drawn: less than a pixel of a picture.
    pub const DRAWN: Chord = Chord::Share(5e-4);
}

/// Greatest angle between neighboring facets, radians: a circle has 24 or more.
const FACET_ANGLE: f64 = std::f64::consts::PI / 12.0;
/// Facets of a model at most.
const MAX_FACETS: usize = 16_000_000;

/// A model where its parts stand, and its facets with the face of each. The document is told of faces that are missing, and of those that
/// contradicted their neighbors and were turned.
pub fn tessellated(
    path: &Path,
    file: &CadFile,
    chord: Chord,
    record: &mut InputRecord,
    progress: &dyn Progress,
) -> Result<(Trimmed, SourceMesh), TaskError> {
    let (shape, turned) = Trimmed::of(&file.model, progress)?.agreed();
    tell_turned(record, &turned);
    let made = divided(path, file, &shape, chord, record, progress)?;
    if made.mesh.faces.is_empty() {
        return Err(TaskError::unanswerable(format!("{}: {}", path.display(), nothing_drawn(&shape, &made))));
    }
    let name = |face: &trueness_cad::brep::Face| match face.name.trim() {
        "" => format!("face {}", face.entity),
        name => name.to_string(),
    };
    let names = shape.brep.faces.iter().map(name).collect();
    let regions = Some(FacetRegions { names, of_facet: made.faces });
    Ok((shape, SourceMesh { mesh: made.mesh, regions, ..SourceMesh::default() }))
}

/// Why a model has no facets, by its first face that has none.
fn nothing_drawn(shape: &Trimmed, made: &Tessellation) -> String {
    let of = shape.brep.faces.len();
    let untrimmed = shape.trims.iter().zip(&shape.brep.faces).find_map(|(trim, face)| {
        let error = trim.as_ref().err()?;
        Some(format!("face #{}: {error}", face.entity))
    });
    let failed = || {
        let (face, why) = made.failed.first()?;
        Some(format!("face #{}: {why}", shape.brep.faces.get(*face as usize)?.entity))
    };
    let why = untrimmed.or_else(failed).map_or(String::new(), |why| format!(": {why}"));
    format!("none of its {of} faces can be divided into facets{why}; export the part again, or as STL")
}

/// A model where its parts stand as its file has it, and its facets and lines along edges. The document is told of faces that are missing.
pub fn drawn(
    path: &Path,
    file: &CadFile,
    chord: Chord,
    record: &mut InputRecord,
    progress: &dyn Progress,
) -> Result<(Trimmed, Tessellation), TaskError> {
    let shape = Trimmed::of(&file.model, progress)?;
    let made = divided(path, file, &shape, chord, record, progress)?;
    Ok((shape, made))
}

/// The facets of a model; the document is told of faces that are missing.
fn divided(
    path: &Path,
    file: &CadFile,
    shape: &Trimmed,
    chord: Chord,
    record: &mut InputRecord,
    progress: &dyn Progress,
) -> Result<Tessellation, TaskError> {
    let size = shape.bounds().diagonal();
    // Most files of meshes hold single precision.
    let finest = f64::from(f32::EPSILON) * size;
    let distance = match chord {
        Chord::Within(distance) if distance < finest => {
            let least = 1.01 * finest;
            return Err(TaskError::usage(format!(
                "--chord {distance:e}: facets of a part of {size:.3} mm cannot lie so near to its faces in the numbers of a mesh; give {least:.2e} mm or more"
            )));
        }
        Chord::Within(distance) => distance,
        Chord::Share(share) => share * size,
    };
    let fineness = Fineness { distance, angle: FACET_ANGLE };
    let made = shape.tessellate(fineness, MAX_FACETS, progress).map_err(|e| match e {
        TessellateError::Cancelled(e) => e.into(),
        e => TaskError::unanswerable(format!("{}: {e}", path.display())),
    })?;
    if let Some(v) = made.mesh.positions.iter().position(|p| out_of_range(p, MAX_VERTEX)) {
        return Err(TaskError::unanswerable(refusal(path, "vertex", v, MAX_VERTEX)));
    }
    let farthest = made.bounds.iter().flatten().map(|b| b.distance).fold(0.0, f64::max);
    let read = made.bounds.iter().flatten().count() as u64;
    record.cad = Some(CadInputRecord { faces: read, facets_within: farthest });
    record.facets = Some(made.mesh.faces.len() as u64);
    tell_missing(file, shape, read, record);
    describe(record, &made.mesh.positions);
    Ok(made)
}

/// Tells the document of faces that could not be read, and of those whose border could not be followed; `read` have neither.
pub fn tell_missing(file: &CadFile, shape: &Trimmed, read: u64, record: &mut InputRecord) {
    let unread = file.model.unread.iter().filter(|u| u.holds_faces).count();
    record.incomplete = incomplete(record.role, read, (shape.brep.faces.len() + unread) as u64);
    if let Some(missing) = &record.incomplete {
        record.warnings.push(format!("{}; `trueness info` names the others", missing.text));
    }
}

/// Tells the document of faces that were turned.
pub fn tell_turned(record: &mut InputRecord, faces: &[u32]) {
    if !faces.is_empty() {
        let count = faces.len();
        record.warnings.push(format!(
            "{count} face(s) look the other way than their neighbors and were turned, so that closed shells look outward; `trueness check` names them"
        ));
    }
}

/// A model where its parts stand as faces to measure against, and the mesh that draws them.
pub fn faces(
    path: &Path,
    file: &CadFile,
    chord: Chord,
    record: &mut InputRecord,
    progress: &dyn Progress,
) -> Result<(CadFaces, Mesh), TaskError> {
    let (shape, drawn) = tessellated(path, file, chord, record, progress)?;
    let drawn_within = record.cad.as_ref().map_or(0.0, |cad| cad.facets_within);
    let of_facet = drawn.regions.map_or(vec![], |regions| regions.of_facet);
    let faces = CadFaces::new(&file.model, shape, (&drawn.mesh, of_facet), drawn_within, progress)?;
    Ok((faces, drawn.mesh))
}

/// What of the faces is missing; `None` where all are there.
fn incomplete(role: Role, read: u64, of: u64) -> Option<IncompleteRecord> {
    let what = if role == Role::Reference { "the reference" } else { "the file" };
    let were = if read == 1 { "was" } else { "were" };
    let text = format!("{read} of {of} faces of {what} {were} read");
    (read < of).then_some(IncompleteRecord { read: Some(read), of: Some(of), text })
}

/// What a document says of the file before anything is made of its faces.
pub fn record(role: Role, path: &Path, file: &CadFile) -> InputRecord {
    InputRecord {
        path: path.display().to_string(),
        format: format!("{}{}", file.format, if file.gzip { "+gzip" } else { "" }),
        bytes: file.bytes,
        unit_assumed: unit(file.unit.millimeters),
        unit_from: file.unit.from.name().into(),
        warnings: file.warnings.iter().map(ToString::to_string).collect(),
        ..InputRecord::of_no_file(role)
    }
}

/// The name of a unit of so many millimeters.
fn unit(millimeters: f64) -> String {
    const NAMES: [(f64, &str); 7] =
        [(1.0, "mm"), (10.0, "cm"), (1000.0, "m"), (25.4, "in"), (0.001, "um"), (304.8, "ft"), (1e6, "km")];
    let same = |(own, _): &&(f64, &str)| (own / millimeters - 1.0).abs() < 1e-9;
    NAMES.iter().find(same).map_or_else(|| format!("{millimeters} mm"), |(_, name)| (*name).into())
}
