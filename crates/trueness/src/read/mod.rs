//! What goes by the names of a request, read and described for the result document.

pub mod cad;
mod places;
mod surface_document;
mod unread;
mod whole;

pub use places::describe;
pub use whole::{bytes, digest};

use cad::Chord;
use places::{out_of_range, refusal};

use crate::task::{Meaning, TaskError};
use std::path::Path;
use trueness_document::{ColumnRecord, InputRecord, Role, TableRecord};
use trueness_files::cad::{CadFile, SplineModel};
use trueness_files::drawing::Drawing;
use trueness_files::{
    ColumnTaken, Columns, Holds, Input, PointSource, ReadError, ReadOptions, SourceMesh, Sources,
    TableReading, Warning, Weld, open_from, open_normals_from,
};
use trueness_geom::closest::{MAX_COORDINATE, MAX_VERTEX};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Progress, Silent};
use trueness_geom::scan::Scan;
use trueness_geom::space::{Point, Vector};
use trueness_geom::spline::surface::Nurbs;
use trueness_measure::cad_faces::CadFaces;
use trueness_measure::compare::RegionRule;
use trueness_measure::plan::regions_of_file;

/// What reading answers.
type Result<T> = std::result::Result<T, TaskError>;

/// A file of this run: what the document says of it, and what is in it.
pub struct Opened {
    /// What the document says; its hash is filled in by [`hash`].
    pub record: InputRecord,
    /// What is in it.
    pub body: Body,
    /// Whether its points have two coordinates only.
    pub planar: bool,
    /// What its format is called, in all detail.
    pub format: &'static str,
    /// Whether it holds nothing at all.
    pub empty: bool,
}

/// A mesh or points.
pub enum Body {
    /// Vertices and faces.
    Mesh(SourceMesh),
    /// Vertices without faces; not yet read beyond the first few.
    Points(PointSource),
}

/// Opens a file that is taken for `role`. Counts and box of a mesh stand in the record; those of points, which have not
/// been read yet, do not.
pub fn open(sources: &dyn Sources, path: &Path, role: Role, options: &ReadOptions) -> Result<Opened> {
    match any(sources, path, role, options)? {
        Any::Whole(opened) => Ok(opened),
        Any::Cad(file, record) => tessellated(path, &file, record),
        Any::Splines(model, record) => Err(unread::refusal(path, &model, &record, MESH_OR_POINTS)),
        Any::Drawing(..) => Err(no_drawing(path)),
    }
}

/// What most commands need.
const MESH_OR_POINTS: &str = "this command needs a mesh or points";

/// A file of any kind.
pub enum Any {
    /// A mesh or points.
    Whole(Opened),
    /// B-spline surfaces and curves.
    Splines(SplineModel, InputRecord),
    /// A CAD model with exact faces.
    Cad(Box<CadFile>, InputRecord),
    /// Lines, arcs and splines in a plane.
    Drawing(Drawing, InputRecord),
}

/// Why a drawing is refused.
fn no_drawing(path: &Path) -> TaskError {
    TaskError::unanswerable(format!(
        "{}: it is a drawing, but this command needs a mesh or points; drawings are nominals of `trueness section`",
        path.display()
    ))
}

/// What a section is compared with.
pub enum NominalBody {
    /// Lines, arcs and splines.
    Drawing(Drawing, InputRecord),
    /// A CAD model.
    Cad(Box<CadFile>, InputRecord),
    /// A mesh or points.
    Whole(Opened),
}

/// Opens the nominal of a section.
pub fn nominal(sources: &dyn Sources, path: &Path, options: &ReadOptions) -> Result<NominalBody> {
    match any(sources, path, Role::Reference, options)? {
        Any::Drawing(drawing, record) => Ok(NominalBody::Drawing(drawing, record)),
        Any::Whole(opened) => Ok(NominalBody::Whole(opened)),
        Any::Cad(file, record) => Ok(NominalBody::Cad(file, record)),
        Any::Splines(model, record) => Err(unread::refusal(path, &model, &record, MESH_OR_POINTS)),
    }
}

