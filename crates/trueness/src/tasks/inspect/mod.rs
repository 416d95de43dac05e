//! A plan and measured parts make verdicts.

mod lists;
mod part;
mod plan_file;
mod qif;
mod scene;

pub use part::{Failed, Part};

use crate::task::{
    Done, Outcome, Output, REPORT_POINTS, Request, RunFiles, STEPS, Scene, TaskError, Watch, ended,
};
use part::Fault;
use plan_file::PlanFile;
use scene::Inspected;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use trueness_document::ResultDocument;
use trueness_document::inspect::InspectDocument;
use trueness_document::plan::PlanError;
use trueness_files::Sources;
use trueness_geom::progress::Cancelled;
use trueness_measure::inspection::{self, Deviations, Stop};

/// What an inspection is asked.
///
/// ```
/// use trueness::task::{Outcome, Request};
/// use trueness::{files::MemorySources, geom::progress::Silent, tasks::inspect::InspectRequest};
/// let mut sources = MemorySources::new();
/// sources.insert("part.xyz", "0 0 0\n9 0 0\n0 9 0\n9 9 0.1\n");
/// sources.insert(
///     "plan.toml",
///     r#"
///     schema = "trueness/plan/1"
///     [[feature]]
///     id = "A"
///     shape = "plane"
///     points = "part.xyz"
///     [[characteristic]]
///     id = "1"
///     kind = "flatness"
///     feature = "A"
///     tolerance = 0.06
///     "#,
/// );
/// let request = InspectRequest { plan: "plan.toml".into(), ..InspectRequest::default() };
/// let done = request.run(&sources, &Silent)?;
/// assert_eq!(done.outcome, Outcome::Conforming);
/// assert!((done.document.characteristics[0].value.unwrap_or(0.0) - 0.05).abs() < 1e-4);
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
///
/// [`Request::run`] answers of one part; of several [`InspectRequest::open`] does.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct InspectRequest {
    /// The plan; paths in it are relative to it.
    pub plan: PathBuf,
    /// Measured meshes or clouds, in place of the plan's own: one part each.
    pub measured: Vec<PathBuf>,
    /// Keep in the document the deviations at places that are the same for every part: for the maps of a trend.
    pub places: bool,
    /// Where to write the characteristics of all parts as a table, one line each.
    pub csv: Option<PathBuf>,
    /// Where to write the verdicts as JUnit XML, for continuous integration.
    pub junit: Option<PathBuf>,
    /// Where to write characteristics, features, values and verdicts as QIF 3.0 results (ISO 23952).
    pub qif: Option<PathBuf>,
    /// Seed of everything random.
    pub seed: u64,
    /// Keep what a report draws; of one part only.
    pub view: bool,
}

impl InspectRequest {
    /// Refuses several parts where an answer holds one.
    ///
    /// # Errors
    /// Wrong usage.
    pub fn one_part(&self) -> Result<(), TaskError> {
        let what =
            "--json and --html hold one part; give one --measured, or --csv, --junit and --qif for all";
        if self.measured.len() > 1 { Err(TaskError::usage(what)) } else { Ok(()) }
    }

    /// Tries the files and reads the plan, by which the parts are inspected one after the other.
    ///
    /// # Errors
    /// Those of [`RunFiles::check`]; a plan that cannot be read or evaluated; values that do not go together, or not with the plan.
    pub fn open<'a>(
        &'a self,
        sources: &'a dyn Sources,
        watch: &'a dyn Watch,
    ) -> Result<Inspecting<'a>, TaskError> {
        self.files(sources)?.check(watch)?;
        self.opened(sources, watch)
    }

    /// Reads the plan.
    fn opened<'a>(
        &'a self,
        sources: &'a dyn Sources,
        watch: &'a dyn Watch,
    ) -> Result<Inspecting<'a>, TaskError> {
        if self.view {
            self.one_part()?;
        }
        let plan = PlanFile::read(sources, &self.plan)?;
        if !self.measured.is_empty() && plan.plan.measured.is_none() {
            let what =
                "--measured replaces the plan's measured data, but the plan names none; add `measured` to it";
            return Err(TaskError::usage(what));
        }
        if self.places && plan.plan.deviation.is_none() {
            let what =
                "--places keeps deviations from the reference, but the plan has no [deviation]; add it";
            return Err(TaskError::usage(what));
        }
        Ok(Inspecting { request: self, plan, sources, watch })
    }
}

impl Request for InspectRequest {
    type Document = InspectDocument;
    const COMMAND: &'static str = "inspect";

