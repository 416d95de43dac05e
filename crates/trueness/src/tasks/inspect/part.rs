//! The parts of a run, and what keeps one from its results.

use crate::task::{Done, TaskError, causes};
use trueness_document::inspect::{InspectDocument, PlanRecord};

/// A part that was to be inspected.
pub enum Part {
    /// With its results.
    Inspected(Box<Done<InspectDocument>>),
    /// Without.
    Failed(Failed),
}

/// A part without results.
pub struct Failed {
    /// What distinguishes it: its measured file, or the plan's.
    pub name: String,
    /// Why there are none.
    pub error: TaskError,
    /// The plan.
    pub plan: PlanRecord,
}

/// What keeps a part from its results.
pub(super) enum Fault {
    /// What is of this part: others may be inspected all the same.
    Part(TaskError),
    /// What is of all parts, or that the run was stopped.
    Run(TaskError),
}

impl From<TaskError> for Fault {
    fn from(error: TaskError) -> Fault {
        Fault::Run(error)
    }
}

impl Part {
    /// Its results.
    pub fn document(&self) -> Option<&InspectDocument> {
        match self {
            Part::Inspected(done) => Some(&done.document),
            Part::Failed(_) => None,
        }
    }

    /// What distinguishes it: its measured file, or the plan's.
    pub fn name(&self) -> &str {
        match self {
            Part::Inspected(done) => {
                done.document.inputs.first().map_or(&done.document.plan.path, |i| &i.path)
            }
            Part::Failed(failed) => &failed.name,
        }
    }
}

impl Failed {
    /// Why there are no results, in one text.
    pub fn why(&self) -> String {
        causes(&self.error).join("; ")
    }
}
