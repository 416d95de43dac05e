//! Exit status: what a script learns from a run.

use crate::{console, signals};
use std::panic::{AssertUnwindSafe, catch_unwind};
use trueness::task::{ErrorKind, Outcome, TaskError};
use trueness_files::WriteError;

/// The exit status of a run that has no answer, or none to some of what was asked.
fn unanswered(kind: ErrorKind) -> u8 {
    match kind {
        ErrorKind::Usage => 2,
        ErrorKind::Unanswerable => 3,
        ErrorKind::Cancelled => signals::status(),
    }
}

/// What the help of a command says at its end: all exit statuses, of which `one` says what 1 means for it, then `rest`.
pub fn help(one: &str, rest: &str) -> String {
    format!(
        "Exit status: 0 done and conforming; 1 done, but {one}; 2 wrong usage; 3 the input could not be read or does not allow \
         an answer; 4 internal error.\n\n{rest}"
    )
}

/// Wrong use of an option that the parser of the command line cannot see.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Usage(pub String);

/// A fault of the program itself.
#[derive(Debug, thiserror::Error)]
#[error("internal error: {0}. Please report it with the command and the files that caused it.")]
pub struct Internal(pub String);

/// Runs `work`; a panic becomes an [`Internal`] error.
pub fn catch(work: impl FnOnce() -> anyhow::Result<Outcome>) -> anyhow::Result<Outcome> {
    std::panic::set_hook(Box::new(|_| {}));
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|cause| {
        let text = cause
            .downcast_ref::<String>()
            .cloned()
            .or_else(|| cause.downcast_ref::<&str>().map(|s| s.to_string()))
            .unwrap_or_else(|| "no message".into());
        Err(Internal(text).into())
    })
}

/// Prints the error, if any, and chooses the exit status.
pub fn code(outcome: anyhow::Result<Outcome>) -> u8 {
    let error = match outcome {
        Ok(Outcome::Conforming) => return 0,
        Ok(Outcome::NotConforming) => return 1,
        Ok(Outcome::Unanswered(kind)) => return unanswered(kind),
        Err(error) => error,
    };
    console::error(error.as_ref());
    status(&error)
}

/// The exit status of a run that ends with this error.
fn status(error: &anyhow::Error) -> u8 {
    let kind = |e: &(dyn std::error::Error + 'static)| {
        let task = || e.downcast_ref().map(TaskError::kind);
        let written = || e.downcast_ref().map(|e: &WriteError| wrong(e.fault.is_wrong_usage()));
        task().or_else(written).or(e.is::<Usage>().then_some(ErrorKind::Usage))
    };
    if error.chain().any(|e| e.is::<Internal>()) {
        return 4;
    }
    unanswered(error.chain().find_map(kind).unwrap_or(ErrorKind::Unanswerable))
}

fn wrong(usage: bool) -> ErrorKind {
    if usage { ErrorKind::Usage } else { ErrorKind::Unanswerable }
}
