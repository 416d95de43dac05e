//! How far is every measured point from the reference?

mod facing;
mod measured;
mod options;
mod points;
mod prepared;
mod references;
mod request;

pub use facing::{FacingAngle, NoFacingAngle};
pub use request::{CompareRequest, Method, Sign};

use crate::task::{Done, Request, RunFiles, Scene, TaskError, Watch};
use points::{PointFiles, numbered};
use prepared::Prepared;
use references::Opened;
use trueness_document::compare::{CompareDocument, MeasuredKind, Sampling};
use trueness_document::scale::Scale;
use trueness_files::write::Writable;
use trueness_files::{Sources, WriteError};
use trueness_geom::mesh::Mesh;
use trueness_measure::cad_faces::CadFaces;
use trueness_measure::compare::{self, Comparisons, Inputs};
use trueness_report::views::compare as drawing;
use trueness_report::{Marks, ViewObject};

impl Request for CompareRequest {
    type Document = CompareDocument;
    const COMMAND: &'static str = "compare";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        let tables = self.scale.iter().chain(&self.regions);
        let inputs = RunFiles::of([&self.measured].into_iter().chain(&self.references).chain(tables));
        let count = self.references.len();
        let points = self.out.iter().flat_map(|path| (0..count).map(move |i| numbered(path, i, count)));
        Ok(points.fold(inputs, |files, path| files.out(Some(&path), Writable::Points)))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<CompareDocument>, TaskError> {
        let mut ready = Prepared::new(self, sources, watch)?;
        let mut points = self.point_files(&ready)?;
        let found = ready.compare(self, points.as_mut(), (sources, watch))?;
        let reverse = if self.both { ready.reverse(&found, watch)? } else { vec![] };
        let Prepared { measured, opened, files, options, alignment, scale } = ready;
        let kind = measured.kind;
        let inputs = Inputs { files, kind, scale, reverse, alignment, doubts: vec![] };
        let mut document = compare::document(&found, inputs, &options);
        if self.view {
            let vertices = kind == MeasuredKind::Vertices;
            let shown = if vertices { found.count } else { found.shown.points.len() as u64 };
            document.sampling = Some(Sampling { shown, total: found.count });
        }
        let outputs = points.map_or(vec![], |files| files.outputs(&document.scale));
        let scene = self.view.then(|| {
            let mesh = measured.mesh.filter(|_| kind == MeasuredKind::Vertices);
            Box::new(Compared { mesh, opened, found }) as Box<dyn Scene<CompareDocument>>
        });
        Ok(Done { scene, outputs, ..Done::new(document) })
    }
}

impl CompareRequest {
    /// Begins the files of points, in color where the scale is known beforehand.
    fn point_files(&self, ready: &Prepared) -> Result<Option<PointFiles>, WriteError> {
        let Some(path) = &self.out else { return Ok(None) };
        let options = &ready.options;
        let judged = options.tolerance.filter(|_| options.regions.is_empty());
        let of_tolerance = || judged.map(|t| Scale::for_deviations(0.0, Some([t.lower, t.upper])));
        let scale = ready.scale.clone().or_else(of_tolerance);
        let reasons = options.facing.is_some() || options.outliers.is_some() || options.along.is_some();
        let numbers = |faces: &CadFaces| faces.faces.iter().map(|face| face.entity).collect();
        let faces = ready.opened.iter().map(|opened| opened.faces().map_or(vec![], numbers)).collect();
        PointFiles::create(path, faces, scale, reasons).map(Some)
    }
}

/// What the report draws: the measured and the references, each with its deviations.
struct Compared {
    /// The measured mesh, where its vertices are what was compared.
    mesh: Option<Mesh>,
    opened: Vec<Opened>,
    found: Comparisons,
}

impl Scene<CompareDocument> for Compared {
    fn draw(
        &self,
        document: &CompareDocument,
        page: &mut dyn FnMut(&[ViewObject], &[Marks]) -> Result<(), TaskError>,
    ) -> Result<(), TaskError> {
        let (name, files) = (&document.inputs[0].path, &document.inputs[1..]);
        let references = references::named(&self.opened, files);
        let view = drawing::View::new(name, self.mesh.as_ref(), &references, &self.found);
        page(&view.objects(), &view.marks(document))
    }
}
