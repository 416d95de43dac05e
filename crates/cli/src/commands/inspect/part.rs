//! The parts of a run, and what keeps one from its results.

use crate::console;
use trueness::task::TaskError;
use trueness_document::inspect::{InspectDocument, PlanRecord};

/// A part that was to be inspected.
pub enum Part {
    /// With its results.
    Inspected(Box<InspectDocument>),
    /// Without.
    Failed(Failed),
}

/// A part without results.
pub struct Failed {
    /// What distinguishes it: its measured file, or the plan's.
    pub name: String,
    /// Why there are none, in one text.
    pub why: String,
    /// The plan.
    pub plan: PlanRecord,
}

/// What keeps a part from its results.
pub enum Fault {
    /// What is of this part: others may be inspected all the same.
    Part(anyhow::Error),
    /// What is of all parts, or that the run was stopped.
    Run(anyhow::Error),
}

impl From<anyhow::Error> for Fault {
    fn from(error: anyhow::Error) -> Fault {
        Fault::Run(error)
    }
}

impl From<TaskError> for Fault {
    fn from(error: TaskError) -> Fault {
        Fault::Run(error.into())
    }
}

impl Part {
    /// Its results.
    pub fn document(&self) -> Option<&InspectDocument> {
        match self {
            Part::Inspected(document) => Some(document),
            Part::Failed(_) => None,
        }
    }

    /// What distinguishes it: its measured file, or the plan's.
    pub fn name(&self) -> &str {
        match self {
            Part::Inspected(document) => name(document),
            Part::Failed(failed) => &failed.name,
        }
    }
}

impl Failed {
    /// A part that has no results for this error.
    pub fn new(name: String, error: &anyhow::Error, plan: PlanRecord) -> Failed {
        Failed { name, why: console::causes(error).join("; "), plan }
    }
}

/// What distinguishes the part of a document.
pub fn name(document: &InspectDocument) -> &str {
    document.inputs.first().map_or(&document.plan.path, |i| &i.path)
}