    fn files(&self, sources: &dyn Sources) -> Result<RunFiles, TaskError> {
        let mut inputs = vec![self.plan.clone()];
        inputs.extend(self.measured.iter().cloned());
        // What is wrong with the plan is told when it is run; here its files must not be written over.
        if let Ok(plan) = PlanFile::read(sources, &self.plan) {
            inputs.extend(plan.inputs(self.measured.is_empty()));
        }
        Ok(RunFiles::of(&inputs)
            .also("--csv", self.csv.as_ref())
            .also("--junit", self.junit.as_ref())
            .also("--qif", self.qif.as_ref()))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<InspectDocument>, TaskError> {
        self.one_part()?;
        let inspecting = self.opened(sources, watch)?;
        let part = inspecting.inspect_part(self.measured.first().map(PathBuf::as_path))?;
        let outputs = inspecting.lists(std::slice::from_ref(&part))?;
        match part {
            Part::Inspected(done) => Ok(Done { outputs, ..*done }),
            Part::Failed(failed) => Err(failed.error),
        }
    }
}

/// An inspection of one or several parts under way.
pub struct Inspecting<'a> {
    request: &'a InspectRequest,
    plan: PlanFile,
    sources: &'a dyn Sources,
    watch: &'a dyn Watch,
}

impl Inspecting<'_> {
    /// The parts in their order, each inspected when it is asked for. Whatever is wrong with a part, the others are inspected.
    ///
    /// After an error, which is of all parts or says that the run was stopped, no other part has an answer.
    pub fn parts(&self) -> impl Iterator<Item = Result<Part, TaskError>> + '_ {
        let measured = &self.request.measured;
        let own = measured.is_empty().then_some(None);
        own.into_iter()
            .chain(measured.iter().map(|path| Some(path.as_path())))
            .map(move |file| self.inspect_part(file))
    }

    /// The answer of all parts, with the lists of them.
    ///
    /// # Errors
    /// Those of writing.
    pub fn finish(&self, parts: Vec<Part>) -> Result<Done<Vec<Part>>, TaskError> {
        let failed = parts.iter().find_map(|part| match part {
            Part::Failed(failed) => Some(failed.error.kind()),
            Part::Inspected(_) => None,
        });
        let all = || parts.iter().filter_map(Part::document).all(InspectDocument::conforms);
        let outcome = failed.map_or_else(|| all().into(), Outcome::Unanswered);
        Ok(Done { outputs: self.lists(&parts)?, ..Done::with_outcome(parts, outcome) })
    }

    fn lists(&self, parts: &[Part]) -> Result<Vec<Output>, TaskError> {
        let InspectRequest { csv, junit, qif, .. } = self.request;
        let title = self.plan.plan.title.as_deref();
        let mut outputs = vec![];
        let mut write = |path: &Option<PathBuf>, text: &dyn Fn() -> Vec<u8>| {
            let Some(path) = path else { return Ok(()) };
            let text = text();
            outputs.push(Output::written(path, |file| file.write_all(&text))?);
            Ok::<(), TaskError>(())
        };
        write(csv, &|| lists::csv(parts))?;
        write(junit, &|| lists::junit(parts).into_bytes())?;
        write(qif, &|| qif::qif(parts, title).into_bytes())?;
        Ok(outputs)
    }

    /// The part of this file, or of the plan's own.
    fn inspect_part(&self, file: Option<&Path>) -> Result<Part, TaskError> {
        match self.inspect(file) {
            Ok(done) => Ok(Part::Inspected(Box::new(done))),
            Err(Fault::Run(error)) => Err(error),
            Err(Fault::Part(error)) => {
                Ok(Part::Failed(Failed { name: self.plan.name_of(file), error, plan: self.plan.record() }))
            }
        }
    }

    fn inspect(&self, part: Option<&Path>) -> Result<Done<InspectDocument>, Fault> {
        let plan = &self.plan;
        let InspectRequest { places, seed, view, .. } = *self.request;
        let (mut data, inputs) = plan.data(self.sources, part, seed, if view { REPORT_POINTS } else { 0 })?;
        data.places = places;
        let stage = self.watch.stage("inspecting", STEPS, Some(inspection::STEPS));
        let found = inspection::run(&plan.plan, data, &*stage);
        let cancelled = stage.cancelled();
        let found = ended(stage, found).map_err(|stop| match stop {
            // Whatever it stopped at: nothing of it is told.
            _ if cancelled => Fault::Run(Cancelled.into()),
            Stop::Cancelled => Fault::Run(Cancelled.into()),
            Stop::Plan { span, what } => {
                let what = PlanError::at(&plan.text, &span, what);
                Fault::Run(TaskError::unanswerable(format!("{}: {what}", plan.path.display())))
            }
            stop if stop.of_part() => {
                Fault::Part(TaskError::unanswerable(format!("{}: {stop}", plan.name_of(part))))
            }
            stop => Fault::Run(TaskError::unanswerable(format!("{}: {stop}", plan.path.display()))),
        })?;
        let mut document = inspection::document(&plan.plan, plan.record(), &found, inputs);
        document.deviation_map = found.deviations.as_ref().and_then(Deviations::place_map);
        let scene = view.then(|| Box::new(Inspected(found)) as Box<dyn Scene<InspectDocument>>);
        Ok(Done { scene, ..Done::new(document) })
    }
}
