//! The tasks: a request as JSON and bytes under names in, a document out.

use crate::{errors, work};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::PyBytes;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use trueness::files::{Fault, FileSources, MemorySources, SourceBytes, Sources};
use trueness::geom::progress::Silent;
use trueness::report::{Language, ReportOptions, Subject};
use trueness::task::{Done, ErrorKind, Outcome, Request, TaskError, Watch};
use trueness::tasks::{
    align, check, compare, convert, curvature, fit, info, inspect, plan_init, repair, section, segment,
    surface, trend,
};

/// Bytes in memory by their names, files by theirs.
struct Inputs {
    memory: MemorySources,
    names: BTreeSet<PathBuf>,
}

impl Inputs {
    fn of(&self, name: &Path) -> &dyn Sources {
        if self.names.contains(name) { &self.memory } else { &FileSources }
    }
}

impl Sources for Inputs {
    fn bytes(&self, name: &Path) -> Result<SourceBytes, Fault> {
        self.of(name).bytes(name)
    }
    fn is_stream(&self, name: &Path) -> bool {
        self.of(name).is_stream(name)
    }
    fn length(&self, name: &Path) -> Option<u64> {
        self.of(name).length(name)
    }
    fn shown(&self, name: &Path) -> String {
        self.of(name).shown(name)
    }
}

/// What a task found.
trait Found: Send {
    fn json(&self) -> Result<String, TaskError>;
    fn status(&self) -> u8;
    fn report(&self, options: &ReportOptions) -> Result<Vec<u8>, TaskError>;
}

/// What has no page.
struct Plain<D>(Done<D>);

impl<D: Subject + serde::Serialize + Send> Found for Done<D> {
    fn json(&self) -> Result<String, TaskError> {
        Done::json(self)
    }
    fn status(&self) -> u8 {
        status(self.outcome)
    }
    fn report(&self, options: &ReportOptions) -> Result<Vec<u8>, TaskError> {
        Done::report(self, options, &Silent)
    }
}

impl<D: serde::Serialize + Send> Found for Plain<D> {
    fn json(&self) -> Result<String, TaskError> {
        self.0.json()
    }
    fn status(&self) -> u8 {
        status(self.0.outcome)
    }
    fn report(&self, _: &ReportOptions) -> Result<Vec<u8>, TaskError> {
        Err(TaskError::usage("this task has no report; save the document as .json"))
    }
}

/// The exit status of the program with this outcome.
fn status(outcome: Outcome) -> u8 {
    match outcome {
        Outcome::Conforming => 0,
        Outcome::NotConforming => 1,
        Outcome::Unanswered(ErrorKind::Usage) => 2,
        Outcome::Unanswered(_) => 3,
    }
}

/// A task by the text of its request.
type Run = fn(&str, &dyn Sources, &dyn Watch) -> Result<Box<dyn Found>, TaskError>;

/// The tasks by their names in Python.
const TASKS: [(&str, Run); 14] = [
    ("align", plain::<align::AlignRequest>),
    ("check", reported::<check::CheckRequest>),
    ("compare", reported::<compare::CompareRequest>),
    ("convert", plain::<convert::ConvertRequest>),
    ("curvature", reported::<curvature::CurvatureRequest>),
    ("fit", reported::<fit::FitRequest>),
    ("info", plain::<info::InfoRequest>),
    ("inspect", reported::<inspect::InspectRequest>),
    ("plan_init", plain::<plan_init::PlanInitRequest>),
    ("repair", reported::<repair::RepairRequest>),
    ("section", reported::<section::SectionRequest>),
    ("segment", reported::<segment::SegmentRequest>),
    ("surface", reported::<surface::SurfaceRequest>),
    ("trend", reported::<trend::TrendRequest>),
];

fn reported<R: Request<Document: Subject + Send + 'static>>(
    text: &str,
    sources: &dyn Sources,
    watch: &dyn Watch,
) -> Result<Box<dyn Found>, TaskError> {
    let mut done = request::<R>(text)?.run(sources, watch)?;
    done.commit()?;
    Ok(Box::new(done))
}

fn plain<R: Request<Document: Send + 'static>>(
    text: &str,
    sources: &dyn Sources,
    watch: &dyn Watch,
) -> Result<Box<dyn Found>, TaskError> {
    let mut done = request::<R>(text)?.run(sources, watch)?;
    done.commit()?;
    Ok(Box::new(Plain(done)))
}

/// The request of a text. An error names the argument: the first that cannot be read alone.
fn request<R: DeserializeOwned>(text: &str) -> Result<R, TaskError> {
    serde_json::from_str(text).map_err(|e| {
        let all: Map<String, Value> = serde_json::from_str(text).unwrap_or_default();
        let alone = |(name, value): (String, Value)| {
            let own = Map::from_iter([(name.clone(), value)]);
            serde_json::from_value::<R>(Value::Object(own)).err().map(|e| format!("{name}: {e}"))
        };
        TaskError::usage(all.into_iter().find_map(alone).unwrap_or_else(|| e.to_string()))
    })
}

/// What a task answered: its document, its exit status, its page.
#[pyclass(frozen, module = "trueness._trueness")]
pub struct Answer(Mutex<Box<dyn Found>>);

impl Answer {
    fn with<T: Send>(
        &self,
        py: Python,
        get: impl FnOnce(&mut dyn Found) -> Result<T, TaskError> + Send,
    ) -> PyResult<T> {
        let mut own = work::lock(py, &self.0)?;
        let found: &mut Box<dyn Found> = &mut own;
        work::run(py, None, move |_| get(&mut **found))?.map_err(|e| errors::task(py, &e))
    }
}

#[pymethods]
impl Answer {
    /// The text of the document, as the program writes it.
    #[getter]
    fn json(&self, py: Python) -> PyResult<String> {
        self.with(py, |found| found.json())
    }

    /// The exit status of the program.
    #[getter]
    fn status(&self, py: Python) -> PyResult<u8> {
        self.with(py, |found| Ok(found.status()))
    }

    /// The report, one HTML page, in a language, with the lines of its head.
    fn report<'py>(
        &self,
        py: Python<'py>,
        language: &str,
        budget: usize,
        head: BTreeMap<String, String>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let language = Language::from_code(language)
            .ok_or_else(|| errors::usage(py, format!("language: ‘{language}’ is none of en, de, ru, zh")))?;
        let of = |name: &str| head.get(name).cloned();
        let options = ReportOptions {
            title: of("title"),
            part: of("part"),
            serial: of("serial"),
            operator: of("operator"),
            budget,
            language,
            ..ReportOptions::default()
        };
        Ok(PyBytes::new(py, &self.with(py, |found| found.report(&options))?))
    }
}

/// Runs a task; `memory` are bytes by the names that the request gives them.
#[pyfunction]
pub fn run(
    py: Python,
    task: &str,
    request: &str,
    memory: BTreeMap<String, PyBackedBytes>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Answer> {
    let known = TASKS.iter().find(|(name, _)| *name == task);
    let (_, run) = known.ok_or_else(|| errors::usage(py, format!("there is no task ‘{task}’")))?;
    let names = memory.keys().map(PathBuf::from).collect();
    let inputs = Inputs { memory: memory.into_iter().collect(), names };
    let found = work::run(py, progress.as_ref(), |watcher| run(request, &inputs, watcher))?;
    Ok(Answer(Mutex::new(found.map_err(|e| errors::task(py, &e))?)))
}
