//! Is this mesh sound, and if not, where not?

use crate::read::cad::Chord;
use crate::read::{self, MeshOrCad};
use crate::task::{
    Done, Reading, Request, RunFiles, STEPS, Scene, TaskError, Watch, ended, not_negative, share_of_percent,
    up_to, welding,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use trueness_document::check::CheckDocument;
use trueness_document::{InputRecord, Role};
use trueness_files::cad::CadFile;
use trueness_files::{ReadOptions, SourceMesh, Sources};
use trueness_geom::check::{self, CheckError, Options};
use trueness_measure::drawn_faces::DrawnFaces;
use trueness_measure::file_numbers::LeftOut;
use trueness_measure::model_check;
use trueness_report::views::check::View;
use trueness_report::{Marks, ViewObject};

/// What a check is asked.
///
/// ```
/// use trueness::task::{Outcome, Request};
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::check::CheckRequest};
/// let request = CheckRequest { mesh: "../../corpus/broken/hole_one_triangle.stl".into(), ..CheckRequest::default() };
/// let done = request.run(&FileSources, &Silent)?;
/// assert_eq!(done.outcome, Outcome::NotConforming);
/// assert_eq!(done.document.defects["holes"].count, Some(1));
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CheckRequest {
    /// The mesh or the CAD model.
    pub mesh: PathBuf,
    /// How it is taken.
    #[serde(flatten)]
    pub reading: Reading,
    /// Distance up to which two places may have been meant as one, mm; without it eight steps of single precision.
    pub gap: Option<f64>,
    /// Join vertices within this distance before looking, mm; without it those at the same place.
    pub weld: Option<f64>,
    /// Facets with a smaller angle than this are slivers, degrees.
    pub sliver_angle: f64,
    /// Shells with a smaller diagonal than this share of the whole are islands, percent.
    pub island: f64,
    /// Do not look for self-intersections.
    pub no_self_intersections: bool,
    /// Defects of each kind to list in the document; all are counted.
    pub items: usize,
    /// Keep what a report draws.
    pub view: bool,
}

impl Default for CheckRequest {
    fn default() -> CheckRequest {
        CheckRequest {
            mesh: PathBuf::new(),
            reading: Reading::default(),
            gap: None,
            weld: None,
            sliver_angle: 0.1,
            island: 1.0,
            no_self_intersections: false,
            items: 1000,
            view: false,
        }
    }
}

impl CheckRequest {
    fn options(&self) -> Result<Options, TaskError> {
        Ok(Options {
            limit: self.items,
            self_intersections: !self.no_self_intersections,
            gap: self.gap.map(|x| not_negative("gap", x)).transpose()?,
            // The least angle of a facet is at most that of an equilateral one.
            sliver_angle: up_to(60.0, "degrees", "sliver-angle", self.sliver_angle)?.to_radians(),
            island_share: share_of_percent("island", self.island)?,
        })
    }
}

impl Request for CheckRequest {
    type Document = CheckDocument;
    const COMMAND: &'static str = "check";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        Ok(RunFiles::of([&self.mesh]))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<CheckDocument>, TaskError> {
        let options = self.options()?;
        let reading = ReadOptions { weld: welding(self.weld)?, ..self.reading.options() };
        let (body, mut record) = read::mesh_or_cad(sources, &self.mesh, Role::Mesh, &reading)?;
        let source = match body {
            MeshOrCad::Mesh(source) => source,
            MeshOrCad::Cad(file) => return self.model(&file, record, sources, watch),
        };
        let facets = source.mesh.faces.len() as u64;
        let stage = watch.stage("checking", "facets", Some(facets));
        let (hash, report) = rayon::join(
            || read::hash(sources, &mut record, &self.mesh),
            || check::check(&source.mesh, source.stored_normals.as_deref(), &options, &*stage),
        );
        let report = ended(stage, report).map_err(|e| match e {
            CheckError::Cancelled(e) => e.into(),
            e => TaskError::unanswerable(format!("{}: {e}", self.mesh.display())),
        })?;
        hash?;
        let left_out = LeftOut(&source.nonfinite_facets);
        let document = trueness_measure::check::document(&report, record, facets, left_out, &options);
        let scene = Checked { source, faces: None };
        let scene = self.view.then(|| Box::new(scene) as Box<dyn Scene<CheckDocument>>);
        Ok(Done { scene, ..Done::new(document) })
    }
}

/// Pairs of facets of a model that are looked at for faces that cross.
const MAX_CROSSING_PAIRS: usize = 100_000;

impl CheckRequest {
    /// Refuses what is asked of facets alone.
    fn only_of_models(&self) -> Result<(), TaskError> {
        let default = CheckRequest::default();
        let asked = [
            ("gap", self.gap.is_some()),
            ("weld", self.weld.is_some()),
            ("sliver-angle", self.sliver_angle != default.sliver_angle),
            ("island", self.island != default.island),
        ];
        let Some((name, _)) = asked.into_iter().find(|(_, is_asked)| *is_asked) else { return Ok(()) };
        let shown = self.mesh.display();
        Err(TaskError::option(format!(
            "{name}: it is about facets, and {shown} holds a CAD model; leave it out"
        )))
    }

    /// The check of a CAD model: what its faces and edges say, and the crossings of their facets.
    fn model(
        &self,
        file: &CadFile,
        mut record: InputRecord,
        sources: &dyn Sources,
        watch: &dyn Watch,
    ) -> Result<Done<CheckDocument>, TaskError> {
        self.only_of_models()?;
        let options = Options { limit: MAX_CROSSING_PAIRS, ..self.options()? };
        let stage = watch.stage("preparing the faces", STEPS, None);
        let (shape, drawn) = read::cad::drawn(&self.mesh, file, Chord::MEASURED, &mut record, &*stage)?;
        let integrals = shape.integrals(&*stage)?;
        stage.finish();
        let facets = drawn.mesh.faces.len() as u64;
        let stage = watch.stage("checking", "facets", Some(facets));
        let report = check::check(&drawn.mesh, None, &options, &*stage);
        let report = ended(stage, report).map_err(|e| match e {
            CheckError::Cancelled(e) => e.into(),
            e => TaskError::unanswerable(format!("{}: {e}", self.mesh.display())),
        })?;
        read::hash(sources, &mut record, &self.mesh)?;
        let checked = model_check::Checked {
            model: &file.model,
            shape: &shape,
            integrals: &integrals,
            drawn: &drawn,
            of_facets: &report,
        };
        let document = model_check::document(&checked, record, self.items);
        let faces = DrawnFaces::new(&shape.brep, &drawn.mesh, drawn.faces);
        let source = SourceMesh { mesh: drawn.mesh, ..SourceMesh::default() };
        let scene = Checked { source, faces: Some(faces) };
        let scene = self.view.then(|| Box::new(scene) as Box<dyn Scene<CheckDocument>>);
        Ok(Done { scene, ..Done::new(document) })
    }
}

/// The mesh with its defects; of a CAD model with its faces.
struct Checked {
    source: SourceMesh,
    faces: Option<DrawnFaces>,
}

impl Scene<CheckDocument> for Checked {
    fn draw(
        &self,
        document: &CheckDocument,
        page: &mut dyn FnMut(&[ViewObject], &[Marks]) -> Result<(), TaskError>,
    ) -> Result<(), TaskError> {
        let left_out = LeftOut(&self.source.nonfinite_facets);
        let view = View::new(document, &document.inputs[0].path, &self.source.mesh, left_out);
        let view = view.with_faces(self.faces.as_ref());
        page(&view.objects(), &view.marks)
    }
}