/// A model as facets, for what works on meshes.
fn tessellated(path: &Path, file: &CadFile, mut record: InputRecord) -> Result<Opened> {
    let (_, mesh) = cad::tessellated(path, file, Chord::MEASURED, &mut record, &Silent)?;
    Ok(Opened { record, body: Body::Mesh(mesh), planar: false, format: file.format, empty: false })
}

/// Opens a file of whatever content.
pub fn any(sources: &dyn Sources, path: &Path, role: Role, options: &ReadOptions) -> Result<Any> {
    let Input { provenance, body, warnings } = open_from(sources, path, options)?;
    let mut record = record(role, &provenance, &warnings);
    let body = match body {
        trueness_files::Body::Cad(file) => {
            let mut record = cad::record(role, path, &file);
            if let Weld::Within(_) = options.weld {
                record
                    .warnings
                    .push("--weld joins vertices of meshes: it was not used on a CAD model".into());
            }
            return Ok(Any::Cad(file, record));
        }
        trueness_files::Body::Splines(model) => return Ok(Any::Splines(model, record)),
        trueness_files::Body::Drawing(drawing) => return Ok(Any::Drawing(drawing, record)),
        trueness_files::Body::Points(points) => Body::Points(points),
        trueness_files::Body::Mesh(mesh) => {
            let out =
                |v: &u32| mesh.mesh.positions.get(*v as usize).is_some_and(|p| out_of_range(p, MAX_VERTEX));
            if let Some(v) = mesh.mesh.faces.par_iter().flat_map_iter(|f| *f).filter(out).min() {
                return Err(TaskError::unanswerable(refusal(path, "vertex", v as usize, MAX_VERTEX)));
            }
            describe(&mut record, &mesh.mesh.positions);
            record.facets = Some(mesh.mesh.faces.len() as u64);
            record.incomplete = unread::incomplete(role, &warnings, record.facets);
            Body::Mesh(mesh)
        }
    };
    let empty = warnings.contains(&Warning::Nothing);
    Ok(Any::Whole(Opened { record, body, planar: provenance.planar, format: provenance.format, empty }))
}

/// What points are compared with.
pub enum ReferenceBody {
    /// Facets.
    Mesh(SourceMesh),
    /// A CAD model.
    Cad(Box<CadFile>),
    /// B-spline surfaces, at least one.
    Surfaces(Vec<Nurbs>),
}

/// Reads a mesh or B-spline surfaces: those of a CAD file, or of a document of `trueness surface`. Points are refused with a remedy.
pub fn reference(
    sources: &dyn Sources,
    path: &Path,
    options: &ReadOptions,
) -> Result<(ReferenceBody, InputRecord)> {
    if options.format.is_none()
        && let Some(found) = surface_document::read(sources, path)?
    {
        return Ok((ReferenceBody::Surfaces(vec![found.0]), found.1));
    }
    match any(sources, path, Role::Reference, options)? {
        Any::Whole(opened) => {
            opened_mesh(path, Role::Reference, opened).map(|(m, r)| (ReferenceBody::Mesh(m), r))
        }
        Any::Cad(mut file, record) => match file.splines.take() {
            Some(model) => splines(path, model, record),
            None => Ok((ReferenceBody::Cad(file), record)),
        },
        Any::Splines(model, record) if model.surfaces.is_empty() => {
            Err(unread::refusal(path, &model, &record, "a reference needs facets or B-spline surfaces"))
        }
        Any::Drawing(..) => Err(no_drawing(path)),
        Any::Splines(model, record) => splines(path, model, record),
    }
}

/// B-spline surfaces of a file.
fn splines(path: &Path, model: SplineModel, mut record: InputRecord) -> Result<(ReferenceBody, InputRecord)> {
    let points: Vec<Point> =
        model.surfaces.iter().flat_map(|s| s.control_points().into_iter().map(|p| p.0)).collect();
    if let Some(i) = points.iter().position(|p| out_of_range(p, MAX_VERTEX)) {
        return Err(TaskError::unanswerable(refusal(path, "control point", i, MAX_VERTEX)));
    }
    record.points = points.len() as u64;
    Ok((ReferenceBody::Surfaces(model.surfaces), record))
}

