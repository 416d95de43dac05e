//! Why a task has no answer.

use std::error::Error;
use std::fmt::Display;
use trueness_files::{ReadError, WriteError};
use trueness_geom::progress::Cancelled;

/// What kind of reason it is: what a script or a server has to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// The question is wrong: values that do not go together, or do not go with the files.
    Usage,
    /// The question cannot be answered: what was read does not allow it, or an output cannot be written.
    Unanswerable,
    /// The watcher stopped it.
    Cancelled,
}

/// Why a task has no answer: a sentence with file, place and remedy, and what led to it.
///
/// [`Error::source`] leads from cause to cause.
#[derive(Debug, thiserror::Error)]
#[error("{text}")]
pub struct TaskError {
    kind: ErrorKind,
    text: String,
    #[source]
    source: Option<Box<dyn Error + Send + Sync>>,
}

impl TaskError {
    /// The question is wrong.
    pub fn usage(text: impl Into<String>) -> TaskError {
        TaskError { kind: ErrorKind::Usage, text: text.into(), source: None }
    }

    /// An option has a value that it does not take; `what` begins with its name and the value.
    pub fn option(what: impl Display) -> TaskError {
        TaskError::usage(format!("--{what}"))
    }

    /// There is no answer, for a reason in words.
    pub fn unanswerable(text: impl Into<String>) -> TaskError {
        TaskError { kind: ErrorKind::Unanswerable, text: text.into(), source: None }
    }

    /// There is no answer, for this reason.
    pub fn because(reason: impl Error + Send + Sync + 'static) -> TaskError {
        TaskError { kind: ErrorKind::Unanswerable, text: reason.to_string(), source: Some(Box::new(reason)) }
    }

    /// The same with what it means, of which it then is the cause.
    pub fn context(self, text: impl Display) -> TaskError {
        TaskError { kind: self.kind, text: text.to_string(), source: Some(Box::new(self)) }
    }

    /// What kind of reason it is.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }
}

/// An error and what led to it, a text each; what only repeats its cause is told once.
pub fn causes(error: &(dyn Error + 'static)) -> Vec<String> {
    let mut all: Vec<String> = vec![];
    let mut last: Option<String> = None;
    let mut next = Some(error);
    while let Some(error) = next {
        let text = error.to_string();
        // Transparent wrappers repeat their cause.
        if last.as_ref().is_none_or(|last| !last.contains(&text)) {
            all.push(text.clone());
        }
        (last, next) = (Some(text), error.source());
    }
    all
}

/// What an error means.
pub trait Meaning<T> {
    /// The same with a sentence for what the error means, of which it then is the cause.
    ///
    /// # Errors
    /// Those of the result.
    fn meaning(self, text: impl FnOnce() -> String) -> Result<T, TaskError>;
}

impl<T, E: Error + Send + Sync + 'static> Meaning<T> for Result<T, E> {
    fn meaning(self, text: impl FnOnce() -> String) -> Result<T, TaskError> {
        self.map_err(|e| TaskError {
            kind: (&e as &dyn std::any::Any)
                .downcast_ref()
                .map_or(ErrorKind::Unanswerable, |e: &TaskError| e.kind),
            text: text(),
            source: Some(Box::new(e)),
        })
    }
}

fn kind(wrong_usage: bool) -> ErrorKind {
    if wrong_usage { ErrorKind::Usage } else { ErrorKind::Unanswerable }
}

impl From<ReadError> for TaskError {
    fn from(e: ReadError) -> TaskError {
        TaskError { kind: kind(e.fault.is_wrong_usage()), ..TaskError::because(e) }
    }
}

impl From<WriteError> for TaskError {
    fn from(e: WriteError) -> TaskError {
        TaskError { kind: kind(e.fault.is_wrong_usage()), ..TaskError::because(e) }
    }
}

impl From<Cancelled> for TaskError {
    fn from(e: Cancelled) -> TaskError {
        TaskError { kind: ErrorKind::Cancelled, ..TaskError::because(e) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_context_keeps_the_kind_and_the_causes() {
        let error = TaskError::from(Cancelled).context("part.stl: cannot be checked");
        assert_eq!(
            (error.kind(), error.to_string().as_str()),
            (ErrorKind::Cancelled, "part.stl: cannot be checked")
        );
        assert_eq!(error.source().unwrap().to_string(), Cancelled.to_string());
        assert_eq!(causes(&error), ["part.stl: cannot be checked".to_string(), Cancelled.to_string()]);
        assert_eq!(causes(&TaskError::because(Cancelled)), [Cancelled.to_string()]);
        assert_eq!(TaskError::usage("--gap -1: give a number from 0 upwards").kind(), ErrorKind::Usage);
    }
}
