//! What a task answers.

use super::{ErrorKind, Output, TaskError, Watch, ended};
use serde::Serialize;
use std::path::PathBuf;
use trueness_document::ResultDocument;
use trueness_report::{self as report, Marks, ReportError, ReportInput, ReportOptions, Subject, ViewObject};

/// What a task that ran to its end found: what its exit status, the head of its page and a server's status say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Done and conforming.
    Conforming,
    /// Done, but out of tolerance, not sound or undecided.
    NotConforming,
    /// Some of what was asked has no answer, for a reason of this kind.
    Unanswered(ErrorKind),
}

impl From<bool> for Outcome {
    fn from(conforming: bool) -> Outcome {
        if conforming { Outcome::Conforming } else { Outcome::NotConforming }
    }
}

/// What the format of a file could not hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounding {
    /// The file.
    pub path: PathBuf,
    /// How far its format moves a place at most, mm.
    pub farthest: f64,
}

/// Takes what a report draws.
pub type Page<'a> = dyn FnMut(&[ViewObject], &[Marks]) -> Result<(), TaskError> + 'a;

/// What the report of a document draws, where the request asked for it.
pub trait Scene<D>: Send {
    /// Hands over meshes, clouds and marks.
    ///
    /// # Errors
    /// Those of `page`.
    fn draw<'a>(&self, document: &D, page: &'a mut Page<'a>) -> Result<(), TaskError>;
}

/// Measured points that are kept for a report at most.
pub const REPORT_POINTS: usize = 1_000_000;

/// What a task answers. Files that were asked for are in their places after [`Done::commit`]; without it there are none.
pub struct Done<D> {
    /// The result document.
    pub document: D,
    /// Whether it conforms.
    pub outcome: Outcome,
    /// What its report draws.
    pub scene: Option<Box<dyn Scene<D>>>,
    /// What the formats of files could not hold.
    pub losses: Vec<Rounding>,
    /// Files that were asked for.
    pub outputs: Vec<Output>,
}

impl<D: ResultDocument> Done<D> {
    /// A document, which says the outcome, without anything beside it.
    pub fn new(document: D) -> Done<D> {
        let outcome = document.conforms().into();
        Done::with_outcome(document, outcome)
    }
}

impl<D> Done<D> {
    /// What is no result document, with its outcome.
    pub fn with_outcome(document: D, outcome: Outcome) -> Done<D> {
        Done { document, outcome, scene: None, losses: vec![], outputs: vec![] }
    }

    /// Puts the files in their places, in the order in which they were asked for.
    ///
    /// # Errors
    /// Those of writing; files before the one that fails are in their places.
    pub fn commit(&mut self) -> Result<(), TaskError> {
        self.outputs.drain(..).try_for_each(|output| Ok(output.commit()?))
    }
}

impl<D: Serialize> Done<D> {
    /// The document as the text of its file.
    ///
    /// # Errors
    /// A document that is no JSON, which none is.
    pub fn json(&self) -> Result<String, TaskError> {
        super::json(&self.document)
    }
}

impl<D: Subject> Done<D> {
    /// The report, one HTML page.
    ///
    /// # Errors
    /// [`ReportError`]; cancelled.
    pub fn report(&self, options: &ReportOptions, watch: &dyn Watch) -> Result<Vec<u8>, TaskError> {
        let mut page = None;
        let mut write = |objects: &[ViewObject], marks: &[Marks]| {
            page = Some(write(&self.document, objects, marks, options, watch)?);
            Ok(())
        };
        match &self.scene {
            Some(scene) => scene.draw(&self.document, &mut write)?,
            None => write(&[], &[])?,
        }
        page.ok_or_else(|| TaskError::unanswerable("the report draws nothing"))
    }
}

/// A report as bytes.
fn write(
    result: &dyn Subject,
    objects: &[ViewObject],
    marks: &[Marks],
    options: &ReportOptions,
    watch: &dyn Watch,
) -> Result<Vec<u8>, TaskError> {
    let input = ReportInput { result, objects, marks, options };
    let stage = watch.stage("writing the report", "places", Some(report::work(objects)));
    let mut page = vec![];
    let written = report::write(&input, &*stage, &mut page);
    ended(stage, written).map_err(|e| match e {
        ReportError::Cancelled(e) => e.into(),
        e => TaskError::because(e),
    })?;
    Ok(page)
}
