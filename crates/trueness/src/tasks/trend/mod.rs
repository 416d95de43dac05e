//! One plan over many parts: capability, control limits, maps.

mod csv;

use crate::read;
use crate::task::{Done, Output, Page, Request, RunFiles, Scene, TaskError, Watch};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use trueness_document::ResultDocument;
use trueness_document::inspect::{self, InspectDocument};
use trueness_document::trend::{ResultInput, TrendDocument, TrendError};
use trueness_files::Sources;
use trueness_report::MapPage;
use trueness_report::views::trend::View;

/// Longest result that is read, bytes.
const LONGEST_RESULT: usize = 256 << 20;

/// What a trend is asked.
///
/// ```
/// use trueness::task::Request;
/// use trueness::tasks::{inspect::InspectRequest, trend::TrendRequest};
/// use trueness::{files::MemorySources, geom::progress::Silent};
/// let plan = r#"
/// schema = "trueness/plan/1"
/// measured = "part.xyz"
/// [[feature]]
/// id = "A"
/// shape = "plane"
/// points = "part.xyz"
/// [[characteristic]]
/// id = "1"
/// kind = "flatness"
/// feature = "A"
/// tolerance = 0.05
/// "#;
/// let mut sources = MemorySources::new();
/// sources.insert("plan.toml", plan);
/// for (part, height) in [("first.json", 0.01), ("second.json", 0.02), ("third.json", 0.03)] {
///     sources.insert("part.xyz", format!("0 0 0\n9 0 0\n0 9 0\n9 9 0\n4 4 {height}\n"));
///     let request = InspectRequest { plan: "plan.toml".into(), ..InspectRequest::default() };
///     sources.insert(part, request.run(&sources, &Silent)?.json()?);
/// }
/// let results = ["first.json", "second.json", "third.json"].map(Into::into).into();
/// let done = TrendRequest { results, ..TrendRequest::default() }.run(&sources, &Silent)?;
/// assert_eq!(done.document.characteristics[0].measured, 3);
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TrendRequest {
    /// Results of inspections by one plan, one part each, in the order in which the parts were made.
    pub results: Vec<PathBuf>,
    /// Where to write the characteristics as a table, one line each.
    pub csv: Option<PathBuf>,
}

impl Request for TrendRequest {
    type Document = TrendDocument;
    const COMMAND: &'static str = "trend";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        Ok(RunFiles::of(&self.results).also("--csv", self.csv.as_ref()))
    }

    fn answer(&self, sources: &dyn Sources, _: &dyn Watch) -> Result<Done<TrendDocument>, TaskError> {
        let read = self.results.iter().map(|path| result(sources, path));
        let (inputs, results): (Vec<_>, Vec<_>) =
            read.collect::<Result<Vec<_>, TaskError>>()?.into_iter().unzip();
        let document = trueness_measure::trend::document(inputs, &results).map_err(|e| match &e {
            TrendError::Different { index, .. }
            | TrendError::Twice { index, .. }
            | TrendError::Changed { index, .. } => {
                TaskError::unanswerable(format!("{}: {e}", self.results[*index].display()))
            }
            TrendError::None => TaskError::usage(e.to_string()),
        })?;
        let mut done = Done::new(document);
        if let Some(path) = &self.csv {
            let text = csv::csv(&done.document);
            done.outputs.push(Output::written(path, |file| file.write_all(&text))?);
        }
        Ok(done)
    }
}

/// The remedy for a file that is no result.
const GIVE_A_RESULT: &str = "give the result as `trueness inspect --json` wrote it";

/// A result of an inspection and what it was read from.
fn result(sources: &dyn Sources, path: &Path) -> Result<(ResultInput, InspectDocument), TaskError> {
    let shown = path.display();
    let wrong = |what: String| TaskError::unanswerable(format!("{shown}: {what}"));
    if sources.is_stream(path) {
        return Err(wrong("a result must be a file; save it and name that".into()));
    }
    let bytes = read::bytes(sources, path, "result", LONGEST_RESULT)?.ok_or_else(|| {
        wrong(format!("it is longer than 256 MB, and so no result of an inspection; {GIVE_A_RESULT}"))
    })?;
    let value: serde_json::Value =
        serde_json::from_slice(&bytes).map_err(|e| wrong(format!("it is no JSON ({e}); {GIVE_A_RESULT}")))?;
    let schema = value.get("schema").and_then(|s| s.as_str()).unwrap_or_default().to_string();
    if schema != inspect::SCHEMA {
        let wanted = inspect::SCHEMA;
        let is = match schema.is_empty() {
            true => "it has no schema".into(),
            false => format!("its schema is \"{schema}\", not \"{wanted}\""),
        };
        return Err(wrong(format!("{is}; {GIVE_A_RESULT}")));
    }
    let document: InspectDocument = serde_json::from_value(value)
        .map_err(|e| wrong(format!("it is no whole result ({e}); {GIVE_A_RESULT}")))?;
    let input = ResultInput {
        path: shown.to_string(),
        format: schema,
        bytes: bytes.len() as u64,
        sha256: read::digest(sources, path),
        unit_assumed: document.units.clone(),
    };
    Ok((input, document))
}

/// The page of the maps of mean and spread over the part, with what it draws.
///
/// # Errors
/// Results without deviations at places have none.
pub fn maps(document: &TrendDocument) -> Result<Done<MapPage<'_>>, TaskError> {
    let (Some(page), Some(map)) = (MapPage::of(document), &document.map) else {
        let why = document.map_reason.as_deref().unwrap_or("there are no places");
        return Err(TaskError::unanswerable(format!("there is no map: {why}")));
    };
    Ok(Done {
        scene: Some(Box::new(Mapped(View::new(map)))),
        ..Done::with_outcome(page, document.conforms().into())
    })
}

/// The part in the colors of mean and spread.
struct Mapped(View);

impl Scene<MapPage<'_>> for Mapped {
    fn draw<'a>(&self, _: &MapPage<'_>, page: &'a mut Page<'a>) -> Result<(), TaskError> {
        page(&self.0.objects(), &[])
    }
}
