//! A plan proposed from the nominal.

use crate::read;
use crate::task::{Done, Outcome, Output, Reading, Request, RunFiles, TaskError, Watch, ended};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use trueness_document::{InputRecord, Role};
use trueness_files::Sources;
use trueness_files::cad::CadFile;
use trueness_geom::mesh::Mesh;
use trueness_geom::segment::{self, Options, SegmentError};
use trueness_measure::inspection::Data;
use trueness_measure::proposal::{self, General, Proposal};

/// What a proposal is asked.
///
/// ```
/// use trueness::task::Request;
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::plan_init::PlanInitRequest};
/// let request = PlanInitRequest { nominal: "../../corpus/shapes/mayo__258_cube.off".into(), ..PlanInitRequest::default() };
/// let plan = request.run(&FileSources, &Silent)?.document;
/// assert_eq!(plan.text.matches("shape = \"plane\"").count(), 6);
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PlanInitRequest {
    /// The nominal: a CAD model with or without tolerances, or a mesh.
    pub nominal: PathBuf,
    /// How it is taken.
    #[serde(flatten)]
    pub reading: Reading,
    /// General tolerances for what a CAD model states none for, as `ISO2768-mK`.
    pub general: Option<String>,
    /// Where to write the plan: a new file.
    pub out: Option<PathBuf>,
    /// Seed of everything random.
    pub seed: u64,
}

/// A proposed plan.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ProposedPlan {
    /// The file read.
    pub inputs: Vec<InputRecord>,
    /// The plan, a text in TOML.
    pub text: String,
}

impl Request for PlanInitRequest {
    type Document = ProposedPlan;
    const COMMAND: &'static str = "plan init";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        Ok(RunFiles::of([&self.nominal]).also("--out", self.out.as_ref()))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<ProposedPlan>, TaskError> {
        // A plan is written by hand in the end: it is never replaced.
        if let Some(path) = self.out.as_ref().filter(|path| path.exists()) {
            let text = format!("--out {}: the file exists; name another or remove it", path.display());
            return Err(TaskError::usage(text));
        }
        let general = self.general.as_ref().map(|text| text.parse::<General>());
        let general = general.transpose().map_err(|e| TaskError::usage(format!("--general: {e}")))?;
        let reading = self.reading.options();
        let (text, mut record) = match read::mesh_or_cad(sources, &self.nominal, Role::Reference, &reading)? {
            (read::MeshOrCad::Cad(file), record) => self.of_model(&file, record, general.as_ref(), watch)?,
            (read::MeshOrCad::Mesh(_), _) if general.is_some() => {
                let what = "--general is for CAD models: of a mesh the faces are not known exactly";
                return Err(TaskError::usage(what));
            }
            (read::MeshOrCad::Mesh(source), record) => (self.of_mesh(&source.mesh, watch)?, record),
        };
        read::hash(sources, &mut record, &self.nominal)?;
        let mut done = Done::with_outcome(ProposedPlan { inputs: vec![record], text }, Outcome::Conforming);
        if let Some(path) = &self.out {
            let text = done.document.text.as_bytes();
            done.outputs.push(Output::written(path, |file| file.write_all(text))?);
        }
        Ok(done)
    }
}

impl PlanInitRequest {
    /// The plan for a CAD model, and what is said of its file.
    fn of_model(
        &self,
        file: &CadFile,
        mut record: InputRecord,
        general: Option<&General>,
        watch: &dyn Watch,
    ) -> Result<(String, InputRecord), TaskError> {
        let stage = watch.stage("proposing", "faces", None);
        let read = read::faces(&self.nominal, file, &mut record, &*stage)?;
        let data = Data { reference: Some(read.1), faces: Some(Arc::new(read.0)), ..Data::default() };
        let asked = Proposal { reference: &self.reference(), general };
        let text = proposal::of_model(&file.model, &data, &asked, &*stage);
        Ok((ended(stage, text).map_err(TaskError::from)?, record))
    }

    /// The plan for the elements of a mesh.
    fn of_mesh(&self, mesh: &Mesh, watch: &dyn Watch) -> Result<String, TaskError> {
        let stage = watch.stage("segmenting", "facets", Some(mesh.faces.len() as u64));
        let options = Options { seed: self.seed, ..Options::default() };
        let found = segment::mesh(mesh, &options, &*stage);
        let found = ended(stage, found).map_err(|e| match e {
            SegmentError::Cancelled(e) => e.into(),
            e => TaskError::unanswerable(format!("{}: {e}", self.nominal.display())),
        })?;
        Ok(proposal::of_mesh(mesh, &found, &self.reference()))
    }

    /// The nominal as the plan names it: relative to its folder where it lies beside it.
    fn reference(&self) -> String {
        let folder = |path: &Path| match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.canonicalize().ok(),
            _ => Path::new(".").canonicalize().ok(),
        };
        let beside = self.out.as_ref().is_none_or(|out| folder(out) == folder(&self.nominal));
        let name = match beside {
            true => self.nominal.file_name().map(PathBuf::from),
            false => self.nominal.canonicalize().ok(),
        };
        name.unwrap_or_else(|| self.nominal.clone()).to_string_lossy().into_owned()
    }
}