/// Reads a mesh, or the faces of a CAD model with the mesh that draws them; points are refused with a remedy.
pub fn mesh_or_faces(
    sources: &dyn Sources,
    path: &Path,
    options: &ReadOptions,
    progress: &dyn Progress,
) -> Result<(SourceMesh, Option<CadFaces>, InputRecord)> {
    match mesh_or_cad(sources, path, Role::Reference, options)? {
        (MeshOrCad::Mesh(mesh), record) => Ok((mesh, None, record)),
        (MeshOrCad::Cad(file), mut record) => {
            let (faces, mesh) = cad::faces(path, &file, Chord::MEASURED, &mut record, progress)?;
            Ok((SourceMesh { mesh, ..SourceMesh::default() }, Some(faces), record))
        }
    }
}

/// Facets, or a model with exact faces.
pub enum MeshOrCad {
    /// Facets.
    Mesh(SourceMesh),
    /// A CAD model.
    Cad(Box<CadFile>),
}

/// Reads a mesh or a CAD model; points are refused with a remedy.
pub fn mesh_or_cad(
    sources: &dyn Sources,
    path: &Path,
    role: Role,
    options: &ReadOptions,
) -> Result<(MeshOrCad, InputRecord)> {
    match any(sources, path, role, options)? {
        Any::Whole(opened) => opened_mesh(path, role, opened).map(|(m, r)| (MeshOrCad::Mesh(m), r)),
        Any::Cad(file, record) => Ok((MeshOrCad::Cad(file), record)),
        Any::Splines(model, record) => Err(unread::refusal(path, &model, &record, MESH_OR_POINTS)),
        Any::Drawing(..) => Err(no_drawing(path)),
    }
}

/// Reads a mesh; points are refused with a remedy.
pub fn mesh(
    sources: &dyn Sources,
    path: &Path,
    role: Role,
    options: &ReadOptions,
) -> Result<(SourceMesh, InputRecord)> {
    opened_mesh(path, role, open(sources, path, role, options)?)
}

/// The faces of a CAD model as a reference, and the mesh that draws them.
pub fn faces(
    path: &Path,
    file: &CadFile,
    record: &mut InputRecord,
    progress: &dyn Progress,
) -> Result<(CadFaces, Mesh)> {
    cad::faces(path, file, Chord::MEASURED, record, progress)
}

fn opened_mesh(path: &Path, role: Role, opened: Opened) -> Result<(SourceMesh, InputRecord)> {
    match opened.body {
        Body::Mesh(mesh) => Ok((mesh, opened.record)),
        Body::Points(_) if role == Role::Reference => Err(TaskError::unanswerable(format!(
            "{}: it holds points without facets, but a reference must be a mesh ({}), or a CAD model or B-spline \
             surfaces ({}); of two files, give the points first",
            path.display(),
            Holds::Mesh.formats(),
            Holds::Model.formats()
        ))),
        // Without vertices, too, it is as empty as an STL file of no facets.
        Body::Points(_) if opened.empty => {
            let record = InputRecord { facets: Some(0), ..opened.record };
            Ok((SourceMesh::default(), record))
        }
        Body::Points(_) => Err(TaskError::unanswerable(format!(
            "{}: it holds points without facets; this command needs a mesh ({})",
            path.display(),
            Holds::Mesh.formats()
        ))),
    }
}

/// Longest file of regions, bytes.
const LONGEST_REGIONS: usize = 16 << 20;

/// The regions of a reference with tolerances of their own, of a file.
pub fn regions(sources: &dyn Sources, path: &Path) -> Result<Vec<RegionRule>> {
    let shown = path.display();
    let text = sources.text(path, LONGEST_REGIONS)?;
    regions_of_file(&text).map_err(|e| TaskError::unanswerable(format!("{shown}: {e}")))
}

/// All of what the file at `path` holds.
pub fn scan(path: &Path, body: Body, record: &mut InputRecord) -> Result<Scan> {
    Ok(match body {
        Body::Mesh(source) => source.mesh.into(),
        Body::Points(source) => Scan::Cloud(all_points(path, source, record)?),
    })
}

