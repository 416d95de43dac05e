//! Is this mesh sound, and if not, where not?

use crate::read;
use crate::task::{
    Done, Reading, Request, RunFiles, Scene, TaskError, Watch, ended, not_negative, share_of_percent, up_to,
    welding,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use trueness_document::Role;
use trueness_document::check::CheckDocument;
use trueness_files::{ReadOptions, SourceMesh, Sources};
use trueness_geom::check::{self, CheckError, Options};
use trueness_measure::file_numbers::LeftOut;
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
    /// The mesh: STL, PLY, OBJ, OFF.
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

    fn run(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<CheckDocument>, TaskError> {
        let options = self.options()?;
        let reading = ReadOptions { weld: welding(self.weld)?, ..self.reading.options() };
        let (source, mut record) = read::mesh(sources, &self.mesh, Role::Mesh, &reading)?;
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
        let mut document = trueness_measure::check::document(&report, record, facets, left_out, &options);
        // Of a CAD model without some of its faces no more than the others was looked at.
        document.sound &= document.inputs.iter().all(|i| i.cad.is_none() || i.incomplete.is_none());
        let scene = self.view.then(|| Box::new(Checked(source)) as Box<dyn Scene<CheckDocument>>);
        Ok(Done { scene, ..Done::new(document) })
    }
}

/// The mesh with its defects.
struct Checked(SourceMesh);

impl Scene<CheckDocument> for Checked {
    fn draw(
        &self,
        document: &CheckDocument,
        page: &mut dyn FnMut(&[ViewObject], &[Marks]) -> Result<(), TaskError>,
    ) -> Result<(), TaskError> {
        let left_out = LeftOut(&self.0.nonfinite_facets);
        let view = View::new(document, &document.inputs[0].path, &self.0.mesh, left_out);
        page(&view.objects(), &view.marks)
    }
}
