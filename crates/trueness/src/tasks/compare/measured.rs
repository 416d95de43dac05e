//! The measured side: a cloud as a stream, or the vertices or samples of a mesh.

use crate::read::{self, Body, Opened};
use crate::task::{Meaning, TaskError, Watch};
use std::path::Path;
use trueness_document::compare::MeasuredKind;
use trueness_document::{InputRecord, Role};
use trueness_files::{Columns, PointSource, ReadOptions, Sources, Weld};
use trueness_geom::align::{self, AlignError, Alignment, BestFit, ExactSurface, Target};
use trueness_geom::closest::{MeshError, Tree};
use trueness_geom::cloud::Whole;
use trueness_geom::deviation::sample::sample as sample_mesh;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Vector;
use trueness_geom::topology::weld;
use trueness_measure::cad_faces::CadFaces;
use trueness_measure::compare::{facet_normals, vertex_normals};

/// What is compared.
pub struct Measured {
    /// The points in their order.
    pub points: PointSource,
    /// The mesh that they are the vertices or samples of.
    pub mesh: Option<Mesh>,
    /// What they are.
    pub kind: MeasuredKind,
    /// Facets of the samples; empty without such.
    faces: Vec<u32>,
    /// How it was brought to the reference.
    motion: Option<Rigid>,
    /// What the document says about the file.
    pub record: InputRecord,
}

impl Measured {
    /// Opens the file; `sample` asks for that many points on a mesh's surface instead of its vertices.
    ///
    /// A mesh keeps its vertices as they stand in the file, so that results can be put back beside it; only the corners of
    /// an STL, which has no vertices of its own, are welded.
    pub fn open(
        path: &Path,
        reading: &ReadOptions,
        sample: Option<u64>,
        seed: u64,
        (sources, watch): (&dyn Sources, &dyn Watch),
    ) -> Result<Measured, TaskError> {
        let reading = ReadOptions { weld: Weld::None, ..reading.clone() };
        let Opened { record, body, format, .. } = read::open(sources, path, Role::Measured, &reading)?;
        let mesh = match body {
            Body::Points(_) if sample.is_some() => {
                let text = format!("--sample needs a measured mesh, but {} holds points", path.display());
                return Err(TaskError::usage(text));
            }
            Body::Points(points) => {
                let (faces, motion) = (vec![], None);
                return Ok(Measured {
                    points,
                    mesh: None,
                    kind: MeasuredKind::Points,
                    faces,
                    motion,
                    record,
                });
            }
            Body::Mesh(mesh) if format.starts_with("stl") => {
                weld::mesh(&mesh.mesh).meaning(|| path.display().to_string())?.mesh
            }
            Body::Mesh(mesh) => mesh.mesh,
        };
        let mut faces = vec![];
        let (points, kind) = match sample {
            Some(n) => {
                check_memory(n, watch)?;
                let samples = sample_mesh(&mesh, n as usize, seed).meaning(|| path.display().to_string())?;
                faces.extend(samples.iter().map(|s| s.face));
                (samples.into_iter().map(|s| s.point).collect(), MeasuredKind::Samples)
            }
            None => (mesh.positions.clone(), MeasuredKind::Vertices),
        };
        let points = Box::new(Whole::new(points));
        Ok(Measured { points, mesh: Some(mesh), kind, faces, motion: None, record })
    }
}

impl Measured {
    /// Brings it to `reference` by the best fit, and says how. All points are held in memory for it.
    pub fn align(
        &mut self,
        path: &Path,
        (reference, faces): (&Mesh, Option<&CadFaces>),
        seed: u64,
        progress: &dyn Progress,
    ) -> Result<Alignment, TaskError> {
        let stream = std::mem::replace(&mut self.points, Box::new(Whole::new(vec![])));
        let mut points = read::all_points(path, stream, &mut self.record)?;
        let tree = Tree::build_watched(reference, progress).map_err(|e| match e {
            MeshError::Cancelled(e) => e.into(),
            e => TaskError::because(e),
        })?;
        let scan = match &self.mesh {
            Some(mesh) => align::Measured::Mesh(mesh),
            None => align::Measured::Points { points: &points, normals: None },
        };
        let options = BestFit { seed, ..BestFit::default() };
        let exact = faces.map(|faces| faces as &dyn ExactSurface);
        let target = Target::new(reference, &tree).drawing(exact);
        let found = align::best_fit(&scan, &target, &options, progress);
        let found = found.map_err(|e| match e {
            AlignError::Cancelled(e) => e.into(),
            e => TaskError::unanswerable(format!("{}: {e}", path.display())),
        })?;
        let motion = &found.reference_from_measured;
        let own = self.mesh.iter_mut().flat_map(|m| &mut m.positions);
        own.chain(&mut points).for_each(|p| *p = motion.point(*p));
        self.points = Box::new(Whole::new(points));
        self.motion = Some(*motion);
        Ok(found)
    }

    /// A normal for each point, as it lies now, for `what` asks for them: of a mesh by its facets, of points from their file at
    /// `path`. All are held in memory.
    pub fn normals(
        &self,
        (sources, path): (&dyn Sources, &Path),
        columns: Option<&Columns>,
        reading: &ReadOptions,
        what: &str,
    ) -> Result<Vec<Vector>, TaskError> {
        if let Some(mesh) = &self.mesh {
            return Ok(match self.kind {
                MeasuredKind::Samples => facet_normals(mesh, self.faces.iter().copied()),
                MeasuredKind::Vertices | MeasuredKind::Points => vertex_normals(mesh),
            });
        }
        let mut normals =
            read::all_normals(sources, path, columns, reading, what, " (or those that --normals names)")?;
        if let Some(motion) = &self.motion {
            normals.iter_mut().for_each(|n| *n = motion.vector(*n));
        }
        Ok(normals)
    }
}

/// Bytes for each sample: itself and its facet, its place, its deviation on the way and its deviation kept.
const BYTES_PER_SAMPLE: u128 = 32 + 24 + 8 + 8;

/// Refuses so many samples as there is no memory for.
fn check_memory(samples: u64, watch: &dyn Watch) -> Result<(), TaskError> {
    let needed = BYTES_PER_SAMPLE * u128::from(samples);
    match watch.memory() {
        Some(there) if needed > u128::from(there) => Err(TaskError::usage(format!(
            "--sample {samples} needs {} of memory, and {} are free; give a smaller number",
            shown(needed),
            shown(there.into())
        ))),
        _ => Ok(()),
    }
}

/// `bytes` as people read them.
fn shown(bytes: u128) -> String {
    let units = ["kB", "MB", "GB", "TB", "PB"];
    let mut size = bytes as f64 / 1e3;
    let mut unit = 0;
    while size >= 999.5 && unit + 1 < units.len() {
        (size, unit) = (size / 1e3, unit + 1);
    }
    format!("{size:.1} {}", units[unit])
}