/// All points of a source, which is the file at `path`. The document is told what there is to tell of them.
pub fn all_points(path: &Path, mut source: PointSource, record: &mut InputRecord) -> Result<Vec<Point>> {
    let (mut all, mut block): (Vec<Point>, Vec<Point>) = (Vec::new(), Vec::new());
    loop {
        source.next_block(&mut block)?;
        if block.is_empty() {
            record.warnings.extend(source.remarks());
            return Ok(all);
        }
        if let Some(i) = block.iter().position(|p| out_of_range(p, MAX_COORDINATE)) {
            return Err(TaskError::unanswerable(refusal(path, "point", all.len() + i, MAX_COORDINATE)));
        }
        all.extend_from_slice(&block);
    }
}

/// The normals of the points of the file at `path`, one for each, for `what` that needs them; `or` tells how else their columns
/// can be named.
pub fn all_normals(
    sources: &dyn Sources,
    path: &Path,
    columns: Option<&Columns>,
    reading: &ReadOptions,
    what: &str,
    or: &str,
) -> Result<Vec<Vector>> {
    if sources.is_stream(path) {
        let what = format!(
            "{what}: {} can be read only once, but its normals need a second reading; give a file",
            path.display()
        );
        return Err(TaskError::usage(what));
    }
    let found = || {
        let (mut all, mut block) = (vec![], vec![]);
        let mut source = open_normals_from(sources, path, columns, reading)?;
        loop {
            source.next_block(&mut block)?;
            if block.is_empty() {
                return Ok(all);
            }
            all.append(&mut block);
        }
    };
    found().map_err(|e: ReadError| TaskError::from(e)).meaning(|| {
        format!(
            "{what} needs the normals of the points: columns nx, ny, nz of a table{or}, such properties of a PLY file, or a measured mesh"
        )
    })
}

/// What the document says about a file; its counts and hash are filled in later.
fn record(
    role: Role,
    provenance: &trueness_files::Provenance,
    warnings: &[trueness_files::Warning],
) -> InputRecord {
    let mut texts: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    if provenance.planar {
        texts.push("two columns: the points were taken to lie in the plane z = 0".into());
    }
    InputRecord {
        role,
        path: provenance.path.clone(),
        format: format!("{}{}", provenance.format, if provenance.gzip { "+gzip" } else { "" }),
        bytes: provenance.bytes,
        sha256: None,
        sha256_reason: None,
        unit_assumed: provenance.unit_assumed.name().into(),
        unit_from: provenance.unit_from.name().into(),
        table: provenance.table.as_ref().map(table),
        points: 0,
        facets: None,
        incomplete: unread::incomplete(role, warnings, None),
        cad: None,
        trimmed_faces: unread::trimmed(warnings),
        bounds: None,
        warnings: texts,
    }
}

fn table(reading: &TableReading) -> TableRecord {
    let column = |c: &ColumnTaken| ColumnRecord { axis: c.axis, number: c.number, name: c.name.clone() };
    TableRecord {
        separator: reading.separator.into(),
        decimal_sign: reading.decimal_sign,
        columns: reading.columns.iter().map(column).collect(),
        of: reading.of,
        header_line: reading.header_line,
        lines_skipped: reading.lines_skipped,
    }
}

/// Fills in the hash of a file as it lies on disk.
///
/// The name in the record is for people: bytes in it that are no text are replaced, so the file is found by `path`.
pub fn hash(sources: &dyn Sources, record: &mut InputRecord, path: &Path) -> Result<()> {
    if sources.is_stream(path) {
        let what = if path == Path::new("-") { "standard input" } else { "a pipe or a device" };
        record.sha256_reason = Some(format!("read from {what}"));
        return Ok(());
    }
    let digest = sources
        .sha256(path)
        .meaning(|| format!("{}: it changed or vanished while it was read", path.display()))?;
    record.sha256 = Some(whole::hexadecimal(digest));
    Ok(())
}
