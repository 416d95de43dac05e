//! The references: meshes, and B-spline surfaces made ready to be searched.

use crate::read::cad::Chord;
use crate::read::{self, ReferenceBody};
use crate::task::{Meaning, STEPS, TaskError, Watch};
use std::path::{Path, PathBuf};
use trueness_cad::search::Search;
use trueness_document::InputRecord;
use trueness_document::compare::Method;
use trueness_files::cad::CadFile;
use trueness_files::{ReadOptions, Sources};
use trueness_geom::deviation::sign_choice::SignRequest;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::Aabb;
use trueness_geom::spline::surface::{Degenerate, FootError, FootSearch, Nurbs};
use trueness_measure::compare::{CadFaces, Exact, Options, Reference};
use trueness_measure::drawn_faces::DrawnFaces;
use trueness_measure::file_numbers::LeftOut;

/// A reference as it was read.
pub enum Opened {
    /// A mesh, and the numbers of the facets of the file that are not in it.
    Mesh(Mesh, Vec<u32>),
    /// Surfaces, and the mesh that draws them.
    Surfaces(Box<FootSearch>, Mesh),
    /// Faces of a CAD model, and the mesh that draws them.
    Cad(Box<CadFaces>, Mesh),
}

impl Opened {
    /// The mesh, or the one that draws the surfaces.
    pub fn mesh(&self) -> &Mesh {
        match self {
            Opened::Mesh(mesh, _) | Opened::Surfaces(_, mesh) | Opened::Cad(_, mesh) => mesh,
        }
    }
    /// The same for the comparison.
    fn reference(&self, name: String) -> Reference<'_> {
        let (exact, left_out) = match self {
            Opened::Mesh(_, left_out) => (None, LeftOut(left_out)),
            Opened::Surfaces(search, _) => (Some(Exact::Splines(search)), LeftOut::default()),
            Opened::Cad(faces, _) => (Some(Exact::Cad(faces)), LeftOut::default()),
        };
        Reference { name, mesh: self.mesh(), exact, left_out }
    }
}

/// All of them for the comparison, by the names of their files.
pub fn named<'a>(all: &'a [Opened], files: &[InputRecord]) -> Vec<Reference<'a>> {
    all.iter().zip(files).map(|(opened, file)| opened.reference(file.path.clone())).collect()
}

/// Reads all references.
pub fn open(
    paths: &[PathBuf],
    reading: &ReadOptions,
    options: &Options,
    (sources, watch): (&dyn Sources, &dyn Watch),
) -> Result<(Vec<Opened>, Vec<InputRecord>), TaskError> {
    let (mut all, mut records) = (vec![], vec![]);
    for path in paths {
        let (body, mut record) = read::reference(sources, path, reading)?;
        let lacking = match &body {
            ReferenceBody::Surfaces(surfaces) => degenerate(surfaces),
            ReferenceBody::Mesh(_) | ReferenceBody::Cad(_) => vec![],
        };
        let opened = match body {
            ReferenceBody::Mesh(mesh) => Opened::Mesh(mesh.mesh, mesh.nonfinite_facets),
            ReferenceBody::Surfaces(surfaces) => {
                allowed(path, options, SPLINES)?;
                prepared(path, &surfaces, watch)?
            }
            ReferenceBody::Cad(file) => {
                allowed(path, options, "faces of a CAD model")?;
                cad(path, &file, &mut record, watch)?
            }
        };
        if matches!(opened, Opened::Surfaces(..)) {
            record.bounds = trueness_measure::bounds(&Aabb::of(&opened.mesh().positions));
        }
        record.warnings.extend(lacking);
        all.push(opened);
        records.push(record);
    }
    Ok((all, records))
}

/// Surfaces that lack an area, the first few by number.
fn degenerate(surfaces: &[Nurbs]) -> Vec<String> {
    /// Said one by one; of more their number is.
    const MAX_NAMED_SURFACES: usize = 10;
    let all = (0..)
        .zip(surfaces)
        .flat_map(|(n, s): (usize, &Nurbs)| s.degenerate().into_iter().map(move |d| (n, d)))
        // Every sphere has poles: what is measured next to one is as sound as elsewhere.
        .filter(|(_, d)| !matches!(d, Degenerate::Edge(..)));
    let all: Vec<(usize, Degenerate)> = all.collect();
    let mut told: Vec<String> =
        all.iter().take(MAX_NAMED_SURFACES).map(|(n, d)| format!("surface {n}: {d}")).collect();
    if all.len() > MAX_NAMED_SURFACES {
        told.push(format!("{} more such places of surfaces", all.len() - MAX_NAMED_SURFACES));
    }
    told
}

/// What a file of whole B-spline surfaces holds, in messages.
const SPLINES: &str = "B-spline surfaces";

/// Refuses what is asked of facets only.
fn allowed(path: &Path, options: &Options, holds: &str) -> Result<(), TaskError> {
    let shown = path.display();
    if options.method == Method::Paper {
        return Err(TaskError::usage(format!(
            "--method paper: it measures to the facets of a mesh, and {shown} holds {holds}; leave it out, or make a mesh of it by `trueness convert`"
        )));
    }
    if options.along.is_some() {
        return Err(TaskError::usage(format!(
            "--along: its lines meet the facets of a mesh, and {shown} holds {holds}; leave it out, or make a mesh of it by `trueness convert`"
        )));
    }
    if !options.regions.is_empty() && holds == SPLINES {
        return Err(TaskError::usage(format!(
            "--regions: they are made of the facets of a mesh, and {shown} holds {holds}; leave it out, or make a mesh of it by `trueness convert`"
        )));
    }
    match options.surface.sign {
        SignRequest::Auto | SignRequest::None => Ok(()),
        SignRequest::Pseudonormal | SignRequest::Winding => Err(TaskError::usage(format!(
            "--sign {}: it is for meshes, and {shown} holds {holds}; take auto, for the side of their normal, or none",
            options.surface.sign.name()
        ))),
    }
}

/// Faces of a CAD model ready to be searched, with the mesh that draws them.
fn cad(
    path: &Path,
    file: &CadFile,
    record: &mut InputRecord,
    watch: &dyn Watch,
) -> Result<Opened, TaskError> {
    let stage = watch.stage("preparing the faces", STEPS, None);
    let (shape, drawn) = read::cad::tessellated(path, file, Chord::DRAWN, record, &*stage)?;
    let count = shape.brep.faces.len();
    let of_facet = drawn.regions.map_or(vec![], |regions| regions.of_facet);
    let faces = DrawnFaces::new(&shape.brep, &drawn.mesh, of_facet);
    let trims = shape.trims.into_iter().map(Result::ok).collect();
    let search = Search::new(&shape.brep, trims);
    let drawn_within = record.cad.as_ref().map_or(0.0, |cad| cad.facets_within);
    stage.finish();
    Ok(Opened::Cad(Box::new(CadFaces { search, count, drawn_within, drawn: faces }), drawn.mesh))
}

/// Surfaces ready to be searched, with the mesh that draws them.
fn prepared(path: &Path, surfaces: &[Nurbs], watch: &dyn Watch) -> Result<Opened, TaskError> {
    let stage = watch.stage("preparing the surfaces", STEPS, None);
    let search = FootSearch::new(surfaces, &*stage).map_err(|e| match e {
        FootError::Cancelled(e) => e.into(),
        e => TaskError::because(e),
    });
    let search = search.meaning(|| path.display().to_string())?;
    let mesh = search.mesh();
    Ok(Opened::Surfaces(Box::new(search), mesh))
}
